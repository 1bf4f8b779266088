// What is damaged in a file is named, and costs nothing else: values of IGES, syntax and circles of STEP.

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam::damaged_entities {
namespace {

ImportReport imported(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("drawing.cad", text));
}

const IgesEntity good{.type = 110, .parameters = "110,0.,0.,0.,9.,0.,0.;"};

/// The only warning of a file that holds a good line of 9 mm and the damaged entity, which is D3.
Diagnostic warning_beside_good_line(const IgesEntity& damaged) {
  const ImportReport report = imported(iges_text_of({good, damaged}));
  EXPECT_EQ(report.curves.size(), 1U) << damaged.parameters;
  if (!report.curves.empty()) EXPECT_NEAR(length(report.curves[0].curve), 9e-3, 1e-12);
  EXPECT_EQ(report.diagnostics.size(), 1U) << damaged.parameters;
  return report.diagnostics.empty() ? Diagnostic{Severity::note, "", ""} : report.diagnostics[0];
}

void expect_named(const IgesEntity& damaged, const std::string& kind, const std::string& word) {
  const Diagnostic warning = warning_beside_good_line(damaged);
  EXPECT_EQ(warning.severity, Severity::warning);
  EXPECT_NE(warning.where.find("D3 " + kind), std::string::npos) << warning.where;
  EXPECT_NE(warning.message.find(word), std::string::npos) << warning.message;
}

TEST(DamagedEntity, LostValuesOfIgesAreNoZeros) {
  expect_named({.type = 110, .parameters = "110,1.,2.,3.;"}, "Line", "3 of the 6 values");
  expect_named({.type = 100, .parameters = "100,0.,0.,0.,1.,0.;"}, "CircularArc", "5 of the 7");
  expect_named({.type = 104, .parameters = "104,1.,0.,1.,0.,0.,-25.,0.,5.;", .form = 1}, "ConicArc",
               "8 of the 11");
  expect_named({.type = 106, .parameters = "106,2,3,0.,0.,0.,1.,1.,1.;", .form = 12}, "CopiousData",
               "8 of the 11");
  expect_named({.type = 126, .parameters = "126,1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.;"}, "BSplineCurve",
               "14 of the 18");
  expect_named({.type = 126, .parameters = "126,5,3,0,0,1,0,0.,0.;"}, "BSplineCurve", "8 of the 40");
}

// 0, 0, 1, 1 without the second: all behind it is moved by one.
TEST(DamagedEntity, AValueThatIsLostInsideASplineIsNoticed) {
  expect_named(
      {.type = 126, .parameters = "126,1,1,0,0,1,0,0.,1.,1.,1.,1.,0.,0.,0.,7.,0.,0.,0.,1.,0.,0.,1.;"},
      "BSplineCurve", "values before it are lost");
}

TEST(DamagedEntity, TextInThePlaceOfANumberIsNamed) {
  for (const std::string text : {"abc", "0x10", "1.5E", "nan", "1.5.5", "+-2"})
    expect_named({.type = 110, .parameters = "110,1.,2.,3.,4.," + text + ",6.;"}, "Line", "is no number");
  expect_named({.type = 126, .parameters = "126,x,1,0,0,1,0,0.,0.,1.,1.,1.,1.;"}, "BSplineCurve",
               "must be a whole number");
}

TEST(DamagedEntity, NumbersOfOtherProgramsAreRead) {
  for (const std::string ten : {"10", "10.", "1.0e1", "1.0D1", "+10.", "1d+1"}) {
    const ImportReport report =
        imported(iges_text_of({{.type = 110, .parameters = "110,,,," + ten + ",,;"}}));
    ASSERT_EQ(report.curves.size(), 1U) << ten;
    EXPECT_NEAR(length(report.curves[0].curve), 0.01, 1e-12) << ten;
    EXPECT_TRUE(report.diagnostics.empty()) << ten;
  }
}

TEST(DamagedEntity, EmptyNumbersInListsAreZerosWithAWarning) {
  const IgesEntity spline{.type = 126,
                          .parameters = "126,1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,7.,,0.,0.,1.;"};
  const ImportReport report = imported(iges_text_of({good, spline, spline}));
  ASSERT_EQ(report.curves.size(), 3U);
  EXPECT_NEAR(length(report.curves[2].curve), 7e-3, 1e-12);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("D3 BSplineCurve"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("read as 0; so in 2 entities"), std::string::npos);
}

TEST(DamagedEntity, PartsThatAreNotInTheFileAreNamed) {
  constexpr int part = 10000;
  const auto with = [&](const IgesEntity& whole) {
    return imported(
        iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,10.,0.,0.;", .status = part}, whole}));
  };
  for (const IgesEntity& whole : {IgesEntity{.type = 102, .parameters = "102,2,1,99;"},
                                  IgesEntity{.type = 402, .parameters = "402,2,1,99;", .form = 7}}) {
    const ImportReport report = with(whole);
    ASSERT_EQ(report.curves.size(), 1U) << whole.parameters;
    EXPECT_NEAR(length(report.curves[0].curve), 0.01, 1e-12);
    ASSERT_FALSE(report.diagnostics.empty()) << whole.parameters;
    EXPECT_NE(report.diagnostics[0].message.find("it names D99, which the file does not have"),
              std::string::npos)
        << report.diagnostics[0].message;
  }
}

TEST(DamagedEntity, ARangeThatIsLostIsTheWholeSpline) {
  const ImportReport report = imported(
      iges_text_of({{.type = 126, .parameters = "126,1,1,0,0,1,0,0.,0.,1.,1.,1.,1.,0.,0.,0.,7.,0.,0.;"}}));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 7e-3, 1e-12);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("V(0) and V(1)"), std::string::npos);
}

