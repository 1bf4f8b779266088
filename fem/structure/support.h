#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <string>

#include "fem/structure/displacement_table.h"
#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"

namespace nurbeam {

struct Structure;

/// Holds a place of a beam where it is drawn, or moves it from there.
struct Support {
  int beam;
  double s;              ///< [m]
  bool clamped = false;  ///< position and direction of the slope; its magnitude stays free
  bool fork = false;     ///< position and roll of the section, of a beam with torsion
  std::string name = {};
  std::optional<DisplacementTable> motion = {};  ///< from the drawn position, scaled as loads by State::load
  /// Of a hinge: position, and the section of a beam with torsion, which turns about this axis alone.
  std::optional<Eigen::Vector3d> axis = {};
  /// Held across this direction alone, along which the place is free.
  std::optional<Eigen::Vector3d> guide = {};

  static constexpr bool from_outside = true;
  Grip place() const { return Grip::on_beam(beam, s); }
  /// "reaction.cable.start", where it has no name of its own.
  std::string reaction_name(const Structure& structure) const;
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    const Hold by = clamped ? Hold::clamp : Hold::position;
    visit(beam, s, [by](HomeNode& node) { node.hold = std::max(node.hold, by); });
  }
};

}  // namespace nurbeam
