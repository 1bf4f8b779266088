#pragma once
#include <Eigen/Core>
#include <string>

#include "fem/motion/meshed_state.h"
#include "fem/motion/run_event.h"

namespace nurbeam {

/// What a change of the mesh is called among the events: "split", "merge", ...
std::string kind_of(MeshChange change);

/// An event with the body of a joint that is about to happen: what is known before it.
template <int D>
RunEvent event_before(const MeshedState<D>& at, const std::string& kind, int joint);

/// Adds what is known after it.
template <int D>
void finish_event(const MeshedState<D>& at, RunEvent& event);

/// What a constraint impulse [N s] gives to the momentum through the supports' positions [kg m/s]; the other
/// constraints (directions, bodies on the beam) give none. An empty impulse is none.
template <int D>
Eigen::Vector3d support_impulse(const BeamModel& model, const Eigen::VectorXd& impulse);

extern template RunEvent event_before<2>(const MeshedState<2>&, const std::string&, int);
extern template RunEvent event_before<3>(const MeshedState<3>&, const std::string&, int);
extern template void finish_event<2>(const MeshedState<2>&, RunEvent&);
extern template void finish_event<3>(const MeshedState<3>&, RunEvent&);
extern template Eigen::Vector3d support_impulse<2>(const BeamModel&, const Eigen::VectorXd&);
extern template Eigen::Vector3d support_impulse<3>(const BeamModel&, const Eigen::VectorXd&);

}  // namespace nurbeam
