// Known answers of mechanics that no other test has as case files.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

CaseRun run_answer(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("case.json", text), overrides);
}

// Yang and Yau's bridge, level under a load that carries it, and 5750 kg on a spring over a massless wheel at
// 100 km/h.
const std::string sprung_mass = R"({
  "nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{ "name": "bridge", "axis": { "polyline": [[0, 0, 0], [25, 0, 0]] },
              "section": { "area": 1, "second_moment": 2.90 },
              "material": { "density": 2303, "youngs_modulus": "2.87 GPa" }, "elements": { "count": 30 } }],
  "supports": [{ "beam": "bridge", "at": "start", "type": "pinned" },
               { "beam": "bridge", "at": "end", "type": "guided", "direction": [1, 0, 0] }],
  "loads": [{ "beam": "bridge", "force_per_length": [0, 0, 22592.43] }],
  "bodies": [{ "name": "wheel", "mass": 1e-3 },
             { "name": "vehicle", "mass": 5750, "position": [0, 0, 2], "velocity": [27.77777777777778, 0, 0] }],
  "sliding_joints": [{ "body": "wheel", "beam": "bridge", "at": "start",
                       "motion": { "table": [[0, 0], [0.9, 25]] } }],
  "connectors": [
    { "name": "spring", "from": { "body": "wheel" }, "to": { "body": "vehicle" }, "direction": [0, 0, 1],
      "stiffness": "1595 kN/m", "length": 2.0353652037617555 },
    { "name": "pull", "from": { "body": "wheel" }, "to": { "body": "vehicle" }, "direction": [1, 0, 0],
      "type": "rod" }],
  "analysis": { "end_time": 0.89, "step": 2.5e-4 },
  "output": { "report": false, "every": 0.0025,
              "probes": [{ "name": "middle", "beam": "bridge", "at": { "length": 12.5 } }] }
})";

TEST(KnownAnswers, ASprungMassCrossesABridge) {
  const CaseRun run = run_answer(sprung_mass);
  ASSERT_EQ(run.code, 0) << run.messages;
  double least = 0, greatest = 0, deepest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double acceleration = -run.value(i, "spring.force [N]") / 5750 - 9.81;
    least = std::min(least, acceleration);
    greatest = std::max(greatest, acceleration);
    deepest = std::min(deepest, run.value(i, "middle.uz [m]"));
    if (std::abs(run.value(i, "time [s]") - 0.45) > 1e-9) continue;
    EXPECT_NEAR(run.value(i, "middle.uz [m]"), -2.01334e-3, 5e-6);
    EXPECT_NEAR(run.value(i, "vehicle.z [m]") - 2, -2.54628e-3, 5e-6);
  }
  EXPECT_NEAR(deepest, -2.40732e-3, 5e-6);
  EXPECT_NEAR(least, -0.142179, 5e-4);
  EXPECT_NEAR(greatest, 0.147966, 5e-4);
}

// 10 m under 2000 N, 0.5 kg/m: n pi c / L.
TEST(KnownAnswers, AStringHasTheNotesOfItsTension) {
  const TemporaryDirectory directory;
  const auto file = directory.write("case.json", R"({
    "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "string", "axis": { "polyline": [[0, 0, 0], [10, 0, 0]] }, "tension": 2000,
                "section": { "area": 1e-4, "second_moment": 1e-18 },
                "material": { "density": 5000, "youngs_modulus": 1e10 }, "elements": { "count": 20 },
                "torsion": false }],
    "supports": [{ "beam": "string", "at": "start", "type": "pinned" },
                 { "beam": "string", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "string", "at": { "length": 3 }, "force": [0, 0, 0] }],
    "analysis": { "type": "modes", "modes": { "count": 6 } }, "output": { "report": false } })");
  std::ostringstream out, err;
  const CapturedErrors errors;
  const auto results = directory.path() / "results";
  ASSERT_EQ(run_command_line({"run", file.string(), "--quiet", "--out", results.string()}, out, err), 0)
      << err.str() << errors.text();
  std::ifstream stream(results / "run.json");
  const auto run = nlohmann::json::parse(stream);
  std::vector<double> omegas;
  for (const auto& mode : run.at("modes"))
    omegas.push_back(2 * M_PI * mode.at("frequency [Hz]").get<double>());
  // In space each comes twice.
  for (const double omega : {19.869177, 39.738353, 59.607530})
    EXPECT_TRUE(std::any_of(omegas.begin(), omegas.end(), [&](double found) {
      return std::abs(found - omega) < 1e-5 * omega;
    })) << omega;
}

// Z1: 800 kg held at 30 m of a rope of 121 m over 120 m: its tension beside the body and at its ends.
TEST(KnownAnswers, ALoadedRopesTensions) {
  const CaseRun run = run_answer(R"({
    "nurbeam": 1, "gravity": [0, 0, -9.81],
    "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 0], [120, 0, 0]] }, "unstressed_length": 121,
                "section": { "area": 1e-4, "second_moment": 1e-18 }, "stress_free": "straight",
                "material": { "density": 25000, "youngs_modulus": 1.5e11 }, "elements": { "count": 96 } }],
    "bodies": [{ "name": "load", "mass": 800 }],
    "sliding_joints": [{ "body": "load", "beam": "rope", "at": { "fraction": 0.24793388429752067 },
                         "slope": "discontinuous", "equilibrium": "held" }],
    "supports": [{ "beam": "rope", "at": "start", "type": "pinned", "name": "left" },
                 { "beam": "rope", "at": "end", "type": "pinned", "name": "right" }],
    "analysis": { "type": "static" }, "output": { "report": false } })");
  ASSERT_EQ(run.code, 0) << run.messages;
  const double H = run.last("right.fx [N]");
  EXPECT_NEAR(H, 28077.985, 0.3);
  EXPECT_NEAR(std::hypot(H, run.last("left.fz [N]")), 29044.953, 0.3);
  EXPECT_NEAR(std::hypot(H, run.last("right.fz [N]")), 28281.104, 0.3);
  // Beside the body: less the rope's own weight between.
  const double per_s = 2.5 * 9.81 * 121 / 120, s = run.last("load.s [m]");
  const double left = std::hypot(H, run.last("left.fz [N]") - per_s * s),
               right = std::hypot(H, run.last("right.fz [N]") - per_s * (120 - s));
  EXPECT_NEAR(left, 28865.451, 0.3);
  EXPECT_NEAR(right, 28101.593, 0.3);
  EXPECT_NEAR(left - right, 763.858, 0.05);
}

}  // namespace
}  // namespace nurbeam::test
