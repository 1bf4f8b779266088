#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// A bent rail, clamped at both ends, and a body that slides along it.
const char* const bent_rail = R"({"nurbeam": 1, "gravity": [0, -9.81, 0],
  "beams": [{"name": "rail", "axis": {"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 2, 2, 2, 2],
      "control_points": [[0, 0, 0], [1, 0.4, 0], [2, -0.4, 0], [3, 0.4, 0], [4, 0, 0]]}},
    "section": {"radius": "10 mm"}, "material": {"density": 1500, "youngs_modulus": "3 GPa"},
    "elements": {"count": 14}}],
  "supports": [{"beam": "rail", "at": "start", "type": "clamped"},
               {"beam": "rail", "at": "end", "type": "clamped"}],
  "bodies": [{"name": "body", "mass": 0.8}],
  "sliding_joints": [{"body": "body", "beam": "rail", "at": {"length": 0.6}, "speed": 1.5}],
  "analysis": {"end_time": 1, "step": "0.5 ms", "initial": "equilibrium"},
  "output": {"every": "0.5 ms", "report": false}})";

CaseRun run_rail(const std::vector<std::string>& overrides) {
  const TemporaryDirectory directory;
  return run_file(directory.write("rail.json", bent_rail), overrides);
}

double joint_force(const CaseRun& run, std::size_t row) {
  return std::hypot(run.value(row, "body.joint_force.x [N]"), run.value(row, "body.joint_force.y [N]"));
}

// The largest difference of the joint's force, of some 10 N.
double kick(const CaseRun& run, const CaseRun& smooth) {
  double largest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    largest = std::max(largest, std::abs(joint_force(run, i) - joint_force(smooth, i)));
  return largest;
}

TEST(ChangesOfMesh, DoNotKickABodyOnABentRail) {
  const CaseRun smooth = run_rail({"sliding_joints[0].carried_as=point", "beams[0].elements.count=56"});
  const CaseRun coarse = run_rail({}), fine = run_rail({"beams[0].elements.count=28"});
  ASSERT_EQ(smooth.code, 0) << smooth.messages;
  ASSERT_EQ(coarse.rows.size(), smooth.rows.size()) << coarse.messages;
  ASSERT_EQ(fine.rows.size(), smooth.rows.size()) << fine.messages;
  EXPECT_LT(kick(coarse, smooth), 2);
  EXPECT_LT(kick(fine, smooth), 0.5);
}

// The mesh is settled before the equilibrium is found, wherever between nodes the body begins.
TEST(ChangesOfMesh, LeaveAHeldBodyAtRestFromTheStart) {
  for (const char* place : {"0.15", "0.163", "0.17", "0.18", "0.19", "0.205", "0.212", "0.22"}) {
    const CaseRun run = run_rail(
        {std::string(
             "sliding_joints[0]={\"body\": \"body\", \"beam\": \"rail\", \"release\": 1, \"at\": {\"fraction\": ") +
             place + "}}",
         "analysis={\"end_time\": 0.2, \"initial\": \"equilibrium\"}", "output.every=10 ms",
         "beams[0].elements.count=20"});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.says("warning")) << run.messages;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      EXPECT_NEAR(joint_force(run, i), 0.8 * 9.81, 1e-6) << place << " " << i;
      EXPECT_LE(run.value(i, "energy.kinetic [J]"), 1e-15) << place << " " << i;
    }
  }
}

}  // namespace
}  // namespace nurbeam::test
