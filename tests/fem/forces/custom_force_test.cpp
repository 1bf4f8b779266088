#include "fem/forces/custom_force.h"

#include <gtest/gtest.h>

#include <random>

#include "fem/system/beam_system.h"
#include "solver/system/tangent_matrix.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam {
namespace {

using testing::disturbed_state;

// A nonlinear spring and damper between two points, and a pull of the second one on the first.
CustomForce::Response spring(double t, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd& v) {
  const Eigen::Vector3d d = r.col(1) - r.col(0), w = v.col(1) - v.col(0);
  const Eigen::Vector3d f = (3 + t) * d.squaredNorm() * d + 0.4 * w + 0.1 * w.squaredNorm() * w;
  CustomForce::Response response;
  response.force.resize(3, 2);
  response.force << f, -f + Eigen::Vector3d(0.2, 0.1, 0) * r(0, 0);
  return response;
}

template <int D>
void check_custom_tangent(int seed) {
  std::mt19937 random(seed);
  BeamModel model = testing::model_with_everything(random, D);
  const double L = model.beams[0].curve.length();
  // Beside the moving node, on a body, and far away.
  model.forces.push_back(
      CustomForce{{testing::point_on_beam(0, 0.34 * L), testing::point_on_body(1)}, spring});
  model.forces.push_back(
      CustomForce{{testing::point_on_beam(0, 0.8 * L), testing::point_on_beam(0, 0.32 * L)}, spring});
  const BeamSystem system(model);
  State state = disturbed_state(system, random);
  state.t = 0.3;
  const int n = system.coordinate_count(), m = system.constraint_count();
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&](int size) {
    return Eigen::VectorXd::NullaryExpr(size, [&] { return unit(random); }).eval();
  };
  const Eigen::VectorXd dq = any(n), dv = any(n);
  const auto dynamics = [&](double h) {
    State moved = state;
    moved.q += h * dq;
    moved.v += h * dv;
    Eigen::VectorXd rows(n), constraints(m);
    system.residual(moved, rows, constraints);
    return rows;
  };
  const auto product = [&](const TangentWeights& w, const Eigen::VectorXd& x) {
    Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, w);
    Eigen::VectorXd padded = Eigen::VectorXd::Zero(n + m);
    padded.head(n) = x;
    return Eigen::VectorXd((kkt * padded).head(n));
  };
  const Eigen::VectorXd derivative = product({.stiffness = 1}, dq) + product({.damping = 1}, dv);
  const auto error = [&](double h) { return ((dynamics(h) - dynamics(-h)) / (2 * h) - derivative).norm(); };
  EXPECT_LT(error(5e-4), 0.02 * derivative.norm());
  EXPECT_NEAR(error(1e-3) / error(5e-4), 4, 0.3);
}

TEST(CustomForce, HasTheDerivativesOfItsLawInTheTangentInThePlane) { check_custom_tangent<2>(3); }
TEST(CustomForce, HasTheDerivativesOfItsLawInTheTangentInSpace) { check_custom_tangent<3>(4); }

TEST(CustomForce, ThatGivesTooFewForcesIsRefused) {
  BeamModel model =
      testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {300, 2, 0.7}, 4, {{0, true}});
  model.forces.push_back(CustomForce{
      {testing::point_on_beam(0, 0.5)},
      [](double, const Eigen::Matrix3Xd&, const Eigen::Matrix3Xd&) { return CustomForce::Response{}; }});
  const BeamSystem system(model);
  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  EXPECT_THROW(system.residual(drawn_state(system), dynamics, constraints), std::invalid_argument);
}

// Two points that pull each other along the line between them.
CustomForce::Response pull(double, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd& v) {
  const Eigen::Vector3d d = r.col(1) - r.col(0), n = d.normalized();
  const Eigen::Vector3d f = (3 * d.norm() + 0.4 * n.dot(v.col(1) - v.col(0))) * n;
  CustomForce::Response response;
  response.force.resize(3, 2);
  response.force << f, -f;
  return response;
}

template <int D>
BeamSystem pulled(double place) {
  ModelBuilder builder(D);
  const int beam = testing::add_bent_beam(builder, D);
  testing::add_sliding(builder, beam, 0.7);
  const int load = builder.add_body("load", 2, {1, -0.6, D == 3 ? 0.3 : 0});
  builder.add(CustomForce{{testing::point_on_beam(beam, place), testing::point_on_body(load)}, pull});
  return BeamSystem(builder.build());
}

// On a fixed element, at both ends and beside a moving node.
template <int D>
void check_pull() {
  std::mt19937 random(5);
  for (const double place : {0.0, 0.31, 0.72, 1.7}) {
    const BeamSystem system = pulled<D>(place);
    const auto custom = testing::the_force<D, BoundCustomForce<D>>(system);
    State state = disturbed_state(system, random);
    const Eigen::VectorXd dynamics = custom.dynamics(state);
    const testing::Resultant on_beam =
        testing::resultant(system, state, dynamics, testing::coordinates_of_beam(system, 0));
    EXPECT_GT(on_beam.force.norm(), 0.1);
    testing::expect_opposite(
        on_beam, testing::resultant(system, state, dynamics, testing::coordinates_of_body(system, 1)));
    testing::expect_actions(custom, system, state, 0);
    testing::expect_work_of_power(custom, state);
    state.load = 0.6;
    testing::expect_same(custom.dynamics(state), 0.6 * dynamics, 1e-13);
  }
}
TEST(CustomForce, ActsOnItsPointsAndDoesItsWorkThereInThePlane) { check_pull<2>(); }
TEST(CustomForce, ActsOnItsPointsAndDoesItsWorkThereInSpace) { check_pull<3>(); }

}  // namespace
}  // namespace nurbeam
