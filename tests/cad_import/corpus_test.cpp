#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "cad_import/import_curves.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {
namespace {

// What must come out of a file. The lengths are those OpenCASCADE's own integration gives for its own curves,
// to the digits that were recorded; the counts were taken with read.iges.bspline.continuity = 0.
struct Expected {
  std::string file;
  std::string unit;
  int curves;
  int free;
  std::map<std::string, int> entities;
  int highest_degree;
  double length_mm;
  std::vector<std::string> diagnostics = {};  // part of each message, in order
  std::vector<double> pipe_radii_mm = {};     // of the centre lines, which are not among the curves above
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.file; }

const std::vector<Expected> manifest{
    {"igesio-sample-curves.igs",
     "mm",
     10,
     10,
     {{"bspline", 3}, {"circle", 4}, {"ellipse", 1}, {"line", 2}},
     3,
     61.8362783,
     {"D3 Line: skipped with all that is made of it: it is an infinite line",
      "D7 Line: skipped with all that is made "
      "of it: it is a ray",
      "D33 CopiousData: its form, 1 to 3, is that of points"}},
    {"pyiges-example-arcs.iges", "mm", 3, 3, {{"bspline", 1}, {"circle", 1}, {"ellipse", 1}}, 6, 1006.894770},
    {"iges-102-composite.igs",
     "inch",
     3,
     3,
     {{"bspline", 1}, {"circle", 1}, {"line", 1}},
     3,
     53.361324,
     {"model space scale 3 (drawing scale)"}},
    {"iges-104-conics.igs",
     "inch",
     9,
     9,
     {{"ellipse", 1}, {"hyperbola", 1}, {"line", 6}, {"parabola", 1}},
     2,
     425.1027612115230},
    {"iges-112-parametric-spline.igs", "inch", 1, 1, {{"bspline", 1}}, 3, 91.357338},
    {"iges-126-bsplines.igs",
     "inch",
     2,
     2,
     {{"bspline", 2}},
     3,
     5615.395610,
     {"model space scale 10 (drawing scale)"}},
    {"iges-124-transform.igs", "inch", 4, 4, {{"line", 4}}, 1, 70.261236},
    {"dealii-line.iges", "inch", 1, 1, {{"bspline", 1}}, 3, 3.357520},
    {"dealii-line.step", "mm", 1, 1, {{"bspline", 1}}, 3, 3.357520},
    {"inventor-issue153.stp", "m", 76, 0, {{"bspline", 16}, {"line", 60}}, 3, 14563.811500},
    {"parastell-magnet.step", "mm", 32, 0, {{"bspline", 32}}, 3, 28463.189900},
    {"ideas-dm1.stp", "inch", 93, 0, {{"bspline", 93}}, 2, 2576.061870},
    {"rhino-sliced-cylinder.step", "cm", 9, 0, {{"bspline", 7}, {"circle", 2}}, 3, 1376.947590},
    {"pygem-pipe.step", "mm", 18, 0, {{"bspline", 18}}, 2, 105132.741000, {}, {1000}}};

class CorpusFile : public ::testing::TestWithParam<Expected> {};

TEST_P(CorpusFile, GivesTheCurvesOfTheManifest) {
  const Expected& expected = GetParam();
  const ImportReport report = import_curves(corpus_file(expected.file));
  EXPECT_TRUE(report.ok());
  EXPECT_EQ(report.unit, expected.unit);
  std::map<std::string, int> entities;
  int free = 0;
  int highest_degree = 0;
  double length_mm = 0;
  std::vector<double> pipe_radii_mm;
  for (const ImportedCurve& curve : report.curves) {
    if (curve.is_centre_line()) {
      pipe_radii_mm.push_back(1000 * curve.pipe_radius);
      continue;
    }
    ++entities[curve.entity];
    free += curve.free;
    highest_degree = std::max(highest_degree, curve.curve.degree());
    length_mm += 1000 * length(curve.curve);
    EXPECT_TRUE(curve.exact);
    EXPECT_EQ(curve.deviation, 0);
  }
  EXPECT_EQ(static_cast<int>(report.curves.size() - pipe_radii_mm.size()), expected.curves);
  EXPECT_EQ(free, expected.free);
  EXPECT_EQ(entities, expected.entities);
  EXPECT_EQ(highest_degree, expected.highest_degree);
  // The recorded lengths have six decimals or nine digits.
  EXPECT_NEAR(length_mm, expected.length_mm, std::max(1e-8 * expected.length_mm, 6e-7));
  ASSERT_EQ(pipe_radii_mm.size(), expected.pipe_radii_mm.size());
  for (std::size_t i = 0; i < pipe_radii_mm.size(); ++i)
    EXPECT_NEAR(pipe_radii_mm[i], expected.pipe_radii_mm[i], 1e-6 * expected.pipe_radii_mm[i]);
  ASSERT_EQ(report.diagnostics.size(), expected.diagnostics.size());
  for (std::size_t i = 0; i < report.diagnostics.size(); ++i) {
    const Diagnostic& d = report.diagnostics[i];
    EXPECT_NE((d.where + ": " + d.message).find(expected.diagnostics[i]), std::string::npos) << d.message;
  }
}

TEST_P(CorpusFile, GivesTheSameReportTwice) {
  const ImportReport a = import_curves(corpus_file(GetParam().file));
  const ImportReport b = import_curves(corpus_file(GetParam().file));
  ASSERT_EQ(a.curves.size(), b.curves.size());
  for (std::size_t i = 0; i < a.curves.size(); ++i) {
    EXPECT_EQ(a.curves[i].name, b.curves[i].name);
    EXPECT_EQ(a.curves[i].curve.knots(), b.curves[i].curve.knots());
    EXPECT_EQ(a.curves[i].curve.control_points(), b.curves[i].curve.control_points());
  }
}

TEST_P(CorpusFile, HasClampedCurvesOnly) {
  for (const ImportedCurve& curve : import_curves(corpus_file(GetParam().file)).curves) {
    const KnotVector& knots = curve.curve.knots();
    EXPECT_EQ(knots.multiplicity(knots.start()), knots.degree() + 1);
    EXPECT_EQ(knots.multiplicity(knots.end()), knots.degree() + 1);
  }
}

INSTANTIATE_TEST_SUITE_P(All, CorpusFile, ::testing::ValuesIn(manifest), [](const auto& test) {
  std::string name = test.param.file;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(Corpus, HasNoFileThatTheManifestDoesNotKnow) {
  std::set<std::string> known{"README.md", ".gitattributes", "kinds"};
  for (const Expected& expected : manifest) known.insert(expected.file);
  for (const auto& entry : std::filesystem::directory_iterator(corpus_file("")))
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
}

TEST(Corpus, AnEdgeSharedByTwoFacesComesOnce) {
  std::set<std::vector<long>> places;
  const ImportReport report = import_curves(corpus_file("inventor-issue153.stp"));
  for (const ImportedCurve& curve : report.curves) {
    const KnotVector& knots = curve.curve.knots();
    const Eigen::Vector3d middle = curve.curve.point((knots.start() + knots.end()) / 2);
    places.insert(
        {std::lround(middle.x() * 1e7), std::lround(middle.y() * 1e7), std::lround(middle.z() * 1e7)});
  }
  EXPECT_EQ(places.size(), report.curves.size());
}

TEST(Corpus, TheSameCurveInIgesInchesAndStepMillimetresAgrees) {
  const ImportReport iges = import_curves(corpus_file("dealii-line.iges"));
  const ImportReport step = import_curves(corpus_file("dealii-line.step"));
  ASSERT_EQ(iges.curves.size(), 1U);
  ASSERT_EQ(step.curves.size(), 1U);
  // The IGES file has six decimals of an inch.
  const auto difference = iges.curves[0].curve.control_points() - step.curves[0].curve.control_points();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Corpus, TransformedLinesOfAnIgesFileLieWhereTheMatrixPutsThem) {
  const ImportReport report = import_curves(corpus_file("iges-124-transform.igs"));
  ASSERT_EQ(report.curves.size(), 4U);
  // All four lines are in the plane that the matrix shifts to (4.5, 9, 0) inches.
  const NurbsCurve& first = report.curves[0].curve;
  EXPECT_LT((first.point(first.knots().start()) - 0.0254 * Eigen::Vector3d(4.5, 9, 0)).norm(), 1e-12);
  EXPECT_LT((first.point(first.knots().end()) - 0.0254 * Eigen::Vector3d(3.5, 9, 0)).norm(), 1e-12);
}

TEST(Corpus, PartsOfAnIgesCompositeCurveComeInARow) {
  const ImportReport report = import_curves(corpus_file("iges-102-composite.igs"));
  ASSERT_EQ(report.curves.size(), 3U);
  for (std::size_t i = 1; i < report.curves.size(); ++i) {
    const NurbsCurve& before = report.curves[i - 1].curve;
    const NurbsCurve& after = report.curves[i].curve;
    EXPECT_LT((before.point(before.knots().end()) - after.point(after.knots().start())).norm(), 1e-9);
  }
}

TEST(Corpus, AHyperbolaThatOpenCascadeCannotReadIsThatOfItsEquation) {
  const ImportReport report = import_curves(corpus_file("iges-104-conics.igs"));
  EXPECT_TRUE(report.diagnostics.empty());
  const auto found = std::find_if(report.curves.begin(), report.curves.end(),
                                  [](const ImportedCurve& curve) { return curve.entity == "hyperbola"; });
  ASSERT_NE(found, report.curves.end());
  constexpr double inch = 0.0254;
  // D29: -0.49 x^2 + 1.96 y^2 + 0.9603999 = 0, turned by D27 so that x goes down: world = (y + 1.0895, 2.7301
  // - x). Its ends have four digits, which is how far the whole can be off.
  const Eigen::Vector3d start = found->curve.point(found->curve.knots().start()) / inch;
  EXPECT_LE((start - Eigen::Vector3d(-0.7 + 1.0895, 2.7301 - 1.9799, 0)).norm(), 1e-12);
  const Eigen::Vector3d end = found->curve.point(found->curve.knots().end()) / inch;
  EXPECT_LE((end - Eigen::Vector3d(0.7 + 1.0895, 2.7301 - 1.9799, 0)).norm(), 1e-12);
  for (double u = 0; u <= 1; u += 0.0625) {
    const Eigen::Vector3d p = found->curve.point(u) / inch;
    const double x = 2.7301 - p.y(), y = p.x() - 1.0895;
    EXPECT_NEAR(-0.49 * x * x + 1.96 * y * y + 0.9603999, 0, 1e-4);
    EXPECT_GT(x, 1.39);  // on the branch of its ends
  }
}

TEST(Corpus, ImportedCirclesHaveTheirRadiusToRoundOff) {
  const ImportReport report = import_curves(corpus_file("igesio-sample-curves.igs"));
  const NurbsCurve& circle = report.curves[2].curve;
  ASSERT_EQ(report.curves[2].entity, "circle");
  const double radius = 1e-3;
  const Eigen::Vector3d centre(-1.25e-3, 0, 0);
  const double first = circle.knots().start();
  const double last = circle.knots().end();
  for (int i = 0; i <= 1000; ++i) {
    const double u = first + (last - first) * i / 1000;
    EXPECT_NEAR((circle.point(u) - centre).norm(), radius, 3e-15 * radius);
  }
}

}  // namespace
}  // namespace nurbeam
