// Pipes of IFC that are circles revolved; and curves and items that hold themselves, which cost no time.

#include <gtest/gtest.h>

#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/ifc_text_of.h"

namespace nurbeam::ifc {
namespace {

using std::numbers::pi;

/// A bend of 100 about the axis #130 by an angle, from a hollow circle at the middle of the solid's place.
std::string bend(const std::string& axis, const std::string& angle) {
  return product("IFCPIPEFITTING", "bend") + "#100=IFCREVOLVEDAREASOLID(#110,#120,#130," + angle +
         ");\n#110=IFCCIRCLEHOLLOWPROFILEDEF(.AREA.,$,$,25.,3.);\n#120=IFCAXIS2PLACEMENT3D(#7,$,$);\n"
         "#130=IFCAXIS1PLACEMENT(#131,#132);\n#131=IFCCARTESIANPOINT((100.,0.,0.));\n#132=IFCDIRECTION((" +
         axis + "));\n";
}

// The product is moved by (1000, 0, 0) and turned by 90 degrees about z: x of the solid is y.
TEST(IfcPipes, RevolvedCirclesAreArcsWithRadii) {
  const ImportReport report = imported(file_of(bend("0.,1.,0.", "1.5707963267948966")));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(report.diagnostics.empty());
  const ImportedCurve& line = report.curves[0];
  EXPECT_TRUE(line.is_centre_line());
  EXPECT_NEAR(line.pipe_radius, 0.025, 1e-15);
  EXPECT_NEAR(line.bore_radius, 0.022, 1e-15);
  EXPECT_NEAR(length(line.curve), 0.05 * pi, 1e-13);
  EXPECT_LE((start_of(line.curve) - Eigen::Vector3d(1, 0, 0)).norm(), 1e-14);
  EXPECT_LE((end_of(line.curve) - Eigen::Vector3d(1, 0.1, 0.1)).norm(), 1e-14);  // from -x to z about y
}

TEST(IfcPipes, OfAWholeTurnAreRings) {
  const ImportReport report = imported(file_of(bend("0.,1.,0.", "6.283185307179586")));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.2 * pi, 1e-13);
}

TEST(IfcPipes, ThatAreNoTorusAreNamed) {
  for (const auto& [bad, words] :
       {std::pair{bend("0.,1.,1.", "1."), "does not lie in the plane of its profile"},
        {bend("1.,0.,0.", "1."), "its axis goes through its profile"},
        {bend("0.,1.,0.", "-1."), "its angle is -1 rad"},
        {bend("0.,1.,0.", "7."), "its angle is 7 rad"}}) {
    const ImportReport report = imported(file_of(bad));
    ASSERT_FALSE(report.diagnostics.empty());
    EXPECT_NE(report.diagnostics[0].where.find("#100 IFCREVOLVEDAREASOLID"), std::string::npos);
    EXPECT_NE(report.diagnostics[0].message.find(words), std::string::npos) << report.diagnostics[0].message;
  }
}

/// What an item that holds itself many times is told to be.
void expect_circle(const std::string& items) {
  const ImportReport report = imported(file_of(product() + items +
                                               "#101=IFCPOLYLINE((#7,#102));\n"
                                               "#102=IFCCARTESIANPOINT((9.,0.,0.));\n"));
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_LE(report.diagnostics.size(), 4U);
  EXPECT_NE(report.diagnostics[0].message.find("a circle of references"), std::string::npos);
}

TEST(IfcCircles, OfSetsAndMappedItemsAreToldAtOnce) {
  expect_circle("#100=IFCGEOMETRICSET((#100,#101,#100,#100));\n");
  expect_circle(
      "#100=IFCGEOMETRICSET((#101,#103,#103));\n#103=IFCMAPPEDITEM(#104,#6);\n"
      "#104=IFCREPRESENTATIONMAP(#6,#95);\n");
}

TEST(IfcCircles, OfCompositeCurvesAreToldAtOnce) {
  expect_circle(
      "#100=IFCGEOMETRICSET((#101,#103));\n#103=IFCCOMPOSITECURVE((#104,#104,#104),.F.);\n"
      "#104=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#103);\n");
}

TEST(IfcCircles, OfReferenceCurvesAreNamed) {
  const ImportReport report =
      imported(file_of(product() + "#100=IFCSEGMENTEDREFERENCECURVE((),.F.,#100,$);\n"));
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE(report.diagnostics[0].message.find("has a cant itself"), std::string::npos);
}

}  // namespace
}  // namespace nurbeam::ifc
