// Bodies whose place on a beam is prescribed, at kinks of their tables and at the ends of beams.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>
#include <string>
#include <tuple>
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

// Time is the load factor there, and nothing has a speed.
TEST(PrescribedMotion, OfLoadStepsHasNoSpeedThatCouldJump) {
  const CaseRun run = run_driven(
      {R"(analysis={"type": "static", "load_steps": [0.2, 0.6, 1]})", "output.every=null",
       R"(sliding_joints[0].motion={"interpolation": "linear", "table": [[0, 0.5], [0.4, 0.9], [1, 1.9]]})"});
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_FALSE(run.says("speed")) << run.messages;
  EXPECT_FALSE(run.says(" s:")) << run.messages;
}

// A body of 1 kg that its table makes stop, go on faster and come back does no work but that of its own
// kinetic energy and of the bar, which hardly moves without gravity.
TEST(PrescribedMotion, JumpsInItsSpeedAreTheWorkOfItsDrive) {
  const CaseRun run = run_driven(
      {"gravity=[0, 0, 0]", "analysis.end_time=0.8", "analysis.step=0.003",
       R"(sliding_joints[0].motion={"interpolation": "linear", "table": [[0, 0.5], [0.2000000000005, 0.9], [0.401, 0.9], [0.6, 1.7], [0.8, 1.3]]})"});
  EXPECT_EQ(run.code, 0) << run.messages;
  EXPECT_TRUE(run.says("the speed jump at the rows, by up to 6.02 m/s at 0.6 s")) << run.messages;
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

// --- Tables of motion

// Of 1 m to 3 m and back to rest in 2 s, and still after that.
double smooth_way(double t) {
  const double u = std::clamp(t / 2, 0.0, 1.0);
  return 1 + 2 * u * u * u * (10 - 15 * u + 6 * u * u);
}

std::string table_of(const std::function<double(double)>& way, double end, double apart) {
  std::ostringstream rows;
  rows.precision(13);
  for (int i = 0; i * apart < end + apart / 2; ++i)
    rows << (i > 0 ? ", [" : "[[") << i * apart << ", " << way(i * apart) << "]";
  return rows.str() + "]";
}

CaseRun run_on_rail(const std::string& parts, const std::string& table, const std::string& analysis,
                    const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("rail.json", R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "g", "rigid": true, "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] } }],
    "sliding_joints": [{ "body": "tr", "beam": "g", "at": { "length": 1 }, "motion": { "table": )" +
                                                   table + "} }], " + parts + R"(, "analysis": )" + analysis +
                                                   R"(, "output": { "every": 0.05, "report": false } })"),
                  overrides);
}

TEST(TableOfMotion, OfAParabolaNeedsTheForceOfItsAcceleration) {
  const std::string table = table_of([](double t) { return 1 + t * t; }, 2, 0.01);
  for (const char* analysis : {R"({"end_time": 1.9, "step": 0.005})", R"({"end_time": 1.9, "step": 0.013})",
                               R"({"end_time": 1.9, "integrator": {"type": "radau"}})"}) {
    const CaseRun run = run_on_rail(R"("bodies": [{ "name": "tr", "mass": 3 }])", table, analysis);
    ASSERT_EQ(run.code, 0) << run.messages;
    for (std::size_t i = 0; i < run.rows.size(); ++i) {
      EXPECT_NEAR(run.value(i, "tr.joint_force.x [N]"), 6, 2e-6) << analysis << " " << i;
      EXPECT_NEAR(run.value(i, "tr.holding_force [N]"), 6, 2e-6) << analysis << " " << i;
    }
  }
}

// A load that is dragged by still air, coupled to nothing: v = v0/(1 + c v0 t).
TEST(TableOfMotion, OfOneBodyDoesNotDisturbAnother) {
  const std::string parts = R"("air": { "density": 1.225 },
    "bodies": [{ "name": "load", "mass": 1, "position": [4, 1, 0], "velocity": [10, 0, 0], "drag_area": 1 },
               { "name": "tr", "mass": 1 }],
    "connectors": [{ "name": "none", "from": { "point": [0, 5, 0] }, "to": { "body": "load" }, "stiffness": 0 }])";
  const double c = 1.225 / 2, right = 4 + std::log1p(c * 10 * 2) / c;
  for (const char* join : {"smooth", "linear"}) {
    const CaseRun run = run_on_rail(parts, table_of(smooth_way, 2.1, 0.02), R"({"end_time": 2})",
                                    {std::string("sliding_joints[0].motion.interpolation=") + join});
    ASSERT_EQ(run.code, 0) << run.messages;
    EXPECT_NEAR(run.last("load.x [m]"), right, 2e-3) << join;
  }
}

const std::string pulled =
    R"("bodies": [{ "name": "tr", "mass": 3 }, { "name": "load", "mass": 2, "position": [4, 0, 0] }],
  "connectors": [{ "name": "s", "from": { "body": "tr" }, "to": { "body": "load" }, "stiffness": 50, "damping": 3,
                   "direction": [1, 0, 0] }])";

