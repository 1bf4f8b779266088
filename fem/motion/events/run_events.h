#pragma once
#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/observables.h"

namespace nurbeam {

/// What a change of the mesh is called among the events. Precondition: not MeshChange::none.
EventKind kind_of(MeshChange change);

/// An event with the body of a rider that is about to happen: what is known before it.
RunEvent event_before(const MeshedState& at, EventKind kind, int rider);

/// The same where the sums over its beam are known.
RunEvent event_before(const MeshedState& at, EventKind kind, int rider, const MotionSums& sums);

/// Adds what is known after it.
void finish_event(const MeshedState& at, RunEvent& event);
void finish_event(const MotionSums& sums, RunEvent& event);

/// What a constraint impulse [N s] gives to the momentum through the supports' positions [kg m/s]; the other
/// constraints (directions, bodies on the beam) give none. An empty impulse is none.
Eigen::Vector3d support_impulse(const MeshedState& at, const Eigen::VectorXd& impulse);

}  // namespace nurbeam
