#include "fem/motion/rest/modes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <memory>
#include <random>

#include "fem/model/build.h"
#include "fem/motion/rest/mode_shape.h"
#include "fem/system/initial_state.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/system/tangent_matrix.h"
#include "tests/fem/torsion_models.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using testing::line_cubic;

ModesReport modes_of(const BeamModel& model, const ModesOptions& options = {}) {
  return find_modes(
      std::make_shared<const BeamModel>(model), options, [] { return false; });
}

/// Squared frequencies on the null space of the constraints, dense.
Eigen::VectorXd dense_squares(const BeamSystem& system, const State& state) {
  const int n = system.coordinate_count();
  const auto tangent = [&](const TangentWeights& w) {
    return Eigen::MatrixXd(tangent_matrix(system, state, w));
  };
  const Eigen::MatrixXd M = tangent({.mass = 1}), K = tangent({.stiffness = 1});
  const Eigen::MatrixXd Z = M.bottomLeftCorner(system.constraint_count(), n).fullPivLu().kernel();
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(Z.transpose() * K.topLeftCorner(n, n) * Z,
                                                                   Z.transpose() * M.topLeftCorner(n, n) * Z)
      .eigenvalues();
}

TEST(Modes, AreThoseOfTheDenseProblemAboutTheDrawing) {
  std::mt19937 random(3);
  for (const BeamModel& model : {testing::joined_model(random, 2), testing::cornered_model(random, 2),
                                 testing::torsion_model(random, 3)}) {
    const ModesReport found = modes_of(model, {.count = 6, .about_equilibrium = false});
    ASSERT_FALSE(found.rest.failure);
    const Eigen::VectorXd exact = dense_squares(*found.at.system, found.at.state);
    ASSERT_EQ(found.modes.size(), 6u);
    for (int i = 0; i < 6; ++i)
      EXPECT_NEAR(found.modes[i].omega * found.modes[i].omega, exact[i], 1e-7 * exact[5]) << i;
  }
}

TEST(Modes, AreThoseOfTheDenseProblemAboutAnEquilibriumWithCorners) {
  std::mt19937 random(4);
  BeamModel model = testing::cornered_model(random, 2);
  model.forces = {PointLoad{{.beam = 0, .s = 2, .value = {0.3, -0.2, 0}, .time = {}}}};
  const ModesReport found = modes_of(model, {.count = 4});
  ASSERT_FALSE(found.rest.failure);
  const Eigen::VectorXd exact = dense_squares(*found.at.system, found.at.state);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(found.modes[i].omega, std::sqrt(exact[i]), 1e-7 * std::sqrt(exact[i])) << i;
}

TEST(Modes, OfManyElementsAreTheirsWithWhatRoundOffLeaves) {
  // A steel rod of 1 m and 20 mm; omega = 1.8751^2 sqrt(EI / rho A).
  const BeamModel held = testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                           testing::round_bar(0.01, 7850, 2e11), 2000, {{0, true}});
  const double exact = std::pow(1.8751040687119611, 2) * std::sqrt(2e11 * 2.5e-5 / 7850);
  const ModesReport found = modes_of(held, {.count = 1, .about_equilibrium = false});
  ASSERT_FALSE(found.rest.failure);
  const Mode& first = found.modes.at(0);
  EXPECT_GT(first.omega, 0);
  EXPECT_LT(std::abs(first.omega * first.omega - exact * exact), first.round_off);
  EXPECT_GT(first.round_off, 1e-3 * exact * exact);
}

TEST(Modes, RigidMotionsOfAFreeRodOfManyElementsAreZero) {
  for (const int elements : {20, 400, 1500}) {
    const ModesReport found = modes_of(testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                                         testing::round_bar(0.05, 7850, 2e11), elements, {}),
                                       {.count = 5, .about_equilibrium = false});
    ASSERT_FALSE(found.rest.failure);
    int rigid = 0;
    for (const Mode& mode : found.modes) rigid += mode.omega == 0;
    EXPECT_EQ(rigid, 3) << elements;
  }
}

TEST(Modes, ShapesHoldTheConstraintsAndHaveUnitMass) {
  std::mt19937 random(5);
  const ModesReport found =
      modes_of(testing::joined_model(random, 2), {.count = 5, .about_equilibrium = false});
  ASSERT_FALSE(found.rest.failure);
  const BeamSystem& system = *found.at.system;
  const int n = system.coordinate_count(), m = system.constraint_count();
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, found.at.state, {.mass = 1});
  const Eigen::MatrixXd dense(kkt);
  for (const Mode& a : found.modes) {
    EXPECT_LT((dense.bottomLeftCorner(m, n) * a.shape).norm(), 1e-9 * a.shape.norm());
    for (const Mode& b : found.modes)
      EXPECT_NEAR(a.shape.dot(dense.topLeftCorner(n, n) * b.shape), &a == &b ? 1 : 0, 1e-8);
  }
}

