#pragma once
#include "tests/fem/random_models.h"

namespace nurbeam::testing {

/// Properties of a beam with torsion whose sections have all stiffnesses different.
inline BeamProperties with_sections(double damping = 0.02) {
  BeamProperties properties(300, 0, 0.7, damping);
  properties.sections = SectionStiffness{2, 1.1, 0.3, 0.8, 0.01};
  return properties;
}

/// Two beams with torsion, curved and twisted as drawn: the first clamped, with a rigid corner, a fork and
/// loads of every kind, the second joined to it rigidly and hinged.
inline BeamModel torsion_model(std::mt19937& random, int dimension) {
  const std::vector<RationalCubic> axis =
      with_corner(uneven_axis(random, dimension), 1.2, uneven_axis(random, dimension), dimension);
  ModelBuilder builder(dimension, {0, -9.81, 0});
  builder.add_beam(ReferenceCurve(axis, dimension)
                       .oriented({Orientation::Rule::start, {0.3, 0.2, 1}, {{0, 0}, {1, 0.7}, {4, 2}}}),
                   with_sections(), {10});
  std::vector<RationalCubic> other;
  for (const RationalCubic& cubic : uneven_axis(random, dimension)) {
    Eigen::Matrix4d points = cubic.points();
    points.row(0).swap(points.row(2));
    other.push_back(RationalCubic(points));
  }
  builder.add_beam(ReferenceCurve(other, dimension), with_sections(), {5});
  const double L = builder.beam(0).curve.length(), M = builder.beam(1).curve.length();
  builder.clamp(0, 0).fork(0, 0.7 * L).join(0, 0.3 * L, 1, 0, true).join(0, L, 1, M, false);
  const Eigen::Vector3d force(1, -2, 3);
  for (const double s : {0.1 * L, L})
    for (const bool follower : {false, true}) {
      builder.add(PointLoad{{0, s, 0, force, follower, {{0, 0.5}, {1, 1}}}});
      builder.add(Moment{{0, s, 0.4, 0.4 * force, follower, {}}});
    }
  builder.add(LineLoad{0, force, {}});
  BeamModel model = builder.build();
  Beam& beam = model.beams[0];
  for (HomeNode& node : beam.home)
    if (node.s == beam.curve.breaks()[2]) node.kind = NodeKind::rigid;
  return model;
}

/// Bodies that slide on a curved and twisted beam and follow its section beside the axis, as a node and,
/// where the element beside it has a moving end, as a point; that bend it by an angle; and that do neither.
/// It is joined to a second one by a hinge with an axis, and that one held by another. Torques along both,
/// forces beside the axis. `point_roll`: the inertia of the one on a point [kg m^2].
inline BeamModel torsion_sliding_model(std::mt19937& random, double point_roll) {
  ModelBuilder builder(3, {0.3, -9.81, 1});
  builder.add_beam(ReferenceCurve(uneven_axis(random, 3), 3)
                       .oriented({Orientation::Rule::start, {0.3, 0.2, 1}, {{0, 0}, {1, 0.7}, {4, 2}}}),
                   with_sections(), {6});
  std::vector<RationalCubic> other;
  for (const RationalCubic& cubic : uneven_axis(random, 3)) {
    Eigen::Matrix4d points = cubic.points();
    points.row(0).swap(points.row(2));
    other.push_back(RationalCubic(points));
  }
  builder.add_beam(ReferenceCurve(other, 3), with_sections(), {4});
  const double L = builder.beam(0).curve.length(), M = builder.beam(1).curve.length();
  const auto slide = [&](double part) -> Rider& {
    return builder.slide(builder.add_body("body at " + std::to_string(part), 0.4), 0, part * L);
  };
  Rider& on_node = slide(0.3);
  on_node.follows_section = true;
  on_node.offset = {0.1, -0.2};
  slide(0.55).continuous_slope = false;
  slide(0.8);
  Rider& on_point = slide(0.99);
  on_point.follows_section = true;
  on_point.offset = {-0.15, 0.1};
  builder.clamp(0, 0);
  builder.add(BeamJoint{0, L, 1, 0, false, {}, Eigen::Vector3d(1, 0.4, -0.3)});
  builder.add(Support{.beam = 1, .s = M, .axis = Eigen::Vector3d(0.2, 1, 0.5)});
  const Eigen::Vector3d force(1, -2, 3);
  for (const bool follower : {false, true})
    for (const double s : {0.1 * L, 0.65 * L})
      builder.add(PointLoad{{0, s, 0.3, force, follower, {{0, 0.5}, {1, 1}}, {0.1, 0.2}}});
  for (const int beam : {0, 1}) builder.add(LineTorque{beam, 0.7, {{0, 1}, {1, 2}}});
  BeamModel model = builder.build();
  model.bodies[0].roll_inertia = 0.3;
  model.bodies[3].roll_inertia = point_roll;
  return model;
}

}  // namespace nurbeam::testing
