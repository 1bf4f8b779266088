#pragma once
#include <Eigen/Core>

#include "cad_import/report/leniency.h"

namespace nurbeam {

/// An arc that runs anticlockwise about its centre.
struct PlaneArc {
  Eigen::Vector2d centre, start, end;
};

/// Gives both ends one distance from the centre: these stay, and it moves by the least; where that would
/// make another arc of an almost whole circle, its end goes to its start. Returns the size of the repair,
/// 0 where the digits of the text need it. Throws std::runtime_error where the distances differ by more than
/// is repaired.
double make_consistent(PlaneArc& arc, const Leniency& leniency);

}  // namespace nurbeam
