#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;

std::string text_of(double value) { return std::to_string(value); }

// A bar of 2 m along a direction askew, EI 150 N m^2 and GJ about 115 N m^2, 1.2 kg/m; `more` are keys of the
// beam, `keys` of the case.
std::string bar(const std::string& support, const std::string& analysis, const std::string& more = "",
                const std::string& keys = "", bool reversed = false) {
  const std::string from = "[1, 2, 3]", to = "[2.2, 3.6, 3]";
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "bar", "axis": { "polyline": [)" +
         (reversed ? to + ", " + from : from + ", " + to) + R"(] },
      "section": { "area": 1e-4, "second_moment": 1e-9 },
      "material": { "density": 12000, "youngs_modulus": 1.5e11, "shear_modulus": 5.75e10 },
      "elements": { "count": 6 })" +
         more + R"( }],
    "supports": [)" +
         support + R"(], "analysis": { )" + analysis + R"( }, "output": { "every": 0.1, "report": false,
      "probes": [{ "name": "tip", "beam": "bar", "at": ")" +
         (reversed ? "start" : "end") + R"(" }] })" + keys + " }";
}

std::string clamp(const std::string& rotation, const std::string& more = "",
                  const std::string& at = "start") {
  return R"({ "name": "hub", "beam": "bar", "at": ")" + at + R"(", "type": "clamped", "rotation": { )" +
         rotation + " }" + more + " }";
}

const std::string statics = R"("type": "static")";

// Nothing loads the bar: it goes round with its clamp, however far, about any axis.
TEST(Rotation, TakesAFreeBarAlongAsARigidBody) {
  for (const bool torsion : {false, true})
    for (const bool reversed : {false, true})
      for (const double degrees : {30.0, -150.0, 400.0, 1100.0}) {
        const std::string axis = torsion ? "[1, -2, 0.5]" : "[0, 0, 1]";
        const CaseRun run = test::run_text(
            bar(clamp(R"("axis": )" + axis + R"(, "about": [0, 0, 1], "table": [[0, 0], [1, )" +
                          text_of(degrees) + "]]",
                      "", reversed ? "end" : "start"),
                statics, torsion ? R"(, "torsion": true)" : R"(, "torsion": false)", "", reversed));
        ASSERT_EQ(run.code, 0) << run.messages;
        const Eigen::Vector3d u =
            (torsion ? Eigen::Vector3d(1, -2, 0.5) : Eigen::Vector3d(0, 0, 1)).normalized();
        const Eigen::Vector3d about(0, 0, 1), drawn(2.2, 3.6, 3);
        const Eigen::Vector3d tip = about + Eigen::AngleAxisd(degrees * M_PI / 180, u) * (drawn - about);
        EXPECT_NEAR(run.last("tip.x [m]"), tip.x(), 1e-8) << degrees;
        EXPECT_NEAR(run.last("tip.y [m]"), tip.y(), 1e-8);
        EXPECT_NEAR(run.last("tip.z [m]"), tip.z(), 1e-8);
        EXPECT_NEAR(run.last("hub.angle [rad]"), degrees * M_PI / 180, 1e-9);
        EXPECT_NEAR(run.last("hub.drive_moment [N m]"), 0, 1e-6);
      }
}

