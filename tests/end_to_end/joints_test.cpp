// Beams joined to each other: frames with known answers, and motion that keeps the joints and the energy.

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;
using test::TemporaryDirectory;

// A column of 1 m, clamped at its foot, and an arm of 1 m from its top; steel rods of radius 10 mm without
// weight.
constexpr const char* joint_frame = R"({
  "nurbeam": 1,
  "gravity": [0, 0, 0],
  "beams": [
    { "name": "column", "axis": { "polyline": [[0, 0, 0], [0, 1, 0]] }, "section": { "radius": 0.01 },
      "material": { "density": 7800, "youngs_modulus": 210e9 }, "elements": { "count": 8 } },
    { "name": "arm", "axis": { "polyline": [[0, 1, 0], [1, 1, 0]] }, "section": { "radius": 0.01 },
      "material": { "density": 7800, "youngs_modulus": 210e9 }, "elements": { "count": 8 } }
  ],
  "supports": [{ "beam": "column", "at": "start", "type": "clamped" }],
  "joints": [{ "beams": ["column", "arm"], "type": "rigid" }],
  "loads": [{ "beam": "arm", "at": "end", "force": [0, -0.01, 0] }],
  "analysis": { "type": "static" },
  "output": { "probes": [{ "name": "top", "beam": "column", "at": "end" },
                         { "name": "corner", "beam": "arm", "at": "start" },
                         { "name": "middle", "beam": "arm", "at": { "fraction": 0.5 } },
                         { "name": "tip", "beam": "arm", "at": "end" }] }
})";

constexpr double joint_EA = 210e9 * std::numbers::pi * 1e-4, EI = 210e9 * std::numbers::pi * 1e-8 / 4;

CaseRun run_joint_frame(const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return test::run_file(directory.write("frame.json", joint_frame), overrides);
}

// How far apart the ends that are joined are in a row of the results [m].
double opening(const CaseRun& run, std::size_t row) {
  double sum = 0;
  for (const char* axis : {".x [m]", ".y [m]", ".z [m]"})
    sum +=
        std::pow(run.value(row, std::string("top") + axis) - run.value(row, std::string("corner") + axis), 2);
  return std::sqrt(sum);
}

TEST(BeamJoints, ARigidFrameBendsAsTheTheoryOfFramesSays) {
  const CaseRun run = run_joint_frame();
  ASSERT_EQ(run.code, 0) << run.messages;
  // The moment P L bends the column, which turns the corner by P L h/(E I) and moves it by P L h²/(2 E I).
  const double P = 0.01, corner = P / (2 * EI);
  EXPECT_NEAR(run.last("corner.x [m]"), corner, 1e-5 * corner);
  EXPECT_NEAR(run.last("tip.y [m]") - 1, -(P / (3 * EI) + P / EI + P / joint_EA), 1e-5 * P / EI);
  EXPECT_LT(opening(run, 0), 1e-12);
}

TEST(BeamJoints, AHingedArmRestsOnItsEnds) {
  const CaseRun run = run_joint_frame(
      {R"(joints[0].type="hinged")",
       R"(supports=[{"beam": "column", "at": "start", "type": "clamped"}, {"beam": "arm", "at": "end", "type": "pinned"}])",
       R"(loads[0]={"beam": "arm", "at": {"fraction": 0.5}, "force": [0, -0.01, 0]})"});
  ASSERT_EQ(run.code, 0) << run.messages;
  // Each end bears half of the load; the column gives way by its own shortening.
  const double P = 0.01, expected = P / (48 * EI) + P / 2 / joint_EA / 2;
  EXPECT_NEAR(1 - run.last("middle.y [m]"), expected, 1e-5 * expected);
  EXPECT_NEAR(1 - run.last("corner.y [m]"), P / 2 / joint_EA, 1e-3 * P / 2 / joint_EA);
}

TEST(BeamJoints, AJointInTheMidstOfABeamIsFoundByItsPlace) {
  // The arm sits at half the column's height.
  const CaseRun run = run_joint_frame({"beams[1].axis.polyline=[[0, 0.5, 0], [1, 0.5, 0]]"});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double P = 0.01, h = 0.5;
  EXPECT_NEAR(run.last("tip.y [m]") - h, -(P / (3 * EI) + P * h / EI + P * h / joint_EA), 1e-5 * P / EI);
  // Above the joint the column is straight: it only leans.
  EXPECT_NEAR(run.last("top.x [m]"), P * h * h / (2 * EI) + P * h / EI * (1 - h), 1e-5 * P / EI);
}

std::vector<std::string> falling_joints(const std::string& type) {
  return {
      R"(supports=[{"beam": "column", "at": "start", "type": "pinned"}])",
      "joints[0].type=\"" + type + "\"",
      "loads=null",
      "gravity=[0, -9.81, 0]",
      "beams[0].material.youngs_modulus=2e8",
      "beams[1].material.youngs_modulus=2e8",
      R"(analysis={"end_time": 0.4, "step": 5e-4, "integrator": {"type": "generalized-alpha", "rho_infinity": 1}})",
      "output.every=0.02"};
}

TEST(BeamJoints, AFallingFrameKeepsItsJointsAndItsEnergy) {
  for (const char* type : {"hinged", "rigid"}) {
    const CaseRun run = run_joint_frame(falling_joints(type));
    ASSERT_EQ(run.code, 0) << run.messages;
    ASSERT_EQ(run.rows.size(), 21u);
    double largest = 0;
    for (std::size_t row = 0; row < run.rows.size(); ++row) {
      EXPECT_LT(opening(run, row), 1e-9) << type;
      largest = std::max(largest, run.value(row, "energy.kinetic [J]"));
      EXPECT_NEAR(run.value(row, "energy.total [J]"), run.value(0, "energy.total [J]"), 1e-3 * largest + 1e-9)
          << type << " " << row;
    }
    EXPECT_GT(largest, 1) << type;
  }
}

