#pragma once
#include <variant>

#include "fem/structure/beam_joint.h"
#include "fem/structure/held_body.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// What holds beams and bodies, as it is described; what comes of it in a mesh is in fem/constraints.
///
/// A description offers place(), where what it gives is recorded, reaction_name(structure), and, if it has
/// them: for_each_node(visit), which calls visit(beam, s, mark) for places that keep a node, mark(home node)
/// saying why; `from_outside`, where what it gives comes from no other part of the model; `motion`, an
/// optional table of where it moves what it holds, with rows().
using Constraint = std::variant<Support, BeamJoint, HeldBody>;

}  // namespace nurbeam
