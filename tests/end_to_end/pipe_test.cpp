// The commonest CAD input there is: a pipe that is bent in space.

#include <gtest/gtest.h>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// Clamped at both ends under its weight it sags 0.58 mm (frame of straight elements, nu = 0.3).
TEST(BentPipe, SagsAsAPipeWithTorsionDoesWhenNothingIsSaid) {
  const CaseRun run = run_file(std::filesystem::path(NURBEAM_SOURCE_DIR) / "tests/cases/d_pipe_default.json");
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("pipe.displacement.max [m]"), 0.58e-3, 0.02 * 0.58e-3);
  const double weight = run.last("reaction.pipe.start.fz [N]") + run.last("reaction.pipe.end.fz [N]");
  EXPECT_GT(weight, 500);
  EXPECT_NEAR(run.last("reaction.pipe.start.fx [N]") + run.last("reaction.pipe.end.fx [N]"), 0,
              1e-8 * weight);
}

}  // namespace
}  // namespace nurbeam::test