// Clamped at its other end too, it is twisted by full turns, by the moment GJ phi/L.
TEST(Rotation, CountsFullTurnsOfTwist) {
  const double GJ = 5.75e10 * 2e-9, degrees = 720;
  const std::string other = R"(, { "name": "foot", "beam": "bar", "at": "start", "type": "clamped" })";
  const std::string turned =
      clamp(R"("axis": [1.2, 1.6, 0], "table": [[0, 0], [1, )" + text_of(degrees) + "]]",
            R"(, "direction": [1.2, 1.6, 0], "force": 3000)", "end");
  const CaseRun run = test::run_text(bar(turned + other, statics, R"(, "torsion": true)"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("hub.drive_moment [N m]"), GJ * 4 * M_PI / 2, 1e-4 * GJ * 4 * M_PI / 2);
  EXPECT_NEAR(run.last("bar.twist.max [rad]"), 4 * M_PI, 1e-6);
}

// The work of the drive is what the motion has; the same with Radau's method as with fixed steps, and after a
// restart.
TEST(Rotation, PutsItsWorkIntoTheMotion) {
  const std::string drive =
      clamp(R"("axis": [0.3, -0.2, 1], "about": [0.5, 2, 3], "table": [[0, 0], [1, 500]])");
  for (const std::string how :
       {R"("step": 1e-3)", R"("tolerance": 1e-6, "integrator": { "type": "radau" })"}) {
    const CaseRun run = test::run_text(bar(drive, R"("end_time": 1.5, )" + how, R"(, "torsion": true)"));
    ASSERT_EQ(run.code, 0) << run.messages;
    double most = 0;
    for (std::size_t i = 0; i < run.rows.size(); ++i) most = std::max(most, run.value(i, "energy.input [J]"));
    EXPECT_GT(most, 10);
    for (std::size_t i = 0; i < run.rows.size(); ++i)
      EXPECT_NEAR(run.value(i, "energy.total [J]"), 0, 2e-3 * most);
  }
}

TEST(Rotation, TellsWhatItCannotBe) {
  const auto says = [](const std::string& text, const std::string& message) {
    const CaseRun run = test::run_text(text);
    EXPECT_EQ(run.code, 2) << run.messages;
    EXPECT_NE(run.messages.find(message), std::string::npos) << run.messages;
  };
  const auto support = [](const std::string& keys) {
    return R"({ "beam": "bar", "at": "start", )" + keys + " }";
  };
  const std::string motion = R"("end_time": 1, "step": 0.01)";
  says(bar(clamp(R"("axis": [0, 0, 0], "speed": 1)"), motion),
       "is [0, 0, 0]; give the direction of the axis");
  says(bar(clamp(R"("axis": [0, 0, 1])"), motion), "give one of \"table\", \"speed\"");
  says(bar(clamp(R"("axis": [0, 0, 1], "speed": 1)"), statics), "give a \"table\" of angles");
  says(bar(clamp(R"("axis": [0, 0, 1], "table": [[0, 10], [1, 20]])"), motion), "is at 10 degrees at time 0");
  says(bar(support(R"("type": "pinned", "rotation": { "axis": [0, 0, 1], "speed": 1, "ramp": 1 })"), motion),
       "turns nothing");
  says(bar(support(
               R"("type": "guided", "direction": [1, 0, 0], "rotation": { "axis": [0, 0, 1], "speed": 1 })"),
           motion),
       "is of \"clamped\", \"fork\" and \"pinned\" supports");
  says(bar(support(R"("type": "pinned", "direction": [1, 0, 0])"), motion), "use \"guided\"");
  says(
      bar(support(
              R"("type": "clamped", "direction": [1, 0, 0], "force": 3, "rotation": { "axis": [0, 0, 1], "speed": 1, "ramp": 1 })"),
          motion),
      "let the rotation's \"axis\" be along it");
}

std::string pendulum(const std::string& connector, const std::string& analysis,
                     const std::string& torsion = "false") {
  return bar(R"({ "beam": "bar", "at": "start", "type": "pinned" })", analysis, R"(, "torsion": )" + torsion,
             R"(, "connectors": [{ "name": "hinge", "type": "rotational", )" + connector + " }]");
}
const std::string from_space = R"("from": { "point": [0, 0, 0] }, "to": { "beam": "bar", "at": "start" })";

TEST(RotationalConnector, TurnsToWhereItIsFree) {
  for (const double degrees : {40.0, -100.0}) {
    const CaseRun run = test::run_text(pendulum(
        R"("axis": [0, 0, 1], "stiffness": 80, "angle": )" + text_of(degrees) + ", " + from_space, statics));
    ASSERT_EQ(run.code, 0) << run.messages;
    const double angle = std::atan2(1.6, 1.2) + degrees * M_PI / 180;
    EXPECT_NEAR(run.last("tip.x [m]"), 1 + 2 * std::cos(angle), 1e-6);
    EXPECT_NEAR(run.last("tip.y [m]"), 2 + 2 * std::sin(angle), 1e-6);
    EXPECT_NEAR(run.last("hinge.angle [rad]"), degrees * M_PI / 180, 1e-8);
    EXPECT_NEAR(run.last("hinge.moment [N m]"), 0, 1e-6);
  }
}

// A free bar that is turned on by a constant moment: counted on over full turns; what the damper takes and
// the spring holds is the energy.
TEST(RotationalConnector, CountsItsAngleInAMotion) {
  const CaseRun run = test::run_text(pendulum(
      R"("axis": [0, 0, 1], "stiffness": "2 N m/rad", "damping": "0.05 N m s/rad", "moment": -60, )" +
          from_space,
      R"("end_time": 2, "tolerance": 1e-7, "integrator": { "type": "radau" })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  double most = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double angle = run.value(i, "hinge.angle [rad]");
    most = std::max(most, angle);
    if (i > 0) EXPECT_LT(std::abs(angle - run.value(i - 1, "hinge.angle [rad]")), 3);
    EXPECT_NEAR(run.value(i, "energy.total [J]"), 900, 0.5);  // 60^2/(2 2)
  }
  EXPECT_GT(most, 4 * M_PI);
}

TEST(RotationalConnector, TellsWhatItCannotBe) {
  const auto says = [](const std::string& text, const std::string& message) {
    const CaseRun run = test::run_text(text);
    EXPECT_EQ(run.code, 2) << run.messages;
    EXPECT_NE(run.messages.find(message), std::string::npos) << run.messages;
  };
  says(pendulum(R"("stiffness": "80 N/m", "axis": [0, 0, 1], )" + from_space, statics),
       "rotational stiffness");
  says(pendulum(R"("stiffness": 80, "axis": [0, 0, 0], )" + from_space, statics),
       "give the direction of the axis");
  says(pendulum(R"("stiffness": 80, "length": 2, "axis": [0, 0, 1], )" + from_space, statics),
       "is of connectors along a line");
  says(pendulum(R"("axis": [0, 0, 1], )" + from_space, statics), "\"stiffness\" is missing");
  says(pendulum(R"("stiffness": 80, "axis": [3, 4, 0], )" + from_space, statics), "has no torsion");
  says(
      pendulum(
          R"("stiffness": 80, "axis": [0, 0, 1], "from": { "point": [0, 0, 0] }, "to": { "point": [1, 0, 0] })",
          statics),
      "joins two points");
  std::string spring = pendulum(R"("stiffness": 80, "axis": [0, 0, 1], )" + from_space, statics);
  spring.replace(spring.find("\"rotational\""), 12, "\"spring\"");
  says(spring, "is of the type \"rotational\"");
}

TEST(SpinUp, HasItsKnownNumbers) {
  const CaseRun run = test::run_file(test::sample("spin_up/spin_up.json"), {"output.report=false"});
  ASSERT_EQ(run.code, 0) << run.messages;
  double behind = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double a = run.value(i, "hub.angle [rad]");
    behind =
        std::min(behind, std::cos(a) * run.value(i, "tip.y [m]") - std::sin(a) * run.value(i, "tip.x [m]"));
  }
  EXPECT_NEAR(behind, -0.5737507, 1e-3);
  EXPECT_NEAR(run.value(60, "hub.drive_moment [N m]"), 289.9302, 0.3);
}

}  // namespace
}  // namespace nurbeam
