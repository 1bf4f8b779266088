#pragma once
#include <optional>

#include "nurbs/smooth/moebius_change.h"

namespace nurbeam::smooth {

/// The piece, written with one degree more, times the linear function that is 1 at its start, `factor` at its
/// end: the same points at the same parameters with other weights.
Piece times_linear(const Piece& piece, double factor);

/// The pieces, each times a linear function and on intervals that make the speed continuous, so that they are
/// C1 in homogeneous coordinates with the least ratio of weights. Nothing where that is not mild, as after
/// more than about one turn, or where two neighbours do not share their tangent.
std::optional<Pieces> with_linear_factors(const Pieces& pieces, double tolerance);

}  // namespace nurbeam::smooth
