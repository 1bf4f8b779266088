#include "cad_import/export_curves.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "cad_import/import_curves.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/uneven_circle.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;

struct Target {
  std::string extension;
  LengthUnit unit;
  std::string unit_name;
};

void PrintTo(const Target& target, std::ostream* out) {
  *out << target.extension << " in " << target.unit_name;
}

const std::vector<Target> targets{
    {".step", LengthUnit::metre, "m"},       {".stp", LengthUnit::millimetre, "mm"},
    {".step", LengthUnit::inch, "inch"},     {".igs", LengthUnit::metre, "m"},
    {".iges", LengthUnit::millimetre, "mm"}, {".igs", LengthUnit::inch, "inch"}};

// All curves of the corpus up to degree 3, each under a name of its own.
std::vector<NamedCurve> corpus_curves() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(corpus_file(""))) {
    const std::string extension = entry.path().extension().string();
    if (extension.starts_with(".s") || extension.starts_with(".i")) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<NamedCurve> curves;
  for (const fs::path& file : files) {
    for (const ImportedCurve& curve : import_curves(file).curves) {
      const std::string name = file.stem().string() + " " + std::to_string(curves.size());
      if (curve.curve.degree() <= 3) curves.push_back({name, curve.curve});
    }
  }
  return curves;
}

NurbsCurve quarter_circle(double radius) {
  Eigen::Matrix3Xd points(3, 3);
  points << radius, radius, 0, 0, radius, radius, 1, 1, 1;
  return make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), points, Eigen::Vector3d(1, std::sqrt(0.5), 1));
}

int entries(const fs::path& directory) {
  return static_cast<int>(std::distance(fs::directory_iterator(directory), {}));
}

class RoundTrip : public ::testing::TestWithParam<Target> {};

TEST_P(RoundTrip, GivesEveryCubicOfTheCorpusBackUnderItsName) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / ("curves" + GetParam().extension);
  const std::vector<NamedCurve> written = corpus_curves();
  ASSERT_GT(written.size(), 250U);
  ASSERT_TRUE(export_curves(file, written, GetParam().unit).empty());
  const ImportReport report = import_curves(file);
  EXPECT_TRUE(report.diagnostics.empty());
  EXPECT_EQ(report.unit, GetParam().unit_name);
  ASSERT_EQ(report.curves.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    const NurbsCurve& before = written[i].curve;
    const NurbsCurve& after = report.curves[i].curve;
    EXPECT_EQ(report.curves[i].name, written[i].name);
    EXPECT_EQ(after.knots(), before.knots());
    ASSERT_EQ(after.control_points().cols(), before.control_points().cols());
    const double size = before.control_points().cwiseAbs().maxCoeff();
    EXPECT_LE((after.control_points() - before.control_points()).cwiseAbs().maxCoeff(), 1e-15 * size)
        << written[i].name;
  }
}

TEST_P(RoundTrip, KeepsNamesWithQuotesAndForeignLetters) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / ("curves" + GetParam().extension);
  const std::vector<std::string> names{"O'Brien \\ \"cable\"",
                                       "Drahtseil \xC3\x84\xC3\xB6\xC3\x9F \xF0\x9F\x98\x80",
                                       std::string(200, 'n'),
                                       "a,b;(c)",
                                       "X",
                                       ""};
  std::vector<NamedCurve> curves;
  for (const std::string& name : names) curves.push_back({name, quarter_circle(1 + 0.1 * curves.size())});
  ASSERT_TRUE(export_curves(file, curves, GetParam().unit).empty());
  const ImportReport report = import_curves(file);
  ASSERT_EQ(report.curves.size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) EXPECT_EQ(report.curves[i].name, names[i]);
}

TEST_P(RoundTrip, KeepsTheShapeOfACurveWithUnclampedEnds) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / ("curves" + GetParam().extension);
  Eigen::Matrix3Xd points(3, 6);
  points << 0, 1, 2, 3, 4, 5, 0, 1, 0, -1, 0, 2, 0, 0, 1, 1, 0, 0;
  const KnotVector knots(3, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
  const NurbsCurve curve = make_nurbs_curve(knots, points, Eigen::VectorXd::Ones(6));
  ASSERT_TRUE(export_curves(file, {{"uniform", curve}}, GetParam().unit).empty());
  const ImportReport report = import_curves(file);
  ASSERT_EQ(report.curves.size(), 1U);
  const NurbsCurve& back = report.curves[0].curve;
  EXPECT_EQ(back.knots().start(), 3);
  EXPECT_EQ(back.knots().end(), 6);
  for (double u = 3; u <= 6; u += 0.25) EXPECT_LT((back.point(u) - curve.point(u)).norm(), 1e-14);
}

