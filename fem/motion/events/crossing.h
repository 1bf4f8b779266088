#pragma once
#include <optional>

#include "fem/system/beam_system.h"
#include "solver/steps/event.h"

namespace nurbeam {

/// A crossing: a sliding body passes a place of its beam.
struct Crossing {
  int rider;
  double s;      ///< the place [m]
  bool forward;  ///< whether s of the body grows
};

/// The first crossing between two states of a hidden permanent node by a moving node, or of any node by a
/// point; a landing just before a place is not yet one. The drawn curvature may jump there and with it the
/// force along the beam: a step must end on the near side and the next begin on the far side, or energy
/// drifts at first order.
std::optional<Crossing> first_crossing(const BeamSystem& system, const State& before, const State& after);

/// The last or the first end of its beam, where a rider's body is at it; nothing elsewhere.
std::optional<Crossing> end_reached(const BeamSystem& system, const State& state, int rider, bool forward);

/// The first rider whose body has come beyond an end of its beam, at that end. A prescribed motion does not
/// leave its beam.
std::optional<Crossing> end_passed(const BeamSystem& system, const State& state);

/// Whether a beam's end is held, by a support or by another beam.
bool is_held(const BeamModel& model, const Crossing& end);

/// Distance from its place within which a body lands [m].
double landing_tolerance(const BeamModel& model, int rider);

/// Distance of the body beyond the place; negative before it [m].
double distance_beyond(const BeamSystem& system, const State& state, const Crossing& crossing);

/// The state to which a step of another length leads, for which the body lands just before the place.
State landed(const BeamSystem& system, Integrator& integrator, const StepTaken& taken,
             const Crossing& crossing);

/// The cubic through two states of one mesh and their rates, at a part of the time between them.
State between(const State& from, const State& to, double part);

/// A landed state on the other side of the place, after a time of 1e-6 `step` at most in which nothing else
/// happens.
State carried_over(const BeamSystem& system, State state, double step, const Crossing& crossing);

}  // namespace nurbeam
