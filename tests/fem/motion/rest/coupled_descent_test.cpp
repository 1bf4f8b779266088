#include "fem/motion/rest/coupled_descent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "fem/motion/rest/modes.h"
#include "fem/motion/run/simulation.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using std::numbers::pi;
constexpr double gravity_of_bowl = 9.81, radius_of_bowl = 5, first_mass = 30, second_mass = 20;

// ---- A move within limits ----

const Eigen::MatrixXd stiff_pair = (Eigen::Matrix2d() << 1e8 + 3, -1e8, -1e8, 1e8 + 3).finished();

TEST(LeastWithin, IsNewtonsStepHoweverStiffBodiesAreCoupled) {
  const Eigen::Vector2d f(4, 2);
  const LimitedMove move = least_within(f, stiff_pair, 1e-9, 0.1, {});
  EXPECT_NEAR(move.x.sum(), -2, 1e-7);  // -(f1 + f2)/3
  EXPECT_NEAR(move.x[1] - move.x[0], 1e-8, 1e-13);
}

TEST(LeastWithin, StopsWhereALimitIsAndSaysWhatPushes) {
  const std::vector<MoveLimit> limits{{Eigen::Vector2d(1, 0), -0.25, MoveLimit::Of::stop},
                                      {Eigen::Vector2d(0, 1), -9, MoveLimit::Of::stop}};
  const LimitedMove move = least_within(Eigen::Vector2d(4, 2), stiff_pair, 1e-9, 0.1, limits);
  EXPECT_NEAR(move.x[0], -0.25, 1e-9);
  EXPECT_NEAR(move.x[1], -0.25, 1e-7);
  EXPECT_TRUE(move.pushed[0]);
  EXPECT_FALSE(move.pushed[1]);
}

TEST(LeastWithin, GoesDownFromARidge) {
  const Eigen::MatrixXd ridge = Eigen::Vector2d(-2, 5).asDiagonal();
  EXPECT_NEAR(least_within(Eigen::Vector2d(1, 1), ridge, 1e-9, 0.1, {}).x[0], -0.5, 1e-12);
  EXPECT_NEAR(std::abs(least_within(Eigen::Vector2d(0, 0), ridge, 1e-9, 0.1, {}).x[0]), 0.1, 1e-12);
}

// ---- Where coupled bodies rest ----

/// A half circle with its lowest place at s = pi R/2, with two bodies on it.
ModelBuilder bowl(double first_at, double second_at, const std::optional<Friction>& friction = {}) {
  ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
  builder.add_guide(ReferenceCurve(testing::arc_cubics({0, 0, 0}, radius_of_bowl, pi, 2 * pi, 4), 2));
  for (const auto& [mass, s] : {std::pair{first_mass, first_at}, std::pair{second_mass, second_at}})
    builder.slide(builder.add_body("", mass), 0, s).friction = friction;
  return builder;
}

Snapshot rest_of(const BeamModel& model) {
  std::optional<Snapshot> found;
  const SimulationReport report = simulate(model, {}, {.statics = true, .output_times = {0}},
                                           {.snapshot = [&](const Snapshot& frame) { found = frame; }});
  EXPECT_EQ(report.status, SimulationStatus::done);
  return found.value();
}

/// From the lowest place [rad].
double angle_of(const Snapshot& rest, int body) { return *rest.bodies[body].s / radius_of_bowl - pi / 2; }

// A strut keeps them apart: m1 sin(phi - beta) + m2 sin(phi + beta) = 0, and its push k (l - 2 R sin beta)
// holds each on its slope.
TEST(CoupledRest, OfTwoBodiesOnAStrutIsThatOfBothTogether) {
  for (const double stiffness : {2e2, 2e4, 2e6, 2e8}) {
    ModelBuilder builder = bowl(0.5, 2);
    builder.connect(Grip::on_body(0), Grip::on_body(1), ConnectorType::spring, stiffness);
    BeamModel model = builder.build();
    const double length = 2 * radius_of_bowl * std::sin(0.75 / radius_of_bowl);
    model.connectors[0].length = length;
    double beta = 0.75 / radius_of_bowl, phi = 0;
    for (int i = 0; i < 200; ++i) {
      phi = std::atan((first_mass - second_mass) / (first_mass + second_mass) * std::tan(beta));
      const double push = second_mass * gravity_of_bowl * std::sin(phi + beta) / std::cos(beta);
      beta = (beta + std::asin((length - push / stiffness) / (2 * radius_of_bowl))) / 2;
    }
    const Snapshot rest = rest_of(model);
    EXPECT_NEAR(angle_of(rest, 0), phi - beta, 1e-8) << stiffness;
    EXPECT_NEAR(angle_of(rest, 1), phi + beta, 1e-8) << stiffness;
    EXPECT_NEAR(rest.bodies[0].holding_force, 0, 1e-6) << stiffness;
  }
}

