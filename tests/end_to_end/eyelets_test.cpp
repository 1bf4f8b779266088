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

CaseRun run_text(const std::string& text) {
  const test::TemporaryDirectory directory;
  return test::run_file(directory.write("case.json", text));
}

// Both parts of the string have one tension T, by Green's law, and the eyelet bears what these do not
// balance.
TEST(Eyelets, LeadAStringWithOneTension) {
  const CaseRun run = run_text(string_through(
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
  const CaseRun run = run_text(string_through(
      R"({ "name": "ring", "beam": "string", "at": { "length": 1.5 }, "position": [1.5, 0, 0.4], "equilibrium": "held" })"));
  ASSERT_EQ(run.code, 0) << run.messages;
  const double stretch = 2 * std::hypot(1.5, 0.4) / 2.9;
  EXPECT_NEAR(run.last("ring.s [m]"), 1.5, 1e-12);
  EXPECT_NEAR(run.last("string.axial_force.max [N]"), 1e3 * (stretch * stretch - 1) / 2 * stretch, 1e-8);
}

TEST(Eyelets, SayWhatTheyCannotBe) {
  const auto says = [](const std::string& text, const std::string& part) {
    const CaseRun run = run_text(text);
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