TEST(BeamJoints, InSpaceARigidJointKeepsItsAngle) {
  std::vector<std::string> overrides = falling_joints("rigid");
  overrides[0] = R"(supports=[{"beam": "column", "at": "start", "type": "clamped"}])";
  overrides[3] = "gravity=[3, -5, 8]";
  overrides.push_back("output.probes[2].at={\"length\": 1e-3}");
  overrides.push_back(R"(output.probes[3]={"name": "below", "beam": "column", "at": {"length": 0.999}})");
  const CaseRun run = run_joint_frame(overrides);
  ASSERT_EQ(run.code, 0) << run.messages;
  double moved = 0;
  for (std::size_t row = 0; row < run.rows.size(); ++row) {
    const auto point = [&](const std::string& name) {
      return Eigen::Vector3d(run.value(row, name + ".x [m]"), run.value(row, name + ".y [m]"),
                             run.value(row, name + ".z [m]"));
    };
    const Eigen::Vector3d along = (point("middle") - point("corner")).normalized(),
                          up = (point("top") - point("below")).normalized();
    // Chords of a millimetre stand for the tangents.
    EXPECT_NEAR(along.dot(up), 0, 2e-3);
    EXPECT_LT(opening(run, row), 1e-9);
    moved = std::max(moved, (along - Eigen::Vector3d::UnitX()).norm());
  }
  EXPECT_GT(moved, 0.1);
}

void expect_joint_refused(const std::vector<std::string>& overrides, const std::vector<std::string>& parts) {
  const CaseRun run = run_joint_frame(overrides);
  EXPECT_EQ(run.code, 2);
  for (const std::string& part : parts) EXPECT_TRUE(run.says(part)) << run.messages;
}

TEST(BeamJoints, ThatCannotBeAreRefused) {
  expect_joint_refused({"beams[1].axis.polyline=[[0, 1.1, 0], [1, 1, 0]]"},
                       {"joints[0]: \"column\" and \"arm\" do not meet", "0.0995", "(0, 1, 0) m"});
  expect_joint_refused({R"(joints[0].beams=["column", "arn"])"},
                       {"joints[0].beams[1]", "did you mean \"arm\""});
  expect_joint_refused({R"(joints[0].beams=["arm", "arm"])"}, {"give different beams"});
  expect_joint_refused(
      {R"(joints=[{"beams": ["column", "arm"], "type": "rigid"}, {"beams": ["arm", "column"], "type": "hinged"}])"},
      {"joints[1]", "joined at (0, 1, 0) m already"});
  expect_joint_refused(
      {R"(supports=[{"beam": "column", "at": "end", "type": "clamped"}, {"beam": "arm", "at": "start", "type": "pinned"}])"},
      {"supports[1]", "supports[0] already holds a beam that is joined to it"});
  const std::string at_half = "beams[1].axis.polyline=[[0, 0.5, 0], [1, 0.5, 0]]";
  expect_joint_refused(
      {at_half,
       R"(supports=[{"beam": "column", "at": {"length": 0.500000000001}, "type": "pinned"}, {"beam": "arm", "at": "start", "type": "pinned"}])"},
      {"supports[1]", "supports[0] already holds a beam that is joined to it"});
  expect_joint_refused(
      {R"(beams=[{"name": "column", "axis": {"polyline": [[0, 0, 0], [0, 1, 0]]}, "section": {"radius": 0.01}, "material": "steel"},
                 {"name": "arm", "axis": {"polyline": [[0, 0.5, 0], [1, 0.5, 0]]}, "section": {"radius": 0.01}, "material": "steel"},
                 {"name": "strut", "axis": {"polyline": [[0, 0.500000000001, 0], [1, 0, 0]]}, "section": {"radius": 0.01}, "material": "steel"}])",
       R"(joints=[{"beams": ["column", "arm"], "type": "hinged"}, {"beams": ["arm", "strut"], "type": "hinged"}, {"beams": ["column", "strut"], "type": "hinged"}])"},
      {"joints[2]", "joined at (0, 0.5, 0) m already"});
  expect_joint_refused(
      {R"(bodies=[{"name": "bead", "mass": 1}])",
       R"(sliding_joints=[{"body": "bead", "beam": "column", "at": {"fraction": 0.2}}])", at_half},
      {"over which body \"bead\" slides"});
  expect_joint_refused({"gravity=[0, 0, -1]", "beams[1].axis.polyline=[[0, 1, 0], [0, 2, 0]]",
                        "loads[0].force=[1, 0, 0]", "beams[0].torsion=false", "beams[1].torsion=false"},
                       {"joints[0].type", "run in one line"});
}

TEST(BeamJoints, ABodyStopsAtAJoinedEnd) {
  const CaseRun run = run_joint_frame(
      {R"(bodies=[{"name": "bead", "mass": 0.1}])",
       R"(sliding_joints=[{"body": "bead", "beam": "column", "at": {"fraction": 0.5}, "speed": 5}])",
       "loads=null", R"(analysis={"end_time": 0.12, "step": 1e-4})"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.s [m]"), 1, 1e-9);
}

}  // namespace
}  // namespace nurbeam