// The parts of a composite curve, a group and a subfigure around a damaged line.
// OpenCASCADE trims it without end.
TEST(DamagedEntity, AConicOfAFormThatIsNoneIsNamedAtOnce) {
  expect_named(
      {.type = 104, .parameters = "104,0.5,0.,1.,0.,0.,-0.5,0.,0.7575,-0.4616,-0.8971,0.3125;", .form = 8},
      "ConicArc", "its form number 8");
}

// OpenCASCADE crashes on the odd line that is left, and takes the entities behind it for others.
TEST(DamagedEntity, ALostLineOfADirectoryEntryCostsThatEntity) {
  const std::string whole = iges_text_of({good, {.type = 110, .parameters = "110,0.,0.,0.,3.,4.,0.;"}, good});
  for (const std::string lost : {"D      3\n", "D      4\n"}) {
    std::string text = whole;
    const std::size_t end = text.find(lost) + lost.size();
    text.erase(text.rfind('\n', end - 2) + 1, end - text.rfind('\n', end - 2) - 1);
    const ImportReport report = imported(text);
    ASSERT_EQ(report.curves.size(), 2U);
    for (const ImportedCurve& curve : report.curves) EXPECT_NEAR(length(curve.curve), 9e-3, 1e-12);
    ASSERT_EQ(report.diagnostics.size(), 2U);
    EXPECT_NE(report.diagnostics[0].message.find("section D has 5 lines"), std::string::npos);
    EXPECT_NE(report.diagnostics[1].where.find("D3 Line"), std::string::npos) << report.diagnostics[1].where;
    EXPECT_NE(report.diagnostics[1].message.find("a line of its directory entry is lost"), std::string::npos);
  }
}

TEST(DamagedEntity, TheOthersOfItsCompositeCurveAreRead) {
  constexpr int part = 10000;
  const ImportReport report =
      imported(iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,10.,0.,0.;", .status = part},
                             {.type = 110, .parameters = "110,10.,0.;", .status = part},
                             {.type = 110, .parameters = "110,20.,5.,0.,30.,5.,0.;", .status = part},
                             {.type = 102, .parameters = "102,3,1,3,5;", .status = part},
                             {.type = 402, .parameters = "402,2,7,11;", .form = 7, .label = "group"},
                             {.type = 110, .parameters = "110,0.,0.,0.,0.,10.,0.;", .status = part}}));
  ASSERT_EQ(report.curves.size(), 3U);
  for (const ImportedCurve& curve : report.curves) {
    EXPECT_NEAR(length(curve.curve), 0.01, 1e-12);
    EXPECT_EQ(curve.part, "group");
  }
  EXPECT_EQ(report.diagnostics.size(), 1U);
}

TEST(DamagedEntity, ThePiecesOfACompositeCurveKeepItsTransformation) {
  constexpr int part = 10000;
  const ImportReport report = imported(iges_text_of(
      {{.type = 110, .parameters = "110,0.,0.,0.,10.,0.,0.;", .status = part},
       {.type = 110, .parameters = "110,10.,0.;", .status = part},
       {.type = 102, .parameters = "102,2,1,3;", .matrix = 7},
       {.type = 124, .parameters = "124,1.,0.,0.,5.,0.,1.,0.,6.,0.,0.,1.,7.;", .status = part}}));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_LE((1e3 * start_of(report.curves[0].curve) - Eigen::Vector3d(5, 6, 7)).norm(), 1e-9);
}

