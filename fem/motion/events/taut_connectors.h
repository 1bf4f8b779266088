#pragma once
#include <optional>

#include "fem/motion/remesh/meshed_state.h"

/// Connectors of one sign with a damper, whose pull jumps where they come taut.
namespace nurbeam {

/// A connector comes taut, or, if it only pushes, tight.
struct TautEvent {
  int connector;
  double part;  ///< approximate part of the step at which it does
};

/// The first connector to come taut between two states of the system.
std::optional<TautEvent> first_taut(const BeamSystem& system, const State& before, const State& after);
/// Stretch of the connector in a state of the step, negative before the event; within the tolerance the state
/// is at it [m].
double beyond(const BeamSystem& system, const State& before, const State& state, const TautEvent& event);
double tolerance(const BeamSystem& system, const State& before, const TautEvent& event);
void apply(MeshedState& at, const TautEvent& event);

/// Records in the memory which connectors are taut.
void start_connectors(MeshedState& at);

}  // namespace nurbeam
