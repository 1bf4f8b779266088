#pragma once
#include <optional>

#include "fem/motion/remesh/meshed_state.h"

/// Connectors of one sign with a damper, whose pull jumps where they come taut.
namespace nurbeam {

/// One comes taut, or, where it only pushes, tight.
struct TautEvent {
  int connector;
  double part;  ///< of the step, about, at which it does
};

/// The first of them between two states of the system.
std::optional<TautEvent> first_taut(const BeamSystem& system, const State& before, const State& after);
/// How near a state of the step is to the event, negative before it; nearer than the tolerance is at it [m].
double beyond(const BeamSystem& system, const State& before, const State& state, const TautEvent& event);
double tolerance(const BeamSystem& system, const State& before, const TautEvent& event);
void apply(MeshedState& at, const TautEvent& event);

/// Tells the memory which of them are taut.
void start_connectors(MeshedState& at);

}  // namespace nurbeam
