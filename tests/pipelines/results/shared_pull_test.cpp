#include "pipelines/results/shared_pull.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "fem/model/build.h"
#include "fem/motion/run/simulation.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

constexpr double line_density = 10, gravity = 10, weight = line_density * gravity;  // [kg/m], [m/s^2], [N/m]

// A bar of 1 m that pulls along itself by its weight.
ModelBuilder bar(int elements, const Eigen::Vector3d& along = {1, 0, 0}) {
  ModelBuilder builder(2, gravity * Eigen::Vector3d(1, 0, 0));
  builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, along)}, 2),
                   BeamProperties(2e8, 2e4, line_density), {elements});
  return builder;
}

struct Told {
  std::vector<SharedPull> coarse;
  Snapshot frame;
};

Told told(const BeamModel& model) {
  SharedPulls pulls(model);
  Told told;
  const auto look = [&](const Snapshot& frame) {
    pulls.look_at(frame);
    told.frame = frame;
  };
  EXPECT_EQ(simulate(model, {}, {.statics = true, .output_times = {0}}, {.snapshot = look}).status,
            SimulationStatus::done);
  told.coarse = pulls.coarse();
  return told;
}

// Clamped and pinned at s: the clamp bears half of the weight of what is between them.
TEST(SharedPulls, TellHowFarOffReactionsAre) {
  for (const double s : {0.1, 0.3, 0.5})
    for (const int elements : {5, 10, 14}) {
      const Told found = told(bar(elements).clamp(0, 0).pin(0, s).build());
      const double off = std::abs(found.frame.reactions[0].force.x() + weight * s / 2);
      ASSERT_EQ(found.coarse.size(), 1) << s << ' ' << elements;
      EXPECT_NEAR(found.coarse[0].error, off, 0.25 * off) << s << ' ' << elements;
      EXPECT_EQ(found.coarse[0].s, s);
    }
}

TEST(SharedPulls, SayNothingOfWhatIsFine) {
  const auto is_quiet = [](const BeamModel& model) { return told(model).coarse.empty(); };
  EXPECT_TRUE(is_quiet(bar(200).clamp(0, 0).pin(0, 0.5).build()));
  // What a single support bears is what is there.
  EXPECT_TRUE(is_quiet(bar(4).guide(0, 0, {1, 0, 0}).pin(0, 0.5).guide(0, 1, {1, 0, 0}).build()));
  EXPECT_TRUE(is_quiet(bar(4).pin(0, 0).guide(0, 0.5, {1, 0, 0}).build()));
  EXPECT_TRUE(is_quiet(bar(4).pin(0, 0).pin(0, 1).build()));
  // Across the weight nothing is pulled along.
  EXPECT_TRUE(is_quiet(bar(4, {0, 1, 0}).pin(0, 0).pin(0, 0.3).pin(0, 1).build()));
  // Two bars that are joined at the support: their forces may differ.
  ModelBuilder joined(2, gravity * Eigen::Vector3d(1, 0, 0));
  for (const double from : {0.0, 0.5})
    joined.add_beam(ReferenceCurve({testing::line_cubic({from, 0, 0}, {from + 0.5, 0, 0})}, 2),
                    BeamProperties(2e8, 2e4, line_density), {2});
  const Told found = told(joined.join(0, 0.5, 1, 0, true).clamp(0, 0).pin(0, 0.5).build());
  EXPECT_TRUE(found.coarse.empty());
  EXPECT_NEAR(found.frame.reactions[1].force.x(), -weight * 0.25, 1e-3);
}

}  // namespace
}  // namespace nurbeam
