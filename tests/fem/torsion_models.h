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

}  // namespace nurbeam::testing
