// Where parts of STEP assemblies stand, held to ISO 10303-43: what brings a placement A to another one B is B
// A^-1.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/imported_text.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam {
namespace {

const Eigen::Vector3d drawn_start(1, 2, 3), drawn_end(11, 2, 3);  // in the unit of the part

std::string triple(const Eigen::Vector3d& v) {
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint << "(" << v.x() << "," << v.y() << "," << v.z() << ")";
  return text.str();
}

/// Instances n to n + 3.
std::string placement(int n, const Eigen::Isometry3d& at) {
  const auto number = [&](int i) { return "#" + std::to_string(n + i); };
  return number(0) + " = AXIS2_PLACEMENT_3D(''," + number(1) + "," + number(2) + "," + number(3) + ");\n" +
         number(1) + " = CARTESIAN_POINT(''," + triple(at.translation()) + ");\n" + number(2) +
         " = DIRECTION(''," + triple(at.linear().col(2)) + ");\n" + number(3) + " = DIRECTION(''," +
         triple(at.linear().col(0)) + ");\n";
}

const std::string line =
    "#100 = TRIMMED_CURVE('rod',#101,(PARAMETER_VALUE(0.)),(PARAMETER_VALUE(10.)),.T.,.PARAMETER.);\n"
    "#101 = LINE('',#102,#103);\n#102 = CARTESIAN_POINT('',(1.,2.,3.));\n#103 = VECTOR('',#14,1.);\n";

struct Order {
  bool items_swapped = false;      // as some exporters write them
  bool assembly_is_first = false;  // of the two representations, with its placement
};

/// The line of a part in an assembly that places it by `transformation` (#300 and what it refers to); #301 is
/// an item of the part, #310 one of the assembly.
std::string assembly(const std::string& transformation, const std::string& part_unit, Order order = {}) {
  std::string text = step_text_of("", line + transformation + R"(
#50 = PRODUCT('part','part','',(#8));
#51 = PRODUCT_DEFINITION('design','',#52,#9);
#52 = PRODUCT_DEFINITION_FORMATION('','',#50);
#53 = PRODUCT_DEFINITION_SHAPE('','',#51);
#54 = SHAPE_DEFINITION_REPRESENTATION(#53,#55);
#55 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#301,#56),#57);
#56 = GEOMETRIC_CURVE_SET('',(#100));
#57 = ( GEOMETRIC_REPRESENTATION_CONTEXT(3) GLOBAL_UNIT_ASSIGNED_CONTEXT((#58,#28,#29)) REPRESENTATION_CONTEXT('','3D') );
#58 = )" + part_unit + R"(;
#60 = NEXT_ASSEMBLY_USAGE_OCCURRENCE('a','a','',#5,#51,$);
#61 = PRODUCT_DEFINITION_SHAPE('','',#60);
#62 = CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#63,#61);
#63 = ( REPRESENTATION_RELATIONSHIP('','',)" +
                                          (order.assembly_is_first ? "#10,#55" : "#55,#10") + R"()
REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#300) SHAPE_REPRESENTATION_RELATIONSHIP() );
)");
  const std::string own = "#10 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);";
  text.replace(text.find(own), own.size(), "#10 = SHAPE_REPRESENTATION('',(#11,#310),#26);");
  const std::string set = "#15 = GEOMETRIC_CURVE_SET('',());\n";
  text.replace(text.find(set), set.size(), "");
  return text;
}

std::string between(const Eigen::Isometry3d& A, const Eigen::Isometry3d& B, Order order = {}) {
  const bool part_first = order.items_swapped == order.assembly_is_first;
  return std::string("#300 = ITEM_DEFINED_TRANSFORMATION('','',") + (part_first ? "#301,#310" : "#310,#301") +
         ");\n" + placement(301, A) + placement(310, B);
}

NurbsCurve placed_curve(const std::string& text) {
  const ImportReport report = import_text(text);
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
  if (report.curves.size() != 1) throw std::runtime_error("expected one curve");
  return report.curves[0].curve;
}

/// `place`: of coordinates of the part [m].
void expect_placed(const NurbsCurve& curve, const Eigen::Affine3d& place, double part_unit) {
  EXPECT_LE((start_of(curve) - place * (part_unit * drawn_start)).norm(), 1e-13)
      << start_of(curve).transpose();
  EXPECT_LE((end_of(curve) - place * (part_unit * drawn_end)).norm(), 1e-13) << end_of(curve).transpose();
}

Eigen::Isometry3d placed(const Eigen::Vector3d& origin, double angle = 0,
                         const Eigen::Vector3d& axis = {0, 0, 1}) {
  return Eigen::Translation3d(origin) * Eigen::AngleAxisd(angle, axis.normalized());
}

const std::vector<Eigen::Isometry3d> places{
    placed({0, 0, 0}), placed({1, 2, 3}), placed({50, 0, 0}, 1.5707963267948966),
    placed({-3, 4, 10}, 2.2, {1, 2, -1}), placed({0, 0, 0}, 0.7, {0, 1, 0})};

TEST(PlacedParts, StandWhereOnePlacementIsBroughtToTheOther) {
  for (const Eigen::Isometry3d& A : places)
    for (const Eigen::Isometry3d& B : places) {
      SCOPED_TRACE(placement(301, A) + placement(310, B));
      Eigen::Affine3d place = B * A.inverse();
      place.translation() *= 1e-3;
      for (const Order order : {Order{}, Order{.items_swapped = true}, Order{.assembly_is_first = true}})
        expect_placed(placed_curve(assembly(between(A, B, order), millimetres, order)), place, 1e-3);
    }
}

TEST(PlacedParts, HaveTheirPlacementInTheirOwnUnit) {
  const std::string metres = "( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )";
  Eigen::Isometry3d A = placed({1, 2, 3}, 0.4, {1, 0, 1}), B = placed({50, 7, 1}, 2.2, {1, 2, -1});
  const std::string text = assembly(between(A, B), metres);
  B.translation() *= 1e-3;
  const ImportReport report = import_text(text);
  ASSERT_EQ(report.curves.size(), 1U);
  expect_placed(report.curves[0].curve, Eigen::Affine3d(B * A.inverse()), 1);
}

/// #300, an operator with this first axis, y as the second and z as the third; its origin is (100, 0, 0).
std::string operation(const std::string& axis1, const std::string& scale) {
  return "#300 = CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#303,#304,#305," + scale +
         ",#13);\n#303 = DIRECTION('',(" + axis1 +
         "));\n#304 = DIRECTION('',(0.,1.,0.));\n#305 = CARTESIAN_POINT('',(100.,0.,0.));\n";
}

/// An assembly that places its part by an operator.
std::string assembly_by_operator(const std::string& transformation, Order order = {}) {
  return with(with(assembly(transformation, millimetres, order), "#11,#301,#56", "#11,#56"), "(#11,#310)",
              "(#11)");
}

TEST(PlacedParts, AreScaledAndMirroredByAnOperator) {
  struct Case {
    std::string axis1, scale;
    Eigen::Vector3d factors;
  };
  for (const auto& [axis1, scale, factors] : std::vector<Case>{{"-1.,0.,0.", "3.", {-3, 3, 3}},
                                                               {"1.,0.,0.", "3.", {3, 3, 3}},
                                                               {"-1.,0.,0.", "$", {-1, 1, 1}},
                                                               {"1.,0.,0.", "$", {1, 1, 1}}})
    for (const bool assembly_is_first : {false, true}) {
      SCOPED_TRACE(axis1 + " " + scale);
      Eigen::Affine3d place = Eigen::Affine3d::Identity();
      place.linear() = factors.asDiagonal();
      place.translation().x() = 0.1;
      if (assembly_is_first) place = place.inverse();
      expect_placed(placed_curve(assembly_by_operator(operation(axis1, scale),
                                                      {.assembly_is_first = assembly_is_first})),
                    place, 1e-3);
    }
}

TEST(PlacedParts, ByAnOperatorWrittenAsAComplexInstanceStandThereOrAreNamed) {
  const std::string simple = assembly_by_operator(operation("-1.,0.,0.", "3."));
  const std::string complex = with(
      simple, "CARTESIAN_TRANSFORMATION_OPERATOR_3D('','','',#303,#304,#305,3.,#13)",
      "( CARTESIAN_TRANSFORMATION_OPERATOR(#303,#304,#305,3.) CARTESIAN_TRANSFORMATION_OPERATOR_3D(#13)\n"
      "FUNCTIONALLY_DEFINED_TRANSFORMATION('','') GEOMETRIC_REPRESENTATION_ITEM() "
      "REPRESENTATION_ITEM('') )");
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.linear() = Eigen::Vector3d(-3, 3, 3).asDiagonal();
  place.translation().x() = 0.1;
  expect_placed(placed_curve(complex), place, 1e-3);
  const ImportReport unknown =
      import_text(with(complex, "GEOMETRIC_REPRESENTATION_ITEM", "ODD_TRANSFORMATION"));
  ASSERT_EQ(unknown.curves.size(), 1U);
  ASSERT_FALSE(unknown.diagnostics.empty());
  EXPECT_NE(unknown.diagnostics.front().where.find("#63"), std::string::npos)
      << unknown.diagnostics.front().where;
  EXPECT_NE(unknown.diagnostics.front().message.find("as if it were not placed"), std::string::npos)
      << unknown.diagnostics.front().message;
}

TEST(PlacedParts, BetweenWhatIsNoPlacementAreNamed) {
  const std::string text = assembly(between(places[1], places[2]), millimetres);
  const ImportReport report =
      import_text(with(text, "#310 = AXIS2_PLACEMENT_3D", "#310 = AXIS2_PLACEMENT3D"));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(std::any_of(report.diagnostics.begin(), report.diagnostics.end(), [](const Diagnostic& d) {
    return d.severity == Severity::warning && d.where.find("#63") != std::string::npos &&
           d.message.find("not both AXIS2_PLACEMENT_3D") != std::string::npos;
  })) << (report.diagnostics.empty() ? "nothing is told" : report.diagnostics.front().message);
}

TEST(PlacedParts, DrawnByMappedItemsStandBetweenTheirPlacementsToo) {
  for (const Eigen::Isometry3d& A : places)
    for (const Eigen::Isometry3d& B : places) {
      SCOPED_TRACE(placement(301, A) + placement(310, B));
      std::string text = step_text_of("#100", line + placement(301, A) + placement(310, B));
      const std::string own = "#10 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#11,#15),#26);";
      text.replace(text.find(own), own.size(),
                   "#10 = SHAPE_REPRESENTATION('',(#11,#202),#26);\n"
                   "#200 = GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION('',(#301,#15),#26);\n"
                   "#201 = REPRESENTATION_MAP(#301,#200);\n#202 = MAPPED_ITEM('',#201,#310);");
      Eigen::Affine3d place = B * A.inverse();
      place.translation() *= 1e-3;
      expect_placed(placed_curve(text), place, 1e-3);
    }
}

// Curves of a part that nothing says to stand in another, but that are moved against it.
TEST(PlacedParts, ThatNoAssemblyUsesAreNamed) {
  std::string text = assembly(between(places[1], places[2]), millimetres);
  for (const std::string key :
       {"#60 = ", "#61 = ", "#62 = ", "#50 = ", "#51 = ", "#52 = ", "#53 = ", "#54 = "}) {
    const auto begin = text.find("\n" + key);
    text.erase(begin, text.find(";\n", begin) + 1 - begin);
  }
  const ImportReport report = import_text(text);
  EXPECT_TRUE(report.curves.empty());
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE(report.diagnostics.front().message.find("its place or its unit in the assembly is not known"),
            std::string::npos)
      << report.diagnostics.front().message;
}

}  // namespace
}  // namespace nurbeam