// m x'' = k (s + 3 - x) + c (s' - x'), by the classical Runge-Kutta method with steps of 1e-4 s.
double pulled_load(double t_end) {
  const auto rate = [](double t, double x, double v) {
    const double h = 1e-6, speed = (smooth_way(t + h) - smooth_way(t - h)) / (2 * h);
    return (50 * (smooth_way(t) + 3 - x) + 3 * (speed - v)) / 2;
  };
  double x = 4, v = 0;
  constexpr double h = 1e-4;
  for (int i = 0; i < std::lround(t_end / h); ++i) {
    const double t = i * h, a1 = rate(t, x, v), v2 = v + h / 2 * a1, a2 = rate(t + h / 2, x + h / 2 * v, v2),
                 v3 = v + h / 2 * a2, a3 = rate(t + h / 2, x + h / 2 * v2, v3), v4 = v + h * a3,
                 a4 = rate(t + h, x + h * v3, v4);
    x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
    v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
  return x;
}

TEST(TableOfMotion, LeavesRadauItsAccuracy) {
  EXPECT_NEAR(pulled_load(1), 4.915439, 1e-6);
  for (const auto& [analysis, apart, tolerance] :
       {std::tuple(R"({"end_time": 4, "step": 0.02, "integrator": {"type": "radau"}})", 0.005, 1e-6),
        std::tuple(R"({"end_time": 4, "tolerance": 1e-8, "integrator": {"type": "radau"}})", 0.005, 1e-6)}) {
    const CaseRun run = run_on_rail(pulled, table_of(smooth_way, 2.1, apart), analysis);
    ASSERT_EQ(run.code, 0) << analysis << run.messages;
    for (const int t : {1, 2, 3, 4})
      EXPECT_NEAR(run.value(20 * t, "load.x [m]"), pulled_load(t), tolerance) << analysis << t;
  }
}

TEST(TableOfMotion, TurnsAtTheEndOfItsBeam) {
  const CaseRun run = run_on_rail(R"("bodies": [{ "name": "tr", "mass": 3 }])", "[[0, 1], [1, 10], [1.5, 8]]",
                                  R"({"end_time": 2, "step": 0.01})");
  ASSERT_EQ(run.code, 0) << run.messages;
  for (std::size_t i = 0; i < run.rows.size(); ++i) EXPECT_LE(run.value(i, "tr.s [m]"), 10 + 1e-9);
  EXPECT_NEAR(run.last("tr.s [m]"), 8, 1e-9);
}

// A stout bar of 0.98 kg whose clamp goes at 1 m/s, and at 3 m/s from 0.1 s on.
TEST(TableOfMotion, OfASupportMayBeLinear) {
  const TemporaryDirectory directory;
  const auto file = directory.write("carried.json", R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0.1, 0, 0]] }, "section": { "radius": 0.02 },
                "material": { "density": 7800, "youngs_modulus": 2.1e11, "damping": 1e-4 }, "elements": { "count": 2 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped", "interpolation": "linear",
                   "motion": [[0, 0, 0, 0], [0.1, 0.1, 0, 0], [0.2, 0.4, 0, 0]] }],
    "analysis": { "end_time": 0.18, "step": 1e-5 }, "output": { "report": false, "every": 0.02 } })");
  const CaseRun fine = run_file(file);
  ASSERT_EQ(fine.code, 0) << fine.messages;
  EXPECT_TRUE(fine.says("speed jump at the rows, by up to 2 m/s at 0.1 s")) << fine.messages;
  const double mass = 7800 * M_PI * 0.02 * 0.02 * 0.1;
  EXPECT_NEAR(fine.last("energy.kinetic [J]"), mass * 9 / 2, 1e-6);
  // Steps that are longer than a wave takes along an element make a blow of any size.
  const CaseRun coarse = run_file(file, {"analysis.step=1e-4"});
  EXPECT_TRUE(coarse.code == 3 && coarse.says("take a shorter \"step\"")) << coarse.messages;
  EXPECT_EQ(run_file(file, {"analysis={\"type\": \"static\"}", "output={\"report\": false}"}).code, 0);
}

// A rope of 100 m and 30 kN whose end is drawn out at 0.1 m/s for 0.4 s.
TEST(TableOfMotion, OfASupportThatIsLinearPullsARopeWithItsWork) {
  const CaseRun run = run_text(R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [100, 0, 0]] }, "tension": "30 kN",
                "stress_free": "straight", "section": { "rope": { "diameter": "16 mm", "metallic_area": "110 mm^2" } },
                "material": { "density": 8200, "youngs_modulus": 1e11, "damping": 1e-4 }, "elements": { "count": 40 } }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" },
                 { "beam": "b", "at": "end", "type": "pinned", "interpolation": "linear",
                   "motion": [[0, 0, 0, 0], [0.2, 0, 0, 0], [0.6, 0.04, 0, 0], [1.2, 0.04, 0, 0]] }],
    "analysis": { "end_time": 1, "step": 1e-3, "initial": "equilibrium" },
    "output": { "report": false, "every": 0.2 } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  double most = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    most = std::max(most, std::abs(run.value(i, "energy.total [J]") - run.value(0, "energy.total [J]")));
  EXPECT_GT(run.last("energy.input [J]"), 1000);
  EXPECT_LT(most, 1e-3);  // of all less what has been put in
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