TEST_P(RoundTrip, PrintsNothing) {
  const ScratchDirectory scratch;
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  ASSERT_TRUE(export_curves(scratch.path() / ("a" + GetParam().extension), {{"a", quarter_circle(1)}},
                            GetParam().unit)
                  .empty());
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

INSTANTIATE_TEST_SUITE_P(All, RoundTrip, ::testing::ValuesIn(targets), [](const auto& test) {
  return test.param.extension.substr(1) + "_" + test.param.unit_name;
});

/// Readers that make marked curves periodic give their end the weight of their start.
TEST(ExportCurves, ClosedCurvesWhoseEndsHaveDifferentWeightsAreNotMarkedAsClosed) {
  const ScratchDirectory scratch;
  for (const char* name : {"ring.step", "ring.igs", "ring.dxf", "ring.brep"}) {
    const fs::path file = scratch.path() / name;
    ASSERT_TRUE(export_curves(file, {{"ring", uneven_circle(0.05)}}, LengthUnit::millimetre).empty());
    const NurbsCurve ring = import_curves(file).curves.at(0).curve;
    for (double u = 0; u <= 3; u += 0.0625)
      EXPECT_NEAR(ring.point(u).norm(), 0.05, 1e-15) << name << " " << u;
  }
  EXPECT_EQ(content_of(scratch.path() / "ring.step").find(".UNSPECIFIED.,.T."), std::string::npos);
}

TEST(ExportCurves, ReplacesAnOldFileAndLeavesNoOther) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.file("curve.step", "old");
  ASSERT_TRUE(export_curves(file, {{"a", quarter_circle(1)}}, LengthUnit::metre).empty());
  EXPECT_EQ(import_curves(file).curves.size(), 1U);
  EXPECT_EQ(entries(scratch.path()), 1);
}

TEST(ExportCurves, LeavesNoPartOfAFileWhenItFails) {
  const ScratchDirectory scratch;
  const std::vector<NamedCurve> curves{{"a", quarter_circle(1)}};
  const fs::path occupied = scratch.path() / "directory.step";
  fs::create_directory(occupied);
  for (const fs::path& file : {occupied, scratch.path() / "missing" / "a.igs"}) {
    const std::vector<Diagnostic> problems = export_curves(file, curves, LengthUnit::metre);
    ASSERT_EQ(problems.size(), 1U);
    EXPECT_EQ(problems[0].severity, Severity::error);
    EXPECT_EQ(problems[0].where, file.string());
    EXPECT_NE(problems[0].message.find("directory"), std::string::npos) << problems[0].message;
  }
  EXPECT_EQ(entries(scratch.path()), 1);
}

TEST(ExportCurves, WritesSeveralFilesAtOnceAsOneByOne) {
  const ScratchDirectory scratch;
  const fs::path one = scratch.path() / "one", all = scratch.path() / "all";
  fs::create_directory(one);
  fs::create_directory(all);
  std::vector<CurvesFile> files;
  for (const char* name : {"a.step", "b.igs", "c.dxf", "d.brep"}) {
    const std::vector<NamedCurve> curves{{name, quarter_circle(2)}, {"other", quarter_circle(3)}};
    files.push_back({all / name, curves, LengthUnit::millimetre});
    ASSERT_TRUE(export_curves(one / name, curves, LengthUnit::millimetre).empty());
  }
  files.push_back({scratch.path() / "missing" / "a.igs", files[0].curves, LengthUnit::millimetre});
  const std::vector<Diagnostic> problems = export_curves(files);
  ASSERT_EQ(problems.size(), 1U);
  EXPECT_EQ(problems[0].where, files.back().path.string());
  for (std::size_t i = 0; i < 4; ++i) {
    const auto read = import_curves(files[i].path).curves;
    const auto expected = import_curves(one / files[i].path.filename()).curves;
    ASSERT_EQ(read.size(), expected.size());
    for (std::size_t k = 0; k < read.size(); ++k) {
      EXPECT_EQ(read[k].name, expected[k].name);
      EXPECT_EQ(read[k].curve.control_points(), expected[k].curve.control_points());
    }
  }
}

