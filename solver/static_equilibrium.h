#pragma once
#include <functional>

#include "solver/second_order_system.h"

namespace nurbeam {

struct StaticEquilibrium {
  double tolerance = 1e-10;   ///< on the scaled residual, relative to the largest single force contribution
  int max_iterations = 100;   ///< Newton iterations in one KINSOL call
  int max_load_steps = 400;
};

enum class StaticStatus { converged, not_converged, singular_matrix };

struct StaticReport {
  StaticStatus status = StaticStatus::not_converged;
  int load_steps = 0;
  int newton_iterations = 0;
  double load_factor = 0;     ///< reached
  double residual_norm = 0;
};

/// Equilibrium f(q, 0, t) = G'lambda, g(q, t) = 0 by KINSOL (line search, KLU), in place.
///
/// `set_load_factor(f)`, f in [0, 1], scales the system's loads: when the full load does not converge directly the
/// load is applied in adaptive increments, and where the tangent is singular (a straight or slack cable without
/// tension) each is reached by proximal steps M(q)(q - q_k)/tau^2 + f = 0 with growing tau, which decrease the
/// potential energy. v and a are zero on return.
StaticReport find_static_equilibrium(const StaticEquilibrium& settings, const SecondOrderSystem& system,
                                     const std::function<void(double)>& set_load_factor, State& state);

}  // namespace nurbeam
