#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

using test::CaseRun;

// A string without weight, 2.9 m long when it is free, from (0, 0, 0) to (3, 0, 0) through an eyelet; `more`
// are keys beside it.
std::string string_through(const std::string& eyelet,
                           const std::string& more = R"("analysis": { "type": "static" })") {
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [3, 0, 0]] },
      "section": { "area": 1e-5, "second_moment": 1e-18 }, "material": { "density": 1000, "youngs_modulus": 1e8 },
      "elements": { "count": 12 }, "unstressed_length": 2.9 }],
    "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                 { "beam": "string", "at": "end", "type": "pinned" }],
    "eyelets": [)" +
         eyelet + "], " + more + R"(, "output": { "report": false } })";
}

// Both parts of the string have one tension T, by Green's law, and the eyelet bears what these do not
// balance.
TEST(Eyelets, LeadAStringWithOneTension) {
  const CaseRun run = test::run_text(string_through(
      R"({ "name": "ring", "beam": "string", "at": { "length": 1.3 }, "position": [1, 0, 0.4] })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double left = std::hypot(1, 0.4), right = std::hypot(2, 0.4), stretch = (left + right) / 2.9;
  const double T = 1e3 * (stretch * stretch - 1) / 2 * stretch;
  EXPECT_NEAR(run.last("ring.s [m]"), 3 * left / (left + right), 1e-9);
  EXPECT_NEAR(run.last("string.axial_force.min [N]"), T, 1e-8);
  EXPECT_NEAR(run.last("string.axial_force.max [N]"), T, 1e-8);
  EXPECT_NEAR(run.last("ring.fx [N]"), T * (1 / left - 2 / right), 1e-8);
  EXPECT_NEAR(run.last("ring.fz [N]"), T * 0.4 * (1 / left + 1 / right), 1e-8);
  EXPECT_NEAR(run.last("ring.joint_force.z [N]"), -run.last("ring.fz [N]"), 1e-9);
}

// Held, the place `at` is in the eyelet, and the parts have tensions of their own.
TEST(Eyelets, HoldTheirPlaceWhereTheyAreToldTo) {
  const CaseRun run = test::run_text(string_through(
      R"({ "name": "ring", "beam": "string", "at": { "length": 1.5 }, "position": [1.5, 0, 0.4], "equilibrium": "held" })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double stretch = 2 * std::hypot(1.5, 0.4) / 2.9;
  EXPECT_NEAR(run.last("ring.s [m]"), 1.5, 1e-12);
  EXPECT_NEAR(run.last("string.axial_force.max [N]"), 1e3 * (stretch * stretch - 1) / 2 * stretch, 1e-8);
}

// A string over a tower, drawn with its corner: both parts have one tension, and, with friction, tensions
// that differ by what the capstan bears at most.
TEST(Eyelets, LeadABeamRoundACornerOfItsDrawing) {
  const auto saddle = [](const std::string& friction, double beyond) {
    return test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [6, 0, 4.5], [14, 0, 4.5]] },
        "section": { "area": 1e-5, "second_moment": 1e-12 }, "material": { "density": 1000, "youngs_modulus": 1e11 },
        "elements": { "count": 15 }, "tension": 2000, "stress_free": "straight" }],
      "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                   { "beam": "string", "at": "end", "type": "pinned" }],
      "loads": [{ "beam": "string", "at": { "length": 12 }, "force": [0, 0, )" +
                          std::to_string(-beyond) + R"(] }],
      "eyelets": [{ "name": "tower", "beam": "string", "at": { "near": [6, 0, 4.5] })" +
                          friction + R"( }],
      "analysis": { "type": "static" }, "output": { "report": false,
        "probes": [{ "name": "one", "beam": "string", "at": { "length": 3 } },
                   { "name": "two", "beam": "string", "at": { "length": 10 } }] } })");
  };
  const CaseRun even = saddle("", 0);
  ASSERT_EQ(even.code, 0) << even.messages;
  const double T = 2000;
  EXPECT_NEAR(even.last("one.axial_force [N]"), T, 1e-6 * T);
  EXPECT_NEAR(even.last("two.axial_force [N]"), T, 1e-6 * T);
  EXPECT_NEAR(even.last("tower.fz [N]"), T * 0.6, 1e-5 * T);

  const CaseRun loaded = saddle("", 400);
  EXPECT_NEAR(loaded.last("one.axial_force [N]") / loaded.last("two.axial_force [N]"), 1, 1e-6);
  const CaseRun rough = saddle(R"(, "friction": { "coefficient": 0.1 })", 400);
  ASSERT_EQ(rough.code, 0) << rough.messages;
  const double ratio = rough.last("two.axial_force [N]") / rough.last("one.axial_force [N]");
  EXPECT_GT(ratio, 1.001);
  EXPECT_LE(ratio, std::exp(0.1 * 1.2));
}

TEST(Eyelets, SayWhatTheyCannotBe) {
  const auto says = [](const std::string& text, const std::string& part) {
    const CaseRun run = test::run_text(text);
    EXPECT_EQ(run.code, 2);
    EXPECT_TRUE(run.says(part)) << run.messages;
  };
  const std::string motion = R"("analysis": { "end_time": 1, "step": 1e-3 })";
  says(string_through(R"({ "name": "ring", "beam": "rope", "at": { "length": 1 } })"),
       "there is no beam \"rope\"");
  says(string_through(R"({ "name": "ring", "beam": "string", "at": { "length": 1 }, "position": [1, 0, 1] })",
                      motion),
       "start with \"initial\": \"equilibrium\"");
  says(string_through(R"({ "name": "a", "beam": "string", "at": { "length": 1 } },
                         { "name": "b", "beam": "string", "at": { "length": 1 } })"),
       "must be more than");
}

// Coulomb's bound is that of the force across, which grows without limit as both parts become parallel.
TEST(Eyelets, RefuseCoulombsLawAboveAWrapOf120Degrees) {
  // Drawn round a corner of 2 atan(1/slope) against what it comes from.
  const auto drawn = [](double slope, const std::string& law) {
    const std::string top = std::to_string(6 * slope);
    return test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
      "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [6, 0, )" +
                          top + R"(], [12, 0, 0]] },
        "section": { "area": 1e-5, "second_moment": 1e-12 }, "material": { "density": 1000, "youngs_modulus": 1e11 },
        "elements": { "count": 12 }, "tension": 2000, "stress_free": "straight" }],
      "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                   { "beam": "string", "at": "end", "type": "pinned" }],
      "eyelets": [{ "name": "tower", "beam": "string", "at": { "near": [6, 0, )" +
                          top + R"(] }, "friction": { "coefficient": 0.1, "law": ")" + law + R"(" } }],
      "analysis": { "type": "static" }, "output": { "report": false } })");
  };
  EXPECT_EQ(drawn(1.7, "coulomb").code, 0) << drawn(1.7, "coulomb").messages;  // 119 degrees
  EXPECT_EQ(drawn(1.8, "capstan").code, 0);
  const CaseRun refused = drawn(1.8, "coulomb");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(refused.says("eyelets[0].friction.law") && refused.says("121.9 degrees") &&
              refused.says("use \"capstan\""))
      << refused.messages;
}

