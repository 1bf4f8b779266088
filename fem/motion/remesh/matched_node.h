#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Moves a node of `to` that `from` had not, and that stands where its curve was, so that both elements
/// beside it carry the axial strain eps_hat which the one old element carried: the mean over the left part,
/// the mean over the right part and the value at the node are those of the old eps_hat. Of all such moves of
/// (r, r_s) the least, slopes weighed with the length of the old element. Nothing changes where the strain is
/// pointwise, or where the conditions cannot be met.
void match_axial_strain(const BeamSystem& from, const State& state, const BeamSystem& to, int beam, int node,
                        State& next);

}  // namespace nurbeam
