#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

struct Structure;

/// A joint of two beams at places that no body slides over: the two material points keep the offset they have
/// in the drawing.
struct BeamJoint {
  int beam_a;
  double s_a;  ///< [m]
  int beam_b;
  double s_b;          ///< [m]
  bool rigid = false;  ///< the angle between the slopes stays too (HeldAngle); between beams with torsion the
                       ///< relative orientation of their sections stays (JoinedSections); false: a hinge
  std::string name = {};
  /// The axis of a hinge of two beams with torsion, as drawn: their sections turn against each other about
  /// this axis alone.
  std::optional<Eigen::Vector3d> axis = {};

  Grip place() const { return Grip::on_beam(beam_a, s_a); }
  /// The joint's name; without one "joint.cable.mast".
  std::string reaction_name(const Structure& structure) const;
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    const auto join = [](HomeNode& node) { node.joined = true; };
    visit(beam_a, s_a, join);
    visit(beam_b, s_b, join);
  }
};

}  // namespace nurbeam