TEST(Modes, EffectiveMassesSumUpToTheMassThatMoves) {
  ModelBuilder builder(2);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 2), BeamProperties{1e4, 1, 3}, {6});
  const ModesReport free = modes_of(builder.build(), {.count = 28});
  ASSERT_FALSE(free.rest.failure);
  EXPECT_NEAR(free.mass, 3, 1e-12);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Mode& mode : free.modes) sum += mode.participation.cwiseAbs2();
  EXPECT_NEAR(sum.x(), 3, 1e-8);
  EXPECT_NEAR(sum.y(), 3, 1e-8);
  EXPECT_EQ(sum.z(), 0);
}

/// A column that stands on its clamp, of 1 m with EI = 1, under the weight q per length.
ModelBuilder column(double q) {
  ModelBuilder builder(2, {0, -1, 0});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {0, 1, 0})}, 2), BeamProperties{1e6, 1, q}, {8});
  return builder.clamp(0, 0);
}
/// The same under a force along it at s.
BeamModel loaded(double q, double force, double s = 1, bool follower = false) {
  BeamModel model = column(q).force(0, s, {0, force, 0}).build();
  std::get<PointLoad>(model.forces[0]).follower = follower;
  return model;
}

TEST(Modes, AreInterruptedAmongTheIterationsForEigenvaluesToo) {
  std::mt19937 random(3);
  const auto model = std::make_shared<const BeamModel>(testing::joined_model(random, 2));
  for (const bool about_equilibrium : {true, false}) {
    const ModesOptions options{.count = 6, .about_equilibrium = about_equilibrium};
    int questions = 0;
    ASSERT_EQ(find_modes(model, options, [&] { return ++questions == 0; }).modes.size(), 6u);
    ASSERT_GT(questions, 10);
    for (int at = 1; at <= questions; at += questions - 1) {
      int asked = 0;
      const ModesReport found = find_modes(model, options, [&] { return ++asked == at; });
      EXPECT_TRUE(found.rest.interrupted && !found.rest.failure && found.modes.empty());
      EXPECT_EQ(asked, at);
    }
  }
}

// Above q L^3/EI = 7.837 it hangs over; as drawn it would topple.
TEST(Modes, OfAColumnThatIsTooHeavyAreThoseOfItsBentShape) {
  const ModesReport light = modes_of(column(7.8).build(), {.count = 1}),
                    heavy = modes_of(column(7.9).build(), {.count = 1});
  ASSERT_FALSE(light.rest.failure);
  ASSERT_FALSE(heavy.rest.failure);
  EXPECT_LT(std::abs(light.at.state.q[light.at.system->mesh().nodes[0].back().r]), 1e-9);
  EXPECT_GT(std::abs(heavy.at.state.q[heavy.at.system->mesh().nodes[0].back().r]), 0.05);
  EXPECT_GT(heavy.modes[0].omega, light.modes[0].omega);
}

// What is left of forces in its drawn shape is round-off, and nothing holds it.
TEST(Modes, OfAFreeSlenderBeamNeedNoLuckWithTheLastBitsOfItsDrawing) {
  std::mt19937 random(8);
  std::uniform_int_distribution<int> bits(-1, 1);
  ModelBuilder builder(2);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 2), BeamProperties{1e8, 1, 1}, {32});
  const MeshedState at = MeshedState::drawn(std::make_shared<const BeamModel>(builder.build()));
  for (int trial = 0; trial < 50; ++trial) {
    State state = at.state;
    for (double& q : state.q) q += bits(random) * 0x1p-52;
    const Eigen::VectorXd drawn = state.q;
    const StaticReport report = find_static_equilibrium({}, *at.system, state);
    EXPECT_EQ(report.status, StaticStatus::converged) << trial;
    EXPECT_EQ(report.newton_iterations, 0) << trial;
    EXPECT_EQ(state.q, drawn) << trial;
  }
}

TEST(Buckling, OfAColumnUnderItsWeightAndALoad) {
  // Timoshenko & Gere: with its weight alone it buckles at q L^3/EI = 7.837; near it hardly any load is left.
  const ModesReport near = modes_of(loaded(7.8, -1), {.kind = ModesOptions::Kind::buckling, .count = 1});
  ASSERT_FALSE(near.rest.failure);
  // P + 0.3 q L = 2.47 nearly: less than a straight line to pi^2/4 would leave.
  EXPECT_GT(near.modes[0].factor, 0.2 * (7.8373 - 7.8));
  EXPECT_LT(near.modes[0].factor, 0.4 * (7.8373 - 7.8));
}

