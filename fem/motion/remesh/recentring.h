#pragma once
#include "fem/mesh/mesh_elements.h"
#include "fem/motion/remesh/meshed_state.h"

namespace nurbeam {

/// Whether a section of a beam with torsion has come far from its chart, which is singular at the opposite
/// tangent.
bool recentring_due(const BeamSystem& system, const State& state);

/// Whether an end is at a node clamped for good, which keeps the chart of the drawing.
bool keeps_drawn_chart(const BeamSystem& system, const MeshElement<3>& e, int end);

/// The motion in the charts of the present sections, on the same mesh: angles become zero, their rates the
/// spins about the tangents. Clamped nodes keep the chart of the drawing. Accelerations of angles must be
/// made consistent anew. `held`: see BeamSystem. `like`: the plan of a neighbouring motion on this mesh,
/// whose charts are then used.
MeshedState recentred(const BeamSystem& system, const State& state, const std::vector<bool>& held = {},
                      const MeshPlan* like = nullptr);

}  // namespace nurbeam
