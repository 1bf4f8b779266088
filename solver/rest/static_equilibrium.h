#pragma once
#include <functional>

#include "solver/system/second_order_system.h"

namespace nurbeam {

struct StaticEquilibrium {
  double tolerance = 1e-10;  ///< on the scaled residual, relative to the largest single force contribution
  int max_iterations = 100;  ///< limit of Newton iterations in one KINSOL call
  /// Limit of increments, proximal steps and failed attempts together; 1: the full load directly, or nothing.
  int max_load_steps = 400;
  /// Asked at every equilibrium and every proximal step on the way: true ends the search there, to go on from
  /// that state in other coordinates.
  std::function<bool(const State&)> ends_at = {};
};

enum class StaticStatus {
  converged,
  not_converged,
  singular_matrix,
  unstable,          ///< equilibria were found, but no stable one
  lost_in_round_off  ///< the loads are no greater than the round-off of internal forces
};

struct StaticReport {
  StaticStatus status = StaticStatus::not_converged;
  int load_steps = 0;
  int newton_iterations = 0;  ///< also of searches that have not led to the answer
  double load_factor = 0;     ///< load factor reached
  double residual_norm = 0;   ///< scaled as `tolerance` is
  bool leaves_start = false;  ///< the start was an equilibrium that is not stable
  bool diverges =
      /// The equilibrium is left when it is touched: its loads have no energy, and no stable one was found.
      false;
};

/// Equilibrium f(q, 0, t) = G'lambda, g(q, t) = 0 by KINSOL (full Newton steps, then line search; KLU), in
/// place.
///
/// State::load in [0, 1] scales the system's loads. The full load is tried directly, first with full Newton
/// steps. Next the first Newton step is bounded: if it moves a coordinate by more than its
/// coordinate_scale(), it goes only as far as the work of the forces along it leads. This is for a model that
/// is soft only as long as it is as drawn, such as a straight wire.
///
/// The attempt fails if it does not converge, moves a coordinate by more than its coordinate_scale(), or goes
/// against the direction of the tangent at the start. The load is then applied in adaptive increments under
/// the same bounds, so that the branch of equilibria that starts at `state` is followed.
///
/// An equilibrium that is not stable (stability.h) does not count: it is left along its unstable direction.
/// But where loads have no energy and no stable one is found for ten times what an answer costs, one that
/// diverges is accepted. An increment may not converge at all: a straight or slack cable without tension has
/// a singular tangent, a snap-through no equilibrium nearby. A higher load is then reached by proximal steps
/// M(q)(q - q_k)/tau^2 - f + G'lambda = 0 with growing tau, which decrease the potential energy.
///
/// Converged means: no residual is larger than `tolerance` times the largest force (the load or G'lambda,
/// compared as work over coordinate_scale()) or, failing that, than its own round-off. v and a are zero on
/// return. On any status but `converged`, the load is that of the last equilibrium found (the start, when
/// none was). So is the state, unless `ends_at` ended a proximal step. Throws std::invalid_argument for
/// settings out of range and a q of the wrong size; exceptions of the system arrive unchanged.
[[nodiscard]] StaticReport find_static_equilibrium(const StaticEquilibrium& settings,
                                                   const SecondOrderSystem& system, State& state);

}  // namespace nurbeam
