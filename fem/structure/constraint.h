#pragma once
#include <variant>

#include "fem/structure/beam_joint.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// What holds beams, as it is described; what comes of it in a mesh is in fem/constraints.
using Constraint = std::variant<Support, BeamJoint>;

}  // namespace nurbeam
