// Curves of DXF drawings, against what their entities say they are.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// A drawing of these entities and blocks, written "0 LINE 10 1.5 ...", in the unit of this $INSUNITS.
std::string dxf_of(const std::string& entities, int insunits = 4, const std::string& blocks = "") {
  std::string text = "0 SECTION 2 HEADER 9 $INSUNITS 70 " + std::to_string(insunits) + " 0 ENDSEC " +
                     (blocks.empty() ? "" : "0 SECTION 2 BLOCKS " + blocks + " 0 ENDSEC ") +
                     "0 SECTION 2 ENTITIES " + entities + " 0 ENDSEC 0 EOF";
  std::replace(text.begin(), text.end(), ' ', '\n');
  return text + "\n";
}

ImportReport import_dxf(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("drawing.dxf", text));
}

NurbsCurve only_dxf_curve(const std::string& entities, int insunits = 4) {
  const ImportReport report = import_dxf(dxf_of(entities, insunits));
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
  EXPECT_EQ(report.curves.size(), 1U);
  return report.curves.at(0).curve;
}

Eigen::Vector3d middle_of(const NurbsCurve& curve) {
  return curve.point(0.5 * (curve.knots().start() + curve.knots().end()));
}

void expect_near(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { EXPECT_LE((a - b).norm(), 1e-15); }

TEST(ReadDxf, LinesHaveTheUnitOfTheDrawing) {
  const std::string line = "0 LINE 8 0 10 1 20 2 30 3 11 4 21 6 31 3";
  const std::vector<std::pair<std::string, double>> units{{"inch", 0.0254},
                                                          {"ft", 0.3048},
                                                          {"mile", 1609.344},
                                                          {"mm", 1e-3},
                                                          {"cm", 1e-2},
                                                          {"m", 1},
                                                          {"km", 1e3},
                                                          {"microinch", 2.54e-8},
                                                          {"mil", 2.54e-5},
                                                          {"yard", 0.9144},
                                                          {"angstrom", 1e-10},
                                                          {"nm", 1e-9},
                                                          {"um", 1e-6},
                                                          {"dm", 0.1},
                                                          {"dam", 10},
                                                          {"hm", 100},
                                                          {"Gm", 1e9},
                                                          {"au", 149597870700.0},
                                                          {"light year", 9460730472580800.0},
                                                          {"parsec", 3.0856775814913673e16},
                                                          {"US survey ft", 1200.0 / 3937},
                                                          {"US survey inch", 100.0 / 3937},
                                                          {"US survey yard", 3600.0 / 3937},
                                                          {"US survey mile", 6336000.0 / 3937}};
  for (std::size_t i = 0; i < units.size(); ++i) {
    const auto& [name, metres] = units[i];
    const ImportReport report = import_dxf(dxf_of(line, static_cast<int>(i) + 1));
    ASSERT_EQ(report.curves.size(), 1U) << name;
    EXPECT_TRUE(report.diagnostics.empty()) << name;
    EXPECT_EQ(report.unit, name);
    EXPECT_DOUBLE_EQ(report.unit_in_metres, metres);
    EXPECT_LE((start_of(report.curves[0].curve) / metres - Eigen::Vector3d(1, 2, 3)).norm(), 1e-15) << name;
    EXPECT_LE((end_of(report.curves[0].curve) / metres - Eigen::Vector3d(4, 6, 3)).norm(), 2e-15) << name;
  }
  const ImportReport unknown = import_dxf(dxf_of(line, 25));
  ASSERT_EQ(unknown.diagnostics.size(), 1U);
  EXPECT_NE(unknown.diagnostics[0].message.find("$INSUNITS is 25"), std::string::npos);
  const ImportReport without = import_dxf(dxf_of(line, 0));
  ASSERT_EQ(without.diagnostics.size(), 1U);
  EXPECT_NE(without.diagnostics[0].message.find("$INSUNITS"), std::string::npos);
  EXPECT_EQ(without.unit, "mm");
}

TEST(ReadDxf, ArcsRunCounterclockwiseAboutTheirNormal) {
  const NurbsCurve arc = only_dxf_curve("0 ARC 10 5 20 0 30 1 40 2 50 300 51 60", 6);
  const double root = std::sqrt(3.0);
  expect_near(start_of(arc), {6, -root, 1});
  expect_near(middle_of(arc), {7, 0, 1});
  expect_near(end_of(arc), {6, root, 1});
  EXPECT_NEAR(length(arc), 2 * 2 * pi / 3, 1e-14);
  // Seen from behind its x axis points the other way (the arbitrary axis algorithm).
  const NurbsCurve behind = only_dxf_curve("0 ARC 10 5 20 0 30 1 40 2 50 0 51 90 210 0 220 0 230 -1", 6);
  expect_near(start_of(behind), {-7, 0, -1});
  expect_near(end_of(behind), {-5, 2, -1});
  const NurbsCurve circle = only_dxf_curve("0 CIRCLE 10 1 20 1 30 0 40 0.5", 6);
  EXPECT_NEAR(length(circle), pi, 1e-14);
  for (double u = 0; u <= 4; u += 0.25)
    EXPECT_NEAR((circle.point(u) - Eigen::Vector3d(1, 1, 0)).norm(), 0.5, 1e-15);
}

TEST(ReadDxf, EllipsesRunFromTheirMajorAxis) {
  const NurbsCurve quarter =
      only_dxf_curve("0 ELLIPSE 10 1 20 0 30 0 11 0 21 3 31 0 40 0.5 41 0 42 1.5707963267948966", 6);
  expect_near(start_of(quarter), {1, 3, 0});
  EXPECT_LE((end_of(quarter) - Eigen::Vector3d(-0.5, 0, 0)).norm(), 1e-15);
  const NurbsCurve whole =
      only_dxf_curve("0 ELLIPSE 10 0 20 0 30 0 11 3 21 0 31 0 40 0.33333333333333333", 6);
  EXPECT_NEAR(length(whole), 13.364893220555258, 1e-12);
}

TEST(ReadDxf, WholeTurnsAreWholeWhateverTheirDigits) {
  for (const char* range : {"41 0 42 6.283185307179586", "41 0 42 6.28318530718", "41 0 42 6.283185",
                            "41 -3.1415926535898 42 3.1415926535898"}) {
    const NurbsCurve whole = only_dxf_curve(
        std::string("0 ELLIPSE 10 0 20 0 30 0 11 3 21 0 31 0 40 0.33333333333333333 ") + range, 6);
    EXPECT_NEAR(length(whole), 13.364893220555258, 1e-12) << range;
    EXPECT_LE((start_of(whole) - end_of(whole)).norm(), 1e-14) << range;
  }
  for (const char* range :
       {"50 90 51 450.0000000001", "50 90 51 90", "50 90 51 90.00000001", "50 90 51 89.99999999"})
    EXPECT_NEAR(length(only_dxf_curve(std::string("0 ARC 10 0 20 0 40 2 ") + range, 6)), 4 * pi, 1e-14)
        << range;
  EXPECT_NEAR(length(only_dxf_curve("0 ARC 10 0 20 0 40 2e7 50 0 51 360.00005")), 4e4 * pi, 1e-8);
}

TEST(ReadDxf, SmallArcsOfLargeCirclesAreNoWholeTurns) {
  const double angle = 5e-5 * pi / 180, length_in_metres = 2e4 * angle;
  for (const char* range : {"50 90.0 51 90.00005", "50 359.99998 51 0.00003"}) {
    const NurbsCurve arc = only_dxf_curve(std::string("0 ARC 10 0 20 0 30 0 40 20000000.0 ") + range);
    EXPECT_NEAR(length(arc), length_in_metres, 1e-9) << range;
    EXPECT_NEAR((end_of(arc) - start_of(arc)).norm(), length_in_metres, 1e-9) << range;
  }
  const NurbsCurve ellipse =
      only_dxf_curve("0 ELLIPSE 10 0 20 0 30 0 11 0 21 2e7 31 0 40 0.5 41 0 42 0.000001");
  EXPECT_NEAR(length(ellipse), 0.5 * 2e4 * 1e-6, 1e-9);
}

TEST(ReadDxf, SplinesKeepTheirKnotsAndWeights) {
  // A quarter of the unit circle.
  const NurbsCurve arc = only_dxf_curve(
      "0 SPLINE 70 4 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 41 1 41 0.70710678118654752 41 1 "
      "10 1 20 0 30 0 10 1 20 1 30 0 10 0 20 1 30 0",
      6);
  for (double u = 0; u <= 1; u += 0.125) EXPECT_NEAR(arc.point(u).norm(), 1, 1e-15);
}

TEST(ReadDxf, ASplineWithoutZLiesInThePlane) {
  const std::string start = "0 SPLINE 70 8 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 ";
  const NurbsCurve flat = only_dxf_curve(start + "10 1 20 0 10 1 20 1 10 0 20 1", 6);
  expect_near(start_of(flat), {1, 0, 0});
  expect_near(middle_of(flat), {0.75, 0.75, 0});
  expect_near(end_of(flat), {0, 1, 0});
  const ImportReport uneven = import_dxf(dxf_of(start + "10 1 20 0 30 2 10 1 20 1 10 0 20 1 0 LINE 11 1"));
  ASSERT_EQ(uneven.diagnostics.size(), 1U);
  EXPECT_NE(uneven.diagnostics[0].message.find("3 x of control points (group 10) and 1 z (group 30)"),
            std::string::npos)
      << uneven.diagnostics[0].message;
}

TEST(ReadDxf, PolylinesAreOneCurveOrTheirLinesAndArcs) {
  const NurbsCurve square =
      only_dxf_curve("0 LWPOLYLINE 90 4 70 1 38 2 10 0 20 0 10 1 20 0 10 1 20 1 10 0 20 1", 6);
  EXPECT_EQ(square.degree(), 1);
  EXPECT_EQ(square.control_points().cols(), 5);
  EXPECT_NEAR(length(square), 4, 1e-15);
  EXPECT_EQ(start_of(square).z(), 2);
  // A slot: two lines, two half circles that bulge outwards, and again clockwise.
  for (const double turn : {1.0, -1.0}) {
    const std::string b = std::to_string(turn), top = std::to_string(turn * 1);
    const ImportReport slot = import_dxf(dxf_of(
        "0 LWPOLYLINE 70 1 10 0 20 0 10 2 20 0 42 " + b + " 10 2 20 " + top + " 10 0 20 " + top + " 42 " + b,
        6));
    ASSERT_EQ(slot.curves.size(), 4U);
    double sum = 0;
    for (const ImportedCurve& curve : slot.curves) sum += length(curve.curve);
    EXPECT_NEAR(sum, 4 + pi, 1e-14);
    expect_near(middle_of(slot.curves[1].curve), {2.5, 0.5 * turn, 0});
    expect_near(middle_of(slot.curves[3].curve), {-0.5, 0.5 * turn, 0});
    for (int i = 0; i < 4; ++i)
      expect_near(end_of(slot.curves[i].curve), start_of(slot.curves[(i + 1) % 4].curve));
  }
  const NurbsCurve in_space = only_dxf_curve(
      "0 POLYLINE 66 1 70 8 0 VERTEX 70 32 10 0 20 0 30 0 0 VERTEX 70 32 10 1 20 2 30 2 0 VERTEX 70 32 10 1 20 2 30 3 "
      "0 SEQEND",
      6);
  EXPECT_NEAR(length(in_space), 4, 1e-15);
  EXPECT_EQ(end_of(in_space), Eigen::Vector3d(1, 2, 3));
}

TEST(ReadDxf, ArcsOfPolylinesMeetTheirCornersHoweverFlat) {
  for (const std::string bulge : {"1e-12", "-1e-9", "1e-6", "-0.01", "0.7", "-1", "30", "1e6"}) {
    const NurbsCurve arc =
        only_dxf_curve("0 LWPOLYLINE 90 2 70 0 10 1000 20 500 42 " + bulge + " 10 1002 20 500", 6);
    EXPECT_EQ(start_of(arc), Eigen::Vector3d(1000, 500, 0)) << bulge;
    EXPECT_EQ(end_of(arc), Eigen::Vector3d(1002, 500, 0)) << bulge;
    // The bulge is the height of the arc over half its chord, to the right of a positive one.
    const double height = std::stod(bulge), digits = 3e-13 + 1e-15 * std::abs(height);
    EXPECT_LE((middle_of(arc) - Eigen::Vector3d(1001, 500 - height, 0)).norm(), digits) << bulge;
  }
}

TEST(ReadDxf, PolylinesInAPlaneLieAtTheHeightOfTheirEntity) {
  for (const char* z : {"", "30 0 ", "30 5 "}) {
    const std::string height(z);
    const NurbsCurve flat = only_dxf_curve("0 POLYLINE 66 1 10 0 20 0 30 5 70 0 0 VERTEX 10 0 20 0 " +
                                               height + "0 VERTEX 10 3 20 4 " + height + "0 SEQEND",
                                           6);
    expect_near(start_of(flat), {0, 0, 5});
    expect_near(end_of(flat), {3, 4, 5});
  }
}

TEST(ReadDxf, LayersColoursAndHiddenEntitiesAreKept) {
  const ImportReport report = import_dxf(
      dxf_of("0 LINE 8 cables 62 3 11 1 0 LINE 8 frame 420 16744448 60 1 11 2 0 TEXT 1 note 10 0 20 0"));
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_EQ(report.curves[0].layer, "cables");
  EXPECT_EQ(report.curves[0].colour, "#00ff00");
  EXPECT_EQ(report.curves[1].colour, "#ff8000");
  EXPECT_TRUE(report.curves[1].hidden);
}

// Of AutoCAD's table.
TEST(ReadDxf, ColoursByNumberAreThoseThatAutoCadShows) {
  for (const auto& [number, colour] : std::vector<std::pair<int, std::string>>{{8, "#808080"},
                                                                               {11, "#ff7f7f"},
                                                                               {13, "#a55252"},
                                                                               {20, "#ff3f00"},
                                                                               {50, "#ffff00"},
                                                                               {94, "#007f00"},
                                                                               {170, "#0000ff"},
                                                                               {211, "#ff7fff"},
                                                                               {248, "#260009"},
                                                                               {255, "#ffffff"},
                                                                               {256, ""}})
    EXPECT_EQ(import_dxf(dxf_of("0 LINE 8 0 62 " + std::to_string(number) + " 11 1")).curves.at(0).colour,
              colour)
        << number;
}

TEST(ReadDxf, LettersThatAreWrittenByTheirNumbersAreRead) {
  const auto layer_of = [](const std::string& layer) {
    return import_dxf(dxf_of("0 LINE 8 " + layer + " 10 0 11 1")).curves.at(0).layer;
  };
  EXPECT_EQ(layer_of("\\U+00FCber_\\U+7D22"), "über_索");
  EXPECT_EQ(layer_of("\\U+12G4\\U+41"), "\\U+12G4\\U+41");
}

TEST(ReadDxf, CurvesOfFrozenAndSwitchedOffLayersAreHidden) {
  const std::string tables =
      "0 SECTION 2 TABLES 0 TABLE 2 LAYER 70 4 0 LAYER 2 off 70 0 62 -3 0 LAYER 2 Frozen 70 1 62 5 "
      "0 LAYER 2 locked 70 4 62 1 0 LAYER 2 0 70 0 62 7 0 ENDTAB 0 ENDSEC 0 SECTION 2 ENTITIES";
  std::string text = dxf_of(
      "0 LINE 8 off 11 1 0 LINE 8 FROZEN 11 2 0 LINE 8 locked 11 3 0 LINE 8 0 11 4 0 LINE 8 unlisted 11 5");
  std::string lines = tables;
  std::replace(lines.begin(), lines.end(), ' ', '\n');
  const ImportReport report = import_dxf(with(text, "0\nSECTION\n2\nENTITIES", lines));
  ASSERT_EQ(report.curves.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(report.curves[i].hidden, i < 2) << i;
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  EXPECT_NE(report.diagnostics[0].message.find("2 curve(s) are hidden"), std::string::npos);
}

TEST(ReadDxf, ThePaperSpaceIsNoPartOfTheModel) {
  const ImportReport report = import_dxf(
      dxf_of("0 LINE 67 1 11 1 0 VIEWPORT 67 1 0 INSERT 67 1 2 frame 0 POLYLINE 67 1 66 1 0 VERTEX 67 1 10 0 "
             "0 VERTEX 67 1 10 1 0 SEQEND 67 1 0 LINE 67 0 11 2 0 LINE 11 3"));
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_NEAR(length(report.curves[0].curve), 2e-3, 1e-17);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("entity 1 LINE"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("2 curve(s)"), std::string::npos);
}

TEST(ReadDxf, BlocksStandWhereTheyAreInserted) {
  // In the block's own coordinates, its base point at (1, 2): a line of (3, 4) and a quarter of a circle.
  const std::string arm =
      "0 BLOCK 2 arm 10 1 20 2 30 0 0 LINE 8 0 62 0 10 1 20 2 11 4 21 6 0 ARC 8 own 10 1 20 2 40 1 50 0 51 90 "
      "0 ENDBLK 8 0";
  const ImportReport placed =
      import_dxf(dxf_of("0 INSERT 8 cables 62 1 2 ARM 10 10 20 20 30 30 41 2 42 3 50 90", 6, arm));
  EXPECT_TRUE(placed.diagnostics.empty());
  ASSERT_EQ(placed.curves.size(), 2U);
  expect_near(start_of(placed.curves[0].curve), {10, 20, 30});
  EXPECT_LE((end_of(placed.curves[0].curve) - Eigen::Vector3d(10 - 12, 20 + 6, 30)).norm(), 1e-14);
  EXPECT_EQ(placed.curves[0].layer, "cables");
  EXPECT_EQ(placed.curves[0].colour, "#ff0000");
  EXPECT_EQ(placed.curves[0].part, "arm");
  EXPECT_EQ(placed.curves[1].layer, "own");
  const NurbsCurve& ellipse = placed.curves[1].curve;  // its axes are 2 along y and 3 along -x
  for (double u = 0; u <= 1; u += 0.125) {
    const Eigen::Vector3d p = ellipse.point(u) - Eigen::Vector3d(10, 20, 30);
    EXPECT_NEAR(std::pow(p.x() / 3, 2) + std::pow(p.y() / 2, 2), 1, 1e-14);
  }
}

TEST(ReadDxf, BlocksInBlocksStandInThemAndArraysAreCopied) {
  const std::string blocks =
      "0 BLOCK 2 side 10 0 20 0 0 LINE 8 0 10 0 20 0 11 1 21 0 0 ENDBLK "
      "0 BLOCK 2 frame 10 0 20 0 0 INSERT 8 0 2 side 10 5 20 0 50 90 0 LINE 8 rim 11 7 0 ENDBLK";
  // Seen from behind, x points the other way.
  const ImportReport report = import_dxf(
      dxf_of("0 INSERT 8 steel 2 frame 10 1 20 0 210 0 220 0 230 -1 70 2 71 3 44 10 45 20", 6, blocks));
  EXPECT_TRUE(report.diagnostics.empty());
  ASSERT_EQ(report.curves.size(), 12U);
  for (int copy = 0; copy < 6; ++copy) {
    const ImportedCurve& side = report.curves[2 * copy];
    const Eigen::Vector3d at(-(1 + 5 + 10 * (copy % 2)), 20 * (copy / 2), 0);
    EXPECT_LE((start_of(side.curve) - at).norm(), 1e-14);
    EXPECT_LE((end_of(side.curve) - at - Eigen::Vector3d::UnitY()).norm(), 1e-14);
    EXPECT_EQ(side.part, "frame/side");
    EXPECT_EQ(side.layer, "steel");
  }
  EXPECT_EQ(report.curves[1].layer, "rim");
}

TEST(ReadDxf, BlocksWithoutEndAreRefusedAndHarmNothing) {
  const std::string itself =
      "0 BLOCK 2 a 0 INSERT 2 b 0 ENDBLK 0 BLOCK 2 b 0 INSERT 2 a 0 LINE 11 1 0 ENDBLK";
  const ImportReport circle = import_dxf(dxf_of("0 INSERT 2 a", 6, itself));
  EXPECT_EQ(circle.curves.size(), 1U);
  ASSERT_EQ(circle.diagnostics.size(), 1U);
  EXPECT_NE(circle.diagnostics[0].message.find("'a' places itself"), std::string::npos);
  std::string nest = "0 BLOCK 2 n0 0 LINE 11 1 0 ENDBLK";
  for (int i = 1; i <= 12; ++i) {
    nest += " 0 BLOCK 2 n" + std::to_string(i);
    for (int k = 0; k < 10; ++k) nest += " 0 INSERT 2 n" + std::to_string(i - 1) + " 10 " + std::to_string(k);
    nest += " 0 ENDBLK";
  }
  const ImportReport many = import_dxf(dxf_of("0 INSERT 2 n12", 6, nest));
  ASSERT_TRUE(has_errors(many.diagnostics));
  EXPECT_NE(many.diagnostics[0].message.find("more than 1000000"), std::string::npos);
}

TEST(ReadDxf, WhatCannotBeReadIsNamedAndHarmsNothing) {
  for (const auto& [entity, reason] : {std::pair{"0 INSERT 2 block", "'block' that it places is not"},
                                       {"0 ARC 40 -1", "radius"},
                                       {"0 SPLINE 71 3 11 1 11 1", "fewer than two different fit points"},
                                       {"0 LWPOLYLINE 10 0 20 0 10 0 20 0", "length"},
                                       {"0 LINE 10 0x10 11 1", "'0x10'"},
                                       {"0 SPLINE 71 2.5e9 10 0 20 0", "from -1e9 to 1e9"},
                                       {"0 ELLIPSE 11 3 40 0", "minor axis"},
                                       {"0 LINE 10 x 11 1", "'x'"},
                                       {"0 LINE 11 0", "length"},
                                       {"0 SPLINE 71 2 40 1 40 0 10 0 20 0 30 0", "not read"},
                                       {"0 LWPOLYLINE 10 0 20 0", "corners"},
                                       {"0 CIRCLE 40 1 210 0 220 0 230 0", "normal"}}) {
    const ImportReport report = import_dxf(dxf_of(std::string(entity) + " 0 LINE 11 1"));
    EXPECT_EQ(report.curves.size(), 1U) << entity;
    ASSERT_EQ(report.diagnostics.size(), 1U) << entity;
    EXPECT_NE((report.diagnostics[0].where + report.diagnostics[0].message).find(reason), std::string::npos)
        << report.diagnostics[0].where << report.diagnostics[0].message;
  }
  const std::string whole = dxf_of("0 LINE 11 1");
  EXPECT_NE(import_dxf(whole.substr(0, whole.size() - 5)).diagnostics.at(0).message.find("EOF"),
            std::string::npos);
  EXPECT_NE(import_dxf(with(whole, "11\n1", "eleven\n1")).diagnostics.at(0).message.find("group code"),
            std::string::npos);
  EXPECT_EQ(import_dxf("999\nmade by hand\n" + whole).curves.size(), 1U);
}

}  // namespace
}  // namespace nurbeam
