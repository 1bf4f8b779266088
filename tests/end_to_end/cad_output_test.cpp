// The CAD files that a case asks for, and those that `nurbeam export` makes of its results.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "tests/end_to_end/case_run.h"

namespace nurbeam::test {
namespace {

/// A hanging cable, run into `results`.
class CadOutputTest : public ::testing::Test {
 protected:
  const TemporaryDirectory directory;
  const std::filesystem::path case_file = directory.write("cable.json", smallest_case);
  const std::filesystem::path results = directory.path() / "results";

  /// The exit code; what is said is in `messages`.
  int run(std::vector<std::string> words) {
    std::ostringstream out, err;
    const CapturedErrors errors;
    const int code = run_command_line(words, out, err);
    messages = err.str() + errors.text();
    return code;
  }
  int run_case(const std::string& cad) {
    return run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set",
                "analysis.end_time=0.05", "--set", "output.every=0.005", "--set", "output.cad=" + cad});
  }
  std::vector<std::string> cad_files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(results))
      if (const std::string name = entry.path().filename().string(); name.starts_with("deformed"))
        names.push_back(name);
    std::sort(names.begin(), names.end());
    return names;
  }
  NurbsCurve only_curve(const std::filesystem::path& file) const {
    const ImportReport report = import_curves(file);
    EXPECT_TRUE(report.ok());
    EXPECT_EQ(report.curves.size(), 1u);
    return report.curves.at(0).curve;
  }

  std::string messages;
};

TEST_F(CadOutputTest, AllFramesAreASequenceWhoseNamesSort) {
  ASSERT_EQ(run_case(R"({"times": "all", "formats": ["iges"]})"), 0) << messages;
  const std::vector<std::string> files = cad_files();
  ASSERT_EQ(files.size(), 11u);
  EXPECT_EQ(files.front(), "deformed_0000.igs");
  EXPECT_EQ(files.back(), "deformed_0010.igs");
  double height = 1;
  for (const std::string& file : files) {
    const NurbsCurve curve = only_curve(results / file);
    const double end = curve.point(curve.knots().end()).z();
    EXPECT_LT(end, height);  // the free end falls
    height = end;
  }
}

TEST_F(CadOutputTest, ListedTimesKeepTheirNames) {
  ASSERT_EQ(run_case(R"({"times": [0, 0.05], "formats": ["step", "step-solid"]})"), 0) << messages;
  EXPECT_EQ(cad_files(), (std::vector<std::string>{"deformed_t0.05.step", "deformed_t0.05_solid.step",
                                                   "deformed_t0.step", "deformed_t0_solid.step"}));
  const std::vector<ImportedCurve> rod = import_curves(results / "deformed_t0_solid.step").curves;
  EXPECT_NEAR(rod.back().pipe_radius, 0.01, 1e-9);
  EXPECT_EQ(rod.back().bore_radius, 0);
  // A second run with fewer files leaves none of the first.
  ASSERT_EQ(run_case(R"({"times": [0.05], "formats": ["step"]})"), 0) << messages;
  EXPECT_EQ(cad_files(), std::vector<std::string>{"deformed_t0.05.step"});
}

TEST_F(CadOutputTest, TimesThatSixDigitsDoNotTellApartHaveMore) {
  ASSERT_EQ(run_case(R"({"times": [0.01, 0.0123456788, 0.0123456789, 0.02000001], "formats": ["step"]})"), 0)
      << messages;
  EXPECT_EQ(cad_files(), (std::vector<std::string>{"deformed_t0.01.step", "deformed_t0.0123456788.step",
                                                   "deformed_t0.0123456789.step", "deformed_t0.02.step"}));
  ASSERT_EQ(run_case(R"({"times": [0.01], "formats": ["step"]})"), 0) << messages;
  EXPECT_EQ(cad_files(), std::vector<std::string>{"deformed_t0.01.step"});
}

TEST_F(CadOutputTest, AnUndeformedStraightCableIsALineAgain) {
  ASSERT_EQ(run_case(R"({"times": [0]})"), 0) << messages;
  const NurbsCurve curve = only_curve(results / "deformed_t0.step");
  EXPECT_EQ(curve.degree(), 1);
  EXPECT_EQ(curve.control_points().cols(), 2);
}