// A stop between them, hard or a buffer: m1 sin phi1 + m2 sin phi2 = 0, R (phi2 - phi1) its gap less what it
// gives.
TEST(CoupledRest, OfTwoBodiesAgainstEachOtherIsThatOfBothTogether) {
  const double gap = 1;
  for (const std::optional<Buffer>& buffer : {std::optional<Buffer>{}, std::optional<Buffer>{Buffer{3e4}}})
    for (const double start : {0.5, 12.0}) {
      BeamModel model = bowl(start, start + 1.5).build();
      model.stops = {{.rider = 0, .other = 1, .place = gap, .buffer = buffer}};
      const Snapshot rest = rest_of(model);
      const double first = angle_of(rest, 0), second = angle_of(rest, 1);
      EXPECT_NEAR(first_mass * std::sin(first) + second_mass * std::sin(second), 0, 1e-6);
      const double push = second_mass * gravity_of_bowl * std::sin(second);
      EXPECT_NEAR(radius_of_bowl * (second - first), gap - (buffer ? push / buffer->stiffness : 0), 1e-8);
      EXPECT_GT(push, 10);
    }
}

// On a rope that sags the middle of the two is its middle, whatever joins them.
TEST(CoupledRest, OfATrainOnARopeIsAboutItsMiddle) {
  for (const ConnectorType type : {ConnectorType::rod, ConnectorType::spring}) {
    ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
    BeamProperties rope(2e7, 20, 0.9);
    rope.free_strain.of_tension = -6000 / rope.axial_stiffness;
    builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, {20, 0, 0})}, 2), rope, {20});
    builder.pin(0, 0).pin(0, 20);
    for (const double s : {4.0, 6.0})
      builder.slide(builder.add_body("", first_mass), 0, s).continuous_slope = false;
    builder.connect(Grip::on_body(0), Grip::on_body(1), type, type == ConnectorType::rod ? 0 : 1e7);
    const Snapshot rest = rest_of(builder.build());
    EXPECT_NEAR(*rest.bodies[0].s + *rest.bodies[1].s, 20, 1e-5);
    EXPECT_NEAR(*rest.bodies[1].s - *rest.bodies[0].s, 2, 1e-2);
  }
}

// One lies on a stop and the other on it, from as near to both as may be.
TEST(CoupledRest, OfTwoBodiesThatNearlyLieOnAStopIsOnIt) {
  for (const double off : {1e-6, 1e-4, 3e-3, 0.1}) {
    ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
    const double c = std::sqrt(0.75), area = pi * 4e-4;
    builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, {3 * c, 1.5, 0})}, 2),
                     BeamProperties(2e11 * area, 2e11 * area * 1e-4, 7850 * area), {12});
    builder.clamp(0, 0).guide(0, 3, {c, 0.5, 0});
    builder.slide(builder.add_body("", 10), 0, 1 + off);
    builder.slide(builder.add_body("", 20), 0, 1.5 + 2 * off);
    BeamModel model = builder.build();
    model.stops = {{.rider = 0, .place = 1, .from_below = false}, {.rider = 0, .other = 1, .place = 0.5}};
    const Snapshot rest = rest_of(model);
    EXPECT_NEAR(*rest.bodies[0].s, 1, 1e-9) << off;
    EXPECT_NEAR(*rest.bodies[1].s, 1.5, 1e-5) << off;  // the bar bends between them
  }
}

