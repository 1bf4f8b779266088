// Offset curves, replicas and pieces of conics in STEP, held to ISO 10303-42 and to the points in the file.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "nurbs/arc_length.h"
#include "nurbs/number_text.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/imported_text.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"
#include "tests/cad_import/uneven_circle.h"

namespace nurbeam::restated_step {
namespace {

struct Unit {
  std::string text;
  double in_metres;
};
const std::vector<Unit> units{{millimetres, 1e-3}, {inches, 0.0254}};

/// #100 of these entities alone, with as many diagnostics.
NurbsCurve restated_curve(const std::string& text, std::size_t diagnostics = 0) {
  const ImportReport report = import_text(text);
  EXPECT_EQ(report.diagnostics.size(), diagnostics)
      << (report.diagnostics.empty() ? "" : report.diagnostics[0].message);
  if (report.curves.size() != 1) throw std::runtime_error("expected one curve");
  return report.curves[0].curve;
}

void expect_ends(const NurbsCurve& curve, const Eigen::Vector3d& start, const Eigen::Vector3d& end,
                 double unit) {
  EXPECT_LE((start_of(curve) / unit - start).norm(), 1e-12) << start_of(curve).transpose() / unit;
  EXPECT_LE((end_of(curve) / unit - end).norm(), 1e-12) << end_of(curve).transpose() / unit;
}

TEST(RestatedStep, OffsetCurvesHaveTheirDistanceInTheUnitOfTheFile) {
  for (const Unit& unit : units)
    expect_ends(restated_curve(step_text_of("#100",
                                            "#100 = OFFSET_CURVE_3D('',#101,1.,.F.,#13);\n"
                                            "#101 = CIRCLE('',#11,10.);",
                                            "", unit.text)),
                {9, 0, 0}, {9, 0, 0}, unit.in_metres);
}

// ------------------------------------------------------------------------------------------- placements

TEST(RestatedStep, PlacementsWithoutFirstAxisHaveThatOfTheStandard) {
  // build_axes of ISO 10303-42: the first axis is x as far as it is at right angles to the third, else y.
  struct Axes {
    std::string third;
    Eigen::Vector3d first;
  };
  const std::vector<Axes> all{{"0.,1.,0.", {1, 0, 0}},
                              {"1.,0.,0.", {0, 1, 0}},
                              {"-1.,0.,0.", {0, 1, 0}},
                              {"0.,0.,-1.", {1, 0, 0}},
                              {"1.,1.,1.", Eigen::Vector3d(2, -1, -1).normalized()}};
  for (const auto& [third, first] : all) {
    const std::string placement =
        "#102 = AXIS2_PLACEMENT_3D('',#12,#103,$);\n#103 = DIRECTION('',(" + third + "));\n";
    expect_ends(restated_curve(step_text_of("#100", "#100 = ELLIPSE('',#102,5.,2.);\n" + placement)),
                5 * first, 5 * first, 1e-3);
  }
}

TEST(RestatedStep, PiecesOfConicsWhosePlacementHasNoAxesAreNoWholeConics) {
  const NurbsCurve arc = restated_curve(step_text_of(
      "#100",
      "#100 = TRIMMED_CURVE('',#101,(PARAMETER_VALUE(0.5)),(PARAMETER_VALUE(2.)),.F.,.PARAMETER.);\n"
      "#101 = CIRCLE('',#102,4.);\n#102 = AXIS2_PLACEMENT_3D('',#12,$,$);\n"));
  const auto at = [](double angle) { return Eigen::Vector3d(4 * std::cos(angle), 4 * std::sin(angle), 0); };
  expect_ends(arc, at(0.5), at(2), 1e-3);  // against the sense of the circle
  EXPECT_NEAR(length(arc), 4 * (2 * std::numbers::pi - 1.5) * 1e-3, 1e-15);
}

// ------------------------------------------------------------------------------------- closed splines

TEST(RestatedStep, ClosedSplinesWhoseEndsHaveDifferentWeightsKeepThem) {
  const NurbsCurve circle = uneven_circle(4);
  std::string poles, weights, points;
  for (int i = 0; i < circle.control_points().cols(); ++i) {
    const Eigen::Vector4d pole = circle.control_points().col(i);
    const std::string comma = i > 0 ? "," : "", number = std::to_string(200 + i);
    poles += comma + "#" + number;
    weights += comma + text_of(pole(3), 17);
    points += "#" + number + " = CARTESIAN_POINT('',(" + text_of(pole(0) / pole(3), 17) + "," +
              text_of(pole(1) / pole(3), 17) + ",0.));\n";
  }
  const NurbsCurve read = restated_curve(step_text_of(
      "#100", "#100 = ( BOUNDED_CURVE() B_SPLINE_CURVE(2,(" + poles +
                  "),.UNSPECIFIED.,.T.,.F.) B_SPLINE_CURVE_WITH_KNOTS((3,2,2,3),(0.,1.,2.,3.),.UNSPECIFIED.) "
                  "CURVE() GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE((" +
                  weights + ")) REPRESENTATION_ITEM('') );\n" + points));
  for (double u = 0; u <= 3; u += 0.0625) EXPECT_NEAR(read.point(u).norm(), 4e-3, 1e-13) << u;
}

// ------------------------------------------------------------------------------------- pieces of conics

/// #100, a piece of #101.
std::string piece(const std::string& first, const std::string& last, const std::string& master) {
  return "#100 = TRIMMED_CURVE('piece',#101,(" + first + "),(" + last + "),.T.,." + master + ".);\n";
}
const std::string parabola = "#101 = PARABOLA('',#11,2.);\n";
const std::string points =
    "#200 = CARTESIAN_POINT('',(2.,-4.,0.));\n#201 = CARTESIAN_POINT('',(4.5,6.,0.));\n";
const std::string first_u = "PARAMETER_VALUE(-1.)", last_u = "PARAMETER_VALUE(1.5)";

/// C + F (u^2 x + 2 u y) with F = 2, from u = -1 to 1.5.
void expect_parabola(const NurbsCurve& curve, double unit) {
  expect_ends(curve, {2, -4, 0}, {4.5, 6, 0}, unit);
  EXPECT_EQ(curve.degree(), 2);
  for (double t = 0; t <= 1; t += 0.125) {
    const Eigen::Vector3d p =
        curve.point(curve.knots().start() + t * (curve.knots().end() - curve.knots().start())) / unit;
    EXPECT_NEAR(p.y() * p.y(), 8 * p.x(), 1e-12);
  }
}

TEST(RestatedStep, PiecesWhosePointsAreNotTheirEndsAreNamed) {
  const auto warning_of = [](const std::string& trims, const std::string& places, const Unit& unit) {
    const ImportReport report = import_text(step_text_of(
        "#100", "#100 = TRIMMED_CURVE('arc',#101," + trims + ");\n#101 = CIRCLE('',#11,5.);\n" + places, "",
        unit.text));
    EXPECT_EQ(report.curves.size(), 1U);
    return report.diagnostics.empty() ? "" : report.diagnostics[0].where + report.diagnostics[0].message;
  };
  const auto at = [](double radius) {
    return "#200 = CARTESIAN_POINT('',(" + std::to_string(radius) +
           ",0.,0.));\n#201 = CARTESIAN_POINT('',(0.,5.,0.));\n";
  };
  for (const Unit& unit : units) {
    const std::string mm = 1e3 * unit.in_metres > 1 ? "76.2 mm" : "3 mm";
    EXPECT_NE(warning_of("(#200),(#201),.T.,.CARTESIAN.", at(8), unit).find("'arc'it begins " + mm),
              std::string::npos);
    EXPECT_EQ(warning_of("(#200),(#201),.T.,.CARTESIAN.", at(5.004), unit), "");
  }
  const std::string contrary =
      warning_of("(#200,PARAMETER_VALUE(0.)),(#201,PARAMETER_VALUE(3.1415926535897932)),.T.,.PARAMETER.",
                 at(5), units[0]);
  EXPECT_NE(contrary.find("ends " + text_of(std::sqrt(50.0)) + " mm"), std::string::npos) << contrary;
}

TEST(RestatedStep, PiecesOfSplinesThatGoBeyondTheirEndsAreNamed) {
  const auto read = [](const std::string& first, const std::string& last) {
    return import_text(step_text_of(
        "#100", "#100 = TRIMMED_CURVE('piece',#101,(PARAMETER_VALUE(" + first + ")),(PARAMETER_VALUE(" +
                    last +
                    ")),.T.,.PARAMETER.);\n#101 = B_SPLINE_CURVE_WITH_KNOTS('',2,(#110,#111,#112,#113),"
                    ".UNSPECIFIED.,.F.,.F.,(3,1,3),(0.,1.,2.),.UNSPECIFIED.);\n"
                    "#110 = CARTESIAN_POINT('',(0.,0.,0.));\n#111 = CARTESIAN_POINT('',(1.,2.,0.));\n"
                    "#112 = CARTESIAN_POINT('',(3.,2.,0.));\n#113 = CARTESIAN_POINT('',(4.,0.,0.));\n"));
  };
  EXPECT_TRUE(read("0.", "2.0000000001").diagnostics.empty());
  for (const auto& [first, last] : {std::pair("-0.5", "1.5"), std::pair("0.5", "7.")}) {
    const ImportReport report = read(first, last);
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
    EXPECT_NE(report.diagnostics[0].where.find("'piece'"), std::string::npos);
    EXPECT_NE(report.diagnostics[0].message.find("beyond the ends of its curve, at 0 and 2"),
              std::string::npos)
        << report.diagnostics[0].message;
  }
}

TEST(RestatedStep, PiecesOfParabolasGoByTheirPoints) {
  for (const Unit& unit : units) {
    const auto read = [&](const std::string& first, const std::string& last, const std::string& master,
                          std::size_t warnings) {
      expect_parabola(
          restated_curve(step_text_of("#100", piece(first, last, master) + parabola + points, "", unit.text),
                         warnings),
          unit.in_metres);
    };
    for (const std::string master : {"PARAMETER", "CARTESIAN", "UNSPECIFIED"}) {
      read("#200," + first_u, "#201," + last_u, master, 0);
      read("#200,PARAMETER_VALUE(-1.25)", "#201," + last_u, master, 1);  // contradict each other
    }
  }
  // As OpenCASCADE has them, lengths.
  expect_parabola(restated_curve(step_text_of(
                      "#100", piece("#200,PARAMETER_VALUE(-4.)", "#201,PARAMETER_VALUE(6.)", "PARAMETER") +
                                  parabola + points)),
                  1e-3);
}

TEST(RestatedStep, PiecesOfParabolasWithoutPointsAreThoseOfTheStandardWithAWarning) {
  for (const Unit& unit : units) {
    const ImportReport report =
        import_text(step_text_of("#100", piece(first_u, last_u, "PARAMETER") + parabola, "", unit.text));
    ASSERT_EQ(report.curves.size(), 1U);
    expect_parabola(report.curves[0].curve, unit.in_metres);
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
    EXPECT_NE(report.diagnostics[0].where.find("#100 TrimmedCurve 'piece'"), std::string::npos);
    for (const char* text : {"-1 to 1.5", "ISO 10303-42", "y = -1 mm to 1.5 mm", "cartesian"})
      EXPECT_NE(report.diagnostics[0].message.find(text), std::string::npos) << report.diagnostics[0].message;
  }
}

TEST(RestatedStep, PiecesOfParabolasByOpenCascadeHaveLengths) {
  std::string text =
      step_text_of("#100", piece("PARAMETER_VALUE(-4.)", "PARAMETER_VALUE(6.)", "PARAMETER") + parabola);
  const std::string nobody = "(''),(''),'','',''";
  text.replace(text.find(nobody), nobody.size(), "(''),(''),'Open CASCADE STEP processor 7.6','FreeCAD',''");
  expect_parabola(restated_curve(text), 1e-3);
}

TEST(RestatedStep, PiecesOfParabolasInEdgesGoByTheVertices) {
  for (const bool same_sense : {true, false}) {
    const std::string edge =
        "#300 = VERTEX_POINT('',#200);\n#301 = VERTEX_POINT('',#201);\n#302 = EDGE_CURVE('',#30" +
        std::string(same_sense ? "0,#301,#100,.T." : "1,#300,#100,.F.") +
        ");\n#303 = ORIENTED_EDGE('',*,*,#302,.T.);\n"
        "#304 = EDGE_LOOP('',(#303));\n#305 = WIRE_SHELL('',(#304));\n"
        "#306 = SHELL_BASED_WIREFRAME_MODEL('',(#305));\n"
        "#307 = SHELL_BASED_WIREFRAME_SHAPE_REPRESENTATION('',(#306),#26);\n"
        "#308 = SHAPE_REPRESENTATION_RELATIONSHIP('','',#10,#307);\n#110 = CIRCLE('good',#11,1.);\n";
    const ImportReport report =
        import_text(step_text_of("#110", piece(first_u, last_u, "PARAMETER") + parabola + points + edge));
    EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics.at(0).message;
    ASSERT_EQ(report.curves.size(), 2U);
    const NurbsCurve& curve = report.curves[1].curve;
    const bool forward = start_of(curve).y() < 0;
    expect_parabola(forward ? curve : curve.reversed(), 1e-3);
  }
}

TEST(RestatedStep, PiecesOfHyperbolasAreThoseOfTheStandard) {
  // C + 3 cosh u x + 2 sinh u y
  for (const Unit& unit : units)
    expect_ends(restated_curve(step_text_of(
                    "#100", piece(first_u, last_u, "PARAMETER") + "#101 = HYPERBOLA('',#11,3.,2.);\n", "",
                    unit.text)),
                {3 * std::cosh(1), -2 * std::sinh(1), 0}, {3 * std::cosh(1.5), 2 * std::sinh(1.5), 0},
                unit.in_metres);
}

// ---------------------------------------------------------------------------------------------- replicas

/// #100, a replica of #101, whose transformation has these axes, the origin (1, 2, 3) and this scale.
std::string replica(const std::string& axis1, const std::string& axis2, const std::string& scale,
                    const std::string& axis3) {
  return "#100 = CURVE_REPLICA('copy',#101,#102);\n#102 = CARTESIAN_TRANSFORMATION_OPERATOR_3D('','',''," +
         axis1 + "," + axis2 + ",#103," + scale + "," + axis3 +
         ");\n#103 = CARTESIAN_POINT('',(1.,2.,3.));\n#104 = DIRECTION('',(0.,1.,0.));\n"
         "#105 = DIRECTION('',(0.,-1.,0.));\n#106 = DIRECTION('',(0.,0.,-1.));\n";
}
const std::string arc =
    "#101 = TRIMMED_CURVE('',#110,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.5707963267948966)),.T.,.PARAMETER.);\n"
    "#110 = CIRCLE('',#111,10.);\n#111 = AXIS2_PLACEMENT_3D('',#112,#13,#14);\n"
    "#112 = CARTESIAN_POINT('',(0.,0.,4.));\n";

TEST(RestatedStep, ReplicasAreScaledTurnedAndMirrored) {
  struct Case {
    std::string transformation;
    Eigen::Matrix3d matrix;
  };
  Eigen::Matrix3d turned;
  turned << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  const std::vector<Case> cases{
      {replica("$", "$", "2.", "$"), 2 * Eigen::Matrix3d::Identity()},
      {replica("#104", "$", "$", "$"), turned},
      {replica("#104", "$", "0.5", "#13"), 0.5 * turned},
      {replica("#14", "#105", "3.", "#13"), 3 * Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix()},
      {replica("#14", "#105", "$", "$"), Eigen::Vector3d(1, -1, 1).asDiagonal().toDenseMatrix()},
      {replica("#14", "#104", "2.", "#106"), 2 * Eigen::Vector3d(1, 1, -1).asDiagonal().toDenseMatrix()},
  };
  for (const Unit& unit : units)
    for (const auto& [transformation, matrix] : cases) {
      SCOPED_TRACE(transformation);
      const NurbsCurve curve = restated_curve(step_text_of("#100", transformation + arc, "", unit.text));
      const Eigen::Vector3d origin(1, 2, 3);
      expect_ends(curve, origin + matrix * Eigen::Vector3d(10, 0, 4),
                  origin + matrix * Eigen::Vector3d(0, 10, 4), unit.in_metres);
      const Eigen::Vector3d centre = origin + matrix * Eigen::Vector3d(0, 0, 4);
      for (double t = 0; t <= 1; t += 0.125) {
        const double u = curve.knots().start() + t * (curve.knots().end() - curve.knots().start());
        EXPECT_NEAR((curve.point(u) / unit.in_metres - centre).norm(), 10 * matrix.col(0).norm(), 1e-12);
      }
    }
}

// -------------------------------------------------------------------------------------- pieces of pieces

// The parameter of a piece counts from where it begins, along it (ISO 10303-42).
TEST(RestatedStep, PiecesOfPiecesCountFromWhereTheseBegin) {
  const auto piece = [](const std::string& number, const std::string& basis, double first, double last,
                        bool along) {
    return "#" + number + " = TRIMMED_CURVE('',#" + basis + ",(PARAMETER_VALUE(" + text_of(first) +
           ")),(PARAMETER_VALUE(" + text_of(last) + "))," + (along ? ".T." : ".F.") + ",.PARAMETER.);\n";
  };
  const std::string line = "#110 = LINE('',#12,#111);\n#111 = VECTOR('',#14,1.);\n",
                    circle = "#110 = CIRCLE('',#11,5.);\n";
  for (const Unit& unit : units) {
    const auto read = [&](const std::string& text) {
      return restated_curve(step_text_of("#100", text, "", unit.text));
    };
    expect_ends(read(piece("100", "101", 1, 3, true) + piece("101", "110", 2, 8, true) + line), {3, 0, 0},
                {5, 0, 0}, unit.in_metres);
    expect_ends(read(piece("100", "101", 3, 1, false) + piece("101", "110", 2, 8, true) + line), {5, 0, 0},
                {3, 0, 0}, unit.in_metres);
    expect_ends(read(piece("100", "101", 1, 3, true) + piece("101", "110", 8, 2, false) + line), {7, 0, 0},
                {5, 0, 0}, unit.in_metres);
    expect_ends(read(piece("100", "101", 0.5, 1, true) + piece("101", "102", 1, 3, true) +
                     piece("102", "110", 2, 8, true) + line),
                {3.5, 0, 0}, {4, 0, 0}, unit.in_metres);
    const auto on_circle = [](double angle) {
      return Eigen::Vector3d(5 * std::cos(angle), 5 * std::sin(angle), 0);
    };
    expect_ends(read(piece("100", "101", 0.25, 1, true) + piece("101", "110", 6, 8, true) + circle),
                on_circle(6.25), on_circle(7), unit.in_metres);
  }
}

// ------------------------------------------------------------------------------------------ mapped items

/// A file in which the arc #101 is mapped by the operator of a replica; also, where that is wanted, by an
/// axis placement at the origin, which comes first.
std::string mapped(const std::string& transformation, const std::string& unit, bool also_at_origin = false) {
  std::string text = step_text_of("#101", transformation + arc, "", unit);
  text.erase(text.find("#100 = CURVE_REPLICA"),
             std::string("#100 = CURVE_REPLICA('copy',#101,#102);\n").size());
  text =
      with(text, "#10 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);",
           std::string("#10 = SHAPE_REPRESENTATION('',(#11,") + (also_at_origin ? "#203," : "") +
               "#202),#26);\n#200 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);\n"
               "#201 = REPRESENTATION_MAP(#11,#200);\n#202 = MAPPED_ITEM('',#201,#102);\n" +
               (also_at_origin ? "#203 = MAPPED_ITEM('',#201,#11);\n" : ""));
  return text;
}

TEST(RestatedStep, MappedItemsAreScaledTurnedAndMirroredAsReplicasAre) {
  for (const Unit& unit : units)
    for (const auto& [axis1, axis2, scale, axis3] : {std::array<std::string, 4>{"$", "$", "2.", "$"},
                                                     {"#104", "$", "$", "$"},
                                                     {"#104", "$", "0.5", "#13"},
                                                     {"#14", "#105", "3.", "#13"},
                                                     {"#14", "#105", "$", "$"},
                                                     {"#14", "#104", "2.", "#106"}}) {
      const std::string transformation = replica(axis1, axis2, scale, axis3);
      SCOPED_TRACE(transformation);
      const NurbsCurve witness = restated_curve(step_text_of("#100", transformation + arc, "", unit.text));
      const NurbsCurve curve = restated_curve(mapped(transformation, unit.text));
      expect_ends(curve, start_of(witness) / unit.in_metres, end_of(witness) / unit.in_metres,
                  unit.in_metres);
      EXPECT_NEAR(length(curve), length(witness), 1e-13);
    }
}

TEST(RestatedStep, OperatorsMayBeWrittenAsComplexInstances) {
  const std::string simple = replica("#14", "#105", "3.", "#13");
  const std::string complex = with(
      simple, "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#14,#105,#103,3.,#13)",
      "(CARTESIAN_TRANSFORMATION_OPERATOR(#14,#105,#103,3.)CARTESIAN_TRANSFORMATION_OPERATOR_3D(#13)"
      "FUNCTIONALLY_DEFINED_TRANSFORMATION('','')GEOMETRIC_REPRESENTATION_ITEM()REPRESENTATION_ITEM(''))");
  const NurbsCurve witness = restated_curve(step_text_of("#100", simple + arc));
  for (const std::string& text : {step_text_of("#100", complex + arc), mapped(complex, units[0].text)})
    expect_ends(restated_curve(text), start_of(witness) / 1e-3, end_of(witness) / 1e-3, 1e-3);
}

TEST(RestatedStep, AScaledMappedItemLeavesTheOthersOfItsShapeAlone) {
  const ImportReport report = import_text(mapped(replica("$", "$", "2.", "$"), units[0].text, true));
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_TRUE(report.diagnostics.empty());
  expect_ends(report.curves[0].curve, {10, 0, 4}, {0, 10, 4}, 1e-3);
  expect_ends(report.curves[1].curve, {21, 2, 11}, {1, 22, 11}, 1e-3);
}

TEST(RestatedStep, MappedItemsWithoutAPlaceAreNamed) {
  const auto expect_left_out = [](const std::string& text, const std::string& reason) {
    const ImportReport report = import_text(text);
    ASSERT_EQ(report.curves.size(), 1U);
    expect_ends(report.curves[0].curve, {10, 0, 4}, {0, 10, 4}, 1e-3);
    ASSERT_FALSE(report.diagnostics.empty());
    EXPECT_NE(report.diagnostics.back().where.find("#202 MappedItem"), std::string::npos);
    EXPECT_NE(report.diagnostics.back().message.find(reason), std::string::npos)
        << report.diagnostics.back().message;
  };
  const std::string good = mapped(replica("$", "$", "2.", "$"), units[0].text, true);
  expect_left_out(with(good, ",2.,", ",-2.,"), "its scale is -2");
  expect_left_out(with(good, ",2.,", ",0.,"), "its scale is 0");
  expect_left_out(with(good, "#201,#102", "#201,#103"), "neither AXIS2_PLACEMENT_3D nor");
  expect_left_out(with(good, "#103,2.", "$,2."), "no origin");
}

TEST(RestatedStep, AReplicaOfAReplicaHasBothScales) {
  const std::string text =
      replica("$", "$", "2.", "$") + "#101 = CURVE_REPLICA('',#120,#102);\n#120 = CIRCLE('',#11,10.);\n";
  expect_ends(restated_curve(step_text_of("#100", text)), {1 + 2 * 1 + 40, 2 + 2 * 2, 3 + 2 * 3},
              {1 + 2 * 1 + 40, 2 + 2 * 2, 3 + 2 * 3}, 1e-3);
}

TEST(RestatedStep, APieceOfAReplicaOfAParabolaIsScaled) {
  const std::string text = "#99 = TRIMMED_CURVE('',#100,(" + first_u + "),(" + last_u +
                           "),.T.,.PARAMETER.);\n" + replica("$", "$", "2.", "$") + parabola;
  expect_ends(restated_curve(step_text_of("#99", text), 1), {5, -6, 3}, {10, 14, 3}, 1e-3);
}

TEST(RestatedStep, ReplicasThatAreNotReadAreNamed) {
  const auto refused = [](const std::string& references, const std::string& entities,
                          const std::string& where, const std::string& text) {
    const ImportReport report =
        import_text(step_text_of(references + ",#190", entities + "#190 = CIRCLE('good',#11,1.);\n"));
    ASSERT_EQ(report.curves.size(), 1U);
    EXPECT_EQ(report.curves[0].name, "good");
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_NE(report.diagnostics[0].where.find(where), std::string::npos) << report.diagnostics[0].where;
    EXPECT_NE(report.diagnostics[0].message.find(text), std::string::npos) << report.diagnostics[0].message;
  };
  refused("#100", replica("$", "$", "-2.", "$") + arc, "#100 CurveReplica 'copy'", "its scale is -2");
  refused("#100",
          replica("$", "$", "2.", "$") +
              "#101 = OFFSET_CURVE_3D('',#120,1.,.F.,#13);\n#120 = ELLIPSE('',#11,10.,5.);\n",
          "#100 CurveReplica 'copy'", "draw the curve itself");
  refused("#99",
          "#99 = TRIMMED_CURVE('cut',#100,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.)),.T.,.PARAMETER.);\n" +
              replica("$", "$", "2.", "$") + "#101 = CIRCLE('',#11,10.);\n",
          "#99 TrimmedCurve 'cut'", "trim the curve itself");
}

}  // namespace
}  // namespace nurbeam::restated_step
