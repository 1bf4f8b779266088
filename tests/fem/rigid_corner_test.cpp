// A corner that a beam keeps: it carries the bending moment as a rigid joint of two beams does.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/motion/remesh/transfer.h"
#include "fem/system/material_points.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/steps/explicit_integrator.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::line_cubic;
using testing::uneven_axis;
using testing::with_corner;

using Axis = std::vector<RationalCubic>;

constexpr double turn = 1.2;

Beam beam_on(const Axis& axis, int dimension, const BeamProperties& properties) {
  Beam beam{.name = "beam", .curve = ReferenceCurve(axis, dimension), .properties = properties, .home = {}};
  if (dimension == 3) beam.curve = beam.curve.straightened();
  const std::vector<double> places = fixed_places(beam.curve, {});
  beam.home = home_nodes(places, std::vector<int>(places.size() - 1, 2));
  return beam;
}

void make_corner(Beam& beam, int after_segment) {
  for (HomeNode& node : beam.home)
    if (node.s == beam.curve.breaks()[after_segment]) node.kind = NodeKind::rigid;
}

// A frame of a column, clamped at its foot, and an arm that goes on from its end at an angle: drawn as one
// beam with a corner, and as two that are joined.
struct Frame {
  BeamModel cornered, joined;
  double column;  // its length [m]

  Frame(const Axis& column_axis, const Axis& arm_axis, int dimension, const BeamProperties& properties,
        const Eigen::Vector3d& gravity) {
    const Axis whole = with_corner(column_axis, turn, arm_axis, dimension);
    const auto corner = static_cast<Axis::difference_type>(column_axis.size());
    cornered.dimension = joined.dimension = dimension;
    cornered.gravity = joined.gravity = gravity;
    cornered.constraints = joined.constraints = {Support{0, 0, true}};
    cornered.beams = {beam_on(whole, dimension, properties)};
    make_corner(cornered.beams[0], static_cast<int>(corner));
    joined.beams = {beam_on(column_axis, dimension, properties),
                    beam_on({whole.begin() + corner, whole.end()}, dimension, properties)};
    joined.beams[0].home.back().joined = joined.beams[1].home.front().joined = true;
    column = joined.beams[0].curve.length();
    joined.constraints.push_back(BeamJoint{0, column, 1, 0, true});
  }
};

template <int D>
Eigen::Matrix<double, D, 1> position(const BeamSystem& system, const State& state, int beam, double s) {
  return material_point(system, state, beam, s).r.head<D>();
}

// Largest distance between the material points of both frames, and how far they have moved [m].
template <int D>
std::pair<double, double> compare(const Frame& frame, const BeamSystem& cornered, const State& one,
                                  const BeamSystem& joined, const State& two) {
  double apart = 0, moved = 0;
  const ReferenceCurve& curve = frame.cornered.beams[0].curve;
  for (int i = 0; i <= 40; ++i) {
    const double s = curve.length() * i / 40;
    const bool on_arm = s > frame.column;
    const auto r = position<D>(cornered, one, 0, s);
    apart = std::max(apart, (r - position<D>(joined, two, on_arm, on_arm ? s - frame.column : s)).norm());
    moved = std::max(moved, (r - curve.position(s).template head<D>()).norm());
  }
  return {apart, moved};
}

State equilibrium(const BeamSystem& system) {
  State state = drawn_state(system);
  const StaticReport found = find_static_equilibrium({.tolerance = 1e-12}, system, state);
  EXPECT_EQ(found.status, StaticStatus::converged);
  return state;
}

State moved_on(const BeamSystem& system, double end, int steps) {
  State start = drawn_state(system);
  EXPECT_EQ(make_accelerations_consistent(system, start), ConsistencyStatus::done);
  GeneralizedAlphaIntegrator integrator({.rho_infinity = 0.9, .newton_tolerance = 1e-12}, system, start);
  for (int i = 0; i < steps; ++i) EXPECT_EQ(integrator.advance(end / steps).status, StepStatus::converged);
  return integrator.state();
}

const BeamProperties soft{300, 2, 0.7, 0.02, {}}, undamped{300, 2, 0.7, 0, {}};

template <int D>
void check_statics(const Axis& column, const Axis& arm, const Eigen::Vector3d& gravity) {
  const Frame frame(column, arm, D, soft, gravity);
  BeamSystem cornered(frame.cornered, initial_plan(frame.cornered)),
      joined(frame.joined, initial_plan(frame.joined));
  const auto [apart, moved] = compare<D>(frame, cornered, equilibrium(cornered), joined, equilibrium(joined));
  EXPECT_LT(apart, 1e-9);
  EXPECT_GT(moved, 0.05);
}

TEST(RigidCorner, InEquilibriumIsARigidJointOfTwoBeamsInThePlane) {
  std::mt19937 random(1);
  check_statics<2>(uneven_axis(random, 2), uneven_axis(random, 2), {0.1, -0.3, 0});
}

TEST(RigidCorner, InEquilibriumIsARigidJointOfTwoBeamsInSpace) {
  // The load draws the arm away from the column's line, about which it could turn.
  const Axis line{line_cubic({0, 0, 0}, {0.6, 0, 0}), line_cubic({0.6, 0, 0}, {1, 0, 0})};
  check_statics<3>(line, line, {0.2, 1.1, -0.6});
}

template <int D>
void check_motion(int seed) {
  std::mt19937 random(seed);
  const Axis column = uneven_axis(random, D), arm = uneven_axis(random, D);
  const Frame frame(column, arm, D, soft, {2, -5, D == 3 ? 3 : 0});
  const BeamSystem cornered(frame.cornered, initial_plan(frame.cornered)),
      joined(frame.joined, initial_plan(frame.joined));
  const auto [apart, moved] =
      compare<D>(frame, cornered, moved_on(cornered, 0.3, 300), joined, moved_on(joined, 0.3, 300));
  EXPECT_LT(apart, 1e-9);
  EXPECT_GT(moved, 0.05);
}

