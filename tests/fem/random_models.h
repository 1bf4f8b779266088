#pragma once
#include <Eigen/Geometry>
#include <random>

#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "tests/support/models.h"

namespace nurbeam::testing {

/// Two rational cubics that meet smoothly, with uneven weights, about 2 m long together.
inline std::vector<RationalCubic> uneven_axis(std::mt19937& random, int dimension) {
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto point = [&](double x) {
    return Eigen::Vector3d(x, 0.15 * unit(random), dimension == 3 ? 0.15 * unit(random) : 0);
  };
  std::array<Eigen::Vector3d, 7> p;
  for (int i = 0; i < 7; ++i) p[i] = point(i / 3.0);
  p[3] = (p[2] + p[4]) / 2;
  std::vector<RationalCubic> axis;
  for (int j = 0; j < 2; ++j) {
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      const double w = std::exp(0.3 * unit(random));
      points.col(i) << w * p[3 * j + i], w;
    }
    axis.push_back(RationalCubic(points));
  }
  return axis;
}

/// A state near the drawn shape with random displacements, rates and multipliers; places of joints stay.
inline State disturbed_state(const BeamSystem& system, std::mt19937& random, double amount = 0.05) {
  std::uniform_real_distribution<double> unit(-1, 1);
  State state = drawn_state(system);
  for (Eigen::Index i = 0; i < state.q.size(); ++i) {
    state.q[i] += amount * unit(random);
    state.v[i] = unit(random);
    state.a[i] = unit(random);
  }
  for (Eigen::Index i = 0; i < state.lambda.size(); ++i) state.lambda[i] = unit(random);
  for (const MeshRider& joint : system.mesh().riders)
    if (joint.place >= 0) state.q[joint.place] = drawn_state(system).q[joint.place];
  return state;
}

/// A beam of two uneven segments, clamped and pinned, with loads of every kind, a joint on a moving node, one
/// near the end and one with a prescribed motion.
inline BeamModel model_with_everything(std::mt19937& random, int dimension) {
  BeamModel model = one_beam(uneven_axis(random, dimension), dimension, {300, 2, 0.7, 0.02, {}}, 8,
                             {{0, true}, {1.4, false}});
  const double L = model.beams[0].curve.length();
  add_slider(model, 0.8, 0.33 * L);
  add_slider(model, 0.5, 0.995 * L);
  add_slider(model, 0.4, 0.55 * L);
  model.riders[0].continuous_slope = false;
  model.riders[2].motion = TimeTable{{0, 0.55 * L}, {1, 0.55 * L + 0.3}};
  const Eigen::Vector3d force = dimension == 3 ? Eigen::Vector3d(1, -2, 0.7) : Eigen::Vector3d(1, -2, 0);
  const TimeTable ramp{{0, 0.5}, {1, 2}};
  model.forces = {PointLoad{{0, 0.9 * L, 0, force, false, ramp}}, PointLoad{{0, 0.3 * L, 0, force, true, {}}},
                  PointLoad{{0, 0.1 * L, 0.8, force, false, {}}},
                  PointLoad{{0, 0.2 * L, 0.8, force, true, {}}}};
  for (double s : {0.35 * L, L}) {
    Eigen::Vector3d moment(0, 0, 1.3);
    if (dimension == 3) {
      const Eigen::Vector3d along = model.beams[0].curve.tangent(s);
      moment = Eigen::Vector3d(0.4, 1, -0.6);
      moment -= along.dot(moment) * along;
    }
    for (bool follower : {false, true}) model.forces.push_back(Moment{{0, s, 0, moment, follower, {}}});
  }
  model.forces.push_back(LineLoad{0, force, ramp});
  return model;
}

/// Two beams of two uneven segments each, the second one clamped and turned, joined rigidly in their midst
/// and hinged at the ends that are nearest there; a body slides on the first one.
inline BeamModel joined_model(std::mt19937& random, int dimension) {
  const BeamProperties properties{300, 2, 0.7, 0.02, {}};
  BeamModel model = one_beam(uneven_axis(random, dimension), dimension, properties, 6, {{0, true}});
  std::vector<RationalCubic> turned;
  for (const RationalCubic& cubic : uneven_axis(random, dimension)) {
    Eigen::Matrix4d points = cubic.points();
    points.row(0).swap(points.row(1));
    turned.push_back(RationalCubic(points));
  }
  const BeamModel other = one_beam(turned, dimension, properties, 6, {});
  model.beams.push_back(other.beams[0]);
  const double L = model.beams[0].curve.length(), M = model.beams[1].curve.length();
  model.constraints.push_back(BeamJoint{0, L, 1, 0.4 * M, true});
  model.constraints.push_back(BeamJoint{1, 0, 0, 0, false});
  add_slider(model, 0.8, 0.33 * L);
  return model;
}

/// The axis followed by another one, which is turned by an angle [rad] about an axis askew (in the plane
/// about its normal) and starts at its end: one chain with a corner.
inline std::vector<RationalCubic> with_corner(std::vector<RationalCubic> axis, double angle,
                                              const std::vector<RationalCubic>& other, int dimension) {
  const Eigen::Vector3d about = dimension == 3 ? Eigen::Vector3d(1, 2, 2) : Eigen::Vector3d(0, 0, 1);
  const Eigen::Affine3d moved = Eigen::Translation3d(axis.back().control_point(3)) *
                                Eigen::AngleAxisd(angle, about.normalized()) *
                                Eigen::Translation3d(-other.front().control_point(0));
  for (const RationalCubic& cubic : other) axis.push_back(RationalCubic(moved.matrix() * cubic.points()));
  return axis;
}

/// One beam of four uneven segments, clamped at its start, with a rigid corner between the second and the
/// third.
inline BeamModel cornered_model(std::mt19937& random, int dimension) {
  const std::vector<RationalCubic> column = uneven_axis(random, dimension);
  BeamModel model = one_beam(with_corner(column, 1.2, uneven_axis(random, dimension), dimension), dimension,
                             {300, 2, 0.7, 0.02, {}}, 10, {{0, true}});
  Beam& beam = model.beams[0];
  for (HomeNode& node : beam.home)
    if (node.s == beam.curve.breaks()[2]) node.kind = NodeKind::rigid;
  return model;
}

}  // namespace nurbeam::testing
