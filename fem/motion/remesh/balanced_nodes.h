#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Moves the nodes of `to` that `from` does not have, and their neighbours, to where the forces on them
/// balance with the present accelerations. On the old curve nothing holds such a node, for which the old
/// element had no freedom: two shorter elements, stiffer than the old one, would kick. Coordinates held by
/// constraints stay, and bodies that were nodes before.
///
/// Nothing changes where the strain is pointwise, as a split then keeps the motion; where accelerations are
/// not known yet; or where no balance is near.
void balance_added_nodes(const BeamSystem& from, const BeamSystem& to, State& next);

}  // namespace nurbeam
