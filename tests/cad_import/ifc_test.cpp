// IFC files: curves of products, swept disks, and alignments held to independent integrals.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/ifc_text_of.h"

namespace nurbeam::ifc {
namespace {

using std::numbers::pi;

Eigen::Vector3d millimetres(const Eigen::Vector3d& metres) { return 1e3 * metres; }

void expect_ends(const NurbsCurve& curve, const Eigen::Vector3d& start, const Eigen::Vector3d& end) {
  EXPECT_LE((millimetres(start_of(curve)) - start).norm(), 1e-6) << millimetres(start_of(curve)).transpose();
  EXPECT_LE((millimetres(end_of(curve)) - end).norm(), 1e-6) << millimetres(end_of(curve)).transpose();
}

TEST(Ifc, ASweptDiskIsItsDirectrixWithRadii) {
  const ImportReport report = imported(
      file_of(product() + "#100=IFCSWEPTDISKSOLID(#101,8.,5.,$,$);\n#101=IFCPOLYLINE((#102,#103));\n"
                          "#102=IFCCARTESIANPOINT((0.,0.,0.));\n#103=IFCCARTESIANPOINT((500.,0.,0.));\n"));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(report.diagnostics.empty());
  EXPECT_EQ(report.format, CadFormat::ifc);
  const ImportedCurve& line = report.curves[0];
  EXPECT_EQ(line.name, "bar");
  EXPECT_TRUE(line.is_centre_line());
  EXPECT_NEAR(line.pipe_radius, 0.008, 1e-15);
  EXPECT_NEAR(line.bore_radius, 0.005, 1e-15);
  expect_ends(line.curve, {1000, 0, 0}, {1000, 500, 0});
}

// Lines, and an arc from (500, 0) over (535.36, 14.64) to (550, 50).
TEST(Ifc, ABentBarHasLinesAndArcs) {
  const ImportReport report = imported(file_of(
      product() +
      "#100=IFCSWEPTDISKSOLID(#101,8.,$,$,$);\n"
      "#101=IFCINDEXEDPOLYCURVE(#102,(IFCLINEINDEX((1,2)),IFCARCINDEX((2,3,4)),IFCLINEINDEX((4,5))),.F.);\n"
      "#102=IFCCARTESIANPOINTLIST3D(((0.,0.,0.),(500.,0.,0.),(535.35533905932738,14.644660940672624,0.),"
      "(550.,50.,0.),(550.,300.,0.)));\n"));
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.5, 1e-12);
  EXPECT_NEAR(length(report.curves[1].curve), 0.025 * pi, 1e-12);
  EXPECT_NEAR(length(report.curves[2].curve), 0.25, 1e-12);
  for (int i = 0; i < 2; ++i)
    EXPECT_LE((end_of(report.curves[i].curve) - start_of(report.curves[i + 1].curve)).norm(), 1e-12);
}

TEST(Ifc, APolygonalBarIsRoundedAtItsCorners) {
  const ImportReport report = imported(
      file_of(product() +
              "#100=IFCSWEPTDISKSOLIDPOLYGONAL(#101,8.,$,$,$,40.);\n#101=IFCPOLYLINE((#102,#103,#104));\n"
              "#102=IFCCARTESIANPOINT((0.,0.,0.));\n#103=IFCCARTESIANPOINT((500.,0.,0.));\n"
              "#104=IFCCARTESIANPOINT((500.,300.,0.));\n"));
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.46, 1e-12);
  EXPECT_NEAR(length(report.curves[1].curve), 0.02 * pi, 1e-12);
  EXPECT_NEAR(length(report.curves[2].curve), 0.26, 1e-12);
}

TEST(Ifc, MappedItemsStandWhereTheirTargetsPutThem) {
  const ImportReport report = imported(
      file_of(product() + "#100=IFCMAPPEDITEM(#110,#111);\n#110=IFCREPRESENTATIONMAP(#6,#112);\n"
                          "#111=IFCCARTESIANTRANSFORMATIONOPERATOR3D($,$,#113,2.,$);\n"
                          "#112=IFCSHAPEREPRESENTATION(#5,'Body','AdvancedSweptSolid',(#114));\n"
                          "#113=IFCCARTESIANPOINT((10.,20.,30.));\n#114=IFCSWEPTDISKSOLID(#101,8.,$,$,$);\n"
                          "#101=IFCPOLYLINE((#7,#103));\n#103=IFCCARTESIANPOINT((500.,0.,0.));\n"));
  ASSERT_EQ(report.curves.size(), 1U);
  expect_ends(report.curves[0].curve, {980, 10, 30}, {980, 1010, 30});
  EXPECT_NEAR(report.curves[0].pipe_radius, 0.016, 1e-12);
}

