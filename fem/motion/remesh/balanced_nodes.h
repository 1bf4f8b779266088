#pragma once
#include "fem/system/beam_system.h"

namespace nurbeam {

/// Moves the nodes of `to` that `from` has not, and their neighbours, to where the forces on them are in
/// balance with the accelerations that are there. On the old curve such a node, which an element had no room
/// for, is held by nothing: two shorter elements, stiffer than that one, would kick. What constraints hold
/// and bodies that were nodes before stay. Nothing changes where the strain is pointwise, so that a split
/// keeps the motion, where accelerations are not known yet, or where there is no such place near.
void balance_added_nodes(const BeamSystem& from, const BeamSystem& to, State& next);

}  // namespace nurbeam
