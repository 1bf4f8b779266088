// Bodies that follow the section of a beam with torsion, beside its axis and with inertia of roll; and bodies
// that bend such a beam by an angle.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "fem/motion/run/simulation.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "solver/rest/static_equilibrium.h"
#include "tests/fem/torsion_models.h"

namespace nurbeam {
namespace {

using Eigen::Vector3d;
using testing::line_cubic;
using testing::uneven_axis;
using testing::with_sections;

/// The sine of the angle at a place of a bar of length L along x between forks, with a body that is held
/// beside it at s.
double turned_by_a_held_weight(double L, double s, double mass, double offset, double torsion, double place) {
  BeamProperties properties(1e6, 0, 1);
  properties.sections = SectionStiffness{1e4, 1e4, 0, torsion, 0.01};
  ModelBuilder builder(3, {0, 0, -10});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {L, 0, 0})}, 3), properties, {8});
  builder.fork(0, 0).fork(0, L);
  Rider& joint = builder.slide(builder.add_body("weight", mass), 0, s);
  joint.follows_section = true;
  joint.offset = {offset, 0};  // d1 is y where d2 is z
  BeamModel model = builder.build();
  model.beams[0].properties.mass_per_length = 1e-9;
  const BeamSystem system(model, initial_plan(model), {true});
  State state = drawn_state(system);
  EXPECT_EQ(find_static_equilibrium(StaticEquilibrium{}, system, state).status, StaticStatus::converged);
  return -section_point(system, state, 0, place).triad.d1.z();
}

TEST(Trolley, TwistsABarByItsWeightBesideTheAxis) {
  const double L = 2, mass = 0.3, offset = 0.2, torsion = 1.5;
  const double torque = mass * 10 * offset;
  // phi = m g e cos(phi) s (L - s)/(GJ L): m g e L/(4 GJ) in the middle.
  for (const double s : {1.0, 0.6}) {
    double angle = 0;
    for (int i = 0; i < 100; ++i) angle = torque * std::cos(angle) * s * (L - s) / (torsion * L);
    EXPECT_NEAR(turned_by_a_held_weight(L, s, mass, offset, torsion, s), std::sin(angle), 1e-4 * angle) << s;
  }
  // On a point of an element, whose twist has no kink: exact at its nodes.
  const double s = 1.98, node = 1.75;
  EXPECT_NEAR(turned_by_a_held_weight(L, s, mass, offset, torsion, node),
              std::sin(torque * (L - s) / L * node / torsion), 1e-4 * torque);
}

SimulationReport ride(const BeamModel& model, double end, double step, const SimulationObserver& observer,
                      const Checkpoint* from = nullptr) {
  SimulationOptions options;
  options.end_time = end;
  options.step = step;
  for (int i = 0; i <= 4; ++i) options.output_times.push_back(end * i / 4);
  return simulate(model, {}, options, observer, from);
}

int events_of(const SimulationReport& report, EventKind kind) {
  return static_cast<int>(std::count_if(
      report.events.begin(), report.events.end(), [&](const RunEvent& event) { return event.kind == kind; }));
}

// A rail that hardly gives, whose sections turn by tau per length, and a trolley beside it: the motion with
// (m (1 + e^2 tau^2) + J tau^2) s'' = m g e tau sin(tau s) is that of one coordinate.
TEST(Trolley, RunsDownATwistedRailAsOneCoordinateDoes) {
  const double L = 3, tau = 1.5, mass = 0.7, e = 0.25, J = 0.2, g = 9.81, start = 0.5;
  BeamProperties properties(1e7, 0, 30);
  properties.sections = SectionStiffness{1e6, 1e6, 0, 1e6, 1};
  ModelBuilder builder(3, {0, 0, -g});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {L, 0, 0})}, 3)
                       .oriented({Orientation::Rule::up, {0, 0, 1}, {{0, 0}, {L, tau * L}}}),
                   properties, {10});
  builder.clamp(0, 0).clamp(0, L);
  Rider& joint = builder.slide(builder.add_body("trolley", mass), 0, start, 0.4);
  joint.follows_section = true;
  joint.offset = {0, e};  // above the rail where it starts
  BeamModel model = builder.build();
  model.bodies[0].roll_inertia = J;
  Checkpoint last;
  SimulationObserver observer;
  observer.checkpoint = [&](const Checkpoint& now) { last = now; };
  const double end = 0.8;
  const SimulationReport report = ride(model, end, 5e-4, observer);
  EXPECT_EQ(report.status, SimulationStatus::done);
  EXPECT_GE(events_of(report, EventKind::merge), 2);
  EXPECT_LT(report.energy_drift, 1e-3 * report.peak_kinetic_energy);
  double s = start, v = 0.4;
  const double inertia = mass * (1 + e * e * tau * tau) + J * tau * tau;
  const auto acceleration = [&](double at) { return mass * g * e * tau * std::sin(tau * at) / inertia; };
  const int steps = 20000;
  for (int i = 0; i < steps; ++i) {  // Stoermer-Verlet
    const double h = end / steps;
    v += h / 2 * acceleration(s);
    s += h * v;
    v += h / 2 * acceleration(s);
  }
  const BeamSystem at_end(model, last.plan);
  EXPECT_GT(s - start, 0.8);
  EXPECT_NEAR(*place(at_end, last.state, 0), s, 5e-4);  // the rail gives a little
  EXPECT_NEAR(place_rate(at_end, last.state, 0), v, 5e-3);
}