// A body that falls on a slack string bends it more and more: the run ends where the law does.
TEST(Friction, ByCoulombsLawEndsAtAWrapOf120Degrees) {
  const auto run = [](const std::string& law) {
    return test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [4, 0, 0]] },
        "section": { "area": 1e-5, "second_moment": 1e-14 },
        "material": { "density": 8000, "youngs_modulus": 1e8, "stiffness_damping": 0.01 },
        "elements": { "count": 16 }, "tension": 1 }],
      "bodies": [{ "name": "weight", "mass": 300 }],
      "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                   { "beam": "string", "at": "end", "type": "pinned" }],
      "sliding_joints": [{ "body": "weight", "beam": "string", "at": { "length": 2 }, "slope": "discontinuous",
                           "friction": { "coefficient": 0.2, "law": ")" +
                          law + R"(" } }],
      "analysis": { "end_time": 1.2, "step": 1e-3 }, "output": { "report": false, "every": 0.01 } })");
  };
  const CaseRun ended = run("coulomb");
  EXPECT_EQ(ended.code, 3);
  EXPECT_TRUE(ended.says("degrees at \"weight\"") && ended.says("\"law\": \"capstan\"")) << ended.messages;
  EXPECT_LT(ended.last("weight.z [m]"), -3);  // 2 tan(60 degrees) = 3.46 less a step's frame
  EXPECT_GT(ended.last("weight.z [m]"), -3.5);
  const CaseRun goes_on = run("capstan");
  EXPECT_EQ(goes_on.code, 0) << goes_on.messages;
  EXPECT_LT(goes_on.last("weight.z [m]"), -3.5);
}

