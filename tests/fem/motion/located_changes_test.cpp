#include <gtest/gtest.h>

#include <cmath>

#include "fem/motion/run/simulation.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

// A bar that is held at one end, with a body that slides towards the other.
std::vector<RunEvent> changes(double tolerance) {
  BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                      testing::round_bar(0.02, 7200, 2e6), 6, {{0, true}});
  testing::add_slider(model, 0.8, 0.2);
  SimulationOptions options{.end_time = 0.5, .output_times = {0.5}};
  options.integrator = GeneralizedAlpha{.tolerance = tolerance};
  const SimulationReport report = simulate(model, {}, options, {});
  EXPECT_EQ(report.status, SimulationStatus::done);
  return report.events;
}

TEST(LocatedChanges, OfTheMeshComeWhenTheyFallDueWhateverTheSteps) {
  const std::vector<RunEvent> coarse = changes(1e-3), fine = changes(1e-6);
  ASSERT_GE(coarse.size(), 3u);
  ASSERT_EQ(coarse.size(), fine.size());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    EXPECT_EQ(coarse[i].kind, fine[i].kind);
    EXPECT_NEAR(coarse[i].time, fine[i].time, 1e-4) << i;
  }
}

}  // namespace
}  // namespace nurbeam