TEST(DamagedEntity, CirclesOfReferencesInIgesAreNamed) {
  const std::vector<std::vector<IgesEntity>> files{
      {good, {.type = 102, .parameters = "102,1,3;"}},
      {good, {.type = 102, .parameters = "102,1,5;"}, {.type = 102, .parameters = "102,1,3;"}},
      {good, {.type = 130, .parameters = "130,3,1,0,0,0,2.,0.,0.,0.,0.,0.,1.,0.,1.;"}},
      {good, {.type = 402, .parameters = "402,2,1,3;", .form = 7}},
      {good,
       {.type = 308, .parameters = "308,0,3Habc,1,5;"},
       {.type = 408, .parameters = "408,3,0.,0.,0.,1.;"}}};
  for (const std::vector<IgesEntity>& file : files) {
    const ImportReport report = imported(iges_text_of(file));
    ASSERT_EQ(report.curves.size(), 1U) << file[1].parameters;
    EXPECT_NEAR(length(report.curves[0].curve), 9e-3, 1e-12);
    ASSERT_FALSE(report.diagnostics.empty());
    EXPECT_NE(report.diagnostics[0].message.find("a circle of references"), std::string::npos)
        << report.diagnostics[0].message;
  }
}

// The columns of a line of the directory have moved, and another line has a number that is not its own.
TEST(DamagedEntity, ALineOfTheDirectoryThatHasMovedCostsItsEntity) {
  const std::string column = std::string(32, ' ');
  const std::string form = "     110       2       2       1       ",
                    line = "     408       2       2       1       0" + column;
  std::string file = content_of(corpus_file("iges-124-transform.igs"));
  file = with(file, form + "0" + column + "D     10", form + "4294967296" + column + "D     10");
  file = with(file, line + "D     14", line + "D      7");
  const ImportReport report = imported(file);
  EXPECT_EQ(report.curves.size(), 3U);
  ASSERT_EQ(report.diagnostics.size(), 2U);
  EXPECT_NE(report.diagnostics[1].where.find("D9 Line"), std::string::npos);
}

/// What is read of a line #100 of 9 mm beside what else there is in the set.
ImportReport beside_line(const std::string& references, const std::string& entities) {
  return imported(step_text_of("#100," + references,
                               "#100 = POLYLINE('good',(#12,#101));\n"
                               "#101 = CARTESIAN_POINT('',(9.,0.,0.));\n" +
                                   entities));
}

void expect_good_line(const ImportReport& report, const std::string& label, const std::string& word) {
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 9e-3, 1e-12);
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE(report.diagnostics[0].where.find(label), std::string::npos) << report.diagnostics[0].where;
  EXPECT_NE(report.diagnostics[0].message.find(word), std::string::npos) << report.diagnostics[0].message;
}

TEST(DamagedEntity, ACrashOfTheReaderCostsTheEntityThatItCrashesOn) {
  const ImportReport report = beside_line("#110", "#110 = GEOMETRIC_CURVE_SET('',(#110));\n");
  expect_good_line(report, "#110 GeometricCurveSet", "OpenCASCADE crashes on it");
}

TEST(DamagedEntity, CirclesOfReferencesInStepAreNamed) {
  expect_good_line(beside_line("#110",
                               "#110 = COMPOSITE_CURVE('',(#111),.F.);\n"
                               "#111 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#112);\n"
                               "#112 = COMPOSITE_CURVE('',(#113),.F.);\n"
                               "#113 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#110);\n"),
                   "#112 CompositeCurve", "a circle of references");
  expect_good_line(beside_line("#110",
                               "#110 = TRIMMED_CURVE('',#110,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,"
                               ".PARAMETER.);\n"),
                   "#110 TrimmedCurve", "a circle of references");
}

TEST(DamagedEntity, ANestOfManyCurvesInStepIsNamed) {
  std::string nest = "#1000 = LINE('',#12,#102);\n#102 = VECTOR('',#14,1.);\n";
  constexpr int deep = 3000;
  for (int i = 1; i <= deep; ++i)
    nest += "#" + std::to_string(1000 + i) + " = TRIMMED_CURVE('',#" + std::to_string(999 + i) +
            ",(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n";
  expect_good_line(beside_line("#" + std::to_string(1000 + deep), nest), "TrimmedCurve",
                   "nested more than 1000 deep");
}