// x = (dM/2 rho)(cosh wt - 1), w^2 = 2 rho g/(sum of all masses), for a rope that does not stretch.
TEST(Eyelets, LetAnAtwoodsMachineFall) {
  const CaseRun run = test::run_file(test::source_directory() / "tests/cases/atwood_eyelets.json");
  ASSERT_EQ(run.code, 0) << run.messages;
  const double rho = 2, total = 6 + 8 + rho * 10.4, w = std::sqrt(2 * rho * 9.81 / total);
  for (const std::size_t row : {1, 2, 3}) {
    const double t = run.value(row, "time [s]");
    EXPECT_NEAR(run.value(0, "end.z [m]") - run.value(row, "end.z [m]"),
                (8 - 6) / (2 * rho) * (std::cosh(w * t) - 1), 1e-4)
        << t;
  }
}

// Atwood's machine: a rope of 10.4 m and 2 kg/m over two eyelets, 8 and 6 kg at its ends, and the inertia of
// turning pulleys. The heavier side falls by (dM/2 rho) (cosh w t - 1), w^2 = 2 rho g/(sum of masses). There
// is no rest: the start holds the rope.
std::string atwood(double inertia, const std::string& keys = "") {
  const std::string J = R"(, "inertia": )" + std::to_string(inertia) + keys + " }";
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, -5], [0, 0, 0], [0.4, 0, 0], [0.4, 0, -5]] },
      "stress_free": "straight", "section": { "area": 1e-4, "second_moment": 5e-14 },
      "material": { "density": 20000, "youngs_modulus": 2e11 }, "elements": { "max_length": 0.25 } }],
    "bodies": [{ "name": "six", "mass": 6, "fastened": { "beam": "rope", "at": "start" } },
               { "name": "eight", "mass": 8, "fastened": { "beam": "rope", "at": "end" } }],
    "eyelets": [{ "name": "left", "beam": "rope", "at": { "length": 5 })" +
         J + R"(, { "name": "right", "beam": "rope", "at": { "length": 5.4 })" + J + R"(],
    "analysis": { "initial": "equilibrium", "end_time": 1.5, "step": 0.001 },
    "output": { "report": false, "every": 0.5 } })";
}
TEST(Eyelets, TurnAsThePulleysOfAtwoodsMachine) {
  for (const double inertia : {0.0, 2.0}) {
    const CaseRun run = test::run_text(atwood(inertia));
    ASSERT_EQ(run.code, 0) << run.messages;
    const double rate = std::sqrt(2 * 2 * 9.81 / (14 + 20.8 + 2 * inertia));
    for (const std::size_t row : {1U, 2U, 3U}) {
      const double fall = 2 / (2.0 * 2) * (std::cosh(rate * 0.5 * static_cast<double>(row)) - 1);
      // The rope stretches by 0.03 mm as it is let go.
      EXPECT_NEAR(run.value(0, "eight.z [m]") - run.value(row, "eight.z [m]"), fall, 4e-5) << inertia;
    }
    EXPECT_TRUE(run.says(R"(there is no rest near the drawing with beam "rope" free to run through "left")"))
        << run.messages;
  }
}

TEST(Eyelets, LetTheBeamGoWhereTheyAreReleased) {
  const CaseRun run = test::run_text(atwood(0, R"(, "equilibrium": "held", "release": 0.5)"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.value(1, "eight.z [m]"), run.value(0, "eight.z [m]"), 1e-9);
  const double fall = 0.5 * (std::cosh(std::sqrt(4 * 9.81 / 34.8) * 0.5) - 1);
  EXPECT_NEAR(run.value(1, "eight.z [m]") - run.value(2, "eight.z [m]"), fall, 4e-5);
  EXPECT_FALSE(run.says("there is no rest"));
}

// A movable pulley of 12 kg between a ceiling and an eyelet, and 8 kg on the rope: a light rope's
// acceleration is g (8 - 6)/(8 + 12/4 + J/4 + J'), with the inertia J of the pulley, over which the rope runs
// half as fast, and J' of the eyelet's.
TEST(Eyelets, AreMovablePulleysOnBodies) {
  for (const double turning : {0.0, 1.0}) {
    const std::string J = std::to_string(2 * turning), J_top = std::to_string(3 * turning);
    const CaseRun run = test::run_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
      "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [0.01, 0, -6], [0.02, 0, 0], [0.02, 0, -5]] },
        "stress_free": "straight", "section": { "area": 1e-6, "second_moment": 1e-16 },
        "material": { "density": 100, "youngs_modulus": 2e13 }, "elements": { "max_length": 0.25 } }],
      "bodies": [{ "name": "pulley", "mass": 12 },
                 { "name": "weight", "mass": 8, "fastened": { "beam": "rope", "at": "end" } }],
      "supports": [{ "beam": "rope", "at": "start", "type": "pinned" }],
      "eyelets": [{ "name": "block", "beam": "rope", "at": { "near": [0.01, 0, -6] }, "on": "pulley", "inertia": )" +
                                       J + R"( },
                  { "name": "top", "beam": "rope", "at": { "near": [0.02, 0, 0] }, "inertia": )" +
                                       J_top + R"( }],
      "analysis": { "initial": "equilibrium", "end_time": 0.5, "step": 0.001 },
      "output": { "report": false, "every": 0.25 } })");
    ASSERT_EQ(run.code, 0) << run.messages;
    const double a = 9.81 * 2 / (11 + 3.5 * turning);
    const double fall = run.value(0, "weight.z [m]") - run.last("weight.z [m]");
    EXPECT_NEAR(fall, a * 0.125, 3e-4 * a * 0.125) << turning;
    EXPECT_NEAR(run.last("pulley.z [m]") - run.value(0, "pulley.z [m]"), fall / 2, 1e-3 * fall);
    EXPECT_NEAR(run.last("block.x [m]"), run.last("pulley.x [m]"), 1e-12);
    EXPECT_NEAR(run.last("block.z [m]"), run.last("pulley.z [m]"), 1e-12);
  }
}

