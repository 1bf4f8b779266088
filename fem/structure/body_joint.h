#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fem/structure/displacement_table.h"
#include "fem/structure/grip.h"
#include "fem/structure/home_nodes.h"
#include "fem/structure/turn.h"

namespace nurbeam {

struct Structure;

/// An axis of one thing and an axis of another that stay square to each other: both as drawn, of length 1.
using AxisPair = std::array<Eigen::Vector3d, 2>;

/// Pairs that leave a turn about an axis free.
std::vector<AxisPair> hinge_pairs(const Eigen::Vector3d& axis);
/// Pairs that leave no turn free.
std::vector<AxisPair> rigid_pairs();

struct Rider;
/// The pairs by which a rider's body follows its beam: an axis of the section, in its own axes d1, d2, t, and
/// one of the body, in its own.
std::vector<AxisPair> followed_pairs(const Structure& structure, const Rider& rider);

/// A place of a rigid body is held: by a point in space, by another body, or by a place of a beam. Alone this
/// is a ball; with pairs of axes it holds the attitude of the body too, against space, a rigid body or the
/// section of a beam with torsion.
struct BodyJoint {
  std::string name;                               ///< heads the columns of its force and couple on the body
  int point;                                      ///< a body, or a place of the rigid body that is held
  Grip to;                                        ///< what holds it
  Eigen::Vector3d arm = Eigen::Vector3d::Zero();  ///< of a rigid body `to`: as BodyPoint::arm [m]
  std::vector<AxisPair> pairs = {};               ///< at most three: an axis of the body, one of `to`
  /// The point is free along this direction, as drawn; it turns with a rigid body `to`.
  std::optional<Eigen::Vector3d> slide = {};
  /// Displacement of a point in space `to`; State::load scales it as it scales loads.
  std::optional<DisplacementTable> motion = {};
  /// Turns all that is held about an axis that goes with `to`, from the drawing on; State::load scales the
  /// angle. With the pairs of hinge_pairs, or with no less than those of rigid_pairs. In space the place goes
  /// round `about` too; elsewhere it lies on the axis.
  std::optional<AxisTurn> turn = {};

  Grip place() const { return Grip::on_body(point); }
  std::string reaction_name(const Structure& structure) const;
  /// The body whose attitude the pairs hold.
  int turning_body(const Structure& structure) const;
  template <class Visit>
  void for_each_node(Visit&& visit) const {
    if (to.beam >= 0)
      visit(
          to.beam, to.s, [](HomeNode& node) { node.kept = true; });
  }
};

}  // namespace nurbeam
