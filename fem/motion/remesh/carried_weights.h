#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Constant weights that stay with their elements as the mesh becomes that of `plan`: kept, split (Eq. 21 of
/// Ding & Ouyang) or merged (Eqs. 31-38).
void carry_weights(const BeamSystem& system, const State& state, MeshPlan& plan);

}  // namespace nurbeam
