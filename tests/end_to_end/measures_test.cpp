// Sags of the spans of a beam and its clearance over the ground, as a case file has them.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// A rope over an eyelet between two spans, of 60 and 40 m, above a slope.
const std::string ropeway = R"({ "nurbeam": 1, "gravity": [0, 0, -9.81],
  "beams": [{ "name": "rope", "axis": { "polyline": [[0, 0, 20], [60, 0, 24], [100, 0, 20]] }, "tension": 20000,
    "stress_free": "straight", "section": { "rope": { "diameter": "16 mm", "metallic_area": "110 mm^2" } },
    "material": { "density": 8200, "youngs_modulus": "100 GPa" }, "elements": { "count": 40 } }],
  "eyelets": [{ "name": "tower", "beam": "rope", "at": { "length": 60.13318552 } }],
  "supports": [{ "beam": "rope", "at": "start", "type": "pinned" },
               { "beam": "rope", "at": "end", "type": "pinned" }],
  "analysis": { "type": "static" },
  "output": { "report": false, "probes": [{ "name": "p", "beam": "rope", "at": { "length": 30.06659276 } }],
    "clearances": [{ "name": "ground", "beam": "rope",
                     "profile": { "polyline": [[-5, 0, 12], [50, 0, 14], [105, 0, 14]] } }] } })";

CaseRun run(const std::vector<std::string>& overrides = {}) {
  const TemporaryDirectory directory;
  return run_file(directory.write("ropeway.json", ropeway), overrides);
}

// Of a shallow span of length l under its own weight: w l^2/(8 H), with w over the chord.
TEST(Measures, OfARopewayAreThoseOfParabolas) {
  const CaseRun rope = run();
  ASSERT_EQ(rope.code, 0) << rope.messages;
  const double H = std::abs(rope.last("reaction.rope.start.fx [N]"));
  const double w = 8200 * 110e-6 * 9.81;
  for (const auto& [column, l] : {std::pair{"rope.sag_1 [m]", 60.0}, {"rope.sag_2 [m]", 40.0}}) {
    const double along = std::hypot(l, 4) / l;
    EXPECT_NEAR(rope.last(column), w * along * l * l / (8 * H), 3e-3 * rope.last(column)) << column;
  }
  // The lowest is the end, of 20 m over 14 m of ground; a rock under the first span is nearer.
  EXPECT_NEAR(rope.last("ground.clearance [m]"), 6, 1e-9);
  const CaseRun rock =
      run({"output.clearances[0].profile.polyline=[[-5,0,12],[29,0,12],[30,0,18],[31,0,12],[105,0,12]]"});
  EXPECT_NEAR(rock.last("ground.clearance [m]"), rock.last("p.z [m]") - 18, 1e-3);
}

TEST(Measures, MoveWithTheRope) {
  // The whole ground lies on a spline that is level: the clearance is the height of the lowest place.
  const CaseRun rope =
      run({R"(output.clearances[0].profile={"through": [[-5, 0, 3], [40, 0, 3], [105, 0, 3]]})",
           R"(loads=[{"beam": "rope", "at": {"length": 30.06659276}, "force": [0, 0, -3000]}])"});
  ASSERT_EQ(rope.code, 0) << rope.messages;
  EXPECT_NEAR(rope.last("ground.clearance [m]"), std::min(rope.last("p.z [m]"), 20.0) - 3, 1e-2);
  EXPECT_GT(rope.last("rope.sag_1 [m]"), 4 * rope.last("rope.sag_2 [m]"));
}

TEST(Measures, ThatCannotBeAreRefused) {
  const auto says = [](const std::string& change, const std::string& text) {
    const CaseRun refused = run({change});
    EXPECT_EQ(refused.code, 2) << change;
    EXPECT_TRUE(refused.says(text)) << refused.messages;
  };
  says(R"(output.clearances[0].beam="rop")", "did you mean \"rope\"?");
  says("gravity=[0, 0, 0]", "a clearance is measured along gravity");
  says(R"(output.clearances[0].profile={"file": "none.step"})", "there is no file");
  says(R"(output.clearances[0].profile={"polyline": [[0, 0, 0]]})", "output.clearances[0].profile.polyline");
  says(R"(output.clearances[0].name="p")", "output.clearances[0].name");
}

}  // namespace
}  // namespace nurbeam::test
