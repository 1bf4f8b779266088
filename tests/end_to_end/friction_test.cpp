#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

using std::numbers::pi;
constexpr double gravity = 9.81;

// 40 m down by that angle [degrees].
std::string slope_down(double degrees) {
  std::ostringstream axis;
  axis.precision(17);
  axis << R"({"polyline": [[0, 0, 0], [)" << 400 * std::cos(degrees * pi / 180) << ", 0, "
       << -400 * std::sin(degrees * pi / 180) << "]]}";
  return axis.str();
}
const char* const half_circle =
    R"({"arc": {"center": [0, 0, 0], "start": [-3, 0, 0], "end": [3, 0, 0], "normal": [0, -1, 0]}})";

std::string rubbing_case(const std::string& axis, double mass, const std::string& joint,
                         const std::string& analysis, const std::string& body = "",
                         const std::string& top = "") {
  std::ostringstream text;
  text << R"({"nurbeam": 1, )" << top << R"("beams": [{"name": "rail", "rigid": true, "axis": )" << axis
       << R"(}], "bodies": [{"name": "bead", "mass": )" << mass << body
       << R"(}], "sliding_joints": [{"body": "bead", "beam": "rail", )" << joint << R"(}], "analysis": )"
       << analysis << "}";
  return text.str();
}

CaseRun run_rubbing(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("friction.json", text), overrides);
}

double drift_of(const CaseRun& run) {
  double most = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    most = std::max(most, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  return most;
}

// Where a column has the value, between the rows by a parabola through three of them.
double time_of(const CaseRun& run, const std::string& column, double value) {
  for (std::size_t i = 1; i + 1 < run.rows.size(); ++i) {
    const double a = run.value(i - 1, column) - value, b = run.value(i, column) - value,
                 c = run.value(i + 1, column) - value;
    if (a > 0 || b < 0) continue;
    const double t = run.value(i, "time [s]"), h = run.value(i + 1, "time [s]") - t;
    double x = -b * h / (c - b);
    for (int k = 0; k < 20; ++k) {
      const double slope = (c - a) / (2 * h), bend = (c - 2 * b + a) / (h * h);
      x -= (b + slope * x + bend * x * x / 2) / (slope + bend * x);
    }
    return t + x;
  }
  return std::nan("");
}

TEST(FrictionRun, DownASlopeABodyAcceleratesByWhatFrictionLeaves) {
  // F1: a = g (sin - mu cos).
  const double a = gravity * (0.5 - 0.2 * std::sqrt(0.75)), time = std::sqrt(20 / a);
  EXPECT_NEAR(a, 3.205858, 1e-6);
  std::ostringstream analysis;
  analysis.precision(17);
  analysis << R"({"end_time": )" << time << R"(, "step": "20 ms"})";
  const CaseRun run = run_rubbing(
      rubbing_case(slope_down(30), 5, R"("at": "start", "friction": {"coefficient": 0.2})", analysis.str()));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.s [m]"), 10, 1e-6);
  EXPECT_NEAR(std::hypot(run.last("bead.vx [m/s]"), run.last("bead.vz [m/s]")), a * time, 1e-7);
  EXPECT_NEAR(run.last("energy.dissipated [J]"), 0.2 * 5 * gravity * std::sqrt(0.75) * 10, 1e-4);
  EXPECT_NEAR(run.last("bead.friction_force [N]"), -0.2 * 5 * gravity * std::sqrt(0.75), 1e-7);
  EXPECT_EQ(run.last("bead.stuck [1]"), 0);
  EXPECT_LT(drift_of(run), 1e-6);
}

TEST(FrictionRun, AParkedBodyDoesNotCreep) {
  const std::string text =
      rubbing_case(slope_down(30), 5, R"("at": {"length": 1}, "friction": {"coefficient": 0.6})",
                   R"({"end_time": 100, "step": 0.05})");
  const CaseRun run = run_rubbing(text);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.s [m]"), 1, 1e-12);
  EXPECT_EQ(run.last("bead.stuck [1]"), 1);
  EXPECT_NEAR(run.last("bead.friction_force [N]"), -5 * gravity / 2, 1e-9);
  // A blow moves it by micrometres, and not for long.
  const CaseRun shaken = run_rubbing(text, {"sliding_joints[0].speed=1e-4"});
  ASSERT_EQ(shaken.code, 0) << shaken.messages;
  const double stiffness = 5 * std::pow(200 * pi, 2);
  EXPECT_LT(std::abs(shaken.last("bead.s [m]") - 1), 2 * 5 * gravity * 0.5 / stiffness);
  const std::size_t half = shaken.rows.size() / 2;
  EXPECT_NEAR(shaken.last("bead.s [m]"), shaken.value(half, "bead.s [m]"), 1e-12);
}

TEST(FrictionRun, AParkedBodyInAWindIsNotTakenForEnergyFromNowhere) {
  // What the wind does to the bristles goes into them and out again: round-off of 129 J is left.
  for (const char* joint : {R"("at": {"length": 1}, "friction": {"coefficient": 0.2, "static": 0.3})",
                            R"("at": {"length": 1}, "friction": {"force": 100})"}) {
    const CaseRun run = run_rubbing(
        rubbing_case(R"({"polyline": [[0, 0, 0], [10, 0, 0]]})", 2, joint,
                     R"({"end_time": 20, "step": 0.02})", R"(, "drag_area": 0.5)",
                     R"("gravity": [0, 0, -9.81], "air": {"density": 1.2, "wind": [4, 0, 0]}, )"));
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_EQ(run.last("bead.stuck [1]"), 1);
    EXPECT_NEAR(run.last("bead.s [m]"), 1, 1e-3);
  }
}

TEST(FrictionRun, ADrivenBodyThatStandsIsNotRubbed) {
  for (const char* step : {"5e-3", "1e-2", "2e-2"}) {
    const CaseRun run = run_rubbing(rubbing_case(
        R"({"polyline": [[0, 0, 0], [10, 0, 0]]})", 2,
        R"("at": {"length": 1}, "friction": {"coefficient": 0.3, "viscous": 3},
           "motion": {"table": [[0, 1], [1, 3], [2, 3], [3, 1]], "interpolation": "linear"})",
        std::string(R"({"end_time": 1.8, "step": )") + step + "}", "", R"("gravity": [0, 0, -9.81], )"));
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("bead.friction_force [N]"), 0, 1e-9) << step;
    EXPECT_NEAR(run.last("bead.drive_force [N]"), 0, 1e-9) << step;
  }
}