TEST_F(CadOutputTest, AKinkOfTheDrawingsDigitsComesBackSmooth) {
  const std::string axis =
      R"(beams[0].axis={"nurbs": {"degree": 2, "knots": [0, 0, 0, 1, 1, 2, 2, 2],)"
      R"( "control_points": [[0, 0, 0], [0.5, 0, 0], [1, 0, 0], [1.5, 3e-8, 0], [2, 0.5, 0]],)"
      R"( "weights": [1, 1, 1, 0.8, 1]}})";
  ASSERT_EQ(run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set", axis, "--set",
                 "analysis.end_time=0.001", "--set", R"(output.cad={"times": [0]})"}),
            0)
      << messages;
  EXPECT_NE(messages.find("tangents that differed"), std::string::npos) << messages;
  const NurbsCurve curve = only_curve(results / "deformed_t0.step");
  const std::vector<double> breaks = curve.knots().breaks();
  for (std::size_t i = 1; i + 1 < breaks.size(); ++i)
    EXPECT_LT(curve.knots().multiplicity(breaks[i]), curve.degree());
}

TEST_F(CadOutputTest, AnAxisWithASliverAndWithoutSpeedAtItsEndRuns) {
  const std::string axis =
      R"(beams[0].axis={"nurbs": {"degree": 3, "knots": [0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2], "control_points":)"
      R"( [[0, 0, 0], [0, 0, 0], [0, 0, 0], [0, 0, 0], [0.3, 0.1, 0], [1, 0, 0], [1, 0, 0]],)"
      R"( "weights": [1, 1, 1, 1, 1, 1, 1]}})";
  ASSERT_EQ(run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set", axis, "--set",
                 "analysis.end_time=0.001", "--set", R"(output.cad={"times": [0]})"}),
            0)
      << messages;
  EXPECT_NE(messages.find("1 pieces shorter"), std::string::npos) << messages;
  EXPECT_NE(messages.find("1 that stand still"), std::string::npos) << messages;
  const NurbsCurve curve = only_curve(results / "deformed_t0.step");
  EXPECT_LE((curve.point(curve.knots().end()) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-15);
  EXPECT_GT(curve.derivatives(curve.knots().end(), 1).col(1).norm(), 0.1);
}

TEST_F(CadOutputTest, MaterialParameterIsReferenceArcLength) {
  ASSERT_EQ(run_case(R"({"times": [0.05], "parameter": "material"})"), 0) << messages;
  const NurbsCurve curve = only_curve(results / "deformed_t0.05.step");
  EXPECT_EQ(curve.knots().start(), 0);
  EXPECT_NEAR(curve.knots().end(), 1, 1e-15);
  // Speed over reference arc length is the stretch: next to 1 in a cable that hardly stretches.
  for (double s = 0; s <= 1; s += 0.01) EXPECT_NEAR(curve.derivatives(s, 1).col(1).norm(), 1, 2e-2);
}