TEST(RigidCorner, InMotionIsARigidJointOfTwoBeamsInThePlane) { check_motion<2>(2); }
TEST(RigidCorner, InMotionIsARigidJointOfTwoBeamsInSpace) { check_motion<3>(3); }

// Runge and Kutta's method keeps the acceleration on the constraint; the angle itself drifts with its order.
TEST(RigidCorner, IsKeptByRungeAndKuttaToTheOrderOfTheirMethod) {
  std::mt19937 random(5);
  const Axis column = uneven_axis(random, 3), arm = uneven_axis(random, 3);
  const Frame frame(column, arm, 3, undamped, {2, -5, 3});
  const BeamSystem system(frame.cornered, initial_plan(frame.cornered));
  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  std::vector<double> drift;
  for (const int steps : {600, 1200, 2400}) {
    ExplicitIntegrator integrator({}, system, drawn_state(system));
    for (int i = 0; i < steps; ++i) ASSERT_EQ(integrator.advance(0.5 / steps).status, StepStatus::converged);
    system.residual(integrator.state(), dynamics, constraints);
    drift.push_back(constraints.norm());
  }
  EXPECT_LT(drift[0], 1e-4);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(std::log2(drift[i] / drift[i + 1]), 4, 0.2) << drift[i];
}

// A column of height h and an arm of length L at right angles, a force P along the column at the tip: the
// arm bends as a cantilever, the moment P L turns and bends the column, P shortens it. The theory of frames
// is linear: what it leaves out grows with the load.
TEST(RigidCorner, BendsAFrameAsTheTheoryOfFramesSaysForASmallLoad) {
  const double h = 1.5, L = 1, EA = 4e4, EI = 2;
  BeamModel model;
  model.dimension = 2;
  model.beams = {
      beam_on({line_cubic({0, 0, 0}, {0, h, 0}), line_cubic({0, h, 0}, {L, h, 0})}, 2, {EA, EI, 0.7, 0, {}})};
  make_corner(model.beams[0], 1);
  model.constraints = {Support{0, 0, true}};
  std::vector<double> errors;
  for (const double P : {1e-3, 5e-4, 2.5e-4}) {
    model.forces = {PointLoad{{.s = model.beams[0].curve.length(), .value = {0, -P, 0}}}};
    BeamSystem system(model, initial_plan(model));
    const State state = equilibrium(system);
    const double turned = P * L * h / EI;
    const Eigen::Vector2d corner(turned * h / 2, h - P * h / EA),
        tip(L + turned * h / 2, h - P * h / EA - turned * L - P * L * L * L / (3 * EI));
    errors.push_back((position<2>(system, state, 0, h + L) - tip).norm() / (P / EI));
    EXPECT_LT((position<2>(system, state, 0, h) - corner).norm(), 1e-2 * turned);
  }
  EXPECT_LT(errors[0], 5e-3);
  for (int i = 0; i < 2; ++i) EXPECT_NEAR(errors[i] / errors[i + 1], 2, 0.05) << errors[i];
}

// The unit of the slopes does not matter: a drawing without metric is held at its angle too.
TEST(RigidCorner, IsFreeOfStressAsDrawnAlsoWithoutMetric) {
  std::mt19937 random(4);
  const Axis column = uneven_axis(random, 3), arm = uneven_axis(random, 3);
  Frame frame(column, arm, 3, soft, Eigen::Vector3d::Zero());
  for (BeamModel* model : {&frame.cornered, &frame.joined}) {
    for (Beam& beam : model->beams) {
      Axis axis;
      for (int j = 0; j < beam.curve.segment_count(); ++j) axis.push_back(beam.curve.segment(j));
      beam.curve = ReferenceCurve(axis, 3, Metric::label);
    }
    const BeamSystem system(*model, initial_plan(*model));
    Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
    system.residual(drawn_state(system), dynamics, constraints);
    EXPECT_LT(constraints.norm(), 1e-13);
  }
}

// Whether the node of the corner is still there when a body has come within a part of an element of it.
bool stays(NodeKind kind, double distance, bool continuous_slope = false) {
  BeamModel model = testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0}), line_cubic({1, 0, 0}, {1, 1, 0})}, 2,
                                      soft, 10, {{0, true}});
  const std::size_t corner = 5;
  EXPECT_NEAR(model.beams[0].home[corner].s, 1, 1e-12);
  model.beams[0].home[corner].kind = kind;
  testing::add_slider(model, 0.8, 1 - 0.2 * distance);
  model.riders[0].speed = 1;
  model.riders[0].continuous_slope = continuous_slope;
  const BeamSystem system(model, initial_plan(model));
  State state = drawn_state(system);
  start_moving(system, state);
  const NextPlan next = next_plan(system, state, LengthControl{});
  return system.mesh().plan.beams[0].present[corner] &&
         (next.change == MeshChange::none || next.plan.beams[0].present[corner]);
}

TEST(RigidCorner, IsNeverRemovedWhereASmoothBreakWouldBe) {
  for (const double distance : {0.5, 0.1, 0.045, 0.039, 0.01}) {
    EXPECT_TRUE(stays(NodeKind::rigid, distance)) << distance;
    EXPECT_TRUE(stays(NodeKind::hinge, distance)) << distance;
    EXPECT_TRUE(stays(NodeKind::rigid, distance, true)) << distance;
  }
  EXPECT_FALSE(stays(NodeKind::smooth, 0.039));
}

}  // namespace
}  // namespace nurbeam