// A brake that stops its body as a step ends, but for round-off, holds it there.
TEST(FrictionRun, ABodyThatComesToRestAsAStepEndsStaysThere) {
  const char* const level = R"({"polyline": [[0, 0, 0], [4, 0, 0]]})";
  for (const char* joint : {R"("at": {"length": 1.91}, "speed": 1.5, "friction": {"force": 3})",
                            R"("at": {"length": 2.09}, "speed": -1.5, "friction": {"force": 3})"})
    for (const char* analysis :
         {R"({"end_time": 2})", R"({"end_time": 2, "step": 0.125})", R"({"end_time": 2, "step": "1 ms"})",
          R"({"end_time": 2, "tolerance": 1e-6})"}) {
      const CaseRun run = run_rubbing(rubbing_case(level, 2, joint, analysis, "",
                                                   R"("gravity": [0, 0, 0], "output": {"every": 0.25}, )"));
      ASSERT_EQ(run.code, 0) << run.messages;
      const double way = std::string(joint).find("-1.5") == std::string::npos ? 1 : -1;
      EXPECT_NEAR(run.last("bead.s [m]"), way > 0 ? 2.66 : 1.34, 2e-6) << joint << analysis;
      EXPECT_LT(drift_of(run), 1e-5) << joint << analysis;
    }
}