/// A twisted rail of unlike CAD segments with a trolley beside it, or a cable with a body that bends it by an
/// angle.
BeamModel trolley_rail(double speed, const Vector3d& gravity, bool clamped, bool kinked) {
  std::mt19937 random(4);
  ModelBuilder builder(3, gravity);
  BeamProperties properties = with_sections(0);
  properties.axial_stiffness = 3000;
  if (kinked) properties.sections = SectionStiffness{0.03, 0.02, 0.005, 0.02, 0.01};  // of a cable
  builder.add_beam(ReferenceCurve(uneven_axis(random, 3), 3)
                       .oriented({Orientation::Rule::start, {0.3, 0.2, 1}, {{0, 0}, {1, 0.7}, {4, 2}}}),
                   properties, {10});
  const double L = builder.beam(0).curve.length();
  if (clamped) builder.clamp(0, 0).clamp(0, L);
  Rider& joint = builder.slide(builder.add_body("trolley", 0.3), 0, 0.23 * L, speed);
  joint.continuous_slope = !kinked;
  if (!kinked) {
    joint.follows_section = true;
    joint.offset = {0.1, -0.15};
  }
  BeamModel model = builder.build();
  if (!kinked) model.bodies[0].roll_inertia = 0.02;
  return model;
}

// The kink starts waves that only short steps resolve; longer ones damp them.
TEST(Trolley, KeepsTheEnergyThroughSplitsAndMerges) {
  for (const bool kinked : {false, true}) {
    const BeamModel model = trolley_rail(1.5, {0.3, -1, -2}, true, kinked);
    const double end = kinked ? 0.12 : 0.6;
    std::vector<double> drifts;
    for (const double step : kinked ? std::array{2.5e-4, 6.25e-5} : std::array{1e-3, 5e-4}) {
      Checkpoint last;
      SimulationObserver observer;
      observer.checkpoint = [&](const Checkpoint& now) { last = now; };
      const SimulationReport report = ride(model, end, step, observer);
      EXPECT_EQ(report.status, SimulationStatus::done);
      EXPECT_GE(events_of(report, EventKind::merge), kinked ? 1 : 2);
      EXPECT_GT(energy(BeamSystem(model, last.plan), last.state).torsion, 1e-5);
      drifts.push_back(report.energy_drift / report.peak_kinetic_energy);
    }
    EXPECT_LT(drifts[1], 2e-3);
    EXPECT_LT(drifts[1], std::max(0.6 * drifts[0], 1e-6)) << drifts[0];
  }
}

TEST(Trolley, KeepsTheMomentumOfAFreeRail) {
  for (const bool kinked : {false, true}) {
    const BeamModel model = trolley_rail(1.5, {0, 0, 0}, false, kinked);
    Checkpoint first, last;
    SimulationObserver observer;
    int points = 0;
    observer.checkpoint_due = [&] { return points == 0; };
    observer.checkpoint = [&](const Checkpoint& now) { (points++ == 0 ? first : last) = now; };
    const SimulationReport report = ride(model, 0.6, kinked ? 5e-4 : 1e-3, observer);
    EXPECT_EQ(report.status, SimulationStatus::done);
    EXPECT_GE(events_of(report, EventKind::merge), 1);
    const Vector3d start = momentum(BeamSystem(model, first.plan), first.state),
                   end = momentum(BeamSystem(model, last.plan), last.state);
    EXPECT_GT(start.norm(), 0.1);
    EXPECT_LT((end - start).norm(), (kinked ? 5e-4 : 5e-5) * start.norm());
  }
}

TEST(Trolley, GoesOnFromACheckpointBitByBit) {
  const BeamModel model = trolley_rail(1.5, {0.3, -1, -2}, true, false);
  Checkpoint middle, end, resumed;
  int steps = 0;
  SimulationObserver observer;
  observer.checkpoint_due = [&] { return ++steps == 200; };
  observer.checkpoint = [&](const Checkpoint& now) { (steps <= 200 ? middle : end) = now; };
  ride(model, 0.4, 1e-3, observer);
  SimulationObserver again;
  again.checkpoint = [&](const Checkpoint& now) { resumed = now; };
  ride(model, 0.4, 1e-3, again, &middle);
  EXPECT_EQ(resumed.state.t, end.state.t);
  EXPECT_EQ(resumed.state.q, end.state.q);
  EXPECT_EQ(resumed.state.v, end.state.v);
}

