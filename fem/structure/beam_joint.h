#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>

#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

struct Structure;

/// Joins two beams at a place of each, which no body slides over: their material points there stay together
/// (at the distance they have in the drawing).
struct BeamJoint {
  int beam_a;
  double s_a;  ///< [m]
  int beam_b;
  double s_b;          ///< [m]
  bool rigid = false;  ///< the angle between the slopes stays too (HeldAngle), or where both beams have
                       ///< torsion the orientation of their sections (JoinedSections); else a hinge
  std::string name = {};
  /// Of a hinge of two beams with torsion: their sections turn against each other about this axis alone,
  /// which is given as drawn.
  std::optional<Eigen::Vector3d> axis = {};

  Grip place() const { return Grip::on_beam(beam_a, s_a); }
  /// "joint.cable.mast", where it has no name of its own.
  std::string reaction_name(const Structure& structure) const;
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    const auto join = [](HomeNode& node) { node.joined = true; };
    visit(beam_a, s_a, join);
    visit(beam_b, s_b, join);
  }
};

}  // namespace nurbeam
