// Axial laws of beams and connectors in cases: closed forms, notes and messages.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

const std::string hooke = R"(beams[0].material.law="hooke")";

CaseRun run(const std::string& text, std::vector<std::string> overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("law.json", text), overrides);
}

// A bar of 1 m and EA = 100 N, with half of it at its lower end.
const std::string bar = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0, 0, -1]] },
              "section": { "area": 1e-4, "second_moment": 1e-12 },
              "material": { "density": 1000, "youngs_modulus": 1e6 }, "elements": { "count": 10 } }],
  "supports": [{ "beam": "b", "at": "start", "type": "pinned", "name": "A" }],
  "loads": [{ "beam": "b", "at": "end", "force": [0, 0, -50] }],
  "analysis": { "type": "static" },
  "output": { "probes": [{ "name": "tip", "beam": "b", "at": "end" }], "report": false } })";

TEST(AxialLaw, OfABarIsTheChosenOneAndWithoutOneANoteSaysHowFarLawsDiffer) {
  const CaseRun green = run(bar);
  EXPECT_NEAR(green.last("tip.z [m]"), -1.324718, 1e-6);  // L (L^2 - 1)/2 = 1/2
  EXPECT_TRUE(green.says("stretched by 32.5 %")) << green.messages;
  EXPECT_TRUE(green.says("is 50 N by Green's law")) << green.messages;
  EXPECT_TRUE(green.says("32.47 N by Hooke's")) << green.messages;
  const CaseRun said = run(bar, {R"(beams[0].material.law="green")"});
  EXPECT_EQ(said.last("tip.z [m]"), green.last("tip.z [m]"));
  EXPECT_FALSE(said.says("Hooke")) << said.messages;
  const CaseRun engineering = run(bar, {hooke});
  EXPECT_NEAR(engineering.last("tip.z [m]"), -1.5, 1e-9);
  EXPECT_FALSE(engineering.says("Green")) << engineering.messages;
  EXPECT_NEAR(engineering.last("A.fz [N]"), 50, 1e-9);
}

TEST(AxialLaw, OfRowsGoesThroughThem) {
  const std::string rows = "beams[0].material.law=[[-0.5, -20], [0, 0], [0.1, 30], [0.4, 50], [1, 200]]";
  EXPECT_NEAR(run(bar, {rows}).last("tip.z [m]"), -1.4, 1e-8);
  EXPECT_NEAR(run(bar, {rows, "loads[0].force=[0, 0, -30]"}).last("tip.z [m]"), -1.1, 1e-8);
}

TEST(AxialLaw, HoldsWithAnUnstressedLengthATensionAndTorsion) {
  // Unstressed 0.8 m, so that EA (l/0.8 - 1) = 50.
  EXPECT_NEAR(run(bar, {hooke, "beams[0].unstressed_length=0.8"}).last("tip.z [m]"), -1.2, 1e-8);
  // Drawn under 25 N: unstressed 0.8 m.
  EXPECT_NEAR(run(bar, {hooke, "beams[0].tension=25"}).last("tip.z [m]"), -1.2, 1e-8);
  EXPECT_NEAR(run(bar, {hooke, "beams[0].tension=25", "loads[0].force=[0, 0, -25]"}).last("tip.z [m]"), -1,
              1e-8);
  EXPECT_NEAR(run(bar, {hooke, "beams[0].torsion=true"}).last("tip.z [m]"), -1.5, 1e-8);
}

// A webbing of 18 m between anchors 18.9 m apart, EA = 20 kN, with 800 N in the middle: by symmetry
// N = EA (l/9 - 1) and 2 N f/l = 800 with l^2 = 9.45^2 + f^2.
TEST(AxialLaw, OfASlacklineIsHookes) {
  const std::string line = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [18.9, 0, 0]] },
                "section": { "area": 6e-5, "second_moment": 1e-14 },
                "material": { "density": 1, "youngs_modulus": 333333333.3333333 }, "elements": { "count": 20 },
                "unstressed_length": 18.0 }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned" }, { "beam": "b", "at": "end", "type": "pinned" }],
    "loads": [{ "beam": "b", "at": { "fraction": 0.5 }, "force": [0, 0, -800] }],
    "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "m", "beam": "b", "at": { "fraction": 0.5 } },
                                            { "name": "q", "beam": "b", "at": { "fraction": 0.25 } }] } })";
  double f = 2;
  for (int i = 0; i < 200; ++i) {
    const double l = std::hypot(9.45, f), N = 2e4 * (l / 9 - 1);
    f = (f + 800 * l / (2 * N)) / 2;
  }
  const double N = 2e4 * (std::hypot(9.45, f) / 9 - 1);
  EXPECT_NEAR(f, 2.365, 1e-3);
  const CaseRun run_of = run(line, {hooke});
  EXPECT_NEAR(run_of.last("m.z [m]"), -f, 2e-2 * f);
  EXPECT_NEAR(run_of.last("q.axial_force [N]"), N, 1e-2 * N);
}

