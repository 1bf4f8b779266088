// Curves that OpenCASCADE makes no shape of: read by other ways where they can be, else named.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "cad_import/export_into_step.h"
#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/imported_text.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"
#include "tests/support/curves.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

/// The file with a circle that is read anyhow, and these entities, which are in no set of curves.
ImportReport import_beside_a_circle(const std::string& entities, const std::string& in_set = "",
                                    const std::string& unit = millimetres) {
  return import_text(step_text_of("#100" + in_set, "#100 = CIRCLE('good',#11,1.);\n" + entities, "", unit));
}

std::string points(const std::string& first_number, const std::vector<Eigen::Vector3d>& places) {
  std::string text;
  int number = std::stoi(first_number);
  for (const Eigen::Vector3d& p : places)
    text += "#" + std::to_string(number++) + " = CARTESIAN_POINT('',(" + std::to_string(p.x()) + "," +
            std::to_string(p.y()) + "," + std::to_string(p.z()) + "));\n";
  return text;
}

const ImportedCurve* named(const ImportReport& report, const std::string& name) {
  const auto at = std::find_if(report.curves.begin(), report.curves.end(),
                               [&](const ImportedCurve& curve) { return curve.name == name; });
  return at == report.curves.end() ? nullptr : &*at;
}

TEST(LostCurves, ARationalBezierCurveIsReadExactly) {
  // A quarter of the unit circle.
  const std::string arc =
      points("200", {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) +
      "#110 = ( BEZIER_CURVE() BOUNDED_CURVE() B_SPLINE_CURVE(2,(#200,#201,#202),.UNSPECIFIED.,.F.,.F.) CURVE() "
      "GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE((1.,0.70710678118654752,1.)) "
      "REPRESENTATION_ITEM('arc') );\n";
  for (const auto& [unit, size] : {std::pair{millimetres, 1e-3}, {inches, 0.0254}}) {
    const ImportReport report = import_beside_a_circle(arc, ",#110", unit);
    EXPECT_TRUE(report.diagnostics.empty());
    const ImportedCurve* curve = named(report, "arc");
    ASSERT_NE(curve, nullptr);
    EXPECT_TRUE(curve->exact);
    for (double u = 0; u <= 1; u += 0.125) EXPECT_NEAR(curve->curve.point(u).norm(), size, 1e-16);
  }
}

/// #110, of degree 30, whose control points have x from 0 to 30.
std::string steep_curve() {
  std::vector<Eigen::Vector3d> places;
  std::string list;
  for (int i = 0; i <= 30; ++i) {
    places.emplace_back(i, i % 2, 0);
    list += (i > 0 ? ",#" : "#") + std::to_string(200 + i);
  }
  return points("200", places) + "#110 = B_SPLINE_CURVE_WITH_KNOTS('steep',30,(" + list +
         "),.UNSPECIFIED.,.F.,.F.,(31,31),(0.,1.),.UNSPECIFIED.);\n";
}

TEST(LostCurves, ADegreeAboveTwentyFiveIsRead) {
  const ImportReport report = import_beside_a_circle(steep_curve(), ",#110");
  EXPECT_TRUE(report.diagnostics.empty());
  const ImportedCurve* curve = named(report, "steep");
  ASSERT_NE(curve, nullptr);
  EXPECT_EQ(curve->curve.degree(), 30);
  // Bernstein polynomials reproduce x = 30 u / 30 of evenly spread points.
  EXPECT_NEAR(curve->curve.point(0.3).x(), 0.3 * 30e-3, 1e-16);
}

/// A wire whose edge "side" lies on the line along x through #200.
std::string wireframe_of_a_side(const std::string& first, const std::string& last, const std::string& sense) {
  return "#120 = VERTEX_POINT(''," + first + ");\n#121 = VERTEX_POINT(''," + last +
         ");\n#122 = DIRECTION('',(1.,0.,0.));\n"
         "#123 = VECTOR('',#122,1.);\n#124 = LINE('',#200,#123);\n"
         "#125 = EDGE_CURVE('side',#120,#121,#124," +
         sense +
         ");\n#126 = ORIENTED_EDGE('',*,*,#125,.T.);\n"
         "#127 = EDGE_LOOP('',(#126));\n#128 = WIRE_SHELL('',(#127));\n"
         "#129 = SHELL_BASED_WIREFRAME_MODEL('',(#128));\n"
         "#130 = SHELL_BASED_WIREFRAME_SHAPE_REPRESENTATION('',(#129),#26);\n"
         "#131 = SHAPE_REPRESENTATION_RELATIONSHIP('','',#10,#130);\n";
}

TEST(LostCurves, AnEdgeOfAWireRunsFromItsFirstVertexToItsLast) {
  const std::string line = points("200", {{0, 0, 0}, {3, 0, 0}});
  for (const auto& [first, last, sense] :
       {std::array{"#200", "#201", ".T."}, std::array{"#201", "#200", ".F."}}) {
    const ImportReport wire = import_beside_a_circle(line + wireframe_of_a_side(first, last, sense));
    ASSERT_NE(named(wire, "side"), nullptr);
    const double start = sense == std::string(".T.") ? 0 : 3e-3;
    EXPECT_NEAR(start_of(named(wire, "side")->curve).x(), start, 1e-15);
    EXPECT_NEAR(end_of(named(wire, "side")->curve).x(), 3e-3 - start, 1e-15);
  }
}

TEST(LostCurves, AnEdgeOfAWireIsInTheUnitOfTheFileAndOnItsLayer) {
  const std::string line = points("200", {{0, 0, 0}, {3, 0, 0}});
  const std::string layer = "#140 = PRESENTATION_LAYER_ASSIGNMENT('wires','',(#125));\n";
  const ImportReport wire =
      import_beside_a_circle(line + wireframe_of_a_side("#200", "#201", ".T.") + layer, "", inches);
  ASSERT_NE(named(wire, "side"), nullptr);
  EXPECT_NEAR(length(named(wire, "side")->curve), 3 * 0.0254, 1e-15);
  EXPECT_EQ(named(wire, "side")->layer, "wires");
}

TEST(LostCurves, AHyperbolaBoundsAWireToo) {
  // x = 3 cosh u, y = 2 sinh u from u = -1 to 3.
  const std::string ends = points(
      "200", {{3 * std::cosh(1.0), -2 * std::sinh(1.0), 0}, {3 * std::cosh(3.0), 2 * std::sinh(3.0), 0}});
  std::string wire = wireframe_of_a_side("#200", "#201", ".T.");
  const std::string on_line = "#124 = LINE('',#200,#123)";
  wire.replace(wire.find(on_line), on_line.size(), "#124 = HYPERBOLA('',#11,3.,2.)");
  const ImportReport report = import_beside_a_circle(ends + wire);
  ASSERT_NE(named(report, "side"), nullptr);
  const NurbsCurve& side = named(report, "side")->curve;
  EXPECT_NEAR(start_of(side).y(), -2e-3 * std::sinh(1.0), 1e-9);
  EXPECT_NEAR(end_of(side).y(), 2e-3 * std::sinh(3.0), 1e-9);
  for (double u = 0; u <= 1; u += 0.125) {
    const Eigen::Vector3d at =
        side.point(side.knots().start() + u * (side.knots().end() - side.knots().start()));
    EXPECT_NEAR(std::pow(at.x() / 3e-3, 2) - std::pow(at.y() / 2e-3, 2), 1, 1e-11);
  }
}

TEST(LostCurves, ACurveOfASetIsReadBesideWhatIsMadeOfIt) {
  const ImportReport report = import_beside_a_circle(
      steep_curve() + "#112 = OFFSET_CURVE_3D('beside',#110,1.,.F.,#13);\n", ",#110,#112");
  ASSERT_NE(named(report, "steep"), nullptr);
  EXPECT_NEAR(named(report, "steep")->curve.point(0.3).x(), 0.3 * 30e-3, 1e-16);
}

TEST(LostCurves, AnglesWithoutAUnitAreRadiansWithAWarning) {
  std::string text = step_text_of("#101",
                                  "#100 = CIRCLE('',#11,2.);\n#101 = TRIMMED_CURVE('arc',#100,"
                                  "(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(1.5)),.T.,.PARAMETER.);\n");
  const std::string units = "(#27,#28,#29)";
  text.replace(text.find(units), units.size(), "(#27,#29)");
  const ImportReport report = import_text(text);
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 3e-3, 1e-15);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("radians are assumed"), std::string::npos);
}

