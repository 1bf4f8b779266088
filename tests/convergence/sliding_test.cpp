// The examples of Ding & Ouyang 2022 against reference runs of two independent programs; the error of each
// reference stands beside it.

#include <algorithm>

#include "tests/convergence/run_model.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using testing::add_slider;
using testing::arc_cubics;
using testing::line_cubic;
using testing::one_beam;
using testing::round_bar;
using testing::run_model;
using testing::RunRecord;

struct Reference {
  double time, x, y, s;  // of the body
};

// Largest distance of the body from the reference places; frame i belongs to reference i.
double largest_error(const RunRecord& run, const std::vector<Reference>& references) {
  double largest = 0;
  for (std::size_t i = 0; i < references.size(); ++i) {
    EXPECT_DOUBLE_EQ(run.frames.at(i).time, references[i].time);
    largest =
        std::max(largest, std::hypot(run.body(i).x() - references[i].x, run.body(i).y() - references[i].y));
  }
  return largest;
}

std::vector<double> times_of(const std::vector<Reference>& references) {
  std::vector<double> times;
  for (const Reference& reference : references) times.push_back(reference.time);
  return times;
}

double leave_time(const RunRecord& run) {
  for (const RunEvent& event : run.report.events)
    if (event.kind == "left the beam") return event.time;
  return -1;
}

// Clamped at the left, a mass on it; references to 1e-5 m.
RunRecord falling_beam(int elements, const std::vector<double>& times, double step) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                             round_bar(0.01, 7200, 20e6, CurvatureMeasure::spatial), elements, {{0, true}});
  add_slider(model, 0.8, 0.1);
  return run_model(model, times, step, 0.9, {{0, 1.0}});
}
const std::vector<Reference> falling{{0.2, 0.131866, -0.061405, 0.147474},
                                     {0.4, 0.213265, -0.366831, 0.438555},
                                     {0.5, 0.110137, -0.663964, 0.712489}};

TEST(FallingBeam, ConvergesToTheReferenceRunsAndItsMassLeavesOnTime) {
  std::vector<double> errors;
  for (int elements : {10, 20})
    errors.push_back(largest_error(falling_beam(elements, times_of(falling), 4e-4), falling));
  std::vector<double> times = times_of(falling);
  times.push_back(0.75);
  const RunRecord fine = falling_beam(40, times, 4e-4);
  errors.push_back(largest_error(fine, falling));
  EXPECT_LT(errors[1], errors[0] / 4);
  EXPECT_LT(errors[2], errors[1] / 4);
  EXPECT_LT(errors[2], 5e-5);
  EXPECT_NEAR(fine.place(2), falling[2].s, 5e-5);
  EXPECT_NEAR(fine.probe(2).y(), -0.802103, 1e-4);
  EXPECT_NEAR(fine.frames[2].beams[0].length, 1.005065, 1e-5);
  // 0.71356(5) s; 0.67 s with 20 elements.
  EXPECT_NEAR(leave_time(fine), 0.71356, 1e-3);
  EXPECT_FALSE(fine.frames[3].bodies[0].s.has_value());
}

// The same beam hung at both ends, a heavier mass; references to 2e-5 m (s: 1.5e-4 m).
RunRecord suspended_beam(int elements, const std::vector<double>& times, double step) {
  BeamModel model =
      one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, round_bar(0.01, 7200, 20e6, CurvatureMeasure::spatial),
               elements, {{0, false}, {1, false}});
  add_slider(model, 5, 0.1);
  return run_model(model, times, step);
}
const std::vector<Reference> suspended{{0.3, 0.225178, -0.036238, 0.226584},
                                       {0.6, 0.510228, -0.097381, 0.506148},
                                       {1.0, 0.837282, -0.041253, 0.834099}};

TEST(SuspendedBeam, ConvergesToTheReferenceRuns) {
  const double coarse = largest_error(suspended_beam(12, times_of(suspended), 5e-4), suspended);
  const RunRecord run = suspended_beam(24, times_of(suspended), 5e-4);
  const double fine = largest_error(run, suspended);
  EXPECT_LT(fine, coarse / 4);
  EXPECT_LT(fine, 5e-4);
  EXPECT_NEAR(run.place(2), suspended[2].s, 5e-4);
  EXPECT_NEAR(run.frames[0].beams[0].length, 1.007698, 1e-4);
}

// A semicircle hung at both ends; references to 2e-5 m (as drawn) and 1e-4 m (straight).
RunRecord semicircle(bool straight, int elements, const std::vector<double>& times, double step) {
  BeamModel model =
      one_beam(arc_cubics({0, 0, 0}, 2, M_PI, 2 * M_PI, 2), 2,
               round_bar(0.02, 7200, 200e6, CurvatureMeasure::spatial), elements, {{0, false}, {10, false}});
  model.beams[0].straight = straight;
  add_slider(model, 0.8, 2 * M_PI / 16);
  return run_model(model, times, step);
}

TEST(Semicircle, AsDrawnConvergesToTheReferenceRunsAcrossTheJointOfItsArcs) {
  const std::vector<Reference> references{{0.5, -1.194665, -1.354761, 1.580274},
                                          {1.0, 1.152992, -1.625596, 4.408070},
                                          {1.5, 1.869061, -0.314888, 5.942009}};
  const double coarse = largest_error(semicircle(false, 24, times_of(references), 5e-4), references);
  const RunRecord run = semicircle(false, 48, times_of(references), 5e-4);
  const double fine = largest_error(run, references);
  EXPECT_LT(fine, coarse / 4);
  EXPECT_LT(fine, 2e-4);
  EXPECT_NEAR(run.place(2), references[2].s, 2e-4);
}

TEST(Semicircle, OfAStraightBeamBentToItConvergesToTheReferenceRuns) {
  const std::vector<Reference> references{{0.5, -1.138563, -1.349098, 1.602512}};
  const double coarse = largest_error(semicircle(true, 24, {0.5}, 5e-4), references);
  const double fine = largest_error(semicircle(true, 48, {0.5}, 5e-4), references);
  EXPECT_LT(fine, coarse / 4);
  EXPECT_LT(fine, 1e-3);
}

TEST(Semicircle, StartsWithTheEnergyOfItsStressFreeShape) {
  for (const auto& [straight, energy] : {std::pair{true, -693.39324}, std::pair{false, -713.13245}})
    EXPECT_NEAR(semicircle(straight, 8, {0, 1e-6}, 1e-6).frames[0].energy.total, energy, 1e-4);
}

}  // namespace
}  // namespace nurbeam