TEST(ExportCurves, RefusesAnUnknownExtensionAndNamesTheKnownOnes) {
  try {
    (void)export_curves("curve.dwg", {{"a", quarter_circle(1)}}, LengthUnit::metre);
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find(".dwg"), std::string::npos);
    EXPECT_NE(std::string(e.what()).find(".step .stp .igs .iges .dxf .brep .brp"), std::string::npos);
  }
}

std::string content_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A curve that comes back: the same knots, control points within `digits` of its size.
void expect_same_curves(const NurbsCurve& after, const NurbsCurve& before, double digits,
                        const std::string& name) {
  ASSERT_EQ(after.knots().knots().size(), before.knots().knots().size()) << name;
  const double size = before.control_points().cwiseAbs().maxCoeff();
  EXPECT_LE((after.control_points() - before.control_points()).cwiseAbs().maxCoeff(), digits * size) << name;
  for (std::size_t i = 0; i < before.knots().knots().size(); ++i)
    EXPECT_NEAR(after.knots().knots()[i], before.knots().knots()[i],
                digits * std::max(1.0, std::abs(before.knots().knots()[i])))
        << name;
}

TEST(ExportCurves, DxfGivesEveryCubicOfTheCorpusBackOnALayerOfItsName) {
  const std::vector<NamedCurve> written = corpus_curves();
  for (const auto& [unit, name] :
       {std::pair{LengthUnit::metre, "m"}, {LengthUnit::millimetre, "mm"}, {LengthUnit::inch, "inch"}}) {
    const ScratchDirectory scratch;
    const fs::path file = scratch.path() / "curves.dxf";
    ASSERT_TRUE(export_curves(file, written, unit).empty());
    const ImportReport report = import_curves(file);
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(report.unit, name);
    ASSERT_EQ(report.curves.size(), written.size());
    for (std::size_t i = 0; i < written.size(); ++i) {
      EXPECT_EQ(report.curves[i].layer, written[i].name);
      if (written[i].curve.control_points().cols() > 2)  // a line has the parameter of a line
        expect_same_curves(report.curves[i].curve, written[i].curve, 1e-15, written[i].name);
      else
        EXPECT_LE((report.curves[i].curve.point(report.curves[i].curve.knots().end()) -
                   written[i].curve.point(written[i].curve.knots().end()))
                      .norm(),
                  1e-15 * length(written[i].curve) + 1e-15);
    }
  }
}

TEST(ExportCurves, DxfLayersHaveNoForbiddenLetters) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "curves.dxf";
  ASSERT_TRUE(
      export_curves(
          file,
          {{"a/b:c*", quarter_circle(1)}, {"", quarter_circle(2)}, {"Drahtseil \xC3\x84", quarter_circle(3)}},
          LengthUnit::metre)
          .empty());
  const ImportReport report = import_curves(file);
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_EQ(report.curves[0].layer, "a_b_c_");
  EXPECT_EQ(report.curves[1].layer, "0");
  EXPECT_EQ(report.curves[2].layer, "Drahtseil \xC3\x84");
}

TEST(ExportCurves, DxfLayersOfDifferentNamesDiffer) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "curves.dxf";
  const std::string longest(255, 'x'),
      umlaut =
          "Stra\xC3\x9F"
          "e \xC3\x84",
      small =
          "stra\xC3\x9F"
          "e \xC3\xA4";
  std::vector<NamedCurve> curves;
  for (const std::string& name : {std::string("a;b"), std::string("a_b"), std::string("A_B"),
                                  std::string("a;b"), longest + "y", longest + "z", umlaut, small})
    curves.push_back({name, quarter_circle(1)});
  ASSERT_TRUE(export_curves(file, curves, LengthUnit::metre).empty());
  std::vector<std::string> layers;
  for (const ImportedCurve& curve : import_curves(file).curves) layers.push_back(curve.layer);
  EXPECT_EQ(layers, (std::vector<std::string>{"a_b", "a_b 2", "A_B 3", "a_b", longest,
                                              longest.substr(2) + " 2", umlaut, small + " 2"}));
}

TEST(ExportCurves, BrepGivesEveryCubicOfTheCorpusBackInMillimetresOnly) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "curves.brep";
  const std::vector<NamedCurve> written = corpus_curves();
  ASSERT_TRUE(export_curves(file, written, LengthUnit::millimetre).empty());
  const ImportReport report = import_curves(file);
  ASSERT_EQ(report.diagnostics.size(), 1U);  // no unit is declared
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  ASSERT_EQ(report.curves.size(), written.size());
  for (std::size_t i = 0; i < written.size(); ++i)
    expect_same_curves(report.curves[i].curve, written[i].curve, 2e-15, written[i].name);
  EXPECT_THROW((void)export_curves(file, written, LengthUnit::metre), std::invalid_argument);
}