// It goes on to roll and to fly as it did.
TEST(Trolley, TakesItsMotionWithItWhereItLeavesTheRail) {
  const double L = 1.5;
  BeamProperties properties = with_sections(0);
  ModelBuilder builder(3, {0, 0, 0});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {L, 0, 0})}, 3)
                       .oriented({Orientation::Rule::up, {0, 0, 1}, {{0, 0}, {L, 2}}}),
                   properties, {6});
  builder.clamp(0, 0);
  Rider& joint = builder.slide(builder.add_body("trolley", 0.1), 0, 0.8, 2);
  joint.follows_section = true;
  joint.offset = {0.05, 0.1};
  BeamModel model = builder.build();
  model.bodies[0].roll_inertia = 0.01;
  const SimulationReport report = ride(model, 0.5, 2e-4, {});
  EXPECT_EQ(report.status, SimulationStatus::done);
  ASSERT_EQ(events_of(report, EventKind::left_beam), 1);
  const RunEvent& left = *std::find_if(report.events.begin(), report.events.end(), [](const RunEvent& event) {
    return event.kind == EventKind::left_beam;
  });
  EXPECT_NEAR(left.energy_after, left.energy_before, 1e-9 * left.energy_before);
  EXPECT_LT(report.energy_drift, 1e-3 * report.peak_kinetic_energy);
}

// A ring whose sections come back turned by its holonomy: a body without mass goes all around it.
TEST(Trolley, GoesAroundARingWithHolonomy) {
  const Vector3d a(0, 0, 0), b(1, 0.5, 0.3), along_a(0, -0.8, 0.5), along_b(0.2, 0.9, 0.4);
  const auto cubic = [](const std::array<Vector3d, 4>& P) {
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) points.col(i) << P[i], 1;
    return RationalCubic(points);
  };
  const ReferenceCurve curve(
      {cubic({a, a + along_a, b - along_b, b}), cubic({b, b + along_b, a - along_a, a})}, 3,
      Metric::arc_length, true);
  ModelBuilder builder(3);
  builder.add_beam(curve, with_sections(0), {12});
  const double L = curve.length();
  builder.clamp(0, 0.6 * L);
  Rider& joint = builder.slide(builder.add_body("bead", 1e-9), 0, 0.1 * L);
  joint.motion = TimeTable{{0, 0.1 * L}, {1, 1.15 * L}};
  joint.follows_section = true;
  joint.offset = {0.05, 0.02};
  const BeamModel model = builder.build();
  EXPECT_GT(std::abs(model.beams[0].curve.holonomy()), 0.1);
  double largest = 0;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& now) {
    largest = std::max({largest, now.energy.kinetic, now.energy.axial + now.energy.bending});
  };
  const SimulationReport report = ride(model, 1, 2e-3, observer);
  EXPECT_EQ(report.status, SimulationStatus::done);
  EXPECT_GE(events_of(report, EventKind::merge), 9);
  // Of the kinetic energy that the ring would have at the body's speed.
  EXPECT_LT(largest, 1e-4 * 0.7 * L * std::pow(1.05 * L, 2) / 2);
}

// A taut rod with a kink in its midst: a torque at its end twists it as if there were none.
TEST(Trolley, PassesTorsionOverTheKinkThatABodyMakes) {
  const double torque = 0.3;
  ModelBuilder builder(3, {0, 0, -10});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 3), with_sections(0), {8});
  const double L = builder.beam(0).curve.length();
  builder.clamp(0, 0).force(0, L, {200, 0, 0});
  builder.add(Moment{{0, L, 0, {torque, 0, 0}, true, {}}});
  builder.slide(builder.add_body("hook", 0.5), 0, 0.55 * L).continuous_slope = false;
  const BeamModel model = builder.build();
  const BeamSystem system(model, initial_plan(model), {true});
  State state = drawn_state(system);
  ASSERT_EQ(find_static_equilibrium(StaticEquilibrium{}, system, state).status, StaticStatus::converged);
  const double here = 0.55 * L;
  const auto slope = [&](double s) { return material_point(system, state, 0, s).rs.normalized(); };
  EXPECT_GT((slope(here + 1e-9) - slope(here - 1e-9)).norm(), 1e-3);  // it is a kink
  for (const double s : {0.3, 0.9, 1.3, 1.8})
    EXPECT_NEAR(section_point(system, state, 0, s).moments.torque, torque, 5e-3 * torque) << s;
}

}  // namespace
}  // namespace nurbeam