// What hangs on a rod has no stiffness but by the pull of the rod, and bodies between which there is a soft
// buffer are not moved through it.
TEST(CoupledRest, OfATrolleyWithALoadIsWhereTheRopeIsLowest) {
  for (const bool rod : {true, false}) {
    ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
    BeamProperties rope(2e7, 20, 0.9);
    rope.free_strain.of_tension = -6000 / rope.axial_stiffness;
    builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, {20, 0, 0})}, 2), rope, {20});
    builder.pin(0, 0).pin(0, 20);
    builder.slide(builder.add_body("", 10), 0, 3).continuous_slope = false;
    if (rod) {
      builder.add_body("", 50, {2.5, -1.5, 0});
      builder.connect(Grip::on_body(0), Grip::on_body(1), ConnectorType::rod);
    } else {
      builder.slide(builder.add_body("", 10), 0, 15).continuous_slope = false;
    }
    BeamModel model = builder.build();
    if (!rod) model.stops = {{.rider = 0, .other = 1, .place = 2, .buffer = Buffer{2000}}};
    const Snapshot rest = rest_of(model);
    const double second = rod ? *rest.bodies[0].s : *rest.bodies[1].s;
    EXPECT_NEAR((*rest.bodies[0].s + second) / 2, 10, 1e-5) << rod;
    if (!rod) EXPECT_GT(second - *rest.bodies[0].s, 1);
  }
}

// With friction they stay, or slide on until what pulls each is no more than it holds.
TEST(CoupledRest, IsWhereFrictionHoldsEach) {
  const Friction friction{.coefficient = 0.2};
  const auto with_strut = [&](double first, double second) {
    ModelBuilder builder = bowl(first, second, friction);
    builder.connect(Grip::on_body(0), Grip::on_body(1), ConnectorType::spring, 1e7);
    BeamModel model = builder.build();
    model.connectors[0].length = 2 * radius_of_bowl * std::sin((second - first) / (2 * radius_of_bowl));
    return rest_of(model);
  };
  const double bottom = radius_of_bowl * pi / 2;
  EXPECT_NEAR(*with_strut(bottom - 0.9, bottom + 0.6).bodies[0].s, bottom - 0.9, 1e-6);
  const Snapshot rest = with_strut(0.5, 2);
  const double N = rest.connectors[0].force;
  for (const int i : {0, 1}) {
    const double m = i == 0 ? first_mass : second_mass, phi = angle_of(rest, i);
    const double beta = (angle_of(rest, 1) - angle_of(rest, 0)) / 2;
    const double along = -m * gravity_of_bowl * std::sin(phi) + (i == 0 ? N : -N) * std::cos(beta);
    const double across = m * gravity_of_bowl * std::cos(phi) - N * std::sin(beta);
    EXPECT_LE(std::abs(along), friction.coefficient * across * (1 + 1e-6)) << i;
  }
  EXPECT_LT(angle_of(rest, 0) + angle_of(rest, 1), 0);  // they came from there
  EXPECT_GT(angle_of(rest, 0), -0.5);
}

// ---- Where bodies come to the end of their beam ----

SimulationReport resting(const BeamModel& model) {
  return simulate(model, {}, {.statics = true, .output_times = {0}}, {});
}

/// A straight guide that falls to its end at s = 5 m, with bodies at rest on it.
ModelBuilder slope(const std::vector<double>& places) {
  ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
  builder.add_guide(ReferenceCurve({testing::line_cubic({0, 0, 0}, {4, -3, 0})}, 2));
  for (const double s : places) builder.slide(builder.add_body("", first_mass), 0, s);
  return builder;
}

void expect_leaving(const BeamModel& model, int joint) {
  const SimulationReport report = resting(model);
  ASSERT_TRUE(report.failure);
  EXPECT_EQ(report.failure->kind, Failure::Kind::leaves_beam);
  EXPECT_EQ(report.failure->rider, joint);
  EXPECT_NEAR(report.failure->places[joint].s, 5, 1e-9);
}

TEST(RestAtAnEnd, IsNoneForABodyThatSlidesOff) {
  for (const double start : {1.0, 5.0}) expect_leaving(slope({start}).build(), 0);
  ModelBuilder with_friction = slope({1});
  BeamModel model = with_friction.build();
  model.riders[0].friction = Friction{.coefficient = 0.1};
  expect_leaving(model, 0);
}

TEST(RestAtAnEnd, IsThatOfABodyThatSomethingHolds) {
  BeamModel stopped_by_end = slope({1}).build();
  stopped_by_end.riders[0].leave_at_end = false;
  EXPECT_NEAR(*rest_of(stopped_by_end).bodies[0].s, 5, 1e-9);
  for (const double start : {1.0, 5.0}) {
    BeamModel stopped = slope({start}).build();
    stopped.stops = {{.rider = 0, .place = 5}};
    EXPECT_NEAR(*rest_of(stopped).bodies[0].s, 5, 1e-9) << start;
  }
  // Pressed inwards, against a stop at the upper end.
  BeamModel inwards = slope({0}).build();
  inwards.stops = {{.rider = 0, .place = 0}};
  EXPECT_NEAR(*rest_of(inwards).bodies[0].s, 0, 1e-9);
  BeamModel held = slope({5}).build();
  held.riders[0].rest = StaticPlace::held;
  EXPECT_NEAR(*rest_of(held).bodies[0].s, 5, 1e-9);
  BeamModel rough = slope({5}).build();
  rough.riders[0].friction = Friction{.coefficient = 0.9};
  EXPECT_NEAR(*rest_of(rough).bodies[0].s, 5, 1e-9);
  BeamModel weightless = slope({5}).build();
  weightless.gravity.setZero();
  EXPECT_NEAR(*rest_of(weightless).bodies[0].s, 5, 1e-9);
}

