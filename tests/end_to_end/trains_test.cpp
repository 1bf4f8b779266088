// Bodies that connectors join, on rigid guides: trains and pendulums with known answers.

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

CaseRun run_train(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("case.json", text), overrides);
}

double drift_of_energy(const CaseRun& run) {
  double change = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    change = std::max(change, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  return change;
}

// 30 and 50 kg on a level guide with a spring of 2000 N/m: the period is 0.6083668 s.
TEST(Train, OfTwoSwingsAboutItsCentreOfMass) {
  const CaseRun run = run_train(R"({
    "nurbeam": 1,
    "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[0, 0, 0], [100, 0, 0]] } }],
    "bodies": [{ "name": "a", "mass": 30 }, { "name": "b", "mass": 50 }],
    "sliding_joints": [{ "body": "a", "beam": "rail", "at": { "length": 10 }, "speed": 6 },
                       { "body": "b", "beam": "rail", "at": { "length": 12 }, "speed": 3 }],
    "connectors": [{ "name": "spring", "from": { "body": "a" }, "to": { "body": "b" }, "stiffness": 2000 }],
    "analysis": { "end_time": 3.041834, "step": 2e-4 }, "output": { "report": false } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  const double omega = std::sqrt(2000 * 80.0 / 1500);
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double t = run.value(i, "time [s]"), a = run.value(i, "a.x [m]"), b = run.value(i, "b.x [m]");
    EXPECT_NEAR((30 * a + 50 * b) / 80, (30 * 10 + 50 * 12) / 80.0 + (30 * 6 + 50 * 3) / 80.0 * t, 1e-9);
    EXPECT_NEAR(b - a, 2 - 3 / omega * std::sin(omega * t), 2e-5);
  }
  EXPECT_NEAR(run.last("spring.length [m]"), 2, 2e-5);  // five periods
  EXPECT_LT(drift_of_energy(run), 2e-3);
}

// A trolley of 50 kg on a level guide with 80 kg on a rod of 2 m, let go at 60 degrees.
TEST(Pendulum, BelowATrolleySwingsWithIt) {
  const CaseRun run = run_train(R"({
    "nurbeam": 1,
    "beams": [{ "name": "rail", "rigid": true, "axis": { "polyline": [[-10, 0, 0], [10, 0, 0]] } }],
    "bodies": [{ "name": "trolley", "mass": 50 },
               { "name": "load", "mass": 80, "position": [1.7320508075688772, 0, -1] }],
    "sliding_joints": [{ "body": "trolley", "beam": "rail", "at": { "length": 10 } }],
    "connectors": [{ "name": "rod", "from": { "body": "trolley" }, "to": { "body": "load" }, "type": "rod" }],
    "analysis": { "end_time": 2.420131, "step": 2e-4 }, "output": { "report": false, "every": 0.00605032750 } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  // After a period it is where it was; in between the trolley is 2 * 1.065877 m away, and passes at 4.395242
  // m/s.
  EXPECT_NEAR(run.last("trolley.x [m]"), 0, 2e-5);
  EXPECT_NEAR(run.last("load.x [m]"), std::sqrt(3.0), 2e-5);
  double farthest = 0, fastest = 0, pull = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    farthest = std::max(farthest, run.value(i, "trolley.x [m]"));
    fastest = std::max(fastest, std::abs(run.value(i, "trolley.vx [m/s]")));
    pull = std::max(pull, run.value(i, "rod.force [N]"));
    EXPECT_NEAR(run.value(i, "rod.length [m]"), 2, 1e-9);
    EXPECT_NEAR(50 * run.value(i, "trolley.vx [m/s]") + 80 * run.value(i, "load.vx [m/s]"), 0, 1e-8);
  }
  EXPECT_NEAR(farthest, 2 * 1.065877, 1e-4);
  EXPECT_NEAR(fastest, 4.395242, 1e-3);
  EXPECT_NEAR(pull, 2825.280, 0.5);
  EXPECT_LT(drift_of_energy(run), 2e-2);
}

// 30 kg with friction of 0.3 behind 50 kg with 0.1 on a slope of 30 degrees.
TEST(Train, OfUnlikeFrictionPullsItsLink) {
  const CaseRun run = run_train(R"({
    "nurbeam": 1,
    "beams": [{ "name": "slope", "rigid": true, "axis": { "polyline": [[0, 0, 0], [34.64101615137755, 0, -20]] } }],
    "bodies": [{ "name": "light", "mass": 30 }, { "name": "heavy", "mass": 50 }],
    "sliding_joints": [
      { "body": "light", "beam": "slope", "at": { "length": 1 }, "friction": { "coefficient": 0.3 } },
      { "body": "heavy", "beam": "slope", "at": { "length": 3 }, "friction": { "coefficient": 0.1 } }],
    "connectors": [{ "name": "link", "from": { "body": "light" }, "to": { "body": "heavy" }, "type": "rod" }],
    "analysis": { "end_time": 2, "step": 1e-3 }, "output": { "report": false } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  EXPECT_NEAR(run.last("light.s [m]"), 1 + 3.418251 / 2 * 4, 1e-4);
  EXPECT_NEAR(run.last("link.force [N]"), 31.85891, 1e-3);
  EXPECT_LT(drift_of_energy(run), 5e-3);
}

// Below a trolley that slides down 20 degrees a load hangs still at the angle of what it feels.
TEST(Pendulum, HangsStillBelowATrolleyThatSlidesDown) {
  const double slope = 20 * M_PI / 180;
  for (const auto& [friction, degrees, pull] :
       {std::tuple{0.0, 20.0, 737.4708}, {0.1, 14.289407, 741.1490}, {0.2, 8.690068, 752.0756}}) {
    const double angle = degrees * M_PI / 180, s = 2;
    std::ostringstream text;
    text.precision(17);
    text << R"({ "nurbeam": 1,
      "beams": [{ "name": "slope", "rigid": true, "axis": { "polyline": [[0, 0, 0], [)"
         << 40 * std::cos(slope) << ", 0, " << -40 * std::sin(slope) << R"(]] } }],
      "bodies": [{ "name": "trolley", "mass": 50 }, { "name": "load", "mass": 80, "position": [)"
         << s * std::cos(slope) - 2 * std::sin(angle) << ", 0, " << -s * std::sin(slope) - 2 * std::cos(angle)
         << R"(] }],
      "sliding_joints": [{ "body": "trolley", "beam": "slope", "at": { "length": 2 }, "friction": { "coefficient": )"
         << friction << R"( } }],
      "connectors": [{ "name": "rod", "from": { "body": "trolley" }, "to": { "body": "load" }, "type": "rod" }],
      "analysis": { "end_time": 2, "step": 1e-3 }, "output": { "report": false } })";
    const CaseRun run = run_train(text.str());
    ASSERT_EQ(run.code, 0) << run.messages;
    for (std::size_t i = 1; i < run.rows.size(); ++i) {
      const double x = run.value(i, "load.x [m]") - run.value(i, "trolley.x [m]");
      EXPECT_NEAR(std::asin(-x / 2) * 180 / M_PI, degrees, 1e-3) << friction;
      EXPECT_NEAR(run.value(i, "rod.force [N]"), pull, 1e-2) << friction;
    }
  }
}

}  // namespace
}  // namespace nurbeam::test
