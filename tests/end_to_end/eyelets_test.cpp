#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
}  // namespace nurbeam
