#pragma once
#include "fem/motion/remesh/meshed_state.h"
#include "fem/system/observables.h"

namespace nurbeam {

/// The kind of event that a change of the mesh is. Precondition: not MeshChange::none.
EventKind kind_of(MeshChange change);

/// An event of a rider's body that is about to happen, with the data before it.
RunEvent event_before(const MeshedState& at, EventKind kind, int rider);

/// An event with the data before it, where the sums over the rider's beam are known.
RunEvent event_before(const MeshedState& at, EventKind kind, int rider, const MotionSums& sums);

/// Adds the data after the event.
void finish_event(const MeshedState& at, RunEvent& event);
void finish_event(const MotionSums& sums, RunEvent& event);

/// Momentum that a constraint impulse [N s] gives through the supports' positions [kg m/s]; the other
/// constraints (directions, bodies on the beam) give none. An empty impulse gives zero.
Eigen::Vector3d support_impulse(const MeshedState& at, const Eigen::VectorXd& impulse);

}  // namespace nurbeam