// The spring of what sticks is no store of one that slides: a strong brake would put more into it than a
// light body has.
TEST(FrictionRun, WhatABrakeTakesIsLostAsTheBodySlides) {
  const CaseRun run =
      run_rubbing(rubbing_case(R"({"polyline": [[0, 0, 0], [2, 0, 0]]})", 1,
                               R"("at": {"length": 0.5}, "speed": 0.45, "friction": {"force": 2000})",
                               R"({"type": "dynamic", "end_time": 0.0004, "step": 1e-5})", "",
                               R"("gravity": [0, 0, 0], "output": {"every": 1e-5, "report": false}, )"));
  ASSERT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double slid = run.value(i, "bead.s [m]") - 0.5;
    EXPECT_NEAR(run.value(i, "energy.dissipated [J]"), 2000 * slid, 1e-9) << run.value(i, "time [s]");
  }
  EXPECT_NEAR(run.last("energy.dissipated [J]"), 0.45 * 0.45 / 2, 1e-9);
}

// Its impulse, 0.4 N s, was gone with the steps that jumped over it, whatever their error control saw.
TEST(FrictionRun, ABrakeThatCatchesBetweenTwoStepsTakesItsImpulse) {
  struct Steps {
    const char* analysis;
    double near;  // of steps whose lengths jump [m/s]
  };
  for (const Steps& steps : {Steps{R"({"end_time": 0.1, "step": "1 ms"})", 4e-3},
                             Steps{R"({"end_time": 0.1, "step": "10 ms"})", 4e-3},
                             Steps{R"({"end_time": 0.1, "tolerance": 1e-4})", 1e-3},
                             Steps{R"({"end_time": 0.1, "tolerance": 1e-6})", 2e-4}}) {
    const CaseRun run = run_rubbing(rubbing_case(R"({"polyline": [[0, 0, 0], [4, 0, 0]]})", 2,
                                                 R"("at": {"length": 1}, "speed": 2, "friction": {"force":
                                   [[0.0303, 0], [0.0304, 1000], [0.0307, 1000], [0.0308, 0]]})",
                                                 steps.analysis, "", R"("gravity": [0, 0, 0], )"));
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("bead.vx [m/s]"), 2 - 0.4 / 2, steps.near) << steps.analysis;
    EXPECT_NEAR(run.last("energy.dissipated [J]"), (2 * 2 - 1.8 * 1.8) * 2 / 2, 1e-3) << steps.analysis;
  }
}

TEST(FrictionRun, OnACircleABodySwingsUpComesToRestAndGoesBack) {
  // F2. Clockwise from the height of the centre, by the angle phi from there.
  const double R = 3, mu = 0.25;
  const auto v_squared = [&](double phi) {
    return 2 * gravity * R / (1 + 4 * mu * mu) *
           ((1 - 2 * mu * mu) * std::sin(phi) + 3 * mu * (std::cos(phi) - std::exp(-2 * mu * phi)));
  };
  const double rest = 126.991483 * pi / 180;
  EXPECT_NEAR(v_squared(rest), 0, 1e-6);
  const auto run_at = [&](const std::string& step) {
    return run_rubbing(rubbing_case(half_circle, 5, R"("at": "start", "friction": {"coefficient": 0.25})",
                                    R"({"end_time": 2.2, "step": )" + step + "}"),
                       {"output.every=0.02"});
  };
  const CaseRun fine = run_at("0.001"), coarse = run_at("0.002");
  ASSERT_EQ(fine.code, 0) << fine.messages;
  EXPECT_NEAR(time_of(fine, "bead.s [m]", R * pi / 2), 1.165316, 2e-5);
  double farthest = 0;
  for (std::size_t i = 0; i < fine.rows.size(); ++i) {
    const double s = fine.value(i, "bead.s [m]");
    farthest = std::max(farthest, s);
    const double t = fine.value(i, "time [s]");
    if (t > 1.88) break;
    const double v = std::hypot(fine.value(i, "bead.vx [m/s]"), fine.value(i, "bead.vz [m/s]"));
    EXPECT_NEAR(v * v, std::max(0.0, v_squared(s / R)), 1e-3) << t;
  }
  EXPECT_LT(farthest, R * rest + 1e-5);
  EXPECT_GT(farthest, R * rest - 1e-3);
  EXPECT_LT(fine.last("bead.s [m]"), farthest - 0.1);  // and back
  EXPECT_LT(drift_of(fine), 2e-4);
  EXPECT_GT(drift_of(coarse) / drift_of(fine), 3);
}