TEST(Buckling, ByALoadThatPullsHasANegativeFactor) {
  const ModesReport found = modes_of(loaded(1e-9, 1), {.kind = ModesOptions::Kind::buckling, .count = 1});
  ASSERT_FALSE(found.rest.failure);
  EXPECT_NEAR(found.modes[0].factor, -M_PI * M_PI / 4, 1e-3);
}

// What a beam that is bent resists more is no less of its stiffness, though it is so in first order.
TEST(Buckling, OfWhatIsBentIsThatOfItsStresses) {
  const auto factors = [](const Eigen::Vector2d& force) {
    ModelBuilder builder(2);
    builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2), BeamProperties{2e7, 200, 1},
                     {16});
    const BeamModel model = builder.clamp(0, 0).force(0, 2, {force[0], force[1], 0}).build();
    return modes_of(model, {.kind = ModesOptions::Kind::buckling, .count = 2});
  };
  const double euler = M_PI * M_PI / 4 * 200 / 4;
  const ModesReport across = factors({0, -0.5});  // deflected by twice the radius of gyration
  ASSERT_TRUE(across.rest.failure);
  EXPECT_EQ(across.rest.failure->kind, Failure::Kind::nothing_buckles);
  const ModesReport both = factors({-10, -0.5});
  ASSERT_FALSE(both.rest.failure) << static_cast<int>(both.rest.failure->kind);
  EXPECT_NEAR(both.modes[0].factor, euler / 10, 1e-3 * euler / 10);
}

TEST(Buckling, WithoutAnEffectOnTheStiffnessIsRefused) {
  const ModesReport found = modes_of(loaded(1e-9, -1, 0), {.kind = ModesOptions::Kind::buckling, .count = 1});
  ASSERT_TRUE(found.rest.failure);
  EXPECT_EQ(found.rest.failure->kind, Failure::Kind::nothing_buckles);
}

TEST(Modes, UnderALoadThatFollowsAreRefused) {
  const ModesReport found = modes_of(loaded(1e-9, -1, 1, true));
  ASSERT_TRUE(found.rest.failure);
  EXPECT_EQ(found.rest.failure->kind, Failure::Kind::no_energy);
}

TEST(ModeShapes, MoveThePointsAndLeaveTheSectionForces) {
  const ModesReport found = modes_of(column(1).build(), {.count = 1});
  ASSERT_FALSE(found.rest.failure);
  const double amplitude = visible_amplitude(found.at, found.modes[0]);
  const Snapshot rest = record_snapshot(*found.at.system, found.at.state, {{0, 1}});
  const Snapshot moved = record_mode(found.at, found.modes[0], amplitude, 2 * amplitude, {{0, 1}});
  const double way = (moved.probes[0].position - rest.probes[0].position).norm();
  EXPECT_NEAR(way, 0.05, 1e-3);
  EXPECT_NEAR(moved.probes[0].velocity.norm(), 2 * way, 1e-9);
  EXPECT_EQ(moved.beams[0].elements[0].axial_force, rest.beams[0].elements[0].axial_force);
  EXPECT_NE(moved.beams[0].elements[3].control_points, rest.beams[0].elements[3].control_points);
}

// A disc on a ball in its centre, held upright by springs against turning: A w^2 - h w - k = 0 forwards.
TEST(Modes, OfARotorGoRoundForwardsAndBackwards) {
  constexpr double A = 0.4, C = 0.6, k = 30, h = 5;
  ModelBuilder builder(3);
  const int disc = builder.add_rigid_body("disc", 2, Eigen::Vector3d(A, A, C).asDiagonal(), {0, 0, 0});
  builder.body(disc).rigid->rotor = Eigen::Vector3d(0, 0, h);
  builder.add(Constraint(BodyJoint{.name = "", .point = disc, .to = Grip::at_point({0, 0, 0})}));
  BeamModel model = builder.build();
  model.rotational_connectors.push_back(
      {.name = "gimbal", .ends = {Grip::at_point({0, 0, 0}), Grip::on_body(disc)}, .stiffness = k});
  mark_held_nodes(model);
  const ModesReport found = modes_of(model, {.count = 3});
  ASSERT_FALSE(found.rest.failure);
  ASSERT_EQ(found.modes.size(), 3u);
  const double root = std::sqrt(h * h + 4 * A * k);
  EXPECT_NEAR(found.modes[0].omega, (root - h) / (2 * A), 1e-7);
  EXPECT_EQ(found.modes[0].whirl, -1);
  EXPECT_NEAR(found.modes[1].omega, std::sqrt(k / C), 1e-7);
  EXPECT_EQ(found.modes[1].whirl, 0);
  EXPECT_NEAR(found.modes[2].omega, (root + h) / (2 * A), 1e-7);
  EXPECT_EQ(found.modes[2].whirl, 1);
}

}  // namespace
}  // namespace nurbeam
