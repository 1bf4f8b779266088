#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

constexpr double g = 9.81;

// A quarter of a circle of radius 3 m in a vertical plane, from the height of its centre down.
const char* const quarter_arc =
    R"({"arc": {"center": [0, 0, 0], "start": [-3, 0, 0], "end": [0, 0, -3], "normal": [0, -1, 0]}})";
// Three cubic segments in space, between them with curvature and torsion that do not jump.
const char* const space_curve =
    R"({"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 2, 3, 3, 3, 3],
        "control_points": [[0, 0, 10], [3, 1, 8], [5, 5, 6], [9, 6, 7], [12, 2, 3], [14, -1, 1]]}})";
// A whole circle of radius 2 m in a vertical plane, from its lowest place on.
const char* const whole_circle =
    R"({"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4],
        "control_points": [[0, 0, -2], [2, 0, -2], [2, 0, 0], [2, 0, 2], [0, 0, 2], [-2, 0, 2], [-2, 0, 0], [-2, 0, -2],
                           [0, 0, -2]],
        "weights": [1, 0.70710678118654757, 1, 0.70710678118654757, 1, 0.70710678118654757, 1, 0.70710678118654757, 1]}})";

std::string on_guide(const std::string& axis, const std::string& joint, const std::string& analysis,
                     const std::string& more = "") {
  return R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true, "axis": )" + axis + "}" + more +
         R"(], "bodies": [{"name": "bead", "mass": 5}],
             "sliding_joints": [{"body": "bead", "beam": "rail", )" +
         joint + R"(}], "analysis": )" + analysis + "}";
}

CaseRun run_guide(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("guide.json", text), overrides);
}

double drift(const CaseRun& run) {
  double most = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    most = std::max(most, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  return most;
}

TEST(GuideRun, ABodyOnAStraightGuideFallsAsOnAnInclinedPlane) {
  const CaseRun run = run_guide(on_guide(R"({"polyline": [[0, 0, 0], [17.320508075688775, 0, -10]]})",
                                         R"("at": "start")", R"({"end_time": 1.5, "step": "10 ms"})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.s [m]"), g / 2 * 1.5 * 1.5 / 2, 1e-10);
  EXPECT_NEAR(run.last("bead.vz [m/s]"), -g / 2 * 1.5 / 2, 1e-10);
  EXPECT_NEAR(run.last("bead.joint_force.z [N]"), 5 * g * 0.75, 1e-8);
  EXPECT_NEAR(run.last("rail.length [m]"), 20, 1e-12);
}

TEST(GuideRun, ForcesUnderErrorControlAreThoseOfThePlaceAndTheSpeed) {
  // m (v^2 / R - g z / R) towards the centre of the arc, in every row, whatever the steps between them are.
  for (const char* integrator : {"generalized-alpha", "radau"}) {
    const CaseRun run = run_guide(
        on_guide(quarter_arc, R"("at": {"fraction": 0.05})",
                 R"({"end_time": 0.95, "integrator": {"type": ")" + std::string(integrator) + R"("}})"),
        {"output.every=0.05"});
    ASSERT_EQ(run.code, 0) << run.messages;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      const double speed = run.value(i, "bead.speed [m/s]"), z = run.value(i, "bead.z [m]");
      const double force =
          std::hypot(run.value(i, "bead.joint_force.x [N]"), run.value(i, "bead.joint_force.z [N]"));
      EXPECT_NEAR(force, std::abs(5 * (speed * speed - g * z) / 3), 0.15) << integrator << ", row " << i;
    }
  }
}

TEST(GuideRun, ABodyOnACircleIsThePendulum) {
  // A quarter of the arc takes K(1/sqrt 2) sqrt(R/g); at its end v^2 = 2gR and the force is 3mg.
  const double quarter = std::comp_ellint_1(std::numbers::sqrt2 / 2) * std::sqrt(3 / g);
  const auto at_bottom = [&](double steps) {
    std::ostringstream analysis;
    analysis.precision(17);
    analysis << R"({"end_time": )" << quarter * (1 - 1e-9) << R"(, "step": )" << quarter / steps << "}";
    return run_guide(on_guide(quarter_arc, R"("at": "start")", analysis.str()));
  };
  const CaseRun coarse = at_bottom(400), fine = at_bottom(800);
  ASSERT_EQ(fine.code, 0) << fine.messages;
  const auto error = [&](const CaseRun& run) { return run.last("bead.s [m]") - 1.5 * std::numbers::pi; };
  EXPECT_NEAR(error(fine), 0, 2e-5);
  EXPECT_NEAR(error(coarse) / error(fine), 4, 0.4);
  EXPECT_NEAR(fine.last("bead.vx [m/s]"), std::sqrt(2 * g * 3), 1e-4);
  EXPECT_NEAR(fine.last("bead.joint_force.z [N]"), 3 * 5 * g, 2e-3);
  EXPECT_NEAR(drift(coarse) / drift(fine), 4, 0.4);
}

