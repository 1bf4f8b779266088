#include "fem/motion/remesh/recentring.h"

#include <gtest/gtest.h>

#include <numbers>

#include "fem/motion/rest/resting_place.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "tests/fem/torsion_models.h"

namespace nurbeam {
namespace {

using std::numbers::pi;
using testing::disturbed_state;
using testing::line_cubic;
using testing::torsion_model;
using testing::with_sections;

// Of the material, by the accelerations.
double spin_rate(const BeamSystem& system, const State& state, double s) {
  const auto spin = [&](double t) {
    State then = state;
    then.q += t * state.v;
    then.v += t * state.a;
    return material_spin(system, then, 0, s);
  };
  constexpr double t = 1e-5;
  return (spin(t) - spin(-t)) / (2 * t);
}

TEST(Recentring, ChangesNothingThatCanBeSeen) {
  std::mt19937 random(3);
  const BeamSystem system(torsion_model(random, 3));
  const State state = disturbed_state(system, random, 0.3);
  const MeshedState after = recentred(system, state);
  EXPECT_FALSE(recentring_due(*after.system, after.state));
  const SystemEnergy before_energy = energy(system, state), after_energy = energy(*after.system, after.state);
  EXPECT_NEAR(after_energy.bending, before_energy.bending, 1e-12 * before_energy.bending);
  EXPECT_NEAR(after_energy.torsion, before_energy.torsion, 1e-12 * before_energy.torsion);
  EXPECT_NEAR(after_energy.kinetic, before_energy.kinetic, 1e-12 * before_energy.kinetic);
  EXPECT_NEAR(after_energy.dissipation, before_energy.dissipation, 1e-12 * before_energy.dissipation);
  for (const double s : {0.3, 1.1, 2.2}) {
    const SectionPoint a = section_point(system, state, 0, s),
                       b = section_point(*after.system, after.state, 0, s);
    EXPECT_LT((a.triad.d1 - b.triad.d1).norm(), 1e-13);
    EXPECT_NEAR(a.moments.torque, b.moments.torque, 1e-12);
    EXPECT_NEAR(spin_rate(system, state, s), spin_rate(*after.system, after.state, s), 1e-7);
  }
  // Free nodes start anew; a clamped one keeps the drawing's chart, in which its support holds it.
  const std::vector<MeshNode>& nodes = after.system->mesh().nodes[0];
  EXPECT_EQ(after.state.q[nodes[2].angle_left], 0);
  EXPECT_EQ(after.state.q[nodes[0].angle_right], state.q[nodes[0].angle_right]);
  // The same once more.
  const MeshedState again = recentred(*after.system, after.state);
  EXPECT_NEAR(energy(*again.system, again.state).torsion, before_energy.torsion,
              1e-12 * before_energy.torsion);
}

// The tangent at the tip turns by 360 degrees, where no one chart reaches.
TEST(Recentring, LetsACantileverRollUpToACircle) {
  constexpr double L = 2;
  BeamProperties properties = with_sections(0);
  properties.axial_stiffness = 1e5;
  ModelBuilder builder(3);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {L, 0, 0})}, 3).oriented({}), properties, {6});
  // d2 is z, d1 is -y: the moment about y bends with EI1, of which a product would make it twist.
  properties.sections->bending_product = 0;
  builder.beam(0).properties = properties;
  builder.clamp(0, 0).moment(0, L, {0, 2 * pi * properties.sections->bending_1 / L, 0});
  MeshedState at = MeshedState::drawn(std::make_shared<const BeamModel>(builder.build()));
  const RestReport report = find_held_equilibrium(at);
  ASSERT_FALSE(report.failure);
  EXPECT_LT(material_point(*at.system, at.state, 0, L).r.norm(), 2e-2);
  EXPECT_NEAR(material_point(*at.system, at.state, 0, L / 2).r.norm(), L / pi, 1e-2);
}

// A pendulum that swings through 180 degrees and back.
TEST(Recentring, LetsAPendulumSwingThroughHalfATurn) {
  ModelBuilder builder(3, {0, 0, -9.81});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 3).oriented({}), with_sections(0), {4});
  builder.pin(0, 0);
  const BeamModel model = builder.build();
  SimulationOptions options;
  options.end_time = 1.4;
  options.step = 1e-3;
  options.output_times = {0, 1.4};
  SimulationObserver observer;
  std::vector<Snapshot> frames;
  observer.snapshot = [&](const Snapshot& frame) { frames.push_back(frame); };
  const SimulationReport report = simulate(model, {{0, 1}}, options, observer);
  ASSERT_EQ(report.status, SimulationStatus::done);
  EXPECT_LT(report.energy_drift, 1e-3 * report.peak_kinetic_energy);
  EXPECT_LT(frames.back().probes[0].position.x(), 0);  // beyond the lowest point
}

}  // namespace
}  // namespace nurbeam
