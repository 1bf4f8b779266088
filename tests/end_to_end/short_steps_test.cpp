// Steps of a fixed length that are shortened beside a body that is carried as a node.

#include <gtest/gtest.h>

#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

std::size_t count_of(const std::string& words, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

// A bead that runs round a ring at 12 m/s: its 64 elements of 0.9 m get as short as a tenth of that beside
// it.
CaseRun run_ring(const std::vector<std::string>& more) {
  std::vector<std::string> overrides{"analysis.end_time=0.5", "output.report=false", "output.every=0.1"};
  overrides.insert(overrides.end(), more.begin(), more.end());
  return run_file(test::source_directory() / "tests/cases/u2_ring.json", overrides);
}

// (Steps of 5 ms move the bead by 60 mm, and whether the run then keeps its energy at all is chance.)
TEST(ShortSteps, AreSaidOnceWithTheirCure) {
  const CaseRun run = run_ring({"analysis.step=\"3 ms\""});
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_EQ(count_of("steps were shorter", run.messages), 1) << run.messages;
  EXPECT_TRUE(run.says("\"carried_as\": \"point\"")) << run.messages;
}

TEST(ShortSteps, AreNoneOfAPointOrWhereStepsAreShortAnyway) {
  for (const std::vector<std::string>& overrides :
       {std::vector<std::string>{"analysis.step=\"5 ms\"", "sliding_joints[0].carried_as=\"point\""},
        std::vector<std::string>{"analysis.step=\"1 ms\""}}) {
    const CaseRun run = run_ring(overrides);
    EXPECT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.says("steps were shorter")) << run.messages;
  }
}

// A force and a moment that fall to nothing within 0.1 ms, or a tenth of that more or less, between steps of
// 1.25 ms: the accelerations that this leaves are not those of the next step.
TEST(ShortSteps, KeepTheEnergyWhereALoadEndsWithinAStep) {
  for (const std::string end : {"2.5001", "2.50009", "2.50011", "2.50013", "2.5002"}) {
    const std::string rows = "time=[[0,1],[2.5,1],[" + end + ",0]]";
    const CaseRun run =
        run_file(test::source_directory() / "tests/cases/load_ends_within_a_step.json",
                 {"analysis.end_time=3", "output.report=false", "loads[0]." + rows, "loads[1]." + rows});
    EXPECT_EQ(run.code, 0) << end << ": " << run.messages;
    EXPECT_FALSE(run.says("total energy")) << end << ": " << run.messages;
  }
}

}  // namespace
}  // namespace nurbeam::test