TEST(GuideRun, InSpaceAndOverTheJointsOfItsSegmentsEnergyKeepsTheOrderOfTheSteps) {
  const auto at_step = [&](const char* step) {
    return run_guide(on_guide(space_curve, R"("at": "start", "speed": 1)", R"({"end_time": 2.4})"),
                     {std::string("analysis.step=") + step});
  };
  const CaseRun coarse = at_step("0.004"), fine = at_step("0.002");
  ASSERT_EQ(fine.code, 0) << fine.messages;
  ASSERT_GT(fine.last("bead.s [m]"), 12);
  EXPECT_LT(drift(fine), 5e-3);  // of 350 J
  EXPECT_GT(drift(coarse) / drift(fine), 3);
}

TEST(GuideRun, ARingIsRunRoundAndItsSeamIsAPlaceAsAnyOther) {
  const CaseRun run =
      run_guide(on_guide(whole_circle, R"("at": "start", "speed": 10)", R"({"end_time": 4, "step": "2 ms"})"),
                {"beams[0].closed=true"});
  ASSERT_EQ(run.code, 0) << run.messages;
  int turns = 0;
  for (std::size_t i = 1; i < run.rows.size(); ++i)
    if (run.value(i, "bead.s [m]") < run.value(i - 1, "bead.s [m]") - 6) ++turns;
  EXPECT_EQ(turns, 2);
  EXPECT_LT(drift(run), 1e-2);
}

TEST(GuideRun, AtItsEndABodyFliesOnOrStops) {
  const std::string guide = R"({"polyline": [[0, 0, 0], [1, 0, 0]]})";
  const CaseRun leaves =
      run_guide(on_guide(guide, R"("at": "start", "speed": 2)", R"({"end_time": 1, "step": "10 ms"})"));
  ASSERT_EQ(leaves.code, 0) << leaves.messages;
  EXPECT_NEAR(leaves.last("bead.x [m]"), 2, 1e-9);
  EXPECT_NEAR(leaves.last("bead.z [m]"), -g / 2 * 0.25, 1e-6);
  const CaseRun stops = run_guide(on_guide(guide, R"("at": "start", "speed": 2, "at_beam_end": "stop")",
                                           R"({"end_time": 1, "step": "10 ms"})"));
  ASSERT_EQ(stops.code, 0) << stops.messages;
  EXPECT_NEAR(stops.last("bead.x [m]"), 1, 1e-12);
  EXPECT_NEAR(stops.last("energy.dissipated [J]"), 10, 1e-9);
}

TEST(GuideRun, AtRestABodyLiesAtTheLowestPlace) {
  const CaseRun run = run_guide(on_guide(
      R"({"arc": {"center": [0, 0, 0], "start": [-3, 0, 0], "end": [3, 0, 0], "normal": [0, -1, 0]}})",
      R"("at": {"length": 2})", R"({"type": "static"})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.x [m]"), 0, 1e-6);
  EXPECT_NEAR(run.last("bead.z [m]"), -3, 1e-6);
}