TEST_F(CadOutputTest, ASolidOfASectionWithoutRadiusIsRefusedBeforeTheRun) {
  EXPECT_EQ(run({"run", case_file.string(), "--out", results.string(), "--set",
                 R"(beams[0].section={"area": 1e-4, "second_moment": 1e-9})", "--set",
                 R"(output.cad={"formats": ["step", "step-solid"]})"}),
            2);
  EXPECT_NE(messages.find("output.cad.formats[1]"), std::string::npos) << messages;
  EXPECT_NE(messages.find("cable"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(results));
}

TEST_F(CadOutputTest, AHollowPipeOfADrawingComesBackHollow) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 0.4, 0.7, 1, 0, 0.1, -0.1, 0, 0, 0, 0, 0;
  const NurbsCurve axis =
      make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 1}), points, Eigen::Vector4d::Ones());
  ASSERT_TRUE(
      export_solids(directory.path() / "pipe.step", {{{"pipe", axis}, 0.02, 0.015}}, LengthUnit::millimetre)
          .empty());
  ASSERT_EQ(
      run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set", "analysis.end_time=0.05",
           "--set", R"(beams[0].axis={"file": "pipe.step"})", "--set", R"(beams[0].section={"from": "cad"})",
           "--set", R"(output.cad={"formats": ["step-solid"], "times": [0, 0.05]})"}),
      0)
      << messages;
  EXPECT_EQ(messages.find("_solid"), std::string::npos) << messages;
  double height = 1;
  for (const char* const file : {"deformed_t0_solid.step", "deformed_t0.05_solid.step"}) {
    const ImportReport report = import_curves(results / file);
    const auto line = std::find_if(report.curves.begin(), report.curves.end(),
                                   [](const ImportedCurve& curve) { return curve.is_centre_line(); });
    ASSERT_NE(line, report.curves.end()) << file;
    EXPECT_NEAR(line->pipe_radius, 0.02, 1e-6);
    EXPECT_NEAR(line->bore_radius, 0.015, 1e-6);
    const double end = line->curve.point(line->curve.knots().end()).z();
    EXPECT_LT(end, height);
    height = end;
  }
}

/// A spline and an arc in inches, as a CAD system might have drawn them.
std::filesystem::path drawing(const TemporaryDirectory& directory) {
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 0.2, 0.5, 0.8, 1, 0, 0, 0, 0, 0, 0, 0.1, -0.1, 0.1, 0;
  const NurbsCurve spline =
      make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 0.5, 1, 1, 1, 1}), points, Eigen::VectorXd::Ones(5));
  Eigen::Matrix3Xd corners(3, 3);
  corners << 1, 2, 2, 0, 0, 1, 1, 1, 1;
  const NurbsCurve arc =
      make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), corners, Eigen::Vector3d(1, std::sqrt(0.5), 1));
  EXPECT_TRUE(
      export_curves(directory.path() / "drawing.step", {{"frame", arc}, {"cable", spline}}, LengthUnit::inch)
          .empty());
  return directory.path() / "drawing.step";
}

TEST_F(CadOutputTest, TheSourceGetsTheDeformedShapeInPlaceOfTheDrawnOne) {
  const ImportReport before = import_curves(drawing(directory));
  const auto run_into_source = [&](const std::string& axis) {
    return run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set",
                "analysis.end_time=0.05", "--set", "output.every=0.05", "--set", "beams[0].axis=" + axis,
                "--set", R"(output.cad={"formats": ["step", "step-source"], "times": [0, 0.05]})"});
  };
  ASSERT_EQ(run_into_source(R"({"file": "drawing.step", "curve": "cable"})"), 0) << messages;
  const NurbsCurve alone = only_curve(results / "deformed_t0.05.step");
  const ImportReport after = import_curves(results / "deformed_t0.05_source.step");
  ASSERT_EQ(after.curves.size(), 2u);
  EXPECT_EQ(after.unit, "inch");
  EXPECT_EQ(after.curves[0].name, "frame");
  EXPECT_EQ(after.curves[0].curve.control_points(), before.curves[0].curve.control_points());
  EXPECT_EQ(after.curves[1].name, "cable");
  const auto middle = [](const NurbsCurve& curve) {
    return curve.point(0.5 * (curve.knots().start() + curve.knots().end()));
  };
  EXPECT_LE((middle(after.curves[1].curve) - middle(alone)).norm(), 1e-14);
  EXPECT_GT((middle(after.curves[1].curve) - middle(before.curves[1].curve)).norm(), 1e-3);
  // Undeformed, the source comes back with the curve it had.
  const ImportReport undeformed = import_curves(results / "deformed_t0_source.step");
  EXPECT_EQ(undeformed.curves.at(1).curve.control_points().cols(), 5);
  EXPECT_LE((middle(undeformed.curves[1].curve) - middle(before.curves[1].curve)).norm(), 1e-12);
}