// The range of an edge is written with 15 digits: beyond the last knot of the one, before that of the other.
TEST(ExportCurves, BrepGivesCurvesBackWhateverTheirParameter) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "curve.brep";
  for (const double end : {1376870.8545450075, 1376870.8545450035}) {
    const NurbsCurve arc(KnotVector(2, {0, 0, 0, end, end, end}), quarter_circle(876543.21).control_points());
    ASSERT_TRUE(export_curves(file, {{"arc", arc}}, LengthUnit::millimetre).empty());
    const ImportReport report = import_curves(file);
    ASSERT_EQ(report.curves.size(), 1U) << end;
    expect_same_curves(report.curves[0].curve, arc, 2e-15, "arc");
  }
}

TEST(ExportCurves, TheSchemaOfAStepFileIsTheOneAskedFor) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "curve.step";
  for (const auto& [schema, words] :
       {std::pair{StepSchema::ap214, "AUTOMOTIVE_DESIGN"},
        {StepSchema::ap242, "AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF"}}) {
    ASSERT_TRUE(export_curves(file, {{"left", quarter_circle(1)}, {"right", quarter_circle(2)}},
                              LengthUnit::metre, schema)
                    .empty());
    EXPECT_NE(content_of_file(file).find(words), std::string::npos);
    const ImportReport report = import_curves(file);
    EXPECT_TRUE(report.diagnostics.empty());
    ASSERT_EQ(report.curves.size(), 2U);
    EXPECT_EQ(report.curves[1].name, "right");
    EXPECT_EQ(report.curves[1].part, "beams/right");
    expect_same_curves(report.curves[1].curve, quarter_circle(2), 1e-15, "right");
  }
}

TEST(ExportCurves, TheHeaderOfAStepFileNamesWhatWroteIt) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "curve.step";
  ASSERT_TRUE(export_curves(file, {{"a", quarter_circle(1)}}, LengthUnit::metre).empty());
  const std::string text = content_of_file(file);
  EXPECT_EQ(text.find("Open CASCADE"), std::string::npos);
  EXPECT_NE(text.find("'nurbeam','nurbeam'"), std::string::npos);
}

TEST(ExportCurves, RefusesNoCurves) {
  const ScratchDirectory scratch;
  EXPECT_THROW((void)export_curves(scratch.path() / "a.step", {}, LengthUnit::metre), std::invalid_argument);
}

TEST_P(RoundTrip, PutsSpacesForControlCharactersOfNames) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / ("names" + GetParam().extension);
  ASSERT_TRUE(export_curves(file, {{"a\nb\tc", quarter_circle(1)}}, GetParam().unit).empty());
  const ImportReport report = import_curves(file);
  ASSERT_EQ(report.curves.size(), 1u);
  EXPECT_EQ(report.curves[0].name, "a b c");
}

TEST(ExportCurves, SaysThatACurveIsOfTooHighADegree) {
  const ScratchDirectory scratch;
  const int degree = 26;
  std::vector<double> knots(degree + 1, 0);
  knots.resize(2 * degree + 2, 1);
  const Eigen::Matrix3Xd points = Eigen::Matrix3Xd::Random(3, degree + 1);
  const NurbsCurve curve =
      make_nurbs_curve(KnotVector(degree, knots), points, Eigen::VectorXd::Ones(degree + 1));
  for (const char* name : {"a.step", "a.igs"}) {
    const auto problems = export_curves(scratch.path() / name, {{"a", curve}}, LengthUnit::metre);
    ASSERT_EQ(problems.size(), 1U) << name;
    EXPECT_NE(problems[0].message.find("degree"), std::string::npos) << problems[0].message;
  }
  EXPECT_EQ(entries(scratch.path()), 0);
}

TEST(LengthUnit, IsParsedFromItsNames) {
  EXPECT_EQ(parse_length_unit("m"), LengthUnit::metre);
  EXPECT_EQ(parse_length_unit("mm"), LengthUnit::millimetre);
  EXPECT_EQ(parse_length_unit("inch"), LengthUnit::inch);
  EXPECT_EQ(parse_length_unit("in"), LengthUnit::inch);
  EXPECT_THROW(parse_length_unit("furlong"), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