TEST(DamagedEntity, DirectionsOfNoLengthAreNamed) {
  const std::string none = "#120 = DIRECTION('',(0.,0.,0.));\n";
  expect_good_line(
      beside_line("#110", none + "#110 = CIRCLE('',#111,5.);\n#111 = AXIS2_PLACEMENT_3D('',#12,#120,#14);\n"),
      "#110 Circle", "#120 Direction is (0, 0, 0)");
  expect_good_line(
      beside_line("#110", none + "#110 = TRIMMED_CURVE('',#111,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),"
                                 ".T.,.PARAMETER.);\n#111 = LINE('',#12,#112);\n"
                                 "#112 = VECTOR('',#120,1.);\n"),
      "#111 Line", "#120 Direction is (0, 0, 0)");
}

// OpenCASCADE crashes on them, even where nothing is made of them.
TEST(DamagedEntity, DirectionsWithoutValuesAreNamed) {
  const std::string line = "#100 = POLYLINE('good',(#12,#101));\n#101 = CARTESIAN_POINT('',(3.,4.,0.));\n",
                    direction = "#102 = DIRECTION('');\n",
                    placement = "#103 = AXIS2_PLACEMENT_3D('',#12,#102,$);\n";
  for (const std::string others :
       {placement, placement + "#104 = CIRCLE('',#103,5.);\n",
        std::string(
            "#104 = TRIMMED_CURVE('',#105,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n"
            "#105 = LINE('',#12,#106);\n#106 = VECTOR('',#102,1.);\n")}) {
    const ImportReport report = imported(step_text_of("#100,#104", line + direction + others));
    ASSERT_EQ(report.curves.size(), 1U) << others;
    EXPECT_NEAR(length(report.curves[0].curve), 5e-3, 1e-15);
    if (others == placement) continue;
    EXPECT_TRUE(std::any_of(report.diagnostics.begin(), report.diagnostics.end(), [](const Diagnostic& d) {
      return d.message.find("#102 Direction has no values") != std::string::npos;
    })) << others;
  }
}

// A reference to nothing, or to what does not belong there, which OpenCASCADE follows.
TEST(DamagedEntity, CurvesThatLackPartsAreNamed) {
  const std::string line = "#100 = POLYLINE('good',(#12,#101));\n#101 = CARTESIAN_POINT('',(3.,4.,0.));\n";
  for (
      const std::string damaged :
      {"#104 = CIRCLE('',#105,5.);\n#105 = AXIS2_PLACEMENT_3D('',#14,#13,#14);\n",
       "#104 = TRIMMED_CURVE('',#105,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n"
       "#105 = LINE('',#12,#106);\n#106 = VECTOR('',#12,1.);\n",
       "#104 = TRIMMED_CURVE('',#105,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n"
       "#105 = LINE('',#999,#106);\n#106 = VECTOR('',#13,1.);\n",
       "#104 = POLYLINE('',(#12,#999));\n",
       "#104 = BEZIER_CURVE('',2,(#12,#13,#101),.UNSPECIFIED.,.F.,.F.);\n",
       "#104 = B_SPLINE_CURVE_WITH_KNOTS('',1,(#12,#101),.UNSPECIFIED.,.F.,.F.,$,(0.,1.),.UNSPECIFIED.);\n"}) {
    const ImportReport report = imported(step_text_of("#100,#104", line + damaged));
    ASSERT_EQ(report.curves.size(), 1U) << damaged;
    EXPECT_NEAR(length(report.curves[0].curve), 5e-3, 1e-15);
    EXPECT_TRUE(std::any_of(report.diagnostics.begin(), report.diagnostics.end(), [](const Diagnostic& d) {
      return d.message.find("missing; correct it") != std::string::npos ||
             d.message.find("has no point; correct it") != std::string::npos;
    })) << damaged;
  }
}

TEST(DamagedEntity, ValuesThatStepDoesNotAllowCostTheirInstance) {
  for (const std::string value : {"0x10", "1.5E", "ABC", "NAN", "1.2.3", "1..5", "-1.2.3E2", "0.0.5"})
    expect_good_line(beside_line("#110",
                                 "#110 = POLYLINE('bad',(#12,#111));\n"
                                 "#111 = CARTESIAN_POINT('',(" +
                                     value + ",0.,0.));\n"),
                     "#111 CARTESIAN_POINT", "is no value of a STEP file");
}

