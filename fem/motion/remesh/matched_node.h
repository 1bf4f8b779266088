#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Moves a node of `to` that `from` did not have and that lies on the old curve. Both elements beside it then
/// carry the assumed strain eps_hat of the one old element: its mean over the left part, its mean over the
/// right part and its value at the node; of spans with own slopes also the moments that AssumedEnds takes.
/// Among all such moves of (r, r_s) this is the least, with slopes weighed by the length of the old element.
///
/// Nothing changes where the strain is pointwise, or where the conditions cannot be met.
void match_axial_strain(const BeamSystem& from, const State& state, const BeamSystem& to, int beam, int node,
                        State& next);

}  // namespace nurbeam
