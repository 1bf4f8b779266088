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
/// `motion`, an optional table of prescribed displacements with rows(); `turn`, an optional prescribed
/// rotation.
using Constraint = std::variant<Support, BeamJoint, HeldBody, CarriedBody, BodyJoint>;

/// The rotation that a description prescribes; null where it prescribes none.
inline const AxisTurn* turn_of(const Constraint& constraint) {
  return std::visit(
      [](const auto& c) -> const AxisTurn* {
        if constexpr (
            requires { c.turn; })
          return c.turn ? &*c.turn : nullptr;
        return nullptr;
      },
      constraint);
}

/// Whether a description prescribes a motion.
inline bool is_moved(const Constraint& constraint) {
  return turn_of(constraint) || std::visit(
                                    [](const auto& c) {
                                      if constexpr (
                                          requires { c.motion; })
                                        return c.motion.has_value();
                                      return false;
                                    },
                                    constraint);
}

}  // namespace nurbeam
