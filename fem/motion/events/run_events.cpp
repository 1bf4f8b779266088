#include "fem/motion/events/run_events.h"

#include <cassert>

namespace nurbeam {

EventKind kind_of(MeshChange change) {
  assert(change != MeshChange::none);
  switch (change) {
    case MeshChange::merge:
      return EventKind::merge;
    case MeshChange::becomes_point:
      return EventKind::becomes_point;
    case MeshChange::becomes_node:
      return EventKind::becomes_node;
    case MeshChange::split:
    case MeshChange::none:
      break;
  }
  return EventKind::split;
}

RunEvent event_before(const MeshedState& at, EventKind kind, int rider) {
  return event_before(at, kind, rider,
                      motion_sums(*at.system, at.state, at.system->model().riders[rider].beam));
}

RunEvent event_before(const MeshedState& at, EventKind kind, int rider, const MotionSums& sums) {
  const Rider& sliding = at.system->model().riders[rider];
  RunEvent event;
  event.time = at.state.t;
  event.kind = kind;
  event.beam = sliding.beam;
  event.body = sliding.body;
  if (const auto s = place(*at.system, at.state, rider))
    event.s = at.system->model().beam_of(sliding).curve.wrapped(*s);
  event.energy_before = sums.energy.mechanical();
  event.momentum_before = sums.momentum;
  event.length_before = sums.length;
  return event;
}

void finish_event(const MeshedState& at, RunEvent& event) {
  finish_event(motion_sums(*at.system, at.state, event.beam), event);
}

void finish_event(const MotionSums& sums, RunEvent& event) {
  event.energy_after = sums.energy.mechanical();
  event.momentum_after = sums.momentum;
  event.length_after = sums.length;
}

Eigen::Vector3d support_impulse(const MeshedState& at, const Eigen::VectorXd& impulse) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  if (impulse.size() == 0) return sum;
  const auto& constraints = at.system->model().constraints;
  for (int i = 0; i < static_cast<int>(constraints.size()); ++i)
    if (std::visit(
            [](const auto& c) {
              return requires { c.from_outside; };
            },
            constraints[i]))
      sum += reaction(*at.system, at.state, impulse, i).force;
  return sum;
}

}  // namespace nurbeam
