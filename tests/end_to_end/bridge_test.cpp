// A sprung mass that crosses a bridge, as a case file.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// Yang and Yau's bridge, which is level in its own equilibrium: as if its weight were carried.
const std::string crossing = R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{ "name": "bridge", "axis": { "polyline": [[0, 0, 0], [25, 0, 0]] },
              "section": { "area": 1, "second_moment": 2.9 },
              "material": { "density": 2303, "youngs_modulus": "2.87 GPa" }, "elements": { "count": 30 } }],
  "supports": [{ "beam": "bridge", "at": "start", "type": "pinned" },
               { "beam": "bridge", "at": "end", "type": "guided", "direction": [1, 0, 0] }],
  "loads": [{ "beam": "bridge", "force_per_length": [0, 0, 22592.43] }],
  "bodies": [{ "name": "wheel", "mass": 1e-3 },
             { "name": "vehicle", "mass": 5750, "position": [0, 0, 2], "velocity": ["100 km/h", 0, 0] }],
  "sliding_joints": [{ "body": "wheel", "beam": "bridge", "at": "start", "motion": { "speed": "100 km/h" } }],
  "connectors": [
    { "name": "spring", "from": { "body": "wheel" }, "to": { "body": "vehicle" }, "direction": [0, 0, 1],
      "stiffness": "1595 kN/m", "force": -56407.5 },
    { "name": "along", "from": { "body": "wheel" }, "to": { "body": "vehicle" }, "direction": [1, 0, 0],
      "type": "rod", "length": 0 }],
  "analysis": { "end_time": 0.8997, "step": 7.5e-5 },
  "output": { "report": false, "every": 3e-4,
              "probes": [{ "name": "middle", "beam": "bridge", "at": { "fraction": 0.5 } }] } })";

// A node leaves the mesh a moment before the greatest acceleration; steps twice as long show that by 1e-5.
// The numbers are those of 60 modes of the bridge by Runge and Kutta, to 1e-11.
TEST(Bridge, SwingsUnderASprungMassAsItsModesDo) {
  const TemporaryDirectory directory;
  const CaseRun run = run_file(directory.write("bridge.json", crossing));
  ASSERT_EQ(run.code, 0) << run.messages;
  const auto at = [&](double time, const std::string& column) {
    const auto row = static_cast<std::size_t>(std::lround(time / 3e-4));
    EXPECT_NEAR(run.value(row, "time [s]"), time, 1e-12);
    return run.value(row, column);
  };
  EXPECT_NEAR(at(0.3711, "middle.z [m]"), -2.40732e-3, 5e-8);
  EXPECT_NEAR(at(0.45, "middle.z [m]"), -2.01334e-3, 5e-8);
  EXPECT_NEAR(at(0.45, "vehicle.z [m]"), 2 - 2.54628e-3, 5e-8);
  double least = 0, greatest = 0;
  for (std::size_t i = 0; i < run.rows.size(); ++i) {
    const double acceleration = -run.value(i, "spring.force [N]") / 5750 - 9.81;
    least = std::min(least, acceleration);
    greatest = std::max(greatest, acceleration);
  }
  EXPECT_NEAR(least, -0.142179, 1e-5);
  EXPECT_NEAR(greatest, 0.147966, 1e-5);
}

}  // namespace
}  // namespace nurbeam::test
