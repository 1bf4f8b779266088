#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::of_pipe_bends {
namespace {

using std::numbers::pi;

// A quarter of an elbow, 219.1 x 6.3 mm bent to 305 mm, clamped at its start, under a moment at its end.
std::string elbow(const std::string& moment, const std::string& torsion) {
  return R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "e", "axis": { "arc": { "center": [0, 0, 0], "start": [0.305, 0, 0],
        "end": [0, 0.305, 0], "normal": [0, 0, 1] } }, "torsion": )" +
         torsion + R"(,
      "section": { "radius": 0.10955, "bore": 0.10325, "bends": "flexible" },
      "material": { "density": 7850, "youngs_modulus": 2e11, "poissons_ratio": 0.3 }, "elements": { "count": 8 } }],
    "supports": [{ "beam": "e", "at": "start", "type": "clamped" }],
    "loads": [{ "beam": "e", "at": "end", "moment": )" +
         moment + R"( }], "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "p", "beam": "e", "at": "end" }] } })";
}

constexpr double R = 0.305, t = 0.0063, r = 0.1064, h = t * R / (r * r), k = 1.65 / h, M = 100;
const double I = pi / 4 * (std::pow(0.10955, 4) - std::pow(0.10325, 4)), EI = 2e11 * I;

test::CaseRun run(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const test::TemporaryDirectory directory;
  const test::CaseRun result = test::run_file(directory.write("case.json", text), overrides);
  EXPECT_EQ(result.code, 0) << result.messages;
  return result;
}

// A moment in the plane turns each section by k M s/EI: ux = -k M R^2 (pi/2 - 1)/EI, uy = -k M R^2/EI.
TEST(PipeBends, InTheirPlaneAreSofterByTheFlexibilityFactor) {
  EXPECT_NEAR(k, 9.72, 0.01);
  for (const char* torsion : {"false", "true"}) {
    const test::CaseRun found = run(elbow("[0, 0, 100]", torsion));
    const double unit = M * R * R / EI;
    EXPECT_NEAR(found.last("p.ux [m]"), -k * unit * (pi / 2 - 1), 2e-3 * k * unit) << torsion;
    EXPECT_NEAR(found.last("p.uy [m]"), -k * unit, 2e-3 * k * unit) << torsion;
    const double stress = 0.9 / std::pow(h, 2. / 3) * M * 0.10955 / I;
    EXPECT_NEAR(std::abs(found.last("e.stress.max [Pa]")), stress, 2e-3 * stress) << torsion;
  }
}

// A moment about x at the end (0, R): at the angle a from the start it bends by cos(a) about the radius and
// twists by -sin(a); only the bending is softer. uz is the sum of both turns times their arms to the end.
TEST(PipeBends, OutOfTheirPlaneAreSofterInBendingAlone) {
  const test::CaseRun found = run(elbow("[100, 0, 0]", "true"));
  const double GJ = 2e11 / 2.6 * 2 * I;
  const double uz = M * R * R * (k / EI * pi / 4 + (pi / 4 - 1) / GJ);
  EXPECT_NEAR(found.last("p.uz [m]"), uz, 2e-3 * uz);
}

TEST(PipeBends, AreRefusedForSectionsWithoutABore) {
  const test::TemporaryDirectory directory;
  std::string solid = elbow("[0, 0, 100]", "true");
  solid.replace(solid.find("\"bore\": 0.10325, "), 17, "");
  const test::CaseRun found = test::run_file(directory.write("case.json", solid));
  EXPECT_EQ(found.code, 2);
  EXPECT_TRUE(found.says("beams[0].section.bends")) << found.messages;
}

// Straight parts stay as they are: a straight pipe says nothing and bends the same.
TEST(PipeBends, LeaveStraightPartsAlone) {
  std::string straight = elbow("[0, 0, 100]", "true");
  const std::string arc = R"({ "arc": { "center": [0, 0, 0], "start": [0.305, 0, 0],
        "end": [0, 0.305, 0], "normal": [0, 0, 1] } })";
  straight.replace(straight.find(arc), arc.size(), R"({ "polyline": [[0, 0, 0], [2, 0, 0]] })");
  const test::CaseRun with = run(straight), without = run(straight, {"beams[0].section.bends=\"stiff\""});
  EXPECT_EQ(with.last("p.uy [m]"), without.last("p.uy [m]"));
}

}  // namespace
}  // namespace nurbeam::of_pipe_bends
