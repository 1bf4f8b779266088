#pragma once
#include <Eigen/Geometry>
#include <algorithm>
#include <random>
#include <vector>

#include "fem/system/assembly.h"
#include "fem/system/initial_state.h"
#include "tests/fem/fastened_parts.h"
#include "tests/support/rate_test.h"

/// States whose fields are known in closed form, as beams interpolate affine images of their drawing exactly;
/// and resultants of generalised forces by their work on rigid motions.
namespace nurbeam::testing {

/// r -> F r + c.
struct AffineMap {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  Eigen::Vector3d c = Eigen::Vector3d::Zero();

  Eigen::Vector3d operator()(const Eigen::Vector3d& r) const { return F * r + c; }
};

/// In the plane for dimension 2.
inline AffineMap random_map(int dimension, std::mt19937& random, double amount = 0.3) {
  AffineMap map;
  map.F.topLeftCorner(dimension, dimension) +=
      amount * random_vector(dimension * dimension, random).reshaped(dimension, dimension);
  map.c.head(dimension) = random_vector(dimension, random);
  return map;
}
inline AffineMap random_rigid_motion(int dimension, std::mt19937& random, double angle = 0.7) {
  const Eigen::Vector3d axis =
      dimension == 2 ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(random_vector(3, random).normalized());
  AffineMap map{Eigen::AngleAxisd(angle, axis).toRotationMatrix()};
  map.c.head(dimension) = random_vector(dimension, random);
  return map;
}

/// Moves the places of all sliding bodies.
inline void shift_places(const BeamSystem& system, State& state, double by) {
  for (const int place : places_of(system)) state.q[place] += by;
}

/// Puts all beams without torsion on the image of their drawing, for the places of `state`, and bodies that
/// are no nodes on that of where they are.
inline void map_drawing(const BeamSystem& system, const AffineMap& map, State& state) {
  const int D = system.dimension();
  for (const int body : system.mesh().bodies) {
    Eigen::Vector3d r = Eigen::Vector3d::Zero();
    r.head(D) = state.q.segment(body, D);
    state.q.segment(body, D) = map(r).head(D);
  }
  for (std::size_t b = 0; b < system.mesh().nodes.size(); ++b)
    for (const MeshNode& node : system.mesh().nodes[b]) {
      const ReferenceCurve& curve = system.model().beams[b].curve;
      const double s = node.place >= 0 ? state.q[node.place] : node.s;
      state.q.segment(node.r, D) = map(curve.position(s)).head(D);
      state.q.segment(node.slope_left, D) = (map.F * curve.tangent(s, true)).head(D);
      state.q.segment(node.slope_right, D) = (map.F * curve.tangent(s)).head(D);
    }
}
inline State mapped_drawing(const BeamSystem& system, const AffineMap& map, double shift = 0) {
  State state = drawn_state(system);
  shift_places(system, state, shift);
  map_drawing(system, map, state);
  return state;
}

/// A state moved as a rigid body, beams and bodies and sections; places stay.
inline State rigidly_moved(const BeamSystem& system, const State& state, const AffineMap& motion) {
  const int D = system.dimension();
  State moved = state;
  const auto turn = [&](int first, const Eigen::Vector3d& c) {
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    x.head(D) = state.q.segment(first, D);
    moved.q.segment(first, D) = (motion.F * x + c).head(D);
  };
  for (const int body : system.mesh().bodies) turn(body, motion.c);
  for (const std::vector<MeshNode>& nodes : system.mesh().nodes)
    for (const MeshNode& node : nodes) {
      turn(node.r, motion.c);
      turn(node.slope_left, Eigen::Vector3d::Zero());
      turn(node.slope_right, Eigen::Vector3d::Zero());
    }
  if (const Assembly<3>* assembly = system.assembly<3>())
    for (const MeshElement<3>& e : assembly->elements())
      for (int end = 0; e.twist && end < 2; ++end) {
        const Eigen::Matrix3d section = e.twist->element.end_section(gather_twist(e, state.q), end).matrix();
        moved.q[e.twist->dofs[TwistLayout::angle(end)]] =
            angle_in(e.twist->element.chart(end), motion.F * section);
      }
  return moved;
}

/// The rates of all coordinates in a rigid motion with this velocity of the origin and this spin.
inline Eigen::VectorXd rigid_rates(const BeamSystem& system, const State& state,
                                   const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin) {
  const auto moved = [&](double h) {
    const double angle = h * spin.norm();
    const Eigen::Vector3d axis = angle != 0 ? Eigen::Vector3d(spin.normalized()) : Eigen::Vector3d::UnitZ();
    return rigidly_moved(system, state, {Eigen::AngleAxisd(angle, axis).toRotationMatrix(), h * velocity}).q;
  };
  constexpr double h = 1e-3;
  return (8 * (moved(h) - moved(-h)) - (moved(2 * h) - moved(-2 * h))) / (12 * h);
}

/// Coordinates of a part of a system.
inline std::vector<int> coordinates_of_body(const BeamSystem& system, int body) {
  std::vector<int> all;
  for (int d = 0; d < system.dimension(); ++d) all.push_back(system.mesh().bodies[body] + d);
  return all;
}
inline std::vector<int> coordinates_of_beam(const BeamSystem& system, int beam) {
  std::vector<int> all;
  for (const MeshNode& node : system.mesh().nodes[beam]) {
    for (const int first : {node.r, node.slope_left, node.slope_right})
      for (int d = 0; d < system.dimension(); ++d) all.push_back(first + d);
    for (const int angle : {node.angle_left, node.angle_right})
      if (angle >= 0) all.push_back(angle);
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}
/// Those of a beam up to a node: of the node itself its position, and the slope and the angle before it.
inline std::vector<int> coordinates_before_node(const BeamSystem& system, int beam, int last) {
  std::vector<int> all;
  const std::vector<MeshNode>& nodes = system.mesh().nodes[beam];
  for (int i = 0; i <= last; ++i) {
    for (int d = 0; d < system.dimension(); ++d) {
      all.push_back(nodes[i].r + d);
      all.push_back(nodes[i].slope_left + d);
      if (i < last && nodes[i].slope_right != nodes[i].slope_left) all.push_back(nodes[i].slope_right + d);
    }
    if (nodes[i].angle_left >= 0) all.push_back(nodes[i].angle_left);
    if (i < last && nodes[i].angle_right != nodes[i].angle_left) all.push_back(nodes[i].angle_right);
  }
  return all;
}

/// Force and moment about the origin [N], [N m].
struct Resultant {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), moment = Eigen::Vector3d::Zero();
  Eigen::Vector3d about(const Eigen::Vector3d& point) const { return moment - point.cross(force); }
};
/// Those of generalised forces on a part: their work on its rigid motions.
inline Resultant resultant(const BeamSystem& system, const State& state, const Eigen::VectorXd& forces,
                           const std::vector<int>& part) {
  const auto work = [&](const Eigen::Vector3d& velocity, const Eigen::Vector3d& spin) {
    const Eigen::VectorXd rates = rigid_rates(system, state, velocity, spin);
    double sum = 0;
    for (const int i : part) sum += forces[i] * rates[i];
    return sum;
  };
  const int D = system.dimension();
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  Resultant total;
  for (int d = 0; d < D; ++d) total.force[d] = work(Eigen::Vector3d::Unit(d), none);
  for (int d = D == 2 ? 2 : 0; d < 3; ++d) total.moment[d] = work(none, Eigen::Vector3d::Unit(d));
  return total;
}
inline Resultant resultant(const BeamSystem& system, const State& state, const Eigen::VectorXd& forces) {
  std::vector<int> all(static_cast<std::size_t>(system.coordinate_count()));
  for (int i = 0; i < system.coordinate_count(); ++i) all[static_cast<std::size_t>(i)] = i;
  return resultant(system, state, forces, all);
}

/// Expects what two parts do to each other to cancel, about any point.
inline void expect_opposite(const Resultant& a, const Resultant& b) {
  const double size = 1 + a.force.norm() + a.moment.norm();
  EXPECT_LT((a.force + b.force).norm(), 1e-9 * size) << a.force.transpose() << " | " << b.force.transpose();
  EXPECT_LT((a.moment + b.moment).norm(), 1e-9 * size)
      << a.moment.transpose() << " | " << b.moment.transpose();
}
inline void expect_same(const Eigen::VectorXd& a, const Eigen::VectorXd& b, double tolerance = 1e-9) {
  EXPECT_LT((a - b).norm(), tolerance * (1 + b.norm())) << a.transpose() << " | " << b.transpose();
}

}  // namespace nurbeam::testing
