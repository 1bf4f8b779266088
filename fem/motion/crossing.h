#pragma once
#include <optional>

#include "fem/motion/integrators.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A sliding body that passes a place of its beam.
struct Crossing {
  int joint;
  double s;      ///< of the place [m]
  bool forward;  ///< whether s of the body grows
};

/// The first crossing between two states of a hidden late node by a moving node, or of any node by a point; a
/// landing just before a place is not yet one. The drawn curvature may jump there and with it the force along
/// the beam: a step must end on the near side and the next begin on the far side, or energy drifts at first
/// order.
template <int D>
std::optional<Crossing> first_crossing(const BeamSystem<D>& system, const State& before, const State& after);

/// The first joint whose body has come beyond an end of its beam, at that end.
template <int D>
std::optional<Crossing> end_passed(const BeamSystem<D>& system, const State& state);

/// A body that lands does so nearer to its place than this [m].
double landing_tolerance(const BeamModel& model, int joint);

/// The state to which a step of another length from `before` leads, for which the body lands just before the
/// place. The step that was taken, of length `step` [s], led to `after`, where it is beyond. Where Newton's
/// iteration stumbles over the place the step is shortened. `algorithmic` is the algorithmic_acceleration()
/// at `before`.
template <int D>
State landed(const BeamSystem<D>& system, const IntegratorSettings& settings, const State& before,
             const Eigen::VectorXd& algorithmic, const State& after, double step, const Crossing& crossing);

/// A landed state on the other side of the place, after a time of 1e-6 `step` at most in which nothing else
/// happens.
template <int D>
State carried_over(const BeamSystem<D>& system, State state, double step, const Crossing& crossing);

extern template std::optional<Crossing> first_crossing<2>(const BeamSystem<2>&, const State&, const State&);
extern template std::optional<Crossing> first_crossing<3>(const BeamSystem<3>&, const State&, const State&);
extern template std::optional<Crossing> end_passed<2>(const BeamSystem<2>&, const State&);
extern template std::optional<Crossing> end_passed<3>(const BeamSystem<3>&, const State&);
extern template State landed<2>(const BeamSystem<2>&, const IntegratorSettings&, const State&,
                                const Eigen::VectorXd&, const State&, double, const Crossing&);
extern template State landed<3>(const BeamSystem<3>&, const IntegratorSettings&, const State&,
                                const Eigen::VectorXd&, const State&, double, const Crossing&);
extern template State carried_over<2>(const BeamSystem<2>&, State, double, const Crossing&);
extern template State carried_over<3>(const BeamSystem<3>&, State, double, const Crossing&);

}  // namespace nurbeam
