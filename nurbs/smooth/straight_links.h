#pragma once
#include <optional>

#include "nurbs/smooth/moebius_change.h"

namespace nurbeam::smooth {

/// Whether the piece is a straight line within the tolerance [m], run through forwards.
bool is_straight(const Piece& piece, double tolerance);

/// The pieces with every straight one made anew, of one to three pieces, so that all neighbours that share
/// their tangent are C1 in homogeneous coordinates: what is bent keeps mild weights and about unit speed, and
/// the lines between, whose weights are free, lead from one weight and slope of it to the next. Nothing where
/// a run of bent pieces has no mild weights of its own, where there is nothing straight, or below degree 2.
std::optional<Pieces> with_straight_links(const Pieces& pieces, double tolerance);

}  // namespace nurbeam::smooth
