// Ropes that go slack, or hang freely: no element folds.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

CaseRun run_case(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return run_file(test::source_directory() / "tests/cases" / name, overrides);
}

// 30 m of wire rope, drawn plumb, which hangs by its own weight.
std::string hanging_rope(int elements, double bending_stiffness) {
  std::ostringstream text;
  text << R"({ "nurbeam": 1, "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0, 0, -30]] },
    "stress_free": "straight", "section": { "area": 2e-5, "second_moment": )"
       << bending_stiffness / 1e11 << R"( }, "material": { "density": 7000, "youngs_modulus": 1e11 },
    "elements": { "count": )"
       << elements << R"( } }], "supports": [{ "beam": "b", "at": "start", "type": "pinned" }],
    "analysis": { "type": "static" },
    "output": { "probes": [{ "name": "z", "beam": "b", "at": "end" }], "report": false } })";
  return text.str();
}

// The weight w stretches it by w L^2/(2 EA), to first order.
TEST(HangingRope, HangsPlumb) {
  const double stretch = 0.14 * 9.81 * 30 * 30 / (2 * 2e6);
  for (const double bending_stiffness : {0.01, 1.0})
    for (const int elements : {1, 2, 5, 10, 20, 25}) {
      const CaseRun run = run_text(hanging_rope(elements, bending_stiffness));
      ASSERT_EQ(run.code, 0) << run.messages;
      EXPECT_EQ(run.messages, "") << elements;
      EXPECT_LT(std::hypot(run.last("z.x [m]"), run.last("z.y [m]")), 1e-6) << elements;
      EXPECT_NEAR(run.last("z.z [m]"), -30 - stretch, 1e-3 * stretch) << elements;
    }
}

// The speed of the aircraft at a place.
double speed_at(const CaseRun& run, double x) {
  for (std::size_t i = 1; i < run.rows.size(); ++i) {
    const double last = run.value(i - 1, "aircraft.x [m]") + 1, now = run.value(i, "aircraft.x [m]") + 1;
    if (now < x) continue;
    const double part = (x - last) / (now - last);
    return run.value(i - 1, "aircraft.vx [m/s]") * (1 - part) + run.value(i, "aircraft.vx [m/s]") * part;
  }
  return 0;
}

double drift(const CaseRun& run) {
  double largest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    largest =
        std::max(largest, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  return largest;
}

// Half of an arresting gear: the rope behind the brake is pushed out and goes slack. Speeds of a chain of
// masses and springs: 57.53 and 50.27 m/s at 20 and 30 m.
void expect_arrested(const CaseRun& run, double largest_drift, double at_30 = 1e-2) {
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says("folds back")) << run.messages;
  EXPECT_NEAR(speed_at(run, 20), 57.53, 5e-3 * 57.53);
  EXPECT_NEAR(speed_at(run, 30), 50.27, at_30 * 50.27);
  EXPECT_LT(drift(run), largest_drift);
}

TEST(ArrestingGear, HasARopeThatDoesNotFoldBehindTheBrake) {
  expect_arrested(run_case("arresting_half.json"), 600);
}
TEST(ArrestingGear, HasATautTailThatDoesNotFoldBehindTheBrake) {
  expect_arrested(run_case("arresting_slack_tail.json"), 600);
}
// Where nothing folds nothing changes.
TEST(AtwoodRope, RunsThroughTwoEyeletsAsBefore) {
  const CaseRun run = run_case("atwood_two_eyelets.json");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_LT(drift(run), 2e-4);
}

// Ten times the damping of the chain.
TEST(ArrestingGear, IsNearlyAsRightWithMoreDamping) {
  expect_arrested(run_case("arresting_half.json", {"beams[0].material.damping=1e-3"}), 2000, 2e-2);
}

}  // namespace
}  // namespace nurbeam::test
