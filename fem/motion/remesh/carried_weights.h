#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Sets the constant weights of elements in `plan`: kept, split (Eq. 21 of Ding & Ouyang) or merged (Eqs.
/// 31-38).
void carry_weights(const BeamSystem& system, const State& state, MeshPlan& plan);

}  // namespace nurbeam
