#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;

// The falling beam, shorter, with its start at a point.
CaseRun run_at(const std::string& start, const std::string& end) {
  return test::run_file(test::sample("falling_beam/falling_beam.json"),
                        {"beams[0].elements.count=8", "analysis.end_time=0.1", "analysis.step=1e-3",
                         "beams[0].axis.polyline=[" + start + "," + end + "]"});
}

TEST(Invariance, AModelFarFromTheOriginMovesAsOneAtTheOrigin) {
  const CaseRun near = run_at("[0,0,0]", "[1,0,0]");
  const CaseRun far = run_at("[524288,-4194304,65536]", "[524289,-4194304,65536]");
  ASSERT_EQ(near.code, 0) << near.messages;
  ASSERT_EQ(far.code, 0) << far.messages;
  EXPECT_NEAR(far.last("mass.x [m]") - 524288, near.last("mass.x [m]"), 1e-9);
  EXPECT_NEAR(far.last("mass.y [m]") + 4194304, near.last("mass.y [m]"), 2e-9);
  EXPECT_NEAR(far.last("mass.vy [m/s]"), near.last("mass.vy [m/s]"), 1e-9);
  EXPECT_NEAR(far.last("energy.kinetic [J]"), near.last("energy.kinetic [J]"), 1e-9);
  const double mass = 0.8 + 7200 * M_PI * 1e-4;
  EXPECT_NEAR(far.last("energy.gravity [J]"), near.last("energy.gravity [J]") - mass * 9.81 * 4194304, 1e-6);
}

TEST(TwoBodies, ThatShareABreakOfTheDrawingSlideOverIt) {
  // The second starts on the break, in the neighbourhood of the first.
  const CaseRun run = test::run_file(
      test::sample("falling_beam/falling_beam.json"),
      {"beams[0].elements.count=10", "analysis.end_time=0.2", "analysis.step=1e-3",
       "beams[0].axis.polyline=[[0,0,0],[0.5,0,0],[1,0,0]]",
       R"(bodies=[{"name":"mass","mass":1},{"name":"other","mass":1}])",
       R"(sliding_joints=[{"body":"mass","beam":"beam","at":{"length":0.42},"speed":0.6},{"body":"other","beam":"beam","at":{"length":0.49},"speed":0.6}])"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_GT(run.last("mass.s [m]"), 0.52);
  EXPECT_GT(run.last("other.s [m]"), run.last("mass.s [m]"));
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 5e-3);
}

// A body that slides over a support in the middle of a soft beam.
std::vector<std::string> over_a_support(const std::string& slope) {
  return {
      "beams[0].axis.polyline=[[0,0,0],[2,0,0]]",
      "beams[0].elements.count=24",
      R"(supports=[{"beam":"beam","at":"start","type":"pinned"},{"beam":"beam","at":{"fraction":0.5},"type":"pinned"},{"beam":"beam","at":"end","type":"pinned"}])",
      R"(sliding_joints[0]={"body":"mass","beam":"beam","at":{"length":0.15},"speed":4,"at_beam_end":"stop","slope":")" +
          slope + "\"}",
      "analysis.end_time=0.5",
      "analysis.step=1e-4",
      "output.every=0.01"};
}

TEST(InteriorSupport, IsPassedAsAPoint) {
  const CaseRun run =
      test::run_file(test::sample("falling_beam/falling_beam.json"), over_a_support("continuous"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_GT(run.last("mass.s [m]"), 1.1);
  const double start = run.value(0, "energy.total [J]");
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    EXPECT_NEAR(run.value(i, "energy.total [J]"), start, 0.01 * start) << run.value(i, "time [s]");
}

TEST(InteriorSupport, IsPassedWithADiscontinuousSlopeToo) {
  std::vector<std::string> overrides = over_a_support("discontinuous");
  overrides.push_back("gravity=[0,-1,0]");
  const CaseRun run = test::run_file(test::sample("falling_beam/falling_beam.json"), overrides);
  ASSERT_EQ(run.code, 0) << run.messages;
  const double start = run.value(0, "energy.total [J]");
  double farthest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    farthest = std::max(farthest, run.value(i, "mass.s [m]"));
    EXPECT_LT(run.value(i, "energy.total [J]"), start * (1 + 1e-2)) << run.value(i, "time [s]");
  }
  EXPECT_GT(farthest, 1.05);
  EXPECT_GT(run.last("energy.total [J]"), 0.8 * start);  // the shock makes waves, which the steps damp
}

TEST(Stop, AtAnEndThatAStepReachesExactlyLosesEnergy) {
  // 2 m/s over 0.3 m in steps of 0.2 ms: the last step begins at the end itself.
  const CaseRun run = test::run_file(
      test::sample("falling_beam/falling_beam.json"),
      {"gravity=[0,0,0]", "supports=[]", "beams[0].elements.count=10",
       "beams[0].material.youngs_modulus=2.1e11", "analysis.end_time=0.16", "analysis.step=2e-4",
       "output.every=2e-4", "bodies[0].mass=2",
       R"(sliding_joints[0]={"body":"mass","beam":"beam","at":{"fraction":0.7},"speed":2,"at_beam_end":"stop"})"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("mass.s [m]"), 1, 1e-9);
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    EXPECT_LT(run.value(i, "energy.total [J]"), 4 * (1 + 1e-6)) << run.value(i, "time [s]");
}

}  // namespace
}  // namespace nurbeam