TEST(LostCurves, SupplementalGeometryWireframesAndPolyLoopsAreRead) {
  const std::string line = points("200", {{0, 0, 0}, {3, 0, 0}, {3, 4, 0}});
  const ImportReport supplemental = import_beside_a_circle(
      "#110 = ELLIPSE('rim',#11,3.,1.);\n"
      "#150 = CONSTRUCTIVE_GEOMETRY_REPRESENTATION('supplemental geometry',(#110),#26);\n"
      "#151 = CONSTRUCTIVE_GEOMETRY_REPRESENTATION_RELATIONSHIP('supplemental geometry','',#10,#150);\n");
  ASSERT_NE(named(supplemental, "rim"), nullptr);
  EXPECT_EQ(named(supplemental, "rim")->part, "curves");
  EXPECT_NEAR(length(named(supplemental, "rim")->curve), 13.364893220555258e-3, 1e-12);
  const ImportReport wireframe = import_beside_a_circle(line + wireframe_of_a_side("#200", "#201", ".T."));
  ASSERT_NE(named(wireframe, "side"), nullptr);
  EXPECT_NEAR(length(named(wireframe, "side")->curve), 3e-3, 1e-15);
  const ImportReport loop =
      import_beside_a_circle(line + "#110 = POLY_LOOP('triangle',(#200,#201,#202));\n", ",#110");
  ASSERT_NE(named(loop, "triangle"), nullptr);
  EXPECT_EQ(named(loop, "triangle")->part, "curves");
  EXPECT_TRUE(loop.diagnostics.empty());
  EXPECT_NEAR(length(named(loop, "triangle")->curve), 12e-3, 1e-15);
}

