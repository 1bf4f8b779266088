// A body under which a stiff curved bar may have a kink: what it asks of the mesh cannot be done without
// energy.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

std::filesystem::path case_file(const std::string& name) {
  return test::source_directory() / "tests/cases" / name;
}

TEST(StiffHinge, IsWarnedOfAndEndsTheRunBeforeItsMeshMakesEnergy) {
  for (const char* name : {"b5_cycloid_discontinuous.json", "d_disc_24.json"}) {
    const CaseRun run = run_file(case_file(name), {"output.report=false"});
    EXPECT_EQ(run.code, 3) << name;
    EXPECT_TRUE(run.says("sliding_joints[0].slope: \"discontinuous\" makes a hinge")) << run.messages;
    EXPECT_TRUE(run.says("the mesh would have to change beside \"m\"")) << run.messages;
    EXPECT_TRUE(run.says("\"slope\": \"continuous\"")) << run.messages;
    EXPECT_FALSE(run.says("do not trust")) << run.messages;
    EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 1e-3) << name;
    EXPECT_FALSE(run.left_half_files());
  }
}

// The bead on its cycloid arrives at 1.00303 s, by the integral of ds/v.
TEST(StiffHinge, IsNoneWhereTheSlopeIsContinuous) {
  const CaseRun run =
      run_file(case_file("b5_cycloid_continuous.json"),
               {"output.report=false", "beams[0].elements.count=28", "analysis.tolerance=1e-3"});
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says("hinge")) << run.messages;
  std::size_t row = 0;
  while (row + 1 < run.rows.size() && run.value(row, "time [s]") < 1.00303) ++row;
  const double s = run.value(row - 1, "m.s [m]"), end = run.last("m.s [m]");
  const double speed = std::hypot(run.value(row - 1, "m.vx [m/s]"), run.value(row - 1, "m.vz [m/s]"));
  EXPECT_NEAR(run.value(row - 1, "time [s]") + (end - s) / speed, 1.00303, 1e-4);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 2e-3);
}

// Two motions that are each other's image in the plane of symmetry.
TEST(KinkedCable, IsLeftAlongThePartAheadInBothDirections) {
  const auto leave = [](const std::string& speed) {
    const TemporaryDirectory directory;
    return run_file(directory.write("cable.json", R"({"nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{"name": "cable", "axis": {"polyline": [[0, 0, 0], [40, 0, 0]]}, "unstressed_length": 40.5,
                 "stress_free": "straight", "section": {"radius": 0.006},
                 "material": {"density": 5200, "youngs_modulus": 6e10}, "elements": {"count": 20}}],
      "supports": [{"beam": "cable", "at": "start", "type": "pinned"},
                   {"beam": "cable", "at": "end", "type": "pinned"}],
      "bodies": [{"name": "m", "mass": 80}],
      "sliding_joints": [{"body": "m", "beam": "cable", "at": {"fraction": 0.5}, "slope": "discontinuous",
                          "speed": )" + speed + R"(}],
      "analysis": {"initial": "equilibrium", "end_time": 0.2, "step": 1e-3},
      "output": {"report": false, "every": 0.05}})"));
  };
  const CaseRun on = leave("3"), back = leave("-3");
  EXPECT_GT(on.value(0, "m.vz [m/s]"), 0.3);  // up, as the cable ahead of it
  ASSERT_EQ(on.rows.size(), back.rows.size());
  for (std::size_t i = 0; i < on.rows.size(); ++i) {
    EXPECT_NEAR(on.value(i, "m.x [m]") - 20, 20 - back.value(i, "m.x [m]"), 1e-4) << i;
    EXPECT_NEAR(on.value(i, "m.z [m]"), back.value(i, "m.z [m]"), 1e-4) << i;
  }
  EXPECT_NEAR(on.value(0, "m.vx [m/s]"), -back.value(0, "m.vx [m/s]"), 1e-6);
  EXPECT_NEAR(on.value(0, "m.vz [m/s]"), back.value(0, "m.vz [m/s]"), 1e-6);
}

}  // namespace
}  // namespace nurbeam::test
