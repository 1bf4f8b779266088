#include "fem/motion/events/taut_connectors.h"

#include "fem/forces/memory.h"
#include "fem/system/observables.h"

namespace nurbeam {

double beyond(const BeamSystem& system, const State&, const State& state, const TautEvent& event) {
  const Connector& connector = system.model().connectors[event.connector];
  return connector.sign() * (length_and_force(system, state, event.connector).first - connector.length);
}

double tolerance(const BeamSystem& system, const State& before, const TautEvent& event) {
  return system.model().connectors[event.connector].least_stretch(
      length_and_force(system, before, event.connector).first);
}

std::optional<TautEvent> first_taut(const BeamSystem& system, const State& before, const State& after) {
  const BeamModel& model = system.model();
  std::optional<TautEvent> first;
  for (int i = 0; i < static_cast<int>(model.connectors.size()); ++i) {
    if (!model.connectors[i].jumps() || is_taut(system.mesh().memory, before.memory, i)) continue;
    TautEvent event{i, 0};
    const double from = beyond(system, before, before, event), to = beyond(system, before, after, event);
    if (!(from < -tolerance(system, before, event)) || !(to > 0)) continue;
    event.part = from / (from - to);
    if (!first || event.part < first->part) first = event;
  }
  return first;
}

void apply(MeshedState& at, const TautEvent& event) {
  set_taut(at.system->mesh().memory, at.state.memory, event.connector, true);
}

void start_connectors(MeshedState& at) {
  const BeamModel& model = at.system->model();
  for (int i = 0; i < static_cast<int>(model.connectors.size()); ++i) {
    const TautEvent event{i, 0};
    if (!model.connectors[i].jumps()) continue;
    set_taut(at.system->mesh().memory, at.state.memory, i,
             beyond(*at.system, at.state, at.state, event) > -tolerance(*at.system, at.state, event));
  }
}

}  // namespace nurbeam
