#pragma once
#include <functional>

#include "solver/system/second_order_system.h"

namespace nurbeam {

struct StaticEquilibrium {
  double tolerance = 1e-10;  ///< on the scaled residual, relative to the largest single force contribution
  int max_iterations = 100;  ///< Newton iterations in one KINSOL call
  /// Increments, proximal steps and failed attempts together; 1: the full load directly, or nothing.
  int max_load_steps = 400;
  /// Asked of every equilibrium and every proximal step on the way: true ends the search there, which is to
  /// go on from that state in other coordinates.
  std::function<bool(const State&)> ends_at = {};
};

enum class StaticStatus {
  converged,
  not_converged,
  singular_matrix,
  unstable,          ///< equilibria were found, but none that is stable
  lost_in_round_off  ///< the loads are no greater than the round-off of internal forces
};

struct StaticReport {
  StaticStatus status = StaticStatus::not_converged;
  int load_steps = 0;
  int newton_iterations = 0;
  double load_factor = 0;     ///< reached
  double residual_norm = 0;   ///< scaled as `tolerance` is
  bool leaves_start = false;  ///< which lay at an equilibrium that is not stable
  bool diverges =
      false;  ///< left by what touches it: loads without energy, and none was found that is stable
};

/// Equilibrium f(q, 0, t) = G'lambda, g(q, t) = 0 by KINSOL (full Newton steps, then line search; KLU), in
/// place.
///
/// State::load in [0, 1] scales the system's loads. The full load is tried directly; then with a first Newton
/// step that, where it moves a coordinate by more than its coordinate_scale(), goes no further than the work
/// of the forces along it lets it: that of something soft only as long as it is as drawn, a straight wire.
/// When that does not converge, moves a coordinate by more than its coordinate_scale(), or against where the
/// tangent at the start leads, the load is applied in adaptive increments under the same bounds, so that the
/// branch of equilibria that starts at `state` is followed. An equilibrium that is not stable (stability.h)
/// is none: it is left along its unstable direction; but where loads have no energy and nothing stable is
/// found, one that diverges is better than nothing. Where no increment converges (a straight or slack cable
/// without tension has a singular tangent, a snap-through no equilibrium nearby) a load beyond is reached by
/// proximal steps M(q)(q - q_k)/tau^2 - f + G'lambda = 0 with growing tau, which decrease the potential
/// energy.
///
/// Converged means: no residual is larger than `tolerance` times the largest force (the load or G'lambda,
/// compared as work over coordinate_scale()) or, failing that, than its own round-off. v and a are zero on
/// return. On any status but `converged`, its load is that of the last equilibrium found (the start, when
/// none was), and so is the state, unless `ends_at` ended a proximal step. Throws std::invalid_argument for
/// settings out of range and a q of the wrong size; what the system throws arrives unchanged.
[[nodiscard]] StaticReport find_static_equilibrium(const StaticEquilibrium& settings,
                                                   const SecondOrderSystem& system, State& state);

}  // namespace nurbeam