// A bungee of 20 m and EA = 1.5 kN without much mass of its own: m g (l + x) = EA x^2/(2 l).
TEST(AxialLaw, OfABungeeLetsItFallAsFarAsItsEnergySays) {
  const std::string fall = R"({ "nurbeam": 1,
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], [0, 0, -20]] },
                "section": { "area": 1e-4, "second_moment": 1e-13 },
                "material": { "density": 10, "youngs_modulus": 15e6, "law": "hooke" }, "elements": { "count": 20 },
                "stress_free": "straight" }],
    "bodies": [{ "name": "j", "mass": 75 }],
    "supports": [{ "beam": "b", "at": "start", "type": "pinned", "name": "A" }],
    "sliding_joints": [{ "body": "j", "beam": "b", "at": { "length": 20 }, "at_beam_end": "stop",
                         "motion": { "table": [[0, 20], [100, 20]] } }],
    "analysis": { "end_time": 4, "tolerance": 1e-5 }, "output": { "every": 0.02, "report": false } })";
  const CaseRun done = run(fall);
  EXPECT_EQ(done.code, 0) << done.messages;
  double least = 0, pull = 0;
  for (std::size_t i = 0; i < done.rows.size(); ++i) {
    least = std::min(least, done.value(i, "j.z [m]"));
    pull = std::max(pull, done.value(i, "A.fz [N]"));
  }
  // From rest at its full length: EA x^2/(2 l) = m g x.
  const double x = 2 * 75 * 9.81 * 20 / 1500;
  EXPECT_NEAR(least, -20 - x, 2e-3 * (20 + x));
  EXPECT_NEAR(pull, 1500 * x / 20, 2e-2 * 1500 * x / 20);
}

TEST(AxialLaw, OfAConnectorMayBeRows) {
  const std::string hung = R"({ "nurbeam": 1, "gravity": [0, 0, -10],
    "beams": [{ "name": "g", "rigid": true, "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] } }],
    "bodies": [{ "name": "load", "mass": 3, "position": [0, 0, -1] }],
    "connectors": [{ "name": "c", "from": { "point": [0, 0, 0] }, "to": { "body": "load" }, "length": 1,
                     "stiffness": [[-1, -5], [0, 0], [0.1, 30], [0.5, 40]] }],
    "analysis": { "type": "static" }, "output": { "report": false } })";
  EXPECT_NEAR(run(hung).last("load.z [m]"), -1.1, 1e-9);
  EXPECT_NEAR(run(hung, {"bodies[0].mass=4"}).last("load.z [m]"), -1.5, 1e-9);
  EXPECT_NEAR(run(hung, {"bodies[0].mass=4", R"(connectors[0].type="tension-only")"}).last("load.z [m]"),
              -1.5, 1e-9);
  // It swings up and down with the energy of its rows.
  const CaseRun moving = run(hung, {R"(analysis={"end_time": 2, "step": 1e-3})"});
  EXPECT_NEAR(moving.last("energy.total [J]"), moving.value(0, "energy.total [J]"), 1e-3);
  // Its length for a force at the start.
  const CaseRun asked =
      run(hung, {"bodies[0].mass=3", "connectors[0].length=null", "connectors[0].force=30"});
  EXPECT_EQ(asked.code, 0) << asked.messages;
  EXPECT_NEAR(asked.last("c.force [N]"), 30, 1e-8);
}

TEST(AxialLaw, SaysWhatIsWrongWithIt) {
  const auto says = [](const std::string& value, const std::string& expected) {
    const CaseRun refused = run(bar, {"beams[0].material.law=" + value});
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(refused.says(expected)) << refused.messages;
  };
  says(R"("hook")", "\"hooke\"");
  says("[[0, 0], [0.1, 5], [0.2, 4]]", "must be greater than in the row before");
  says("[[0, 0]]", "two rows");
  says("[[0, 3], [0.1, 5]]", "has a force of 3 N where the stretch is 0");
  says("[[-1, -4], [0, 0]]", "at -1 a beam has no length");
  const CaseRun papers =
      run(bar, {hooke, R"(beams[0].form="virtual-work")", R"(beams[0].weights="constant")"});
  EXPECT_EQ(papers.code, 2);
  EXPECT_TRUE(papers.says("beams[0].material.law")) << papers.messages;
  const CaseRun buckles = run(bar, {hooke, "analysis.type=buckling"});
  EXPECT_EQ(buckles.code, 2);
  EXPECT_TRUE(buckles.says("beams[0].material.law")) << buckles.messages;
}

}  // namespace
}  // namespace nurbeam::test
