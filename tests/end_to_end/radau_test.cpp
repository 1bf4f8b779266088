// "integrator": {"type": "radau"}, from the case file to the results.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

constexpr double gravity = 9.81;
const char* const radau = "analysis.integrator.type=radau";

// A bead of 5 kg on a rigid rail that goes down by 30 degrees, from its start.
std::string bead_case(const std::string& joint, const std::string& stops, const std::string& analysis) {
  return R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true,
    "axis": {"polyline": [[0, 0, 0], [17.320508075688775, 0, -10]]}}],
    "bodies": [{"name": "bead", "mass": 5}],
    "sliding_joints": [{"body": "bead", "beam": "rail", "at": "start")" +
         joint + R"(}], "stops": )" + stops + R"(, "analysis": )" + analysis + "}";
}

TEST(RadauRun, ABodyThatRubsTakesLongStepsDownASlope) {
  const CaseRun run =
      run_text(bead_case(R"(, "friction": {"coefficient": 0.2})", "[]", R"({"end_time": 1.5})"), {radau});
  ASSERT_EQ(run.code, 0) << run.messages;
  const double a = gravity * (0.5 - 0.2 * std::sqrt(0.75));
  EXPECT_NEAR(run.last("bead.s [m]"), a * 1.5 * 1.5 / 2, 1e-5);
  EXPECT_NEAR(run.last("bead.friction_force [N]"), -0.2 * 5 * gravity * std::sqrt(0.75), 1e-7);
  EXPECT_NEAR(run.last("energy.dissipated [J]"), 0.2 * 5 * gravity * std::sqrt(0.75) * run.last("bead.s [m]"),
              1e-3);
}

// 1.2 kg are pushed by 200 N that come and go in 10 ms: 1 N s.
const char* const pushed_bar = R"({"nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{"name": "bar", "axis": {"polyline": [[0, 0, 0], [2, 0, 0]]},
    "section": {"rectangle": [0.03, 0.02]}, "material": {"density": 1000, "youngs_modulus": "2 GPa"},
    "elements": {"count": 8}}],
  "loads": [{"beam": "bar", "force_per_length": [0, 100, 0],
             "time": [[0.1, 0], [0.105, 1], [0.11, 0]]}],
  "analysis": {"end_time": 0.2}, "output": {"report": false}})";

TEST(RadauRun, WorkOfLoadsIsOfTheOrderOfTheMotion) {
  for (const std::string& step : {"null", "0.005", "0.01"}) {
    const CaseRun run = run_text(pushed_bar, {radau, "analysis.step=" + step});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("energy.input [J]"), 1 / 2.4, 1e-9) << step;
    EXPECT_NEAR(run.last("energy.total [J]"), 0, 1e-9) << step;
  }
}

TEST(RadauRun, ABodyThatReboundsFromAStopIsWhereItsArcsLead) {
  const double a = gravity / 2, hit = std::sqrt(2 * 2 / a), speed = a * hit, end = 1.6;
  for (const char* analysis : {R"({"end_time": 1.6})", R"({"end_time": 1.6, "step": 0.1})"}) {
    const CaseRun run = run_text(
        bead_case("", R"([{"beam": "rail", "at": {"length": 2}, "restitution": 0.6}])", analysis), {radau});
    ASSERT_EQ(run.code, 0) << run.messages;
    const double back = end - hit;  // 0.697 s of the 1.084 s of the first arc
    EXPECT_NEAR(run.last("bead.s [m]"), 2 - 0.6 * speed * back + a * back * back / 2, 1e-6) << analysis;
    EXPECT_NEAR(run.last("energy.dissipated [J]"), 0.64 * 5 * a * 2, 1e-6) << analysis;
  }
}

// What friction takes follows the force at the stages, not at the ends of a few long steps alone.
TEST(RadauRun, EnergiesOfLongStepsAreThoseOfTheWay) {
  const CaseRun run = run_text(R"({"nurbeam": 1, "beams": [{"name": "rail", "rigid": true,
    "axis": {"arc": {"center": [0, 0, 0], "start": [-3, 0, 0], "end": [3, 0, 0], "normal": [0, -1, 0]}}}],
    "bodies": [{"name": "bead", "mass": 5}],
    "sliding_joints": [{"body": "bead", "beam": "rail", "at": {"fraction": 0.1}, "friction": {"coefficient": 0.1}}],
    "analysis": {"end_time": 1.5}, "output": {"every": 0.5, "report": false}})",
                               {radau});
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_GT(run.last("energy.dissipated [J]"), 40);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 4e-3) << "1e-4 of what is lost";
}

TEST(RadauRun, AFallingBeamWithABodyIsWhereShortStepsHaveIt) {
  const std::string text = R"({"nurbeam": 1, "gravity": [0, -9.81, 0],
    "beams": [{"name": "beam", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 7200, "youngs_modulus": "20 MPa"}, "elements": {"count": 10}}],
    "supports": [{"beam": "beam", "at": "start", "type": "clamped"}],
    "bodies": [{"name": "mass", "mass": 0.8}],
    "sliding_joints": [{"body": "mass", "beam": "beam", "at": {"length": 0.1}}],
    "analysis": {"end_time": 0.4}, "output": {"every": 0.1, "report": false}})";
  const CaseRun exact = run_text(text, {"analysis.step=2e-5"}), run = run_text(text, {radau});
  ASSERT_EQ(run.code, 0) << run.messages;
  for (const char* column : {"mass.x [m]", "mass.y [m]"})
    EXPECT_NEAR(run.last(column), exact.last(column), 6e-6);
}

TEST(RadauRun, SaysWhatHasNoEffect) {
  const CaseRun run =
      run_text(bead_case("", "[]", R"({"end_time": 0.1})"), {radau, "analysis.integrator.rho_infinity=0.5"});
  EXPECT_EQ(run.code, 0);
  EXPECT_TRUE(run.says("rho_infinity: has an effect with \"generalized-alpha\" only")) << run.messages;
}

// A change of the mesh sets elements ringing, whose error falls with the step, not with its fifth power.
TEST(RadauRun, GoesOnBehindChangesOfTheMesh) {
  const std::string model = R"({"nurbeam": 1, "gravity": [0, 0, -9.81], "beams": [{"name": "b",
    "axis": {"polyline": [[0, 0, 0], [3, 0.5, -0.6]]}, "section": {"radius": 0.015}, "torsion": false,
    "material": {"density": 7800, "youngs_modulus": 7e10, "damping": 1e-4, "mass_damping": 0.5},
    "elements": {"count": 8}}], "supports": [{"beam": "b", "at": "start", "type": "clamped"}],
    "bodies": [{"name": "m", "mass": 0.6723591756663514}],
    "sliding_joints": [{"body": "m", "beam": "b", "at": {"fraction": 0.2325}, "speed": 2.9020471141940547,
                        "carried_as": "node"}],
    "analysis": {"end_time": 0.25, "initial": "equilibrium"}, "output": {"every": 0.05, "report": false}})";
  const CaseRun fine = run_text(model, {"analysis.step=2e-4"});
  ASSERT_EQ(fine.code, 0) << fine.messages;
  for (int i = 0; i < 24; ++i) {
    const double tolerance = 1e-6 * std::pow(3.2, i / 23.0);
    const CaseRun run =
        run_text(model, {radau, "analysis.tolerance=" + std::to_string(1e6 * tolerance) + "e-6"});
    ASSERT_EQ(run.code, 0) << tolerance << run.messages;
    EXPECT_NEAR(run.last("m.s [m]"), fine.last("m.s [m]"), 1e-4) << tolerance;
  }
}

}  // namespace
}  // namespace nurbeam::test
