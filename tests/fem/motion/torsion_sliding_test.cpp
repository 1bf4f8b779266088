// Bodies that slide on beams with torsion.

#include <gtest/gtest.h>

#include "fem/motion/remesh/carried_sections.h"
#include "fem/motion/remesh/recentring.h"
#include "fem/motion/remesh/transfer.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "tests/fem/torsion_models.h"

namespace nurbeam {
namespace {

using Eigen::Vector3d;
using testing::arc_cubics;
using testing::disturbed_state;
using testing::line_cubic;
using testing::uneven_axis;
using testing::with_sections;

/// A twisted rail of unlike CAD segments in space with a body of that mass and speed on it.
BeamModel rail(double mass, double speed, const Vector3d& gravity, double damping = 0, bool held = true) {
  std::mt19937 random(4);
  ModelBuilder builder(3, gravity);
  BeamProperties properties = with_sections(damping);
  properties.axial_stiffness = 3000;
  builder.add_beam(ReferenceCurve(uneven_axis(random, 3), 3)
                       .oriented({Orientation::Rule::start, {0.3, 0.2, 1}, {{0, 0}, {1, 0.7}, {4, 2}}}),
                   properties, {10});
  const double L = builder.beam(0).curve.length();
  if (held) builder.clamp(0, 0).clamp(0, L);
  builder.slide(builder.add_body("trolley", mass), 0, 0.23 * L, speed);
  return builder.build();
}

SimulationReport run_sliding(const BeamModel& model, double end, double step,
                             const std::function<void(const Snapshot&)>& at_snapshot,
                             const SimulationObserver& more = {}, const Checkpoint* from = nullptr) {
  SimulationOptions options;
  options.end_time = end;
  options.step = step;
  for (int i = 0; i <= 10; ++i) options.output_times.push_back(end * i / 10);
  SimulationObserver observer = more;
  observer.snapshot = at_snapshot;
  return simulate(model, {}, options, observer, from);
}

int count(const SimulationReport& report, EventKind kind) {
  return static_cast<int>(std::count_if(
      report.events.begin(), report.events.end(), [&](const RunEvent& event) { return event.kind == kind; }));
}

// K13 through splits, merges and a break: the node moves, the rail does not.
TEST(TorsionSliding, LeavesARailAtRestUnderABodyWithoutMass) {
  BeamModel model = rail(1e-9, 0, {0, 0, 0});
  const double L = model.beams[0].curve.length();
  model.riders[0].motion = TimeTable{{0, 0.23 * L}, {1, 0.77 * L}};
  double largest = 0;
  const SimulationReport report = run_sliding(model, 1, 2e-3, [&](const Snapshot& now) {
    largest = std::max({largest, now.energy.kinetic, now.energy.axial + now.energy.bending});
  });
  EXPECT_EQ(report.status, SimulationStatus::done);
  EXPECT_GE(count(report, EventKind::split), 3);
  EXPECT_GE(count(report, EventKind::merge), 3);
  EXPECT_GE(count(report, EventKind::becomes_point), 1);
  EXPECT_LT(largest, 1e-6);
}

TEST(TorsionSliding, KeepsTheEnergyThroughSplitsAndMerges) {
  const BeamModel model = rail(0.3, 1.5, {0.3, -1, -2});
  Checkpoint last;
  SimulationObserver observer;
  observer.checkpoint = [&](const Checkpoint& now) { last = now; };
  const SimulationReport report = run_sliding(model, 0.8, 5e-4, nullptr, observer);
  const double torsion = energy(BeamSystem(model, last.plan), last.state).torsion;
  EXPECT_EQ(report.status, SimulationStatus::done);
  EXPECT_GE(count(report, EventKind::split), 2);
  EXPECT_GE(count(report, EventKind::merge), 2);
  EXPECT_GT(torsion, 1e-3 * report.peak_kinetic_energy);
  EXPECT_LT(report.energy_drift, 2e-3 * report.peak_kinetic_energy);
}

TEST(TorsionSliding, KeepsTheMomentumOfAFreeRail) {
  const BeamModel model = rail(0.3, 1.5, {0, 0, 0}, 0.01, false);
  const BeamSystem system(model);
  State state = drawn_state(system);
  start_moving(system, state);
  const Vector3d start = momentum(system, state);
  Checkpoint last;
  SimulationObserver observer;
  observer.checkpoint = [&](const Checkpoint& now) { last = now; };
  const SimulationReport report = run_sliding(model, 0.8, 1e-3, nullptr, observer);
  EXPECT_EQ(report.status, SimulationStatus::done);
  EXPECT_GE(count(report, EventKind::merge), 1);
  const BeamSystem at_end(model, last.plan);
  EXPECT_LT((momentum(at_end, last.state) - start).norm(), 1e-5 * start.norm());
}

TEST(TorsionSliding, GoesOnFromACheckpointBitByBit) {
  const BeamModel model = rail(0.3, 1.5, {0.3, -1, -2}, 0.002);
  Checkpoint middle, end, resumed;
  int steps = 0;
  SimulationObserver observer;
  observer.checkpoint_due = [&] { return ++steps == 300; };
  observer.checkpoint = [&](const Checkpoint& now) { (steps <= 300 ? middle : end) = now; };
  run_sliding(model, 0.6, 1e-3, nullptr, observer);
  ASSERT_FALSE(middle.plan.section_charts.empty());
  SimulationObserver again;
  again.checkpoint = [&](const Checkpoint& now) { resumed = now; };
  run_sliding(model, 0.6, 1e-3, nullptr, again, &middle);
  EXPECT_EQ(resumed.state.t, end.state.t);
  EXPECT_EQ(resumed.state.q, end.state.q);
  EXPECT_EQ(resumed.state.v, end.state.v);
}

/// A rail before and behind a split beside its body and one between fixed ends. `like`: makes the plan behind
/// it that of a neighbour.
void expect_the_same_sections_after_a_split(const std::function<void(MeshPlan&)>& like) {
  std::mt19937 random(8);
  BeamModel model = rail(0.3, 1, {0, 0, 0}, 0, false);
  model.beams[0].properties.axial_strain = AxialStrain::pointwise;
  MeshPlan coarse = initial_plan(model);
  coarse.beams[0].present.assign(coarse.beams[0].present.size(), true);
  MeshPlan full = coarse;
  coarse.beams[0].present[3] = false;  // beside the joint
  coarse.beams[0].present[7] = false;  // between fixed ends
  const BeamSystem from(model, coarse);
  const State before = disturbed_state(from, random, 0.04);
  // As length control does it: in the charts of the present sections.
  MeshedState at = recentred(from, before);
  full.places = at.system->mesh().plan.places;
  carry_sections(*at.system, at.state, full);
  if (like) {
    MeshPlan of_neighbour = full;
    like(of_neighbour);
    carry_sections(*at.system, at.state, full, &of_neighbour);
  }
  const BeamSystem to(model, full);
  const State after = interpolated(*at.system, at.state, to);
  for (int i = 0; i < 50; ++i) {
    const double s = model.beams[0].curve.length() * (i + 0.5) / 50;
    const SectionPoint a = section_point(*at.system, at.state, 0, s), b = section_point(to, after, 0, s);
    EXPECT_LT((a.triad.d1 - b.triad.d1).norm(), 1e-5) << s;
    EXPECT_NEAR(a.strain.twist, b.strain.twist, 5e-5) << s;
    EXPECT_NEAR(material_spin(*at.system, at.state, 0, s), material_spin(to, after, 0, s), 1e-4) << s;
  }
  const SystemEnergy a = energy(*at.system, at.state), b = energy(to, after);
  EXPECT_NEAR(b.torsion, a.torsion, 1e-4 * a.torsion);
  EXPECT_NEAR(b.kinetic, a.kinetic, 1e-4 * a.kinetic);
  EXPECT_GT(a.torsion, 1e-3);
}

TEST(TorsionSliding, HasTheSameSectionsAfterASplit) { expect_the_same_sections_after_a_split(nullptr); }

TEST(TorsionSliding, HasTheSameSectionsInChartsOfANeighbour) {
  const Eigen::Matrix3d swing(Eigen::AngleAxisd(0.3, Vector3d(0.2, -1, 0.4).normalized()));
  expect_the_same_sections_after_a_split([&](MeshPlan& plan) {
    for (MeshPlan::SectionCharts& each : plan.section_charts)
      for (Eigen::Matrix3d& chart : each.charts)
        chart = swing * chart * Eigen::AngleAxisd(0.5, Vector3d::UnitZ());
  });
}

// Where all sections of a neighbour are turned alike, those of new nodes are too.
TEST(TorsionSliding, TurnsChartsOfANeighbourAsThoseBesideThem) {
  std::mt19937 random(9);
  const BeamModel model = rail(0.3, 1, {0, 0, 0}, 0, false);
  MeshPlan coarse = initial_plan(model), full = coarse;
  full.beams[0].present.assign(full.beams[0].present.size(), true);
  coarse = full;
  coarse.beams[0].present[3] = coarse.beams[0].present[7] = false;
  const BeamSystem from(model, coarse);
  const State state = disturbed_state(from, random, 0.04);
  carry_sections(from, state, full);
  MeshPlan turned = full, carried = full;
  for (MeshPlan::SectionCharts& each : turned.section_charts)
    for (Eigen::Matrix3d& chart : each.charts) chart = chart * Eigen::AngleAxisd(-0.5, Vector3d::UnitZ());
  carry_sections(from, state, carried, &turned);
  for (std::size_t i = 0; i < full.section_charts.size(); ++i)
    for (const int end : {0, 1})
      EXPECT_LT((carried.section_charts[i].charts[end] - full.section_charts[i].charts[end]).norm(), 1e-14);
}

}  // namespace
}  // namespace nurbeam
