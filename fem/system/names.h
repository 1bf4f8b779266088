#pragma once
#include <string>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Names of the coordinates, (coordinate_count): "cable[3].x" of a node, "cable[3].slope.y", "trolley.x" of a
/// body, "trolley.s" of its place on a beam, or "trolley.cable.s" where the body slides on several beams.
std::vector<std::string> coordinate_names(const BeamSystem& system);

/// Names of the rows of constraints, (constraint_count), after the part that asks for the row: a support, a
/// joint, a body, a rod or a stop. A part with several rows adds "[1]" and so on.
std::vector<std::string> row_names(const BeamSystem& system);

}  // namespace nurbeam
