// IFC: swept disks along a part of their directrix, numbers that are none, and the world coordinate system.

#include <gtest/gtest.h>

#include <numbers>

#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/ifc_text_of.h"

namespace nurbeam::ifc {
namespace {

using std::numbers::pi;

std::string disk(const std::string& first, const std::string& last, const std::string& directrix) {
  return file_of(product() + "#100=IFCSWEPTDISKSOLID(#101,8.,$," + first + "," + last + ");\n" + directrix);
}

const std::string polyline =
    "#101=IFCPOLYLINE((#102,#103,#104,#105));\n#102=IFCCARTESIANPOINT((0.,0.,0.));\n"
    "#103=IFCCARTESIANPOINT((500.,0.,0.));\n#104=IFCCARTESIANPOINT((500.,300.,0.));\n"
    "#105=IFCCARTESIANPOINT((500.,300.,100.));\n";

/// A line of 100, a quarter of a circle of radius 50, by angles, and a line of 200, of vectors of length 1.
const std::string composite =
    "#101=IFCCOMPOSITECURVE((#111,#112,#113),.F.);\n"
    "#111=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#121);\n#112=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#122);\n"
    "#113=IFCCOMPOSITECURVESEGMENT(.CONTINUOUS.,.T.,#123);\n"
    "#121=IFCTRIMMEDCURVE(#131,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(100.)),.T.,.PARAMETER.);\n"
    "#131=IFCLINE(#7,#132);\n#132=IFCVECTOR(#133,1.);\n#133=IFCDIRECTION((1.,0.,0.));\n"
    "#122=IFCTRIMMEDCURVE(#141,(IFCPARAMETERVALUE(4.71238898038469)),(IFCPARAMETERVALUE(6.283185307179586)),.T.,"
    ".PARAMETER.);\n#141=IFCCIRCLE(#142,50.);\n#142=IFCAXIS2PLACEMENT3D(#143,$,$);\n"
    "#143=IFCCARTESIANPOINT((100.,50.,0.));\n"
    "#123=IFCTRIMMEDCURVE(#151,(IFCPARAMETERVALUE(0.)),(IFCPARAMETERVALUE(200.)),.T.,.PARAMETER.);\n"
    "#151=IFCLINE(#152,#153);\n#152=IFCCARTESIANPOINT((150.,50.,0.));\n#153=IFCVECTOR(#154,1.);\n"
    "#154=IFCDIRECTION((0.,1.,0.));\n";

double total_length(const ImportReport& report) {
  double sum = 0;
  for (const ImportedCurve& curve : report.curves) sum += 1e3 * length(curve.curve);
  return sum;
}

TEST(IfcDirectrix, OfAPolylineIsCutAtItsParameters) {
  EXPECT_NEAR(total_length(imported(disk("$", "$", polyline))), 900, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("0.", "3.", polyline))), 900, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("0.", "1.5", polyline))), 650, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("0.5", "2.25", polyline))), 250 + 300 + 25, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("2.", "$", polyline))), 100, 1e-9);
  EXPECT_TRUE(imported(disk("0.5", "2.25", polyline)).diagnostics.empty());
}

TEST(IfcDirectrix, OfACompositeCurveCountsItsParametersOn) {
  const double quarter = pi / 2, arc = 50 * quarter;
  EXPECT_NEAR(total_length(imported(disk("0.", "301.5707963267949", composite))), 300 + arc, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("40.", "250.", composite))), 60 + arc + 150 - quarter, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("100.", "100.78539816339745", composite))), arc / 2, 1e-9);
  EXPECT_NEAR(total_length(imported(disk("0.", "3.", composite))), 300 + arc, 1e-9);  // as some count pieces
}

TEST(IfcDirectrix, LengthsAreTakenAsSuchWithAWarning) {
  const ImportReport report = imported(disk("0.", "650.", polyline));
  EXPECT_NEAR(total_length(report), 650, 1e-6);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("lengths along it"), std::string::npos);
  const ImportReport beyond = imported(disk("0.", "2000.", polyline));
  EXPECT_FALSE(beyond.ok());
  EXPECT_NE(beyond.diagnostics.at(0).message.find("neither parameters"), std::string::npos);
  const ImportReport first = imported(disk("0.", "1.", polyline));
  EXPECT_NEAR(total_length(first), 500, 1e-9);
  ASSERT_EQ(first.diagnostics.size(), 1U);
  EXPECT_NE(first.diagnostics[0].message.find("behind the first of its 3 lines"), std::string::npos);
}

TEST(IfcNumbers, WithTwoPointsAreNamed) {
  std::string text = file_of(product() +
                             "#100=IFCGEOMETRICSET((#101,#104));\n#101=IFCPOLYLINE((#7,#103));\n"
                             "#103=IFCCARTESIANPOINT((500.,1.2.3,0.));\n"
                             "#104=IFCPOLYLINE((#7,#105));\n#105=IFCCARTESIANPOINT((500.,1.2,0.));\n");
  const ImportReport report = imported(text);
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].where.find("#101"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("'1.2.3'"), std::string::npos)
      << report.diagnostics[0].message;
}

TEST(IfcDamage, IsNamedWhereInstancesAreLost) {
  const std::string shape =
      product() + "#100=IFCPOLYLINE((#7,#103));\n#103=IFCCARTESIANPOINT((500.,0.,0.));\n";
  const auto expect_named = [](const std::string& instances, const std::string& words) {
    std::string all;
    for (const Diagnostic& d : imported(file_of(instances)).diagnostics)
      all += d.where + ": " + d.message + "\n";
    EXPECT_NE(all.find(words), std::string::npos) << all;
  };
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = shape;
    return text.replace(text.find(from), from.size(), to);
  };
  expect_named(shape + "#103=IFCCARTESIANPOINT((900.,0.,0.));\n",
               "'#103=IFCCARTESIANPOINT((900.,0' and 0 more");
  expect_named(with("#103=", "#-0.="), "'#-0.=IFCCARTESIANPOINT");
  expect_named(with("#94=IFCPRODUCTDEFINITIONSHAPE", "#94=IFCSIUNIT"), "its shape, #94, is none");
  expect_named(with("(#95)", "(#91)"), "represented by IFCLOCALPLACEMENT");
  expect_named(shape + "#80=IFCALIGNMENT('2',$,'road',$,$,#91,$,$);\n",
               "#80 IFCALIGNMENT: not read: it has neither");
}

TEST(IfcWorld, CoordinateSystemMovesAllThatIsDrawnInIt) {
  std::string text = file_of(product() +
                             "#100=IFCPOLYLINE((#7,#103));\n#103=IFCCARTESIANPOINT((500.,0.,0.));\n"
                             "#8=IFCCARTESIANPOINT((0.,2000.,30.));\n"
                             "#9=IFCAXIS2PLACEMENT3D(#8,$,$);\n");
  const std::string plain = "1.E-05,#6,$)";
  text.replace(text.find(plain), plain.size(), "1.E-05,#9,$)");
  const ImportReport report = imported(text);
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_LE((start_of(report.curves[0].curve) - Eigen::Vector3d(1, 2, 0.03)).norm(), 1e-12);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  EXPECT_NE(report.diagnostics[0].message.find("WorldCoordinateSystem"), std::string::npos);
}

}  // namespace
}  // namespace nurbeam::ifc
