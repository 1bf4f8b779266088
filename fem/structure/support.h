#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <string>

#include "fem/structure/displacement_table.h"
#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"
#include "fem/structure/turn.h"

namespace nurbeam {

struct Structure;

/// A support holds a place of a beam where it is drawn, or moves it from there.
struct Support {
  int beam;
  double s;              ///< [m]
  bool clamped = false;  ///< position and direction of the slope; its magnitude stays free
  bool fork = false;     ///< position and roll of the section, of a beam with torsion
  /// Of a clamp: the beam turns into the drawn direction within less than an element (BendingLayer), so that
  /// in the mesh its slope is free.
  bool sharp = false;
  std::string name = {};
  /// Displacement from the drawn position; State::load scales it as it scales loads.
  std::optional<DisplacementTable> motion = {};
  /// The axis of a hinge: the position is held, and the section of a beam with torsion turns about this axis
  /// alone.
  std::optional<Eigen::Vector3d> axis = {};
  /// The direction along which the place is free; it is held across this direction alone. What else the
  /// support holds, it holds besides.
  std::optional<Eigen::Vector3d> guide = {};
  /// Turns all that the support holds about an axis; State::load scales the angle. The displacement adds.
  std::optional<AxisTurn> turn = {};

  bool holds_slope() const { return clamped && !sharp; }

  static constexpr bool from_outside = true;
  Grip place() const { return Grip::on_beam(beam, s); }
  /// The support's name; without one "reaction.cable.start".
  std::string reaction_name(const Structure& structure) const;
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    const Hold by = holds_slope() ? Hold::clamp : Hold::position;
    visit(beam, s, [by, turns = turn.has_value()](HomeNode& node) {
      node.hold = std::max(node.hold, by);
      node.turns = node.turns || turns;
    });
  }
};

}  // namespace nurbeam
