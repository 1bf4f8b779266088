#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "fem/element/reference_curve.h"
#include "fem/material/section.h"
#include "fem/model/time_table.h"

namespace nurbeam {

enum class WeightRule {
  material,  ///< ALE-RANCF, weights follow the material: one chart and one W per CAD segment
  constant,  ///< ALE-RANCF, the paper's: four weights that stay with the element
  ones       ///< ALE-ANCF: plain cubics in reference arc length
};
/// Velocities after a merge: the mass-weighted L2 projection with `standard`, the kept nodes' own else.
enum class MergeRule {
  standard,  ///< material weights: none to choose; constant weights: the paper's rule
  paper,     ///< Eqs. 31-38 of Ding & Ouyang, for comparison
  ones       ///< all ones, for comparison
};

/// What the slopes on both sides of a home node have to do with each other.
enum class NodeKind {
  smooth,  ///< they are one
  hinge,   ///< they are free of each other
  rigid    ///< a corner: the angle between them stays that of the drawing (HeldAngle)
};

/// A place where a beam may have a node; the drawn mesh. Nodes return there when a sliding node has passed.
struct HomeNode {
  double s;   ///< reference arc length [m]
  bool late;  ///< a break of the drawing or a support: bodies pass it as a point (passes_as_point)
  NodeKind kind = NodeKind::smooth;  ///< a hinge or a corner is never removed: no body slides over it
};

struct Beam {
  std::string name;
  ReferenceCurve curve;
  BeamProperties properties;
  bool straight = false;  ///< stress-free shape without curvature
  WeightRule weights = WeightRule::material;
  MergeRule merge = MergeRule::standard;
  std::vector<HomeNode> home;  ///< s increasing, from 0 to the length; of a ring the last is the first again

  /// A ring: a closed curve, and no ends.
  bool is_ring() const { return curve.closed(); }
  int home_intervals() const { return static_cast<int>(home.size()) - 1; }
  /// Number in `home` of home node h; on a ring h goes on over the seam, both ways.
  int home_index(int h) const;
  /// s of home node h; on a ring beyond [0, length) for h over the seam [m].
  double home_place(int h) const;
  /// The home interval [h, h + 1] that holds s; over the seam on a ring.
  int home_interval(double s) const;
};

struct Body {
  std::string name;
  double mass;  ///< [kg]
};

struct Support {
  int beam;
  double s;      ///< [m]
  bool clamped;  ///< position and direction of the slope; its magnitude stays free
};

struct PointLoad {
  enum class Kind { force, moment } kind = Kind::force;
  int beam = 0;
  double s = 0;                                     ///< place at t = 0 [m]
  double speed = 0;                                 ///< ds/dt of the place [m/s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N] or [N m]
  bool follower = false;                            ///< turns with the tangent
  TimeTable time;
};

struct LineLoad {
  int beam = 0;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N/m] of reference arc length
  TimeTable time;
};

/// Ties a body to a moving place on the beam.
struct SlidingJoint {
  int body;
  int beam;
  double s;                         ///< at t = 0 [m]
  double speed = 0;                 ///< at t = 0 [m/s]
  std::optional<TimeTable> motion;  ///< prescribed s(t) [m]
  bool continuous_slope = true;
  bool leave_at_end = true;  ///< else it stops there
};

/// Joins two beams at a place of each, which no body slides over: their material points there stay together
/// (at the distance they have in the drawing).
struct BeamJoint {
  int beam_a;
  double s_a;  ///< [m]
  int beam_b;
  double s_b;          ///< [m]
  bool rigid = false;  ///< the angle between the slopes stays too (HeldAngle); else a hinge
};

/// Elements' home places, supports, bodies, loads and joints: all that does not change during a run.
///
/// Coordinates are the model's own frame: for dimension 2 the plane of the model (third components zero).
struct BeamModel {
  int dimension = 3;
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [m/s^2]
  std::vector<Beam> beams;
  std::vector<Body> bodies;
  std::vector<Support> supports;
  std::vector<PointLoad> point_loads;
  std::vector<LineLoad> line_loads;
  std::vector<SlidingJoint> joints;
  std::vector<BeamJoint> beam_joints;
};

/// Intervals of a beam that no element may cross in the drawn mesh: between breaks of the drawing and
/// supports.
std::vector<double> fixed_places(const ReferenceCurve& curve, const std::vector<double>& support_places);
/// How many elements each interval gets when `count` are spread in proportion to length. Throws
/// std::invalid_argument, naming the smallest count, when there are more intervals than elements.
std::vector<int> spread_elements(const std::vector<double>& places, int count);
/// Home nodes: each interval divided in arc length into its number of parts, each part longer than the one
/// before it by `grading` [m] (graded_places); interior places are late nodes. Throws std::invalid_argument,
/// naming the range of the increment in the interval that bounds it most.
std::vector<HomeNode> home_nodes(const std::vector<double>& places, const std::vector<int>& parts,
                                 double grading = 0);

}  // namespace nurbeam
