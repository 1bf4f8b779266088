#pragma once
#include <variant>

#include "fem/structure/beam_joint.h"
#include "fem/structure/body_joint.h"
#include "fem/structure/carried_body.h"
#include "fem/structure/held_body.h"
#include "fem/structure/support.h"

namespace nurbeam {

/// Descriptions of the constraints on beams and bodies; fem/constraints binds them to a mesh.
///
/// A description offers place(), where its reaction is recorded, and reaction_name(structure).
/// Optional: for_each_node(visit), which calls visit(beam, s, mark) for places that keep a node, where
/// mark(home node) records why; `from_outside`, if the reaction comes from no other part of the model;
/// `motion`, an optional table of prescribed displacements with rows().
using Constraint = std::variant<Support, BeamJoint, HeldBody, CarriedBody, BodyJoint>;

}  // namespace nurbeam