/// An archive of one file, not compressed.
std::string zipped(const std::string& text) {
  const auto little_endian = [](std::size_t value, int count) {
    std::string bytes;
    for (int i = 0; i < count; ++i, value >>= 8) bytes += static_cast<char>(value & 0xFF);
    return bytes;
  };
  return "PK\x03\x04" + little_endian(20, 14) + little_endian(text.size(), 4) +
         little_endian(text.size(), 4) + little_endian(6, 4) + "a.step" + text;
}

TEST_F(CadOutputTest, ThePackedSourceIsWrittenUnpacked) {
  const std::filesystem::path step = drawing(directory);
  const auto run_into = [&](const std::filesystem::path& file) {
    std::ifstream content(file, std::ios::binary);
    directory.write("drawing.stpz", zipped({std::istreambuf_iterator<char>(content), {}}));
    return run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set",
                "analysis.end_time=0.01", "--set",
                R"(beams[0].axis={"file": "drawing.stpz", "curve": "cable"})", "--set",
                R"(output.cad={"formats": ["step-source"], "times": [0]})"});
  };
  ASSERT_EQ(run_into(step), 0) << messages;
  EXPECT_EQ(import_curves(results / "deformed_t0_source.step").curves.size(), 2u);
  const std::filesystem::path iges = directory.path() / "drawing.igs";
  EXPECT_TRUE(
      export_curves(iges, {{"cable", import_curves(step).curves.at(1).curve}}, LengthUnit::metre).empty());
  EXPECT_EQ(run_into(iges), 2);
  EXPECT_NE(messages.find("is not from a STEP file"), std::string::npos) << messages;
}

TEST_F(CadOutputTest, ExportGivesTheCurveTheNameOfTheDrawing) {
  drawing(directory);
  ASSERT_EQ(run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set",
                 "analysis.end_time=0.01", "--set", "beams[0].name=rope", "--set", "supports[0].beam=rope",
                 "--set", R"(beams[0].axis={"file": "drawing.step", "curve": "cable"})"}),
            0)
      << messages;
  const auto exported = [&] {
    const std::string file = (directory.path() / "deformed.step").string();
    EXPECT_EQ(run({"export", results.string(), "--time", "0.01", "--to", file}), 0) << messages;
    return import_curves(file).curves.at(0).name;
  };
  EXPECT_EQ(exported(), "cable");
  std::filesystem::remove(results / "run.json");  // which a run that is killed does not write
  EXPECT_EQ(exported(), "rope");
}

TEST_F(CadOutputTest, GuidesHaveNoSolidNorSectionLines) {
  ASSERT_EQ(run({"run", case_file.string(), "--quiet", "--out", results.string(), "--set",
                 "analysis.end_time=0.01", "--set",
                 R"(beams=[{"name": "rail", "rigid": true, "axis": {"polyline": [[0, 1, 0], [1, 1, 0]]}},
                           {"name": "cable", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "torsion": true,
                            "section": {"radius": 0.01},
                            "material": {"density": 7200, "youngs_modulus": 20e6}}])",
                 "--set", "supports[0].type=clamped", "--set",
                 R"(output.cad={"formats": ["step-solid", "step-section-lines"], "times": [0]})"}),
            0)
      << messages;
  const std::vector<ImportedCurve> rod = import_curves(results / "deformed_t0_solid.step").curves;
  EXPECT_EQ(std::ranges::count_if(rod, &ImportedCurve::is_centre_line), 1);
  EXPECT_EQ(import_curves(results / "deformed_t0_section_lines.step").curves.size(), 4u);
}

TEST_F(CadOutputTest, ASourceThatIsNoStepFileIsRefusedBeforeTheRun) {
  const std::string into_source = R"(output.cad={"formats": ["step-source"]})";
  EXPECT_EQ(run({"check", case_file.string(), "--set", into_source}), 2);
  EXPECT_NE(messages.find("output.cad.formats[0]"), std::string::npos) << messages;
  EXPECT_NE(messages.find("cable"), std::string::npos) << messages;
  drawing(directory);
  EXPECT_TRUE(export_curves(directory.path() / "drawing.igs",
                            {{"cable", import_curves(directory.path() / "drawing.step").curves.at(1).curve}},
                            LengthUnit::metre)
                  .empty());
  EXPECT_EQ(run({"check", case_file.string(), "--set", R"(beams[0].axis={"file": "drawing.igs"})", "--set",
                 into_source}),
            2);
  EXPECT_NE(messages.find("STEP"), std::string::npos) << messages;
}