// 10 kg on a light string over a capstan winch that lowers them by t^2/2; the tail is pulled with 50 N.
std::string winch(const std::string& drive, double weight = 10) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, -5], [0, 0, 0], [4, 0, 0]] },
      "stress_free": "straight", "section": { "area": 1e-5, "second_moment": 1e-16 },
      "material": { "density": 10, "youngs_modulus": 1e11, "stiffness_damping": 1e-3 },
      "elements": { "max_length": 0.5 } }],
    "bodies": [{ "name": "weight", "mass": )" +
         std::to_string(weight) + R"(, "fastened": { "beam": "string", "at": "start" } }],
    "supports": [{ "beam": "string", "at": "end", "type": "guided", "direction": [1, 0, 0], "force": 50 }],
    "eyelets": [{ "name": "winch", "beam": "string", "at": { "length": 5 })" +
         drive + R"( }],
    "analysis": { "initial": "equilibrium", "end_time": 2, "step": 0.001 },
    "output": { "report": false, "every": 0.5 } })";
}
TEST(Eyelets, DriveTheBeamAsAWinchDoes) {
  const CaseRun run = test::run_text(winch(R"(, "motion": { "table": [[0, 0], [1, 0.5], [2, 2]] })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("winch.s [m]"), 7, 1e-9);
  EXPECT_NEAR(run.value(0, "weight.z [m]") - run.last("weight.z [m]"), 2, 2e-3);
  // The tail pulls the beam towards its end, the weight towards its start with m (g - a).
  EXPECT_NEAR(run.value(2, "winch.holding_force [N]"), 50 - 10 * (9.81 - 1), 0.5);
  const CaseRun late = test::run_text(winch(R"(, "motion": { "table": [[0, 0.1], [1, 0.5]] })"));
  EXPECT_EQ(late.code, 2);
  EXPECT_TRUE(late.says("eyelets[0].motion.table: is 0.1 m at time 0")) << late.messages;
}

// The weight's 98.1 N against 50 N of the tail and 30 N of the winch's motor, with the inertia of its drum.
TEST(Eyelets, DriveTheBeamWithAForceToo) {
  const CaseRun run = test::run_text(winch(R"(, "force": -30, "inertia": 4, "equilibrium": "held")"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double a = (98.1 - 50 - 30) / (10 + 4);
  EXPECT_NEAR(run.last("winch.s [m]") - 5, a * 2, 2e-3 * a * 2);
}

// A ring takes the string along a path: the weight hangs on what is left of it, and nothing is lost.
TEST(Eyelets, MoveAlongAPath) {
  const CaseRun run = test::run_text(winch(R"(, "path": [[0, 0, 0, 0], [1, 1, 0, 0.5]])", 5.1));
  ASSERT_EQ(run.code, 0) << run.messages;
  for (const std::size_t row : {2U, 3U, 4U}) {
    EXPECT_NEAR(run.value(row, "winch.x [m]"), 1, 1e-12);
    EXPECT_NEAR(run.value(row, "winch.z [m]"), 0.5, 1e-12);
  }
  EXPECT_NEAR(run.value(1, "winch.x [m]"), 0.5, 1e-3);
  EXPECT_FALSE(run.says("energy")) << run.messages;
}

TEST(Eyelets, SayWhatCannotDriveOrCarryThem) {
  for (const auto& [keys, complaint] :
       {std::pair(R"(, "on": "nothing")", R"(eyelets[0].on: there is no body "nothing")"),
        std::pair(R"(, "on": "weight", "position": [0, 0, 0])", "\"position\""),
        std::pair(R"(, "motion": { "speed": 1 }, "force": 3)", "\"motion\""),
        std::pair(R"(, "path": [[0, 0, 0, 0]], "on": "weight")", "\"path\""),
        std::pair(R"(, "motion": { "table": [[0, 0], [1, 9]] })", "must be between -5 and 4 m")}) {
    const CaseRun run = test::run_text(winch(keys));
    EXPECT_EQ(run.code, 2) << keys;
    EXPECT_TRUE(run.says(complaint)) << run.messages;
  }
}

// A bead that runs down a wire to a ring, which is 1.7 m from it and 0.85 m lower.
std::string bead_before_ring(const std::string& joint, double end_time) {
  return R"({ "nurbeam": 1,
    "beams": [{ "name": "wire", "axis": { "polyline": [[0, 0, 0], [4, 0, -2]] }, "section": { "radius": 0.01 },
      "material": "steel", "elements": { "count": 8 } }],
    "bodies": [{ "name": "bead", "mass": 1 }],
    "supports": [{ "beam": "wire", "at": "start", "type": "pinned" },
                 { "beam": "wire", "at": "end", "type": "pinned" }],
    "sliding_joints": [{ "body": "bead", "beam": "wire", "at": { "near": [0.6, 0, -0.3] }, )" +
         joint + R"( }],
    "eyelets": [{ "name": "ring", "beam": "wire", "at": { "near": [2.3, 0, -1.15] } }],
    "analysis": { "end_time": )" +
         std::to_string(end_time) + R"(, "step": 0.002 }, "output": { "report": false } })";
}

struct Checked {
  int code;
  std::string text;
  bool says(const std::string& part) const { return text.find(part) != std::string::npos; }
};
Checked checked(const std::string& text, const std::vector<std::string>& changes = {}) {
  const test::TemporaryDirectory directory;
  std::vector<std::string> words = {"check", directory.write("case.json", text).string()};
  for (const std::string& change : changes) words.insert(words.end(), {"--set", change});
  std::ostringstream out, err;
  const test::CapturedErrors errors;
  const int code = run_command_line(words, out, err);
  return {code, out.str() + err.str() + errors.text()};
}

// s = g sin(a) t^2 / 2 with s = 1.7 hypot(1, 0.5) m: it is there at 0.931 s.
TEST(Eyelets, AreInTheWayOfBodiesThatRunDownToThem) {
  const std::string at_rest = R"("speed": 0)";
  const double there = std::sqrt(2 * 1.7 * std::hypot(1, 0.5) / (9.81 * 0.5 / std::hypot(1, 0.5)));
  const Checked late = checked(bead_before_ring(at_rest, there + 0.01));
  EXPECT_EQ(late.code, 0) << late.text;
  EXPECT_TRUE(late.says("body \"bead\" may run into eyelet \"ring\", at s = 2.57148 m of beam \"wire\""))
      << late.text;
  EXPECT_TRUE(late.says("it is there at t = 0.931 s; nothing passes an eyelet")) << late.text;
  EXPECT_FALSE(checked(bead_before_ring(at_rest, there - 0.01)).says("may run into"));
  EXPECT_FALSE(checked(bead_before_ring(at_rest, 2),
                       {R"(stops=[{"beam": "wire", "at": {"near": [2, 0, -1]}, "stiffness": 1000}])"})
                   .says("may run into"));
  EXPECT_FALSE(checked(bead_before_ring(R"("speed": -1)", 2)).says("may run into"));
}

TEST(Eyelets, RefuseAPrescribedMotionThroughThem) {
  const Checked motion = checked(bead_before_ring(R"("motion": { "speed": 2 })", 1));
  EXPECT_EQ(motion.code, 2) << motion.text;
  EXPECT_TRUE(motion.says("sliding_joints[0].motion: takes body \"bead\" to eyelet \"ring\"")) << motion.text;
  EXPECT_EQ(checked(bead_before_ring(R"("motion": { "speed": 2 })", 0.9)).code, 0);
}

}  // namespace
}  // namespace nurbeam
