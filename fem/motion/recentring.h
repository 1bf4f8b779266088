#pragma once
#include "fem/motion/meshed_state.h"

namespace nurbeam {

/// Whether a section of a beam with torsion has come far from its chart, which is singular at the opposite
/// tangent.
bool recentring_due(const BeamSystem& system, const State& state);

/// The same motion in the charts of the present sections, on the same mesh: angles are zero there, their
/// rates the spins about the tangents. Clamped nodes keep the chart of the drawing. Accelerations of angles
/// are to be made consistent anew. `held` as for BeamSystem.
MeshedState recentred(const BeamSystem& system, const State& state, const std::vector<bool>& held = {});

}  // namespace nurbeam
