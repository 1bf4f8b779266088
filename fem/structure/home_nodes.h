#pragma once
#include <cstdint>
#include <vector>

#include "fem/element/reference_curve.h"

namespace nurbeam {

/// The relation between the slopes on both sides of a home node.
enum class NodeKind : std::uint8_t {
  smooth,  ///< both are one slope
  /// The slopes are free of each other, as bending rounds the angle over less than an element (BendingLayer);
  /// torsion passes (PassedRoll).
  kink,
  hinge,  ///< the slopes are free of each other
  rigid   ///< a corner: the angle between the slopes stays as drawn (HeldAngle)
};

/// The coordinates that a support holds at a node.
enum class Hold : std::uint8_t {
  nothing,
  position,
  clamp  ///< position and direction of the slope; its magnitude stays free
};

/// A home node: a place of the undeformed beam that has a node when no rider is near. The node returns after
/// a sliding node has passed.
struct HomeNode {
  double s;                ///< reference arc length [m]
  bool permanent = false;  ///< a break of the drawing, a support or a joint inside the beam: see Passing
  NodeKind kind =
      NodeKind::smooth;  ///< only a smooth node is ever removed; no body slides over a hinge or a corner
  Hold hold = Hold::nothing;
  bool turns = false;   ///< what holds it turns
  bool joined = false;  ///< another beam is joined here
  bool kept = false;    ///< a mass or a connector is here: the node never gives way
  /// A smooth node where bending yet reaches less far than an element, so that the elements beside it do not
  /// show its moment.
  bool sharp = false;
  bool sharp_clamp = false;  ///< a clamp that holds the slope beyond a layer of bending (Support::sharp)

  /// Whether bodies slide over the node.
  bool is_passed() const { return kind == NodeKind::smooth || kind == NodeKind::kink; }
};

/// Places that must be nodes of the drawn mesh: breaks of the drawing and supports, in order [m].
std::vector<double> fixed_places(const ReferenceCurve& curve, const std::vector<double>& support_places);
/// The number of elements of each interval, when `count` are spread in proportion to length.
/// Throws std::invalid_argument, naming the smallest count, when there are more intervals than elements.
std::vector<int> spread_elements(const std::vector<double>& places, int count);
/// Home nodes: each interval divided in arc length into its number of parts, each part longer than the one
/// before it by `grading` [m] (graded_places); interior places are permanent nodes. Throws
/// std::invalid_argument, naming the range of the increment in the interval that bounds it most.
std::vector<HomeNode> home_nodes(const std::vector<double>& places, const std::vector<int>& parts,
                                 double grading = 0);

/// The breaks of a rigid guide, all permanent.
std::vector<HomeNode> guide_nodes(const ReferenceCurve& curve);

}  // namespace nurbeam
