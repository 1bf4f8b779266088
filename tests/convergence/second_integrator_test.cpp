// Radau and the explicit method, which share nothing with generalized-alpha, on the same models.

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

double largest_integrator_difference(const RunRecord& a, const RunRecord& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.frames.size(); ++i) {
    for (std::size_t j = 0; j < a.frames[i].bodies.size(); ++j)
      largest = std::max(largest, (a.body(i) - b.body(i)).norm());
    for (std::size_t j = 0; j < a.frames[i].probes.size(); ++j)
      largest = std::max(largest, (a.probe(i) - b.probe(i)).norm());
  }
  return largest;
}

TEST(Radau, AgreesWithGeneralizedAlphaThroughTheEventsOfTheFallingBeam) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                             round_bar(0.01, 7200, 20e6, CurvatureMeasure::spatial), 20, {{0, true}});
  add_slider(model, 0.8, 0.1);
  const std::vector<double> times = even_times(0.3, 6);
  const RunRecord radau = run_model(model, times, 2e-3, Radau{}, {{0, 1.0}});
  const RunRecord tight = run_model(model, times, 1e-3, Radau{}, {{0, 1.0}});
  const RunRecord fine = run_model(model, times, 1.25e-4, 0.9, {{0, 1.0}});
  EXPECT_GT(radau.report.events.size(), 1U);
  EXPECT_LT(largest_integrator_difference(radau, tight), 3e-6);
  EXPECT_LT(largest_integrator_difference(tight, fine), 3e-6);
  EXPECT_LT(radau.report.newton_iterations, fine.report.newton_iterations / 4);
}

BeamModel pendulum() {
  BeamModel model = one_beam(arc_cubics({0, 0.5, 0}, 0.5, -M_PI / 2, -M_PI / 6, 1), 2,
                             round_bar(0.02, 6000, 2e6), 4, {{0, false}});
  return model;
}

TEST(ClassicalRungeKutta, AgreesWithGeneralizedAlphaOnThePinnedArc) {
  const std::vector<double> times = even_times(0.4, 4);
  const std::vector<ProbePlace> tip{{0, M_PI / 6}};
  const RunRecord explicit_run = run_model(pendulum(), times, 5e-4, ExplicitRungeKutta{}, tip);
  const RunRecord radau = run_model(pendulum(), times, 1e-3, Radau{}, tip);
  const RunRecord coarse = run_model(pendulum(), times, 2e-3, 0.9, tip);
  const RunRecord fine = run_model(pendulum(), times, 5e-4, 0.9, tip);
  EXPECT_LT(largest_integrator_difference(explicit_run, radau), 1e-6);
  EXPECT_LT(largest_integrator_difference(explicit_run, fine),
            largest_integrator_difference(explicit_run, coarse) / 8);
  EXPECT_LT(largest_integrator_difference(explicit_run, fine), 2e-5);
}

}  // namespace
}  // namespace nurbeam