TEST(LostCurves, SupplementalGeometryInAnAssemblyLiesInItsPartInItsOwnUnit) {
  // A part that is placed at 100 and 300 mm and turned by 90 degrees, with a line of 2 cm besides.
  const ImportReport report = import_curves(test::source_directory() / "tests/fuzz/seeds/supplemental.step");
  std::map<std::string, NurbsCurve> helps;
  for (const ImportedCurve& curve : report.curves)
    if (curve.name == "help") helps.emplace(curve.part, curve.curve);
  ASSERT_EQ(helps.size(), 2U);
  for (const auto& [part, x] : {std::pair{"curves/left", 0.1}, {"curves/right", 0.3}}) {
    ASSERT_TRUE(helps.contains(part)) << part;
    EXPECT_LE((start_of(helps.at(part)) - Eigen::Vector3d(x, 0, 0)).norm(), 1e-15);
    EXPECT_LE((end_of(helps.at(part)) - Eigen::Vector3d(x, 0.02, 0)).norm(), 1e-15);
  }
}

/// Assembly "curves" with a circle of its own and the part "rope" at 100 and at 300 mm, turned by 90 degrees:
/// its set of curves, in inches, holds these.
std::string assembly_with(const std::string& references, const std::string& entities) {
  return step_text_of(
      "#100",
      "#100 = CIRCLE('good',#11,1.);\n"
      "#51 = PRODUCT_DEFINITION('design','',#52,#9);\n#52 = PRODUCT_DEFINITION_FORMATION('','',#53);\n"
      "#53 = PRODUCT('rope','rope','',(#8));\n#54 = SHAPE_DEFINITION_REPRESENTATION(#56,#55);\n"
      "#55 = SHAPE_REPRESENTATION('rope',(#11),#140);\n#56 = PRODUCT_DEFINITION_SHAPE('','',#51);\n"
      "#57 = GEOMETRIC_CURVE_SET('',(" +
          references +
          "));\n"
          "#58 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#57),#140);\n"
          "#59 = SHAPE_REPRESENTATION_RELATIONSHIP('','',#55,#58);\n"
          "#140 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#141,#28,#29)) "
          "REPRESENTATION_CONTEXT('','3D') );\n#141 = " +
          inches + ";\n" + occurrence(60, "left", 100) + occurrence(80, "right", 300) + entities);
}

TEST(LostCurves, OfPartsOfAnAssemblyStandAtTheirPlacesInTheirUnit) {
  // A piece of an ellipse whose edge has ends of its own, so that OpenCASCADE reads it with its own factors.
  const std::string edge =
      points("300", {{3, 0, 0}, {0, 1, 0}}) +
      "#320 = VERTEX_POINT('',#300);\n#321 = VERTEX_POINT('',#301);\n#322 = ELLIPSE('',#11,3.,1.);\n"
      "#323 = EDGE_CURVE('rim',#320,#321,#322,.T.);\n";
  const std::string strand =
      points("400", {{0, 0, 0}, {2, 0, 0}}) + "#402 = POLYLINE('strand',(#400,#401));\n";
  for (const bool beside_others : {true, false}) {
    const std::string references = beside_others ? "#110,#323,#402" : "#110,#323";
    const ImportReport report =
        import_text(assembly_with(references, steep_curve() + edge + (beside_others ? strand : "")));
    EXPECT_EQ(report.diagnostics.size(), 1U);  // the note that there are two units
    std::map<std::string, NurbsCurve> found;
    for (const ImportedCurve& curve : report.curves)
      found.emplace(curve.part + ":" + curve.name, curve.curve);
    for (const auto& [part, x] : {std::pair{"curves/left", 0.1}, {"curves/right", 0.3}}) {
      SCOPED_TRACE(std::string(part) + " of " + references);
      const auto end_is = [&](const std::string& name, double y) {
        ASSERT_TRUE(found.contains(part + name));
        EXPECT_LE((end_of(found.at(part + name)) - Eigen::Vector3d(x, y, 0)).norm(), 1e-14);
      };
      end_is(":steep", 30 * 0.0254);
      ASSERT_TRUE(found.contains(std::string(part) + ":rim"));
      EXPECT_LE((start_of(found.at(std::string(part) + ":rim")) - Eigen::Vector3d(x, 3 * 0.0254, 0)).norm(),
                1e-14);
      if (beside_others) end_is(":strand", 2 * 0.0254);
    }
  }
}

