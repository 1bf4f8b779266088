// tests/corpus/kinds: small files of kinds that other programs write and read, one or more of each, and what
// must come of them. The lengths are independent integrals.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <numbers>
#include <set>

#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "nurbs/curve_chain.h"
#include "nurbs/curve_distance.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam::corpus_kinds {
namespace {

using std::numbers::pi;

constexpr double cable = 140.9586445;  // [mm], the spline of most of these files

/// What must come out of a file.
struct Expected {
  std::string file;
  std::size_t curves;
  double length_mm;                                         // of all
  std::vector<std::pair<Severity, std::string>> said = {};  // a part of each diagnostic, in any order
  double digits = 1e-8;                                     // of the length
};

void PrintTo(const Expected& expected, std::ostream* out) { *out << expected.file; }

constexpr Severity note = Severity::note, warning = Severity::warning, error = Severity::error;

const std::vector<Expected> kinds{
    {"arcs_inconsistent.igs", 5, 5 * 62.9, {{note, "arc"}}, 2e-3},
    {"arc_in_composite_inconsistent.igs", 3, 34.02, {{note, "arc"}}, 1e-3},
    {"iges126_whole.igs", 2, 9 + cable},
    {"iges126_6_values_lost.igs", 1, 9, {{warning, "BSplineCurve"}}},
    {"iges126_35_values_lost.igs", 1, 9, {{warning, "BSplineCurve"}}},
    {"iges126_26_values_lost.igs", 1, 9, {{warning, "BSplineCurve"}}},
    {"many_blocks.dxf", 200, 1000},
    {"polyline_spline_fit.dxf", 1, 293.2965346},
    {"helix_entity.dxf", 1, 171.3929677},
    {"helix_without_spline.dxf", 1, 189.8336794, {{note, "helix without a spline"}}, 1e-6},
    {"fit_points_only.dxf", 1, 20, {{note, "fit points"}}},
    {"binary.dxf", 1, 5, {{warning, "no length unit"}}},
    {"after_eof.dxf", 1, 5, {{note, "EOF"}}},
    {"code_page_1251.dxf", 1, 5},
    {"measurement_only.dxf", 1, 127, {{note, "$MEASUREMENT"}}},
    {"unknown_entities.dxf", 1, 5, {{note, "8 kind(s)"}}},
    {"spline_full_inner_knots.dxf", 1, 153.8979879},
    {"spline_full_inner_knots.step", 1, 195.1752426},
    {"ifc.ifc", 1, 1e5, {{warning, "no product"}, {warning, "metres are assumed"}}},
    {"section_with_axes.dxf", 2, 120 + 50},
    {"far_from_origin.dxf", 1, 1e3 * cable},
    {"tiny_degree5.step", 1, 0.4817144, {}, 1e-6},
    {"composite_of_itself_plus_good.step", 1, cable, {{warning, "circle of references"}}},
    {"utf16.step", 1, cable},
    {"small_letters.step", 2, cable + 10 * pi},
    {"readme_first.zip", 1, cable},
    {"three_drawings.zip",
     1,
     cable,
     {{warning, "2 more CAD file(s), which are not read: parts/line.dxf, rope.igs"}}},
    {"zero_direction.step", 1, cable, {{warning, "(0, 0, 0)"}}},
    {"number_0x10.step",
     1,
     5,
     {{warning, "0X10"}, {warning, "it refers to #102"}, {warning, "a point of it is missing"}}},
    {"number_with_two_points.step",
     1,
     5,
     {{warning, "1.2.3"}, {warning, "it refers to #102"}, {warning, "a point of it is missing"}}},
    {"empty_date.igs", 2, 9 + cable},
    {"whole_circle.dxf", 1, 40 * pi},
    {"whole_circle_9_points.step", 1, 40 * pi},
    {"unplaced_part.step", 1, 5, {{warning, "20 curve(s) in all"}}},
    {"arcs_of_many_angles.igs", 4, 257.97875342955984, {{note, "4 entities"}, {warning, "D5 CircularArc"}}},
    {"composite_with_lost_splines.igs",
     2,
     13 + cable,
     {{warning, "has 36 of the 40 values"}, {warning, "'l.O', which is no number"}}},
    {"composites_of_each_other.igs", 3, 17 + cable, {{warning, "a circle of references"}}},
    {"ellipse_inconsistent.igs", 1, 50.918, {{note, "conic arc"}}, 5e-3},
    {"utf16_helix.dxf", 1, 246.4197093907621, {{note, "helix without a spline"}}, 1e-7},
    {"fit_points_932.dxf", 1, 45.95736611035085, {{note, "fit points"}}},
    {"beziers_with_a_gap.dxf", 2, 39.4202637238471},
    {"closed_spline_fit.dxf", 1, 162.08654035521852},
    {"binary_r12.dxf", 5, 229.95574287564276, {{note, "$MEASUREMENT = 1"}}},
    {"inches_array.dxf", 12, 2800.743254418891, {{warning, "$MEASUREMENT = 0"}}},
    {"unknown_1250.dxf", 1, 290, {{note, "5 kind(s)"}, {note, "EOF"}}},
    {"far_circle_in_inches.dxf", 1, 25.4 * 16 * pi},
    {"degree7_rational.step", 1, 43.39021400833451},
    {"utf16_big_endian.step", 2, 25 + 10 * pi, {{warning, "(0, 0, 0)"}}},
    {"track_in_feet.ifc", 7, 105123.17371178944},
    {"bend.ifc", 2, 300 + 100 * pi / 3, {{note, "IFCREVOLVEDAREASOLID 1"}}}};

class CorpusKind : public ::testing::TestWithParam<Expected> {};

std::filesystem::path kind_file(const std::string& name) { return corpus_file("kinds/" + name); }

TEST_P(CorpusKind, GivesItsRightValue) {
  const Expected& expected = GetParam();
  const ImportReport report = import_curves(kind_file(expected.file));
  double length_mm = 0;
  for (const ImportedCurve& curve : report.curves) length_mm += 1e3 * length(curve.curve);
  EXPECT_EQ(report.curves.size(), expected.curves);
  EXPECT_NEAR(length_mm, expected.length_mm, expected.digits * expected.length_mm + 5e-8);
  std::string all;
  for (const Diagnostic& d : report.diagnostics) all += d.where + ": " + d.message + "\n";
  EXPECT_EQ(report.diagnostics.size(), expected.said.size()) << all;
  for (const auto& [severity, words] : expected.said)
    EXPECT_TRUE(std::any_of(report.diagnostics.begin(), report.diagnostics.end(),
                            [&](const Diagnostic& d) {
                              return d.severity == severity &&
                                     (d.where + ": " + d.message).find(words) != std::string::npos;
                            }))
        << words << "\n"
        << all;
}

INSTANTIATE_TEST_SUITE_P(All, CorpusKind, ::testing::ValuesIn(kinds), [](const auto& test) {
  std::string name = test.param.file;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(CorpusKinds, HaveNoFileThatIsNotHeldToAValue) {
  std::set<std::string> known{"compare_degree5.igs",
                              "compare_degree5_as_cubics.igs",
                              "iges110_text_for_number.igs",
                              "mitred_rod.step",
                              "mitred_tube.step",
                              "mitred_square_tube.step",
                              "alignments.ifc",
                              "bars.ifc"};  // below
  for (const Expected& expected : kinds) known.insert(expected.file);
  for (const auto& entry : std::filesystem::directory_iterator(kind_file("")))
    EXPECT_TRUE(known.contains(entry.path().filename().string())) << entry.path();
}

TEST(CorpusKinds, ArcsKeepTheirEndsSoThatChainsStayClosed) {
  const ImportReport report = import_curves(kind_file("arc_in_composite_inconsistent.igs"));
  std::vector<NurbsCurve> curves;
  for (const ImportedCurve& curve : report.curves) curves.push_back(curve.curve);
  EXPECT_EQ(find_chains(curves, 1e-9).size(), 1U);
  for (const ImportedCurve& arc : import_curves(kind_file("arcs_inconsistent.igs")).curves) {
    EXPECT_GE(1e3 * length(arc.curve), 62.831);
    EXPECT_LE(1e3 * length(arc.curve), 63.15);
  }
}

TEST(CorpusKinds, CurvesOfDegreeFiveLieAtTheirTrueDistance) {
  const NurbsCurve five = import_curves(kind_file("compare_degree5.igs")).curves.at(0).curve;
  std::vector<RationalCubic> cubics;
  for (const ImportedCurve& curve : import_curves(kind_file("compare_degree5_as_cubics.igs")).curves)
    for (const RationalCubic& cubic : BezierPath::from_nurbs(curve.curve, 0).segments)
      cubics.push_back(cubic);
  const auto on_five = [&](double t) {
    return five.point(five.knots().start() + t * (five.knots().end() - five.knots().start()));
  };
  EXPECT_NEAR(largest_distance(on_five, cubics), 7.996476e-7, 1e-12);
}

TEST(CorpusKinds, TextInThePlaceOfANumberIsNamed) {
  const ImportReport report = import_curves(kind_file("iges110_text_for_number.igs"));
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE((report.diagnostics[0].where + report.diagnostics[0].message).find("Line"), std::string::npos);
}

TEST(CorpusKinds, AMitredRodHasACentreLineWithCorners) {
  std::vector<NurbsCurve> lines;
  for (const ImportedCurve& curve : import_curves(kind_file("mitred_rod.step")).curves)
    if (curve.is_centre_line()) {
      EXPECT_NEAR(curve.pipe_radius, 5e-3, 1e-9);
      lines.push_back(curve.curve);
    }
  ASSERT_EQ(lines.size(), 3U);
  const std::vector<Chain> chains = find_chains(lines, 1e-9);
  ASSERT_EQ(chains.size(), 1U);
  double sum = 0;
  for (const NurbsCurve& line : lines) sum += 1e3 * length(line);
  EXPECT_NEAR(sum, 40, 1e-6);
}

TEST(CorpusKinds, AMitredTubeHasACentreLineWithItsBore) {
  std::vector<NurbsCurve> lines;
  for (const ImportedCurve& curve : import_curves(kind_file("mitred_tube.step")).curves)
    if (curve.is_centre_line()) {
      EXPECT_NEAR(curve.pipe_radius, 0.012, 1e-12);
      EXPECT_NEAR(curve.bore_radius, 0.010, 1e-12);
      lines.push_back(curve.curve);
    }
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(find_chains(lines, 1e-9).size(), 1U);
  EXPECT_NEAR(1e3 * (length(lines[0]) + length(lines[1])), 150 + 110, 1e-9);
}

TEST(CorpusKinds, AMitredSquareTubeHasACentreLineWithACorner) {
  std::vector<NurbsCurve> lines;
  for (const ImportedCurve& curve : import_curves(kind_file("mitred_square_tube.step")).curves)
    if (curve.is_centre_line()) {
      EXPECT_NEAR(curve.bar.width, 0.04, 1e-12);
      EXPECT_NEAR(curve.bar.area, (40 * 40 - 34 * 34) * 1e-6, 1e-15);
      lines.push_back(curve.curve);
    }
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(find_chains(lines, 1e-9).size(), 1U);
  EXPECT_NEAR(1e3 * (length(lines[0]) + length(lines[1])), 350, 1e-9);
}

TEST(CorpusKinds, BuildingModelsHaveTheirBarsAndTracks) {
  const ImportReport bars = import_curves(kind_file("bars.ifc")),
                     tracks = import_curves(kind_file("alignments.ifc"));
  const auto count = [](const ImportReport& report, const auto& is) {
    return std::count_if(report.curves.begin(), report.curves.end(), is);
  };
  EXPECT_EQ(count(
                bars, [](const ImportedCurve& curve) { return std::abs(curve.pipe_radius - 0.008) < 1e-12; }),
            6);
  EXPECT_EQ(count(
                bars, [](const ImportedCurve& curve) { return std::abs(curve.pipe_radius - 0.02) < 1e-12; }),
            1);
  EXPECT_EQ(count(
                tracks, [](const ImportedCurve& curve) { return curve.name == "track"; }),
            4);
  EXPECT_EQ(count(tracks, [](const ImportedCurve& curve) { return curve.name == "road"; }), 4);
}

TEST(CorpusKinds, LettersAndLayersOfDrawings) {
  EXPECT_EQ(import_curves(kind_file("code_page_1251.dxf")).curves.at(0).layer, "кабель");
  EXPECT_EQ(import_curves(kind_file("section_with_axes.dxf")).curves.at(0).layer, "outline");
  EXPECT_EQ(import_curves(kind_file("utf16_helix.dxf")).curves.at(0).layer, "трос 7");
  EXPECT_EQ(import_curves(kind_file("fit_points_932.dxf")).curves.at(0).layer, "ケーブル");
  EXPECT_EQ(import_curves(kind_file("unknown_1250.dxf")).curves.at(0).layer, "łańcuch");
}

TEST(CorpusKinds, WholeCirclesHaveTheControlPointsThatTheyAreDrawnWith) {
  EXPECT_EQ(import_curves(kind_file("whole_circle.dxf")).curves.at(0).curve.control_points().cols(), 9);
  EXPECT_EQ(import_curves(kind_file("whole_circle_9_points.step")).curves.at(0).curve.control_points().cols(),
            9);
}

}  // namespace
}  // namespace nurbeam::corpus_kinds
