// Bodies whose place on a beam is prescribed, at kinks of their tables and at the ends of beams.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// Driven at 2 m/s from 0.5 m over a clamped steel bar of 2 m, whose free end it reaches at 0.75 s.
const std::string driven = R"({
  "nurbeam": 1,
  "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] }, "section": { "radius": 0.02 },
              "material": { "density": 7850, "youngs_modulus": 2.1e11 }, "elements": { "count": 10 } }],
  "bodies": [{ "name": "m", "mass": 1 }],
  "supports": [{ "beam": "b", "at": "start", "type": "clamped", "name": "wall" }],
  "sliding_joints": [{ "body": "m", "beam": "b", "at": { "length": 0.5 }, "motion": { "speed": 2 },
                       "at_beam_end": "stop" }],
  "analysis": { "end_time": 1.2 },
  "output": { "report": false, "every": 0.05 }
})";

CaseRun run_driven(const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("driven.json", driven), overrides);
}

TEST(PrescribedMotion, StopsAtAFreeEnd) {
  const CaseRun run = run_driven();
  EXPECT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    EXPECT_NEAR(run.value(i, "m.s [m]"), std::min(2.0, 0.5 + 2 * run.value(i, "time [s]")), 1e-8);
}

TEST(PrescribedMotion, LeavesAtAFreeEndAndFliesOn) {
  const CaseRun run = run_driven({"sliding_joints[0].at_beam_end=leave"});
  EXPECT_EQ(run.code, 0) << run.messages;
  const std::size_t last = run.rows.size() - 1;
  EXPECT_TRUE(std::isnan(run.value(last, "m.s [m]")));
  const double t = run.value(last, "time [s]") - run.value(last - 4, "time [s]"),
               before = run.value(last - 4, "m.vz [m/s]");
  EXPECT_NEAR(run.value(last, "m.vz [m/s]"), before - 9.81 * t, 1e-9);
  EXPECT_NEAR(run.value(last, "m.x [m]"), run.value(last - 4, "m.x [m]") + t * run.value(last, "m.vx [m/s]"),
              1e-9);
  EXPECT_NEAR(run.last("energy.total [J]"), run.value(0, "energy.total [J]"), 5e-3);
}

// A body of 1 kg that its table makes stop, go on faster and come back does no work but that of its own
// kinetic energy and of the bar, which hardly moves without gravity.
TEST(PrescribedMotion, JumpsInItsSpeedAreTheWorkOfItsDrive) {
  const CaseRun run = run_driven(
      {"gravity=[0, 0, 0]", "analysis.end_time=0.8", "analysis.step=0.003",
       R"(sliding_joints[0].motion={"table": [[0, 0.5], [0.2000000000005, 0.9], [0.401, 0.9], [0.6, 1.7], [0.8, 1.3]]})"});
  EXPECT_EQ(run.code, 0) << run.messages;
  const double start = run.value(0, "energy.total [J]");
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double t = run.value(i, "time [s]"), speed = t < 0.2     ? 2
                                                       : t < 0.401 ? 0
                                                       : t < 0.6   ? 0.8 / 0.199
                                                       : t < 0.8   ? -2
                                                                   : 0;
    EXPECT_NEAR(run.value(i, "m.vx [m/s]"), speed, 3e-2) << t;
    EXPECT_NEAR(run.value(i, "energy.input [J]"), speed * speed / 2 - 2, 5e-2) << t;
    EXPECT_NEAR(run.value(i, "energy.total [J]"), start, 5e-3) << t;
  }
}

// A stout bar of 0.98 kg on a support that moves from row to row, where its acceleration jumps: all that is
// put in moves it.
TEST(PrescribedMotion, OfASupportPutsInWhatItMovesByAnyIntegrator) {
  const TemporaryDirectory directory;
  const auto file = directory.write("carried.json", R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0.1, 0, 0]] }, "section": { "radius": 0.02 },
                "material": { "density": 7800, "youngs_modulus": 2.1e11, "damping": 1e-4 }, "elements": { "count": 2 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped",
                   "motion": [[0, 0, 0, 0], [0.1, 0.1, 0, 0.3], [0.22, 0.5, 0, 0.4], [0.3, 0.6, 0, 0], [0.45, 0, 0, -0.6]] }],
    "analysis": { "end_time": 0.4 }, "output": { "report": false, "every": 0.04 } })");
  for (const std::vector<std::string>& by :
       {std::vector<std::string>{R"(analysis.integrator={"type": "radau"})"},
        {R"(analysis.integrator={"type": "radau"})", "analysis.step=0.004"},
        {R"(analysis.integrator={"type": "radau"})", "analysis.step=0.002"},
        {"analysis.step=2e-4"}}) {
    const CaseRun run = run_file(file, by);
    EXPECT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.says("warning")) << run.messages;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      const double kinetic = run.value(i, "energy.kinetic [J]");
      EXPECT_NEAR(run.value(i, "energy.input [J]"), kinetic, 0.01 + 3e-3 * kinetic) << by.back() << " " << i;
    }
  }
}

// At constant speed round an upright circle its drive does the work of gravity alone, however hard the body
// presses on its guide.
TEST(PrescribedMotion, RoundACircleTakesNoWorkUnderErrorControl) {
  const TemporaryDirectory directory;
  const auto file =
      directory.write("round.json", R"({ "nurbeam": 1, "beams": [{ "name": "r", "rigid": true, "closed": true,
      "axis": { "arc": { "center": [0, 0, 0], "start": [1, 0, 0], "end": [1, 0, 0], "normal": [0, -1, 0] } } }],
    "bodies": [{ "name": "p", "mass": 2 }],
    "sliding_joints": [{ "body": "p", "beam": "r", "at": "start", "motion": { "speed": 6.283185307179586 } }],
    "analysis": { "end_time": 3 }, "output": { "report": false, "every": 0.125 } })");
  double last = 0;
  for (const char* tolerance : {"1e-4", "1e-5", "1e-6"}) {
    const CaseRun run = run_file(file, {std::string("analysis.tolerance=") + tolerance});
    EXPECT_EQ(run.code, 0) << run.messages;
    double largest = 0;
    for (std::size_t i = 0; i < run.rows.size(); ++i)
      largest =
          std::max(largest, std::abs(run.value(i, "energy.input [J]") - 2 * 9.81 * run.value(i, "p.z [m]")));
    EXPECT_LE(largest, 0.05) << tolerance;
    if (last > 0) EXPECT_LE(largest, last / 2) << tolerance;
    last = largest;
  }
}

// The reactions of a wall hold beam and body.
TEST(Reactions, OfANamedSupportHaveItsName) {
  const CaseRun run = run_driven({"analysis={\"type\": \"static\"}"});
  EXPECT_EQ(run.code, 0) << run.messages;
  const double weight = 9.81 * (1 + 7850 * std::numbers::pi * 0.02 * 0.02 * 2);
  EXPECT_NEAR(run.last("wall.fz [N]"), weight, 1e-7 * weight);
}

}  // namespace
}  // namespace nurbeam::test