TEST(LostCurves, ThoseOfPartsAreExchangedAtTheirPlaces) {
  const ScratchDirectory scratch;
  const auto source = scratch.file("assembly.step", assembly_with("#110", steep_curve())),
             target = scratch.path() / "moved.step";
  const ImportReport before = import_curves(source);
  const auto right = std::find_if(before.curves.begin(), before.curves.end(),
                                  [](const ImportedCurve& curve) { return curve.part == "curves/right"; });
  ASSERT_NE(right, before.curves.end());
  const NurbsCurve moved = line({0.3, 0, 0}, {0.3, 0.1, 0.2});
  const auto warnings = export_into_step(source, target, {{right->curve, moved, "steep"}});
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].message.find("stands at 2 places"), std::string::npos) << warnings[0].message;
  const ImportReport after = import_curves(target);
  ASSERT_EQ(after.curves.size(), 3U);
  for (const ImportedCurve& curve : after.curves) {
    if (curve.name != "steep") continue;
    const double x = curve.part == "curves/right" ? 0.3 : 0.1;
    EXPECT_LE((end_of(curve.curve) - Eigen::Vector3d(x, 0.1, 0.2)).norm(), 1e-14) << curve.part;
  }
}

/// The one warning, and that the circle was read all the same.
std::string only_warning(const ImportReport& report) {
  EXPECT_NE(named(report, "good"), nullptr);
  EXPECT_EQ(report.diagnostics.size(), 1U);
  if (report.diagnostics.empty()) return "";
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  return report.diagnostics[0].where + ": " + report.diagnostics[0].message;
}

TEST(LostCurves, WhatCannotBeReadIsNamed) {
  const auto told = [](const ImportReport& report, const std::string& what) {
    const std::string warning = only_warning(report);
    EXPECT_NE(warning.find(what), std::string::npos) << warning;
  };
  told(import_beside_a_circle("#110 = CIRCLE('inside out',#11,-2.);\n", ",#110"),
       "#110 Circle 'inside out': not read: its radius is -2; it must be positive");
  told(import_beside_a_circle("", ",#777"), "it refers to #777, which the file does not have");
  told(import_beside_a_circle("#160 = COORDINATES_LIST('',2,((0.,0.,0.),(3.,4.,0.)));\n"
                              "#161 = TESSELLATED_CURVE_SET('mesh',#160,((1,2)));\n"
                              "#162 = TESSELLATED_GEOMETRIC_SET('',(#161));\n"
                              "#163 = TESSELLATED_SHAPE_REPRESENTATION('',(#162),#26);\n"
                              "#164 = SHAPE_REPRESENTATION_RELATIONSHIP('','',#10,#163);\n"),
       "#161 TessellatedCurveSet 'mesh'");
  told(import_beside_a_circle("#110 = CLOTHOID('spiral',#11,5.);\n"), "CLOTHOID");
  told(import_beside_a_circle("#110 = CIRCLE('loose',#11,2.);\n"), "no representation holds it");
}

TEST(LostCurves, HiddenCurvesAreMarked) {
  const ImportReport report = import_beside_a_circle(
      "#110 = CIRCLE('construction',#11,2.);\n#170 = INVISIBILITY((#171));\n"
      "#171 = STYLED_ITEM('',(#172),#110);\n#172 = PRESENTATION_STYLE_ASSIGNMENT((.NULL.));\n",
      ",#110");
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_TRUE(named(report, "construction")->hidden);
  EXPECT_FALSE(named(report, "good")->hidden);
  const ImportReport iges =
      import_text(iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,1.,0.,0.;", .status = 1000000},
                                {.type = 110, .parameters = "110,0.,1.,0.,1.,1.,0.;"}}));
  ASSERT_EQ(iges.curves.size(), 2U);
  EXPECT_TRUE(iges.curves[0].hidden);
  EXPECT_FALSE(iges.curves[1].hidden);
}

}  // namespace
}  // namespace nurbeam
