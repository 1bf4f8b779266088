#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "fem/structure/structure.h"

namespace nurbeam {

/// The way in which a rider is carried at present.
enum class Carried {
  node,     ///< a moving node of the beam: the elements on both sides change length
  point,    ///< a point sigma of the mesh, r_body = r(sigma): near an end of the beam or a permanent node
  stopped,  ///< a point of the mesh, held at the end of the beam
  free      ///< the body has left the beam
};

/// The home nodes of a beam that are present.
struct BeamPlan {
  std::vector<bool> present;
};

/// The plan: which home nodes are present and how each rider is carried, between two changes of the mesh.
struct MeshPlan {
  std::vector<BeamPlan> beams;
  std::vector<Carried> modes;   ///< per rider
  std::vector<double> places;   ///< s of each rider when the plan is made [m]
  std::vector<bool> held = {};  ///< per rider: held at its place until its release; empty: none
  /// Per rider: a point of the mesh for good, as a change of the mesh beside its node would have cost energy;
  /// empty: none.
  std::vector<bool> points_for_good = {};
  /// Constant weights by beam and (s_a, s_b), for elements whose weights a merge or split has set.
  struct Weights {
    int beam;
    double s_a, s_b;
    std::array<double, 4> w;
  };
  std::vector<Weights> weights;
  /// Section charts of an element by beam and (s_a, s_b), with its turn, where they are no longer those of
  /// the drawing (TwistElement).
  struct SectionCharts {
    int beam;
    double s_a, s_b;
    std::array<Eigen::Matrix3d, 2> charts;
    double turn;
  };
  std::vector<SectionCharts> section_charts;
  /// Per rider: the spin with which a body that followed a section has left it [rad/s]; empty: none.
  std::vector<double> spins = {};
  /// Per stop of the model: whether a body rests against it; empty: none.
  std::vector<bool> closed = {};

  bool is_closed(int stop) const { return stop < static_cast<int>(closed.size()) && closed[stop]; }
  bool holds(int rider) const { return rider < static_cast<int>(held.size()) && held[rider]; }
  bool is_point_for_good(int rider) const {
    return rider < static_cast<int>(points_for_good.size()) && points_for_good[rider];
  }
  double spin(int rider) const { return rider < static_cast<int>(spins.size()) ? spins[rider] : 0; }
};

/// The passing of a home node, when a rider comes to it.
enum class Passing {
  as_node,   ///< the node is removed before the rider, and returns behind it
  as_point,  ///< the node stays: the rider passes it as a point of the mesh
  gives_way  ///< the node stays as long as it can: a point cannot carry the kink of a discontinuous slope
};
/// The passing of a home node that is neither hinge nor corner.
Passing passing(const Rider& rider, const HomeNode& node);

/// Nearness to a beam end, in home element lengths, at which a rider is carried as a point; it becomes a node
/// again at twice this distance.
inline constexpr double end_zone = 0.2;
/// Distance of two riders on a beam, in home element lengths, at which they count as having met.
inline constexpr double meeting_distance = 0.05;
/// Distance of two riders on a rigid guide at which they count as having met, in home intervals, as there are
/// no elements between them.
inline constexpr double touching_distance = 3e-6;
/// Nearness to a permanent node, in home element lengths, at which a rider becomes a point, or the node gives
/// way. The second, larger one is that at which it becomes a node again.
inline constexpr double passing_zone = 0.04, passing_zone_left = 0.05;

/// Whether a body is too light for a moving node where its slope is continuous. The stored energy changes a
/// little with the place of a moving node, which is a force on the body. A body this light beside its element
/// would be dragged about by that force. The kink that its weight makes is as small.
bool too_light_for_node(const Structure& structure, const Rider& rider);

/// Whether a rider at s is carried as a point: it is described so, its beam is a rigid guide, or its body is
/// too light for a node. So is a rider with a node that it passes as a point within `reach` home element
/// lengths.
bool near_as_point(const Structure& structure, const Rider& rider, double s, double reach);

/// The drawn mesh with every rider at its start: the home node nearest to it gives way to the moving
/// node; near an end or a permanent node, and with a light body, the rider is a point.
MeshPlan initial_plan(const Structure& structure);

}  // namespace nurbeam