TEST_F(CadOutputTest, ExportOffersTheSameForms) {
  ASSERT_EQ(run_case(R"({"times": [0.05]})"), 0) << messages;
  const auto exported = [&](const std::string& name, std::vector<std::string> options) {
    const std::string file = (directory.path() / name).string();
    std::vector<std::string> words{"export", results.string(), "--time", "0.05", "--to", file};
    words.insert(words.end(), options.begin(), options.end());
    return run(words);
  };
  EXPECT_EQ(exported("solid.step", {"--solid", "5 mm"}), 0) << messages;
  EXPECT_EQ(import_curves(directory.path() / "solid.step").unit, "mm");
  EXPECT_FALSE(import_curves(directory.path() / "solid.step").curves.at(0).free);
  EXPECT_EQ(exported("solid.igs", {"--solid", "5 mm"}), 2);
  EXPECT_EQ(exported("solid.step", {"--solid", "-1"}), 2);
  EXPECT_EQ(exported("tube.step", {"--solid", "5 mm", "--bore", "4 mm"}), 0) << messages;
  const std::vector<ImportedCurve> tube = import_curves(directory.path() / "tube.step").curves;
  EXPECT_NEAR(tube.back().pipe_radius, 0.005, 1e-6);
  EXPECT_NEAR(tube.back().bore_radius, 0.004, 1e-6);
  EXPECT_EQ(exported("tube.step", {"--solid", "5 mm", "--bore", "5 mm"}), 2);
  EXPECT_NE(messages.find("bore"), std::string::npos) << messages;
  EXPECT_EQ(exported("tube.step", {"--bore", "4 mm"}), 2);
  EXPECT_NE(messages.find("--solid"), std::string::npos) << messages;
  EXPECT_EQ(exported("material.igs", {"--parameter", "material", "--unit", "inch"}), 0) << messages;
  EXPECT_EQ(import_curves(directory.path() / "material.igs").unit, "inch");
  EXPECT_NEAR(only_curve(directory.path() / "material.igs").knots().end(), 1, 1e-15);
  EXPECT_EQ(exported("x.igs", {"--schema", "ap242"}), 2);
  EXPECT_NE(messages.find("--schema: is that of a STEP file"), std::string::npos) << messages;
  EXPECT_EQ(exported("x.step", {"--parameter", "arc"}), 2);
  EXPECT_NE(messages.find("material"), std::string::npos) << messages;
}

TEST_F(CadOutputTest, AShapeThatCannotBeASolidIsAWarningOfTheRunAndAnErrorOfTheExport) {
  const std::string arc = R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0],)"
                          R"( "end": [0, 0, 1], "normal": [0, -1, 0]}})";
  EXPECT_EQ(run({"run", case_file.string(), "--out", results.string(), "--set", arc, "--set",
                 "analysis.end_time=0.001", "--set", "beams[0].section.radius=2", "--set",
                 R"(output.cad={"formats": ["step", "step-solid"], "times": [0]})"}),
            0)
      << messages;
  EXPECT_NE(messages.find("warning: "), std::string::npos) << messages;
  EXPECT_NE(messages.find("deformed_t0_solid.step"), std::string::npos) << messages;
  EXPECT_EQ(cad_files(), std::vector<std::string>{"deformed_t0.step"});
  const std::string fat = (directory.path() / "fat.step").string();
  EXPECT_EQ(run({"export", results.string(), "--time", "0", "--to", fat, "--solid", "2"}), 4);
  EXPECT_FALSE(std::filesystem::exists(fat));
  const NurbsCurve back = only_curve(results / "deformed_t0.step");
  EXPECT_EQ(back.degree(), 2);
  EXPECT_EQ(back.control_points().cols(), 3);
}

}  // namespace
}  // namespace nurbeam::test
