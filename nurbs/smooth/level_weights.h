#pragma once
#include <optional>

#include "nurbs/smooth/moebius_change.h"

namespace nurbeam::smooth {

/// The pieces written with one degree more so that the weight of each is level at both its ends, and the
/// lengths of their intervals such that the speed is continuous: neighbours that share their tangent are then
/// C1 in homogeneous coordinates, however far the run turns. Nothing where a piece does not allow it (the
/// weights between its ends exceed those there).
///
/// Of degree d, w_i -> c^i w_i times a linear factor from 1 to l has level ends where l + d c alpha = d + 1 =
/// d beta / c + 1 / l, with alpha = w_1 / w_0, beta = w_{d-1} / w_d: a quadratic for c, real if
/// alpha beta <= 1. Its roots make the piece faster at the one or the other end; the more even is taken.
std::optional<Pieces> with_level_weights(const Pieces& pieces, double tolerance);

}  // namespace nurbeam::smooth
