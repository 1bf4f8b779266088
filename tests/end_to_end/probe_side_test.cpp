// Probes where forces jump.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "nurbs/number_text.h"
#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

// A cantilever of 3 m along a direction, with a force across it at a place, one at its end, and a body of no
// weight.
CaseRun with_a_jump(const Eigen::Vector3d& along, const std::string& at, int elements) {
  const Eigen::Vector3d end = 3 * along.normalized(),
                        across = along.cross(Eigen::Vector3d(0.3, 0.2, 1)).normalized();
  const auto text = [](const Eigen::Vector3d& v) {
    return "[" + text_of(v.x(), all_digits) + ", " + text_of(v.y(), all_digits) + ", " +
           text_of(v.z(), all_digits) + "]";
  };
  const std::string probe = R"("beam": "b", "at": )" + at;
  return run_text(R"({ "nurbeam": 1, "gravity": [0, 0, 0],
    "beams": [{ "name": "b", "axis": { "polyline": [[0, 0, 0], )" +
                  text(end) + R"(] }, "section": { "radius": 0.02 },
                "material": { "density": 7800, "youngs_modulus": 2.1e11 }, "elements": { "count": )" +
                  std::to_string(elements) + R"( } }],
    "supports": [{ "beam": "b", "at": "start", "type": "clamped" }],
    "loads": [{ "beam": "b", "at": )" +
                  at + R"(, "force": )" + text(2 * across) + R"( },
              { "beam": "b", "at": "end", "force": )" +
                  text(across) + R"( }],
    "analysis": { "type": "static" },
    "output": { "report": false, "probes": [{ "name": "before", "side": "before", )" +
                  probe + R"( },
      { "name": "after", "side": "after", )" +
                  probe + R"( }, { "name": "as said", )" + probe + "}] } }");
}

// Shear of 3 N before the place and of 1 N after it, whatever round-off makes of the place.
TEST(SideOfAProbe, IsARuleWhereAForceStands) {
  for (const Eigen::Vector3d& along :
       {Eigen::Vector3d(1, 0, 0), {0.37, -0.61, 0.7}, {-1, 2, 0.1}, {0, -1, 0}})
    for (const char* at : {R"({"fraction": 0.3})", R"({"length": 1.0})", R"({"fraction": 0.5})"})
      for (const int elements : {1, 3, 4, 7}) {
        const CaseRun run = with_a_jump(along, at, elements);
        ASSERT_EQ(run.code, 0) << run.messages;
        EXPECT_NEAR(std::abs(run.last("before.shear_force [N]")), 3, 1e-4) << at << elements;
        EXPECT_NEAR(std::abs(run.last("after.shear_force [N]")), 1, 1e-4) << at << elements;
        EXPECT_EQ(run.last("as said.shear_force [N]"), run.last("after.shear_force [N]"));
        EXPECT_NEAR(run.last("before.moment [N m]"), run.last("after.moment [N m]"), 1e-6);
      }
}

}  // namespace
}  // namespace nurbeam::test
