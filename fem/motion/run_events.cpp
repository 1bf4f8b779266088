#include "fem/motion/run_events.h"

#include "fem/motion/record_frame.h"
#include "fem/motion/sliding_bodies.h"

namespace nurbeam {

std::string kind_of(MeshChange change) {
  switch (change) {
    case MeshChange::split:
      return "split";
    case MeshChange::merge:
      return "merge";
    case MeshChange::becomes_point:
      return "carried as a point";
    case MeshChange::becomes_node:
      return "carried as a node";
    case MeshChange::none:
      break;
  }
  return "none";
}

template <int D>
RunEvent event_before(const MeshedState<D>& at, const std::string& kind, int joint) {
  const BeamModel& model = at.system->model();
  RunEvent event;
  event.time = at.state.t;
  event.kind = kind;
  event.beam = model.beams[model.joints[joint].beam].name;
  event.body = body_name(model, joint);
  if (const auto s = at.system->place(at.state, joint)) event.s = curve_of(model, joint).wrapped(*s);
  event.energy_before = at.system->energy(at.state).mechanical();
  event.momentum_before = at.system->momentum(at.state);
  event.length_before = at.system->beam_length(at.state, model.joints[joint].beam);
  return event;
}

template <int D>
void finish_event(const MeshedState<D>& at, RunEvent& event) {
  const BeamModel& model = at.system->model();
  event.energy_after = at.system->energy(at.state).mechanical();
  event.momentum_after = at.system->momentum(at.state);
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    if (model.beams[b].name == event.beam)
      event.length_after = at.system->beam_length(at.state, static_cast<int>(b));
}

template <int D>
Eigen::Vector3d support_impulse(const BeamModel& model, const Eigen::VectorXd& impulse) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  if (impulse.size() == 0) return sum;
  int row = 0;
  for (const Support& support : model.supports) {
    sum -= widened<D>(impulse, row);
    row += support.clamped ? 2 * D - 1 : D;
  }
  return sum;
}

template RunEvent event_before<2>(const MeshedState<2>&, const std::string&, int);
template RunEvent event_before<3>(const MeshedState<3>&, const std::string&, int);
template void finish_event<2>(const MeshedState<2>&, RunEvent&);
template void finish_event<3>(const MeshedState<3>&, RunEvent&);
template Eigen::Vector3d support_impulse<2>(const BeamModel&, const Eigen::VectorXd&);
template Eigen::Vector3d support_impulse<3>(const BeamModel&, const Eigen::VectorXd&);

}  // namespace nurbeam
