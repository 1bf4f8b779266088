// Every curve of every file of the corpus: import, decomposition, elements, export of the undeformed beam,
// and import again.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <tuple>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"
#include "pipelines/results/export_results.h"
#include "tests/convergence/run_model.h"
#include "tests/pipelines/case_text.h"
#include "tests/support/models.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

constexpr double approximation = 1e-6;  // asked for above degree 3 [m]

std::filesystem::path corpus() { return test::source_directory() / "tests/corpus"; }

std::vector<std::string> corpus_files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(corpus()))
    if (!std::set<std::string>{"README.md", ".gitattributes", "kinds"}.contains(entry.path().filename()))
      names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

// The curve of a beam of these cubics with about three elements to a segment, before anything moves it;
// corners are hinges.
NurbsCurve undeformed_beam(const BezierPath& path) {
  const int segments = static_cast<int>(path.segments.size());
  BeamModel model =
      testing::one_beam(path.segments, 3, testing::round_bar(1e-3, 7800, 200e9), 3 * segments, {});
  model.gravity.setZero();
  Beam& beam = model.beams[0];
  for (const Corner& corner : path.corners(1e-4))
    for (HomeNode& node : beam.home)
      if (node.s == beam.curve.breaks()[corner.after_segment + 1]) node.kind = NodeKind::hinge;
  return deformed_curve(testing::run_model(model, {0}, 1e-6).frames.at(0).beams.at(0).elements);
}

void expect_lowest_form(const std::string& entity, const NurbsCurve& was, const NurbsCurve& curve) {
  if (was.degree() == 2 && is_closed(was, 1e-9 * length(was))) {
    // A whole conic comes back as drawn.
    EXPECT_EQ(curve.degree(), 2);
    ASSERT_EQ(curve.control_points().cols(), was.control_points().cols());
    EXPECT_LE((curve.control_points().colwise().hnormalized() - was.control_points().colwise().hnormalized())
                  .norm(),
              1e-12 * length(was));
    return;
  }
  EXPECT_LE(curve.control_points().cols(), was.control_points().cols());
  EXPECT_LE(curve.degree(), was.degree());
  if (entity == "line") {
    EXPECT_EQ(curve.degree(), 1);
    EXPECT_EQ(curve.control_points().cols(), 2);
  }
  if (std::set<std::string>{"circle", "ellipse", "parabola", "hyperbola"}.contains(entity)) {
    EXPECT_EQ(curve.degree(), 2);
    EXPECT_LE(curve.control_points().cols(), 4);
  }
}

class CorpusWalk : public ::testing::TestWithParam<std::string> {};

TEST_P(CorpusWalk, ReturnsEveryCurveWhereItWas) {
  const ImportReport source = import_curves(corpus() / GetParam());
  ASSERT_FALSE(source.curves.empty());
  std::vector<NamedCurve> beams;
  for (const ImportedCurve& curve : source.curves)
    beams.push_back({curve.name, undeformed_beam(BezierPath::from_nurbs(curve.curve, approximation))});

  const test::TemporaryDirectory directory;
  for (const auto& [name, unit, unit_name] : {std::tuple{"back.step", LengthUnit::millimetre, "mm"},
                                              {"back.igs", LengthUnit::inch, "inch"},
                                              {"back_in_metres.igs", LengthUnit::metre, "m"}}) {
    ASSERT_TRUE(export_curves(directory.path() / name, beams, unit).empty());
    const ImportReport back = import_curves(directory.path() / name);
    ASSERT_EQ(back.curves.size(), source.curves.size());
    EXPECT_TRUE(back.diagnostics.empty());
    EXPECT_EQ(back.unit, unit_name);
    for (std::size_t i = 0; i < back.curves.size(); ++i) {
      SCOPED_TRACE(std::string(name) + ", curve " + std::to_string(i + 1));
      const NurbsCurve& was = source.curves[i].curve;
      const double size = length(was);
      const double allowed = was.degree() <= 3 ? 1e-12 * size : approximation;
      EXPECT_EQ(back.curves[i].name, source.curves[i].name);
      const BezierPath path = BezierPath::from_nurbs(back.curves[i].curve, approximation);
      const auto on_source = [&](double t) {
        return was.point(was.knots().start() + t * (was.knots().end() - was.knots().start()));
      };
      EXPECT_LT(largest_distance(on_source, path.segments), allowed);
      if (was.degree() > 3) continue;
      EXPECT_NEAR(length(back.curves[i].curve), size, allowed);
      EXPECT_LT(hausdorff_distance(path.segments, BezierPath::from_nurbs(was, approximation).segments),
                allowed);
      expect_lowest_form(source.curves[i].entity, was, back.curves[i].curve);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, CorpusWalk, ::testing::ValuesIn(corpus_files()), [](const auto& test) {
  std::string name = test.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

}  // namespace
}  // namespace nurbeam
