// Between events the energy of a conservative run drifts at second order in the step.

#include <cmath>

#include "tests/convergence/run_model.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using testing::add_slider;
using testing::arc_cubics;
using testing::even_times;
using testing::line_cubic;
using testing::one_beam;
using testing::round_bar;
using testing::run_model;
using testing::RunRecord;

// Root mean square of the energy less its start and the jumps of the events, over steps of size h [J].
double drift(const BeamModel& model, double end, double h, double rho_infinity) {
  const RunRecord run = run_model(model, even_times(end, std::lround(end / h)), h, rho_infinity);
  const auto& events = run.report.events;
  EXPECT_FALSE(events.empty());
  double jumps = 0, sum = 0;
  std::size_t next = 0;
  for (const Snapshot& frame : run.frames) {
    for (; next < events.size() && events[next].time <= frame.time + 1e-12; ++next)
      jumps += events[next].energy_after - events[next].energy_before;
    const double error = frame.energy.total - run.frames[0].energy.total - jumps;
    sum += error * error;
  }
  return std::sqrt(sum / run.frames.size());
}

void expect_second_order(const BeamModel& model, double end, double h, double rho_infinity) {
  const double coarse = drift(model, end, h, rho_infinity), middle = drift(model, end, h / 2, rho_infinity),
               fine = drift(model, end, h / 4, rho_infinity);
  // Elements that shrink before the slider keep some modes faster than the step, so the ratios scatter
  // about 4.
  EXPECT_GT(coarse / fine, 9) << coarse << " " << middle << " " << fine;
  EXPECT_GT(coarse / middle, 2.5);
  EXPECT_GT(middle / fine, 2.5);
}

BeamModel suspended_beam(int elements) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, round_bar(0.01, 7200, 20e6), elements,
                             {{0, false}, {1, false}});
  add_slider(model, 5, 0.1);
  return model;
}

TEST(EnergyDrift, FallsWithTheSquareOfTheStepWithThreeElements) {
  expect_second_order(suspended_beam(3), 0.5, 5e-4, 1);
}

TEST(EnergyDrift, FallsWithTheSquareOfTheStepWithADiscontinuousSlope) {
  BeamModel model = suspended_beam(6);
  model.riders[0].continuous_slope = false;
  expect_second_order(model, 0.5, 2e-3, 1);
}

// A line, an arc and a free-form cubic that meet smoothly; the curvature jumps where they do, at 1 m and 2.05
// m.
BeamModel line_arc_spline() {
  const double turn = M_PI / 3;
  std::vector<RationalCubic> axis{line_cubic({0, 1, 0}, {1, 1, 0})};
  axis.push_back(arc_cubics({1, 2, 0}, 1, -M_PI / 2, -M_PI / 2 + turn, 1)[0]);
  const Eigen::Vector3d p = axis.back().control_point(3), t(std::cos(turn), std::sin(turn), 0);
  Eigen::Matrix4d spline;
  spline.col(0) << p, 1;
  spline.col(1) << p + 0.3 * t, 1;
  spline.col(2) << p + Eigen::Vector3d(0.7, 0.6, 0), 1;
  spline.col(3) << p + Eigen::Vector3d(1.1, 0.6, 0), 1;
  axis.push_back(RationalCubic(spline));
  BeamModel model = one_beam(axis, 2, round_bar(0.05, 1000, 2e6), 24, {{0, false}, {10, false}});
  add_slider(model, 1, 0.7);
  model.riders[0].speed = 3;
  return model;
}

TEST(EnergyDrift, FallsWithTheSquareOfTheStepAcrossTheBreaksOfALineArcSplineChain) {
  const BeamModel model = line_arc_spline();
  expect_second_order(model, 0.7, 5e-4, 1);
  const RunRecord run = run_model(model, {0.7}, 1e-3);
  EXPECT_GT(run.place(0), model.beams[0].curve.breaks()[2]);
  int crossings = 0;
  for (const RunEvent& event : run.report.events) {
    if (event.kind != EventKind::becomes_point && event.kind != EventKind::becomes_node) continue;
    ++crossings;
    EXPECT_NEAR(event.energy_after, event.energy_before, 1e-5 * run.report.peak_kinetic_energy) << event.time;
  }
  EXPECT_EQ(crossings, 4);
}

TEST(EnergyDrift, IsSmallAcrossBreaksOnEveryMesh) {
  BeamModel model = line_arc_spline();
  const std::vector<double> places = fixed_places(model.beams[0].curve, {0, model.beams[0].curve.length()});
  for (const int elements : {12, 24, 48}) {
    model.beams[0].home = home_nodes(places, spread_elements(places, elements));
    const RunRecord run = run_model(model, even_times(0.7, 70), 1e-4);
    EXPECT_LT(run.report.energy_drift, 1e-5 * run.report.peak_kinetic_energy) << elements;
  }
}

TEST(EnergyDrift, OfADampedBeamIsSmallWhenTheBodyLeavesIt) {
  BeamModel model =
      one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, round_bar(0.01, 7200, 20e6), 6, {{0, true}});
  model.beams[0].properties.damping = 1e-3;
  add_slider(model, 0.8, 0.6);
  const RunRecord run = run_model(model, {0, 0.5}, 5e-4);
  ASSERT_FALSE(run.frames[1].bodies[0].s.has_value());
  double jumps = 0;
  for (const RunEvent& event : run.report.events) jumps += event.energy_after - event.energy_before;
  EXPECT_GT(run.frames[1].energy.dissipated, 0);
  EXPECT_NEAR(run.frames[1].energy.total - run.frames[0].energy.total, jumps, 1e-2);
}

}  // namespace
}  // namespace nurbeam