TEST(Ifc, TrimmedCirclesAndCompositeCurvesAreExact) {
  const ImportReport report = imported(file_of(
      product("IFCANNOTATION", "axis", "Axis") +
      "#100=IFCCOMPOSITECURVE((#101,#102),.F.);\n#101=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#103);\n"
      "#102=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.F.,#104);\n"
      "#103=IFCTRIMMEDCURVE(#105,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(1.5707963267948966)),.T.,.PARAMETER.);\n"
      "#104=IFCPOLYLINE((#107,#108));\n#105=IFCCIRCLE(#6,100.);\n"
      "#107=IFCCARTESIANPOINT((-50.,100.,0.));\n#108=IFCCARTESIANPOINT((0.,100.,0.));\n"));
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.05 * pi, 1e-13);
  EXPECT_EQ(report.curves[0].name, "axis");
  EXPECT_LE((end_of(report.curves[0].curve) - start_of(report.curves[1].curve)).norm(), 1e-13);
  expect_ends(report.curves[1].curve, {900, 0, 0}, {900, -50, 0});
}

/// Where a clothoid of curvature 0 to 1/R over the length L ends: Simpson's rule.
Eigen::Vector2d end_of_clothoid(double radius, double total) {
  constexpr int count = 2000;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (int i = 0; i <= count; ++i) {
    const double s = total * i / count, angle = s * s / (2 * radius * total);
    const double weight = i == 0 || i == count ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return sum * total / count / 3;
}

/// A line of 100 m, a clothoid of 60 m to a curve of 200 m radius, and this for 50 m.
const std::string plan_of_segments =
    "#201=IFCALIGNMENTHORIZONTAL('h',$,$,$,$,#91,$);\n#202=IFCRELNESTS('n',$,$,$,#90,(#201));\n"
    "#203=IFCRELNESTS('m',$,$,$,#201,(#211,#221,#231));\n"
    "#211=IFCALIGNMENTSEGMENT('a',$,$,$,$,#91,$,#212);\n"
    "#212=IFCALIGNMENTHORIZONTALSEGMENT($,$,#213,0.,0.,0.,100.,$,.LINE.);\n#213=IFCCARTESIANPOINT((0.,0.));\n"
    "#221=IFCALIGNMENTSEGMENT('b',$,$,$,$,#91,$,#222);\n"
    "#222=IFCALIGNMENTHORIZONTALSEGMENT($,$,#223,0.,0.,200.,60.,$,.CLOTHOID.);\n#223=IFCCARTESIANPOINT((100.,0.));\n"
    "#231=IFCALIGNMENTSEGMENT('c',$,$,$,$,#91,$,#232);\n";

std::string arc_segment() {
  const Eigen::Vector2d start = Eigen::Vector2d(100, 0) + end_of_clothoid(200, 60);
  return "#232=IFCALIGNMENTHORIZONTALSEGMENT($,$,#233,0.15,200.,200.,50.,$,.CIRCULARARC.);\n#233=IFCCARTESIANPOINT((" +
         std::to_string(start.x()) + "," + std::to_string(start.y()) + "));\n";
}

const std::string alignment = "#90=IFCALIGNMENT('1',$,'track',$,$,#91,$,$);\n#91=IFCLOCALPLACEMENT($,#6);\n";

TEST(Ifc, AlignmentsAreLinesClothoidsAndArcs) {
  const ImportReport report = imported(file_of(alignment + plan_of_segments + arc_segment(), "$"));
  ASSERT_EQ(report.curves.size(), 3U) << (report.diagnostics.empty() ? "" : report.diagnostics[0].message);
  EXPECT_EQ(report.curves[1].name, "track");
  const std::vector<double> lengths{100, 60, 50};
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(length(report.curves[i].curve), lengths[i], 1e-7) << i;
  const Eigen::Vector3d end = end_of(report.curves[1].curve);
  EXPECT_LE((end.head<2>() - Eigen::Vector2d(100, 0) - end_of_clothoid(200, 60)).norm(), 2e-7);
  EXPECT_TRUE(report.curves[0].exact);
  EXPECT_FALSE(report.curves[1].exact);
  EXPECT_LE(report.curves[1].deviation, 1e-7);
  EXPECT_EQ(report.curves[2].curve.degree(), 2);
}

// A slope of 2 % for 80 m, then a parabola to -2 %: heights by hand.
TEST(Ifc, AlignmentsHaveTheirGrade) {
  const ImportReport report = imported(file_of(
      alignment + plan_of_segments + arc_segment() +
          "#301=IFCALIGNMENTVERTICAL('v',$,$,$,$,#91,$);\n#302=IFCRELNESTS('o',$,$,$,#90,(#301));\n"
          "#303=IFCRELNESTS('p',$,$,$,#301,(#311,#321));\n#311=IFCALIGNMENTSEGMENT('d',$,$,$,$,#91,$,#312);\n"
          "#312=IFCALIGNMENTVERTICALSEGMENT($,$,0.,80.,10.,0.02,0.02,$,.CONSTANTGRADIENT.);\n"
          "#321=IFCALIGNMENTSEGMENT('e',$,$,$,$,#91,$,#322);\n"
          "#322=IFCALIGNMENTVERTICALSEGMENT($,$,80.,130.,11.6,0.02,-0.02,$,.PARABOLICARC.);\n",
      "$"));
  ASSERT_EQ(report.curves.size(), 4U);  // the line has two grades
  EXPECT_NEAR(length(report.curves[0].curve), 80 * std::hypot(1, 0.02), 1e-9);
  EXPECT_NEAR(end_of(report.curves[0].curve).z(), 11.6, 1e-12);
  EXPECT_NEAR(end_of(report.curves[3].curve).z(), 11.6, 1e-9);  // the parabola is symmetric
  const double x = 20, bend = -0.04 / (2 * 130);
  EXPECT_NEAR(end_of(report.curves[1].curve).z(), 11.6 + 0.02 * x + bend * x * x, 1e-12);
}

// Also where a curve that tells the cant stands on it.
TEST(Ifc, CurveSegmentsOfAGradientCurveAreTheSame) {
  const std::string segments =
      "#100=IFCGRADIENTCURVE((#150),.F.,#120,$);\n#120=IFCCOMPOSITECURVE((#121,#131),.F.);\n"
      "#121=IFCCURVESEGMENT(.CONTINUOUS.,#122,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(100.),#123);\n"
      "#122=IFCAXIS2PLACEMENT2D(#124,#125);\n#123=IFCLINE(#124,#126);\n#124=IFCCARTESIANPOINT((0.,0.));\n"
      "#125=IFCDIRECTION((1.,0.));\n#126=IFCVECTOR(#125,1.);\n"
      "#131=IFCCURVESEGMENT(.CONTINUOUS.,#132,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(60.),#133);\n"
      "#132=IFCAXIS2PLACEMENT2D(#134,#125);\n#133=IFCCLOTHOID(#122,109.54451150103322);\n"  // sqrt(200 60)
      "#134=IFCCARTESIANPOINT((100.,0.));\n"
      "#150=IFCCURVESEGMENT(.CONTINUOUS.,#151,IFCLENGTHMEASURE(0.),IFCLENGTHMEASURE(160.),#123);\n"
      "#151=IFCAXIS2PLACEMENT2D(#152,#125);\n#152=IFCCARTESIANPOINT((0.,7.));\n";
  for (const std::string axis : {"#100", "#99"}) {
    const ImportReport report = imported(file_of(
        "#90=IFCALIGNMENT('1',$,'track',$,$,#91,#94,$);\n#91=IFCLOCALPLACEMENT($,#6);\n"
        "#94=IFCPRODUCTDEFINITIONSHAPE($,$,(#95));\n#95=IFCSHAPEREPRESENTATION(#5,'Axis','Curve3D',(" +
            axis + "));\n#99=IFCSEGMENTEDREFERENCECURVE((),.F.,#100,$);\n" + segments,
        "$"));
    ASSERT_EQ(report.curves.size(), 2U) << (report.diagnostics.empty() ? "" : report.diagnostics[0].message);
    EXPECT_NEAR(length(report.curves[1].curve), 60, 1e-7);
    const Eigen::Vector3d end = end_of(report.curves[1].curve);
    EXPECT_LE((end.head<2>() - Eigen::Vector2d(100, 0) - end_of_clothoid(200, 60)).norm(), 2e-7);
    EXPECT_NEAR(end.z(), 7, 1e-12);
  }
}

TEST(Ifc, WhatIsNotReadIsNamedOrCounted) {
  const ImportReport report = imported(
      file_of(product() +
              "#100=IFCGEOMETRICSET((#101,#102,#103,#104));\n#101=IFCPOLYLINE((#7,#105));\n"
              "#102=IFCTRIMMEDCURVE(#106,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(1.)),.T.,.PARAMETER.);\n"
              "#103=IFCFACETEDBREP(#7);\n#104=IFCCOMPOSITECURVE((#107),.F.);\n"
              "#105=IFCCARTESIANPOINT((9.,0.,0.));\n#106=IFCPCURVE(#7,#7);\n"
              "#107=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#104);\n"));
  ASSERT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 3U);
  EXPECT_NE(report.diagnostics[0].where.find("#102 IFCTRIMMEDCURVE"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("IFCPCURVE"), std::string::npos);
  EXPECT_NE(report.diagnostics[1].message.find("a circle of references"), std::string::npos);
  EXPECT_NE(report.diagnostics[2].message.find("IFCFACETEDBREP 1"), std::string::npos);
}

TEST(Ifc, ItemsThatTheFileDoesNotHaveAreNamed) {
  const ImportReport report =
      imported(file_of(product() + "#100=IFCGEOMETRICSET((#101,#999));\n#101=IFCPOLYLINE((#7,#105));\n"
                                   "#105=IFCCARTESIANPOINT((9.,0.,0.));\n"));
  ASSERT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("#999"), std::string::npos) << report.diagnostics[0].where;
  EXPECT_NE(report.diagnostics[0].message.find("the file does not have it"), std::string::npos);
}