TEST(RestAtAnEnd, IsNoneForBodiesOfWhichOneSlidesOff) {
  BeamModel model = slope({1, 3}).build();
  model.stops = {{.rider = 0, .other = 1, .place = 1}};
  expect_leaving(model, 1);
  model.stops.push_back({.rider = 1, .place = 5});
  const Snapshot rest = rest_of(model);
  EXPECT_NEAR(*rest.bodies[0].s, 4, 1e-9);
  EXPECT_NEAR(*rest.bodies[1].s, 5, 1e-9);
}

// The lower of two on a guide rests at a stop, and bears the other by a spring.
TEST(RestAtAnEnd, IsThatOfABodyThatBearsAnotherByASpring) {
  for (const double askew : {0.0, 1.0, 2.3})
    for (const double stiffness : {1e3, 1e5}) {
      ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
      const Eigen::Vector3d end(std::hypot(8, askew), -6, 0);
      builder.add_guide(ReferenceCurve({testing::line_cubic({0, 0, 0}, end)}, 2));
      for (const double s : {2.0, 4.0}) builder.slide(builder.add_body("", 10), 0, s);
      builder.connect(Grip::on_body(0), Grip::on_body(1), ConnectorType::spring, stiffness);
      BeamModel model = builder.build();
      model.stops = {{.rider = 1, .place = 7}};
      const Snapshot rest = rest_of(model);
      const double pull = 10 * gravity_of_bowl * 6 / end.norm();
      EXPECT_NEAR(*rest.bodies[1].s, 7, 1e-9) << askew;
      EXPECT_NEAR(*rest.bodies[0].s, 5 + pull / stiffness, 1e-9) << askew;
    }
}

// However stiff it is: the force of a slope ends in one that is up to a million times as steep.
TEST(RestAtAnEnd, IsWhereABufferHoldsABody) {
  for (const double start : {0.3, 1.0, 2.2, 3.9})
    for (const double stiffness : {1e2, 3e4, 1e6}) {
      BeamModel model = slope({start}).build();
      model.stops = {{.rider = 0, .place = 4, .buffer = Buffer{stiffness}}};
      const double pull = first_mass * gravity_of_bowl * 0.6;
      const double rest = std::min(5.0, 4 + pull / stiffness);
      if (rest < 5)
        EXPECT_NEAR(*rest_of(model).bodies[0].s, rest, 1e-6) << start << ' ' << stiffness;
      else
        expect_leaving(model, 0);
    }
}

// Where round-off leaves it a little off the end.
TEST(RestAtAnEnd, IsFoundFromAnywhere) {
  for (int i = 1; i < 60; ++i) {
    ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
    builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, {4, 3, 0})}, 2),
                     BeamProperties(2e7, 2e4, 1), {8});
    builder.clamp(0, 0).clamp(0, 5);
    builder.slide(builder.add_body("", 1), 0, i / 13.3);
    const ModesReport report =
        find_modes(std::make_shared<BeamModel>(builder.build()), {.bodies_held = false}, {});
    EXPECT_FALSE(report.rest.failure) << i;
  }
}

TEST(RestAtAnEnd, IsThatOfABodyAtASupportedEnd) {
  const auto beam = [](bool pinned) {
    ModelBuilder builder(2, {0, -gravity_of_bowl, 0});
    builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, {4, -3, 0})}, 2),
                     BeamProperties(2e7, 2e4, 1), {4});
    builder.clamp(0, 0);
    if (pinned) builder.pin(0, 5);
    builder.slide(builder.add_body("", 1), 0, 3.5);
    return builder.build();
  };
  EXPECT_NEAR(*rest_of(beam(true)).bodies[0].s, 5, 1e-9);
  expect_leaving(beam(false), 0);
}

}  // namespace
}  // namespace nurbeam