TEST(GuideRun, APrescribedBodyFeelsTheCurvatureOfTheDrawing) {
  const CaseRun run = run_guide(on_guide(quarter_arc, R"("at": "start", "motion": {"speed": 4})",
                                         R"({"end_time": 1, "step": "2 ms"})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double phi = 4.0 / 3, toward_centre = 5 * 16 / 3.0;
  EXPECT_NEAR(run.last("bead.joint_force.x [N]"), toward_centre * std::cos(phi), 3e-4);
  EXPECT_NEAR(run.last("bead.joint_force.z [N]"), toward_centre * std::sin(phi) + 5 * g, 3e-4);
}

TEST(GuideRun, ABeamThatDeformsMayBeInTheSameModel) {
  const CaseRun run =
      run_guide(on_guide(quarter_arc, R"("at": "start")", R"({"end_time": 0.2, "step": "5 ms"})",
                         R"(, {"name": "arm", "axis": {"polyline": [[0, 0, 1], [1, 0, 1]]},
                                              "section": {"radius": 0.01}, "elements": {"count": 4},
                                              "material": {"density": 7800, "youngs_modulus": 2e11}})"),
                {R"(supports=[{"beam": "arm", "at": "start", "type": "clamped"}])",
                 R"(output={"paraview": true, "cad": {"formats": ["step", "iges"]},
                                    "probes": [{"name": "p", "beam": "rail", "at": "end"}]})"});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("p.z [m]"), -3, 1e-12);
  EXPECT_EQ(run.last("p.axial_force [N]"), 0);
  EXPECT_EQ(run.left_half_files(), false);
}

// Round-off is no energy that comes from nowhere.
TEST(GuideRun, WhereNothingMovesNothingIsAmiss) {
  const TemporaryDirectory directory;
  const auto file = directory.write("still.json", R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true,
      "axis": {"polyline": [[0, 0, 0], [1, 0, 0], [4, 0, 0]]}}], "bodies": [{"name": "bead", "mass": 1}],
      "sliding_joints": [{"body": "bead", "beam": "rail", "at": {"length": 1}, "release": 0.5}],
      "analysis": {"end_time": 1}})");
  for (const std::vector<std::string>& step : {std::vector<std::string>{}, {"analysis.step=1e-3"}}) {
    const CaseRun run = run_file(file, step);
    EXPECT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.says("warning")) << run.messages;
    EXPECT_NEAR(run.last("bead.s [m]"), 1, 1e-12);
  }
}

// What holds the body stretches the spring of its friction, which is no loss.
TEST(GuideRun, AReleasedBodyThatSticksLosesNothing) {
  const TemporaryDirectory directory;
  const auto file = directory.write("sticks.json", R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true,
      "axis": {"polyline": [[0, 0, 0], [10, 0, -2]]}}], "bodies": [{"name": "bead", "mass": 5}],
      "sliding_joints": [{"body": "bead", "beam": "rail", "at": {"length": 2}, "release": 1,
        "friction": {"coefficient": 0.1, "static": 0.25, "stick_stiffness": 100}}],
      "analysis": {"end_time": 3}})");
  const double pull = 5 * g * 2 / std::sqrt(104.0);
  for (const std::vector<std::string>& with :
       {std::vector<std::string>{}, {"analysis.step=1e-3"}, {"analysis.integrator={\"type\": \"radau\"}"}}) {
    const CaseRun run = run_file(file, with);
    EXPECT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.says("warning")) << run.messages;
    EXPECT_NEAR(run.last("bead.s [m]"), 2, 1e-9);
    EXPECT_NEAR(run.last("energy.dissipated [J]"), 0, 1e-9);
    EXPECT_NEAR(run.last("energy.spring [J]"), pull * pull / 200, 1e-6);
    EXPECT_NEAR(run.last("energy.input [J]"), pull * pull / 200, 1e-6);
  }
}

TEST(GuideRun, WhatAGuideDoesNotTakeIsRefused) {
  const std::string text = on_guide(quarter_arc, R"("at": "start")", R"({"end_time": 0.1, "step": 0.01})");
  const auto says = [&](const std::string& override, const std::string& part) {
    const CaseRun run = run_guide(text, {override});
    EXPECT_EQ(run.code, 2) << override;
    EXPECT_TRUE(run.says(part)) << run.messages;
  };
  says(R"(beams[0].section={"radius": 0.01})", "beams[0].section: is for beams that deform");
  says(R"(beams[0].elements={"count": 3})", "beams[0].elements: is for beams that deform");
  says(R"(beams[0].corners=rigid)", "beams[0].corners: is \"rigid\", but no body slides over a corner");
  says(R"(beams[0].rigid=false)", "\"section\" is missing");
  says(R"(supports=[{"beam": "rail", "at": "end", "type": "pinned"}])",
       "supports[0].beam: names \"rail\", which is a rigid guide");
  says(R"(loads=[{"beam": "rail", "at": "end", "force": [0, 0, 1]}])",
       "loads[0].beam: names \"rail\", which is a rigid guide");
  says(R"(sliding_joints[0].slope=discontinuous)", "it has no kink at a body");
  says(R"(sliding_joints[0].follows_section=true)", "it has no sections");
  says(R"(analysis.type=modes)", "all beams are rigid guides");
  says(R"(output.cad={"formats": ["step-solid"]})", "which have no sections");
}

}  // namespace
}  // namespace nurbeam::test