TEST(FrictionRun, WithDragTheSpeedHasALimit) {
  // W0: v^2 = v_limit^2 (1 - exp(-2 k s)), and t by artanh.
  const double alpha = 12 * pi / 180, k = 1.225 * 0.8 / (2 * 90);
  const double a = gravity * (std::sin(alpha) - 0.02 * std::cos(alpha)), limit = std::sqrt(a / k);
  const double v = limit * std::sqrt(1 - std::exp(-2 * k * 300)), time = limit / a * std::atanh(v / limit);
  EXPECT_NEAR(v, 18.067436, 1e-6);
  EXPECT_NEAR(time, 23.099223, 1e-6);
  std::ostringstream analysis;
  analysis.precision(17);
  analysis << R"({"end_time": )" << time << R"(, "step": "20 ms"})";
  const std::string text =
      rubbing_case(slope_down(12), 90, R"("at": "start", "friction": {"coefficient": 0.02})", analysis.str(),
                   R"(, "drag_area": 0.8)", R"("air": {"density": 1.225}, )");
  const CaseRun run = run_rubbing(text);
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.s [m]"), 300, 3e-3);
  EXPECT_NEAR(std::hypot(run.last("bead.vx [m/s]"), run.last("bead.vz [m/s]")), v, 2e-4);
  EXPECT_LT(drift_of(run), 2e-2);
  // With a wind from behind it is faster.
  std::ostringstream wind;
  wind.precision(17);
  wind << "air.wind=[" << 5 * std::cos(alpha) << ", 0, " << -5 * std::sin(alpha) << "]";
  const CaseRun blown = run_rubbing(text, {wind.str()});
  ASSERT_EQ(blown.code, 0) << blown.messages;
  EXPECT_GT(std::abs(blown.last("energy.input [J]")), 1000);
  EXPECT_LT(drift_of(blown), 2e-2);
  EXPECT_GT(blown.last("bead.s [m]"), run.last("bead.s [m]") + 50);
}

