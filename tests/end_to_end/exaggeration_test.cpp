// Displacements drawn larger than they are: in CAD files, and what that rests on, the drawn cubics of the
// elements.

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>
#include <string>

#include "nurbs/rational_cubic.h"
#include "pipelines/results/export_results.h"
#include "pipelines/results/results.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam::test {
namespace {

// A quarter of a circle, of rational elements, that a small force bends.
const char* const bow = R"({ "nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{ "name": "bow", "axis": { "arc": { "center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 0, 1],
      "normal": [0, -1, 0] } }, "section": { "radius": "10 mm" }, "material": "steel", "elements": { "count": 5 } }],
  "supports": [{ "beam": "bow", "at": "start", "type": "clamped" }],
  "loads": [{ "beam": "bow", "at": "end", "force": [10, 0, 0] }], "analysis": { "type": "static" } })";

TEST(Exaggeration, OfNothingIsTheDrawingAndOfOneTheRun) {
  const TemporaryDirectory directory;
  const std::filesystem::path case_file = directory.path() / "bow.json", out = directory.path() / "out";
  std::ofstream(case_file) << bow;
  std::ostringstream messages;
  ASSERT_EQ(
      run_command_line({"run", case_file.string(), "--quiet", "--out", out.string()}, messages, messages), 0)
      << messages.str();
  const auto [time, beams] = read_stored_beams(out, 0);
  ASSERT_EQ(beams.size(), 1u);
  const std::vector<ElementRecord>& elements = beams[0].elements;
  const std::vector<ElementRecord> none = exaggerated(elements, 0), thrice = exaggerated(elements, 3);
  double largest = 0;
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (const double u : {0.0, 0.25, 0.5, 0.9, 1.0}) {
      const Eigen::Vector3d drawn = RationalCubic(none[i].control_points).point(u);
      const Eigen::Vector3d now = RationalCubic(elements[i].control_points).point(u);
      EXPECT_NEAR(drawn.norm(), 1, 1e-12);  // the circle
      const Eigen::Vector3d shown = RationalCubic(thrice[i].control_points).point(u);
      EXPECT_LT((shown - drawn - 3 * (now - drawn)).norm(), 1e-12);
      largest = std::max(largest, (now - drawn).norm());
    }
  CaseRun run;
  read_histories(out / "histories.csv", run);
  const double displacement = run.last("bow.displacement.max [m]");
  EXPECT_GT(displacement, 1e-3);
  EXPECT_NEAR(largest, displacement, 1e-3 * displacement);
  const NurbsCurve circle =
      stored_curves(out, 0, CurveParameter::free, WholeConics::as_drawn, 0).second.at(0).curve;
  const KnotVector& knots = circle.knots();
  for (const double part : {0.0, 0.3, 0.7, 1.0})
    EXPECT_NEAR(circle.point(knots.start() + part * (knots.end() - knots.start())).norm(), 1, 1e-12);
}

TEST(Exaggeration, NeedsTheDrawing) {
  std::vector<ElementRecord> of_before(1);
  of_before[0].control_points.setOnes();
  EXPECT_EQ(exaggerated(of_before, 1).size(), 1u);
  EXPECT_THROW(exaggerated(of_before, 2), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam::test
