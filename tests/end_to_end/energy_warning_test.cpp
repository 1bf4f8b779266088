// "Do not trust the result": where energy comes from nowhere, and only there.

#include <gtest/gtest.h>

#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

const char* const warning = "do not trust the result";

CaseRun run_case(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return run_file(test::source_directory() / "tests/cases" / name, overrides);
}

TEST(EnergyOfTheMesh, IsRefusedWithALoadAsWithoutOne) {
  // A joint with a discontinuous slope on a stiff bent bar would gain energy; the load of 1e-9 N does no
  // work.
  for (const char* name : {"d_unmasked.json", "d_masked_warning.json"}) {
    const CaseRun run = run_case(name);
    EXPECT_EQ(run.code, 3) << name;
    EXPECT_TRUE(run.says("the mesh would have to change")) << run.messages;
  }
}

TEST(EnergyOfTheMesh, IsNeverKeptByOpeningAJoint) {
  // A heavy body beside a rigid joint of two beams: four elements cannot hold the bent shape with its node,
  // and moves of the joint's node alone would open it, to be closed by the next step with 12 J of 100. It
  // stays a point there.
  const CaseRun coarse = run_case("node_beside_joined_beams.json");
  EXPECT_EQ(coarse.code, 0) << coarse.messages;
  EXPECT_NEAR(coarse.last("energy.total [J]"), coarse.value(0, "energy.total [J]"), 5e-2);
  const CaseRun fine =
      run_case("node_beside_joined_beams.json", {"beams[0].elements.count=16", "beams[1].elements.count=16"});
  EXPECT_EQ(fine.code, 0) << fine.messages;
  EXPECT_NEAR(fine.last("energy.total [J]"), fine.value(0, "energy.total [J]"), 1e-2);
}

TEST(Seam, IsPassedByANodeWithAKink) {
  // The drawing of the ring has a break at its seam, which gives way to the joint: the joint's node becomes
  // the last of the mesh instead of the first.
  const CaseRun run = run_case("kinked_joint_over_seam.json");
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_LT(run.last("body 1.s [m]"), 0.6172);
  EXPECT_GT(run.last("body 1.s [m]"), 0.4);
  const double moves = run.last("energy.kinetic [J]");
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"),
              5e-2 * moves);  // high frequencies are damped
}

TEST(EnergyWarning, DoesNotRingOverRoundOff) {
  const CaseRun run = run_case("d_rest_false_warning.json");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says(warning)) << run.messages;
}

TEST(EnergyWarning, CountsWhatAStopTakes) {
  // A rider who stops at the end of a zip line: the impact's loss is dissipated, not lost from the balance.
  // What the steps damp of its waves afterwards is a joule or two.
  const CaseRun run = run_case("u1_zip.json", {"output.every=0.2", "output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says(warning)) << run.messages;
  const double start = run.value(0, "energy.total [J]");
  double drift = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    drift = std::max(drift, std::abs(run.value(i, "energy.total [J]") - start));
  EXPECT_GT(run.last("energy.dissipated [J]"), 5000);
  EXPECT_LT(drift, 3e-4 * run.last("energy.dissipated [J]"));
}

TEST(CompressionWarning, NamesThePlaceWhereAnElementIsPressedToNothing) {
  // Three elements of a beam as soft as a sponge under a body of sixty tonnes.
  const CaseRun run = run_case("compressed_to_nothing.json");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_TRUE(run.says("beam \"beam 1\" is compressed to nothing at s = ")) << run.messages;
  EXPECT_TRUE(run.says(warning)) << run.messages;
}

// With the end values and the mean alone statics ended where the element beside the body had turned round,
// 0.7 J above where the rope hangs.
TEST(SlackRope, HangsWithoutAFoldBesideItsBody) {
  for (const char* elements : {"beams[0].elements.count=16", "beams[0].elements.count=64"}) {
    const CaseRun hangs = run_case("slack_ropes_fold.json", {elements});
    ASSERT_EQ(hangs.code, 0) << hangs.messages;
    EXPECT_FALSE(hangs.says(warning)) << hangs.messages;
    EXPECT_NEAR(hangs.last("energy.total [J]"), 2.7128, 1e-3);
  }
}

// A restart out of balance gave damping 360 J back.
TEST(EnergyOfDamping, IsNeverGivenBack) {
  const CaseRun run = run_case("restart_out_of_balance.json");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says(warning)) << run.messages;
  for (std::size_t i = 1; i < run.rows.size(); ++i)
    EXPECT_GE(run.value(i, "energy.dissipated [J]"), run.value(i - 1, "energy.dissipated [J]")) << i;
}

TEST(EnergyWarning, RingsWithALoadWhoseWorkIsBooked) {
  // Far too long a step under a load that does work.
  const CaseRun coarse = run_file(
      sample("falling_beam/falling_beam.json"),
      {R"(loads=[{"beam":"beam","at":"end","force":[0,1,0]}])", "analysis.step=2e-2", "output.every=0.02"});
  EXPECT_TRUE(coarse.says(warning) || coarse.code != 0) << coarse.messages;
  const CaseRun fine = run_file(sample("falling_beam/falling_beam.json"),
                                {R"(loads=[{"beam":"beam","at":"end","force":[0,1,0]}])"});
  EXPECT_EQ(fine.code, 0) << fine.messages;
  EXPECT_FALSE(fine.says(warning)) << fine.messages;
}

TEST(EnergyFromNowhere, EndsTheRunThatItMakesMeaningless) {
  // A body driven fast along an undamped arch, with steps far too long for what it excites.
  const CaseRun run = run_case("energy_from_nowhere.json", {"analysis.step=0.0149"});
  EXPECT_EQ(run.code, 3);
  EXPECT_TRUE(run.says("has come from nowhere, more than all that moves")) << run.messages;
  EXPECT_LT(run.last("time [s]"), 0.5);
}

// In the first step all energy is the load's, whose work no mean of two forces gives.
TEST(EnergyFromNowhere, IsNotThatOfALoadOnWhatRests) {
  const TemporaryDirectory directory;
  const CaseRun run = run_file(directory.write("pulse.json", R"({"nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [2, 0, 0]]},
      "section": {"rectangle": [0.03, 0.02]},
      "material": {"density": 1000, "youngs_modulus": 2e9, "damping": 1e-4}, "elements": {"count": 8}}],
    "supports": [{"beam": "b", "at": "start", "type": "clamped"}],
    "loads": [{"beam": "b", "at": {"fraction": 0.5}, "force": [0, 10000, 0],
               "time": [[0.1003, 0], [0.1004, 1], [0.1005, 0]]}],
    "analysis": {"integrator": {"type": "radau"}, "end_time": 0.12}, "output": {"report": false}})"));
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("energy.total [J]"), 0, 0.01 * run.last("energy.input [J]"));
}

}  // namespace
}  // namespace nurbeam::test
