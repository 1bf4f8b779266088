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

// A body in the middle of an element asks at once for shorter ones, which are those of the drawing.
TEST(ChangesOfMesh, LeaveADrawingAsItIsBeforeItMoves) {
  for (const char* length : {"0.9", "1.2", "2.5"})
    for (const char* speed : {"0", "1.5"}) {
      const CaseRun run =
          run_rail({"analysis.initial=null", "analysis.end_time=0.001", "beams[0].elements.count=6",
                    std::string("sliding_joints[0].at.length=") + length,
                    std::string("sliding_joints[0].speed=") + speed});
      ASSERT_EQ(run.code, 0) << run.messages;
      EXPECT_NEAR(run.value(0, "rail.displacement.max [m]"), 0, 1e-13) << length << ", " << speed;
      EXPECT_NEAR(run.value(0, "energy.axial [J]"), 0, 1e-18) << length << ", " << speed;
      EXPECT_NEAR(run.value(0, "energy.bending [J]"), 0, 1e-18) << length << ", " << speed;
    }
}

// A contact wire of 20 kN and a collector of 8 kg, which is pushed along it from element to element.
const char* const contact_wire = R"({"nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{"name": "wire", "axis": {"polyline": [[0, 0, 0], [30, 0, 0]]}, "stress_free": "straight",
    "tension": 20000, "section": {"area": "150 mm^2", "second_moment": 1.9e-9},
    "material": {"density": 8900, "youngs_modulus": "100 GPa"}, "elements": {"count": 60}}],
  "supports": [{"beam": "wire", "at": "start", "type": "pinned"},
               {"beam": "wire", "at": "end", "type": "pinned"}],
  "bodies": [{"name": "head", "mass": 8}],
  "sliding_joints": [{"body": "head", "beam": "wire", "at": {"length": 4}, "speed": 20,
                      "carried_as": "point"}],
  "analysis": {"initial": "equilibrium", "end_time": 0.1, "step": "1 ms"},
  "output": {"every": "1 ms", "report": false}})";

// Steps end where elements do. What was left of the last one of these, down to a millionth, took what the
// other steps leave of velocities for blows: 2300 N for 80 N.
TEST(ChangesOfMesh, ShortStepsBehindThemMakeNoForces) {
  for (const char* start : {"4", "4.00001", "4.003", "4.019", "4.019999"}) {
    const TemporaryDirectory directory;
    const CaseRun run = run_file(directory.write("wire.json", contact_wire),
                                 {std::string("sliding_joints[0].at.length=") + start});
    ASSERT_EQ(run.code, 0) << run.messages;
    for (std::size_t i = 0; i < run.rows.size(); ++i)
      EXPECT_NEAR(run.value(i, "head.joint_force.z [N]"), 79, 10) << start << ", row " << i;
  }
}

}  // namespace
}  // namespace nurbeam::test
