#pragma once
#include <string>
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// The name of each coordinate, (coordinate_count): "cable[3].x" of a node, "cable[3].slope.y", "trolley.x" of
/// a body, "trolley.s" of its place on a beam, or "trolley.cable.s" where the body slides on several.
std::vector<std::string> coordinate_names(const BeamSystem& system);

/// The name of each row of the constraints, (constraint_count), after what asks for it: a support, a joint, a
/// body, a rod or a stop; with "[1]" and so on of those with several rows.
std::vector<std::string> row_names(const BeamSystem& system);

}  // namespace nurbeam