TEST(FrictionRun, ABrakeThatIsOpenedLetsTheBodyGo) {
  const CaseRun run = run_rubbing(
      rubbing_case(slope_down(30), 5, R"("at": "start", "friction": {"force": [[0, 40], [0.5, 40], [1, 0]]})",
                   R"({"end_time": 2, "step": "2 ms"})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  // It holds m g/2 = 24.525 N until the brake gives less, at t0 = 0.5 + 0.5 (40 - 24.525)/40.
  const double pull = 5 * gravity / 2, t0 = 0.5 + 0.5 * (40 - pull) / 40, rate = 80;
  const double tau = 1 - t0, s1 = rate / 5 * std::pow(tau, 3) / 6, v1 = rate / 5 * tau * tau / 2;
  EXPECT_NEAR(run.last("bead.s [m]"), s1 + v1 + gravity / 4, 3e-5);
  EXPECT_LT(drift_of(run), 1e-3);
}

TEST(FrictionRun, WithoutCoefficientAndForceNothingIsHeld) {
  const CaseRun run =
      run_rubbing(rubbing_case(slope_down(30), 5, R"("at": "start", "friction": {"viscous": 2})",
                               R"({"end_time": 1, "step": "5 ms"})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double c = 2.0 / 5, a = gravity / 2;
  EXPECT_NEAR(run.last("bead.s [m]"), a / c * (1 - (1 - std::exp(-c)) / c), 2e-5);
}

TEST(FrictionRun, AtRestABodyStaysWhereFrictionHoldsItOrSlidesThere) {
  const auto resting = [&](double at, double mu) {
    std::ostringstream joint;
    joint.precision(17);
    joint << R"("at": {"length": )" << at << R"(}, "friction": {"coefficient": )" << mu << "}";
    return run_rubbing(rubbing_case(half_circle, 5, joint.str(), R"({"type": "static"})"));
  };
  const CaseRun stays = resting(3 * (pi / 2 - 0.2), 0.25);  // tan 0.2 < 0.25
  ASSERT_EQ(stays.code, 0) << stays.messages;
  EXPECT_NEAR(stays.last("bead.s [m]"), 3 * (pi / 2 - 0.2), 1e-9);
  EXPECT_EQ(stays.last("bead.stuck [1]"), 1);
  EXPECT_NEAR(stays.last("bead.friction_force [N]"), -5 * gravity * std::sin(0.2), 1e-6);
  const CaseRun slides = resting(1, 0.25);
  ASSERT_EQ(slides.code, 0) << slides.messages;
  EXPECT_NEAR(slides.last("bead.s [m]"), 3 * (pi / 2 - std::atan(0.25)), 1e-5);
}

// Its table is read where those of loads are: at the factor, which is 1 where none is given.
TEST(FrictionRun, AtRestABrakeOverTimeIsThatOfTheFactor) {
  const auto braked = [&](const char* rows, const char* analysis) {
    return run_rubbing(rubbing_case(
        slope_down(30), 2,
        std::string(R"("at": {"length": 1}, "at_beam_end": "stop", "friction": {"force": )") + rows + "}",
        analysis));
  };
  for (const char* analysis : {R"({"type": "static"})", R"({"type": "static", "load_steps": [1]})"}) {
    const CaseRun closes = braked("[[0, 0], [1, 50]]", analysis);
    ASSERT_EQ(closes.code, 0) << closes.messages;
    EXPECT_NEAR(closes.last("bead.s [m]"), 1, 1e-9) << analysis;
    EXPECT_NEAR(closes.last("bead.friction_force [N]"), -2 * gravity / 2, 1e-6) << analysis;
    const CaseRun opens = braked("[[0, 50], [1, 0]]", analysis);
    ASSERT_EQ(opens.code, 0) << opens.messages;
    EXPECT_NEAR(opens.last("bead.s [m]"), 400, 1e-6) << analysis;
  }
}

TEST(FrictionRun, ADriveWorksAgainstFriction) {
  const CaseRun run = run_rubbing(
      rubbing_case(slope_down(0), 5,
                   R"("at": "start", "motion": {"speed": 2}, "friction": {"coefficient": 0.3, "viscous": 1})",
                   R"({"end_time": 1, "step": "10 ms"})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("bead.drive_force [N]"), 0.3 * 5 * gravity + 2, 1e-7);
  EXPECT_NEAR(run.last("bead.friction_force [N]"), -0.3 * 5 * gravity - 2, 1e-7);
  EXPECT_NEAR(run.last("energy.input [J]"), 2 * (0.3 * 5 * gravity + 2), 1e-6);
  EXPECT_LT(drift_of(run), 1e-9);
}

// A heavy trolley on a rope that hardly resists bending.
const char* const rope_case = R"({"nurbeam": 1,
  "beams": [{"name": "rope", "axis": {"polyline": [[0, 0, 0], [20, 0, 0]]}, "stress_free": "straight",
    "section": {"radius": 0.004}, "material": {"density": 5000, "youngs_modulus": "60 GPa"}, "unstressed_length": 21,
    "elements": {"count": 24}}],
  "supports": [{"beam": "rope", "at": "start", "type": "pinned"}, {"beam": "rope", "at": "end", "type": "pinned"}],
  "bodies": [{"name": "bead", "mass": 60}],
  "sliding_joints": [{"body": "bead", "beam": "rope", "at": {"length": 4}, "slope": "discontinuous",
                      "friction": {"coefficient": 0.15, "law": "capstan"}}],
  "analysis": {"type": "static"}})";

TEST(FrictionRun, OnARopeABodySlidesAsFarAsTensionsDifferAsTheCapstanLets) {
  const CaseRun run = run_rubbing(rope_case);
  ASSERT_EQ(run.code, 0) << run.messages;
  // Tensions and kink from the reactions and the rope's own weight, which know nothing of the law.
  const double s = run.last("bead.s [m]"), weight_per_s = 5000 * pi * 16e-6 * 1.05 * gravity;
  const double H = -run.last("reaction.rope.start.fx [N]");
  const double V1 = run.last("reaction.rope.start.fz [N]") - weight_per_s * s,
               V2 = run.last("reaction.rope.end.fz [N]") - weight_per_s * (20 - s);
  const double theta = std::atan2(V1, H) + std::atan2(V2, H);
  EXPECT_NEAR(std::log(std::hypot(H, V1) / std::hypot(H, V2)) / theta, 0.15, 1e-4);
  EXPECT_NEAR(run.last("bead.friction_force [N]"), std::hypot(H, V2) - std::hypot(H, V1), 1e-2);
}

TEST(FrictionRun, WhatCannotBeIsRefused) {
  const std::string text =
      rubbing_case(slope_down(30), 5, R"("at": "start", "friction": {"coefficient": 0.3})",
                   R"({"end_time": 1, "step": "5 ms"})");
  const auto says = [&](const std::string& override, const std::string& part) {
    const CaseRun run = run_rubbing(text, {override});
    EXPECT_EQ(run.code, 2) << override;
    EXPECT_TRUE(run.says(part)) << run.messages;
  };
  says("sliding_joints[0].friction.static=0.2", "friction.static: is 0.2, less than \"coefficient\", 0.3");
  const CaseRun smooth =
      run_rubbing(text, {"sliding_joints[0].friction.law=capstan", "sliding_joints[0].slope=continuous"});
  EXPECT_TRUE(smooth.code == 2 && smooth.says("friction.law: is \"capstan\"")) << smooth.messages;
  says("sliding_joints[0].friction.coefficient=11", "must be between 0 and 10");
  EXPECT_FALSE(run_rubbing(text, {"sliding_joints[0].friction.coefficient=11"}).says("resists nothing"));
  says("sliding_joints[0].friction.coefficient=-1", "must be between 0 and 10");
  says("sliding_joints[0].friction.force=-3", "must be between 0 and 1e+12");
  says("sliding_joints[0].friction.stick_stiffness=0", "must be between 1e-09 and");
  says("analysis.integrator.type=ida",
       "analysis.integrator.type: is \"ida\", which nurbeam no longer has; use \"radau\"");
  EXPECT_FALSE(run_rubbing(text, {"analysis.integrator.type=ida", "analysis.step=null"}).says("rk4"));
  says("sliding_joints[0].friction={\"stick_stiffness\": 100}",
       "friction: resists nothing; give \"coefficient\"");
  says("bodies[0].drag_area=0.8", "bodies[0].drag_area: needs the \"air\" that drags");
}

// A beam that gives a little under a body at its start, whose brake lets go by 0.6 s: down a slope of 20
// degrees.
TEST(Friction, AtTheStartOfABeamHoldsABodyNoLongerThanItSticks) {
  const TemporaryDirectory directory;
  const CaseRun run = run_file(directory.write("brake.json", R"({"nurbeam": 1,
    "beams": [{"name": "l", "axis": {"polyline": [[0, 0, 0], [9.396926207859085, 0, -3.420201433256687]]},
               "section": {"rectangle": [0.1, 0.2]}, "material": "steel"}],
    "bodies": [{"name": "b", "mass": 3}],
    "sliding_joints": [{"body": "b", "beam": "l", "at": "start",
                        "friction": {"force": [[0, 100], [0.5, 100], [0.6, 0]]}}],
    "supports": [{"beam": "l", "at": "start", "type": "clamped"}, {"beam": "l", "at": "end", "type": "clamped"}],
    "analysis": {"end_time": 2, "step": "5 ms"}})"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("b.s [m]"), 3.3146, 5e-3);  // as on a rigid guide, or from the beam's equilibrium
}

}  // namespace
}  // namespace nurbeam::test