TEST(Ifc, KnotsThatAreAlmostOneAreNamed) {
  const ImportReport report = imported(
      file_of(product() +
              "#100=IFCGEOMETRICSET((#101,#102));\n#101=IFCPOLYLINE((#7,#105));\n"
              "#102=IFCBSPLINECURVEWITHKNOTS(2,(#7,#105,#106),.UNSPECIFIED.,.F.,.F.,(3,3),(0.,1.E-320),"
              ".UNSPECIFIED.);\n"
              "#105=IFCCARTESIANPOINT((9.,0.,0.));\n#106=IFCCARTESIANPOINT((9.,5.,0.));\n"));
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("knots must be equal, or at least"), std::string::npos)
      << report.diagnostics[0].message;
}

TEST(Ifc, CurvesOfNoProductAreReadWithAWarning) {
  const ImportReport report = imported(
      "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('IFC4X3_ADD2'));\nENDSEC;\nDATA;\n#1=IFCCARTESIANPOINT((0.,0.,0.));\n"
      "#2=IFCCARTESIANPOINT((100.,0.,0.));\n#3=IFCPOLYLINE((#1,#2));\nENDSEC;\nEND-ISO-10303-21;\n");
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 100, 1e-12);
  EXPECT_EQ(report.diagnostics.size(), 2U);  // nor is there a unit
}

TEST(Ifc, WithoutASchemaIsToldByItsFirstInstance) {
  const ImportReport report = imported(
      with(file_of(product() + "#100=IFCPOLYLINE((#7,#101));\n#101=IFCCARTESIANPOINT((9.,0.,0.));\n"),
           "FILE_SCHEMA(('IFC4X3_ADD2'));\n", ""));
  EXPECT_EQ(report.format, CadFormat::ifc);
  EXPECT_EQ(report.curves.size(), 1U);
}

}  // namespace
}  // namespace nurbeam::ifc