// OpenCASCADE reads 1.2 of it, and all instances behind it: no other number of the file has two points.
TEST(DamagedEntity, ANumberWithTwoPointsCostsNoStringsThatHoldOne) {
  expect_good_line(beside_line("#110",
                               "#110 = POLYLINE('version 1.2.3',(#12,#111));\n"
                               "#111 = CARTESIAN_POINT('',(1.2.3,0.,0.));\n"),
                   "#111 CARTESIAN_POINT", "'1.2.3' in it is no value of a STEP file");
}

TEST(DamagedEntity, ANumberWithTwoPointsInBrepIsNamed) {
  const ScratchDirectory scratch;
  const ImportReport drawing = import_curves(scratch.file("line.igs", iges_text_of({good})));
  const std::filesystem::path file = scratch.path() / "line.brep";
  ASSERT_TRUE(export_curves(file, {{"", drawing.curves.at(0).curve}}, LengthUnit::millimetre).empty());
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  ASSERT_TRUE(imported(text).ok());
  const std::size_t at = text.find(" 9 ", text.find("Curves 1"));
  ASSERT_NE(at, std::string::npos);
  text.replace(at, 3, " 9.0.1 ");
  const ImportReport report = imported(text);
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.diagnostics.at(0).message.find("'9.0.1'"), std::string::npos)
      << report.diagnostics[0].message;
}

TEST(DamagedEntity, CurvesOfPartsThatNothingPlacesAreToldInOneLine) {
  std::string entities = "#100 = POLYLINE('good',(#12,#101));\n#101 = CARTESIAN_POINT('',(9.,0.,0.));\n",
              items = "#11";
  for (int i = 0; i < 20; ++i) {
    entities += "#" + std::to_string(200 + i) + " = POLYLINE('',(#12,#101));\n";
    items += ",#" + std::to_string(200 + i);
  }
  const auto product = [](int n, const std::string& of) {
    const auto number = [&](int i) { return "#" + std::to_string(n + i); };
    return number(0) + " = PRODUCT('" + of + "','" + of + "','',(#8));\n" + number(1) +
           " = PRODUCT_DEFINITION_FORMATION('',''," + number(0) + ");\n" + number(2) +
           " = PRODUCT_DEFINITION('design',''," + number(1) + ",#9);\n" + number(3) +
           " = PRODUCT_DEFINITION_SHAPE('',''," + number(2) + ");\n" + number(5) +
           " = SHAPE_DEFINITION_REPRESENTATION(" + number(3) + "," + number(4) + ");\n";
  };
  entities += product(50, "whole") + "#54 = SHAPE_REPRESENTATION('',(#11),#26);\n";
  entities += product(60, "unplaced") + "#64 = SHAPE_REPRESENTATION('',(" + items + "),#26);\n";
  entities +=
      "#70 = NEXT_ASSEMBLY_USAGE_OCCURRENCE('1','1','',#52,#5,$);\n"
      "#71 = PRODUCT_DEFINITION_SHAPE('','',#70);\n"
      "#72 = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#73,#71);\n"
      "#73 = ( REPRESENTATION_RELATIONSHIP('','',#10,#54) "
      "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#74) SHAPE_REPRESENTATION_RELATIONSHIP() );\n"
      "#74 = ITEM_DEFINED_TRANSFORMATION('','',#11,#11);\n";
  const ImportReport report = imported(step_text_of("#100", entities));
  ASSERT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("20 curve(s) in all"), std::string::npos)
      << report.diagnostics[0].message;
}

// OpenCASCADE may look for what they and missing ones refer to without end.
TEST(DamagedEntity, InstancesWhoseNumberStandsTwiceAreLeftOut) {
  const ImportReport report = imported(step_text_of("#100,#102",
                                                    "#100 = POLYLINE('',(#12,#101));\n"
                                                    "#101 = CARTESIAN_POINT('',(9.,0.,0.));\n"
                                                    "#101 = CARTESIAN_POINT('',(5.,0.,0.));\n"
                                                    "#102 = POLYLINE('',(#12,#199));\n"));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 9e-3, 1e-12);
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE(report.diagnostics[0].where.find("#101 CARTESIAN_POINT"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("an instance before it has its number"), std::string::npos);
}

}  // namespace
}  // namespace nurbeam::damaged_entities
