// Alignments of IFC: every transition curve that the schemas name ends where an integral of its own formula
// says.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <sstream>

#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/ifc_text_of.h"

namespace nurbeam::ifc {
namespace {

using std::numbers::pi;

/// A place, and the tangent there.
struct Pose {
  Eigen::Vector2d place;
  double heading;
};

/// Where a curve of this curvature ends that begins at the origin along x: Runge-Kutta of fourth order.
Pose end_of(const std::function<double(double)>& curvature, double length) {
  constexpr int count = 4000;
  const double h = length / count;
  Pose at{{0, 0}, 0};
  const auto tangent = [](double angle) { return Eigen::Vector2d(std::cos(angle), std::sin(angle)); };
  for (int i = 0; i < count; ++i) {
    const double s = i * h;
    const double k1 = curvature(s), k2 = curvature(s + h / 2), k4 = curvature(s + h);
    const double half = at.heading + h / 2 * (5 * k1 + 8 * k2 - k4) / 12,
                 next = at.heading + h / 6 * (k1 + 4 * k2 + k4);
    at.place += h / 6 * (tangent(at.heading) + 4 * tangent(half) + tangent(next));
    at.heading = next;
  }
  return at;
}

std::string real(double value) {
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint << value;
  return text.str();
}

/// The transition of this kind of IFC 4.3, from one radius to another (0: none), 80 m long.
ImportReport transition(const std::string& kind, double first, double last) {
  return imported(file_of(
      "#90=IFCALIGNMENT('1',$,'track',$,$,#91,$,$);\n#91=IFCLOCALPLACEMENT($,#6);\n"
      "#201=IFCALIGNMENTHORIZONTAL('h',$,$,$,$,#91,$);\n#202=IFCRELNESTS('n',$,$,$,#90,(#201));\n"
      "#203=IFCRELNESTS('m',$,$,$,#201,(#211));\n#211=IFCALIGNMENTSEGMENT('a',$,$,$,$,#91,$,#212);\n"
      "#212=IFCALIGNMENTHORIZONTALSEGMENT($,$,#213,0.," +
          real(first) + "," + real(last) + ",80.,$,." + kind + ".);\n#213=IFCCARTESIANPOINT((0.,0.));\n",
      "$"));
}

void expect_end(const ImportReport& report, const std::function<double(double)>& curvature, double length) {
  ASSERT_FALSE(report.curves.empty()) << report.diagnostics.at(0).message;
  const Pose end = end_of(curvature, length);
  EXPECT_LE((end_of(report.curves.back().curve).head<2>() - end.place).norm(), 3e-7);
  double sum = 0;
  for (const ImportedCurve& curve : report.curves) sum += nurbeam::length(curve.curve);
  EXPECT_NEAR(sum, length, 1e-6);
}

TEST(IfcSpirals, OfEveryKindEndWhereTheirCurvatureSays) {
  const std::vector<std::pair<std::string, std::function<double(double)>>> kinds{
      {"CLOTHOID", [](double x) { return x; }},
      {"BLOSSCURVE", [](double x) { return x * x * (3 - 2 * x); }},
      {"COSINECURVE", [](double x) { return (1 - std::cos(pi * x)) / 2; }},
      {"SINECURVE", [](double x) { return x - std::sin(2 * pi * x) / (2 * pi); }},
      {"HELMERTCURVE", [](double x) { return x < 0.5 ? 2 * x * x : 1 - 2 * (1 - x) * (1 - x); }},
      {"VIENNESEBEND",
       [](double x) { return std::pow(x, 4) * (35 - 84 * x + 70 * x * x - 20 * x * x * x); }}};
  for (const auto& [kind, share] : kinds)
    for (const auto& [first, last] :
         std::vector<std::pair<double, double>>{{0, 200}, {-300, 150}, {200, 0}}) {
      SCOPED_TRACE(kind + " from " + std::to_string(first));
      const double k0 = first == 0 ? 0 : 1 / first, k1 = last == 0 ? 0 : 1 / last;
      expect_end(
          transition(kind, first, last), [&](double s) { return k0 + (k1 - k0) * share(s / 80); }, 80);
    }
}

// Along y = x^3 / (6 R L) the curvature is y'' / (1 + y'^2)^1.5, and the arc length that of y.
TEST(IfcSpirals, ACubicParabolaIsOne) {
  const double a = 1 / (6.0 * 200 * 80);
  double x = 0;
  constexpr int count = 100'000;
  for (int i = 0; i < count; ++i) {
    const double middle = x + 80.0 / count / 2;
    x += 80.0 / count / std::hypot(1, 3 * a * middle * middle);
  }
  const ImportReport report = transition("CUBIC", 0, 200);
  ASSERT_EQ(report.curves.size(), 1U) << report.diagnostics.at(0).message;
  EXPECT_LE((end_of(report.curves[0].curve).head<2>() - Eigen::Vector2d(x, a * x * x * x)).norm(), 1e-6);
  // The other way round: from the arc to the line.
  const ImportReport back = transition("CUBIC", -200, 0);
  ASSERT_EQ(back.curves.size(), 1U) << back.diagnostics.at(0).message;
  const double heading = std::atan(3 * a * x * x);
  const Eigen::Vector2d chord = Eigen::Vector2d(x, a * x * x * x);
  const Eigen::Vector2d turned = Eigen::Rotation2Dd(-heading) * chord;
  EXPECT_LE((end_of(back.curves[0].curve).head<2>() - turned).norm(), 1e-6);
}

/// The segment of this parent curve, taken from `start` for `length`, as a composite curve on its own.
ImportReport segment(const std::string& parent, double start, double length) {
  return imported(file_of(
      "#90=IFCALIGNMENT('1',$,'track',$,$,#91,#94,$);\n#91=IFCLOCALPLACEMENT($,#6);\n"
      "#94=IFCPRODUCTDEFINITIONSHAPE($,$,(#95));\n#95=IFCSHAPEREPRESENTATION(#5,'Axis','Curve2D',(#100));\n"
      "#100=IFCCOMPOSITECURVE((#121),.F.);\n#121=IFCCURVESEGMENT(.CONTINUOUS.,#122,IFCLENGTHMEASURE(" +
          real(start) + "),IFCLENGTHMEASURE(" + real(length) +
          "),#123);\n#122=IFCAXIS2PLACEMENT2D(#124,#125);\n#124=IFCCARTESIANPOINT((0.,0.));\n"
          "#125=IFCDIRECTION((1.,0.));\n#123=" +
          parent + ";\n",
      "$"));
}

TEST(IfcSpirals, AsParentCurvesHaveTheirTerms) {
  const auto power = [](double term, int n) { return (term < 0 ? -1 : 1) / std::pow(std::abs(term), n + 1); };
  expect_end(
      segment("IFCSECONDORDERPOLYNOMIALSPIRAL(#122,-90.,120.,400.)", 0, 70),
      [&](double s) { return power(-90, 2) * s * s + power(120, 1) * s + power(400, 0); }, 70);
  expect_end(
      segment("IFCTHIRDORDERPOLYNOMIALSPIRAL(#122,-100.,80.,$,-500.)", 10, 60),
      [&](double u) {
        const double s = u + 10;
        return power(-100, 3) * s * s * s + power(80, 2) * s * s + power(-500, 0);
      },
      60);
  expect_end(
      segment("IFCSEVENTHORDERPOLYNOMIALSPIRAL(#122,-95.,88.,-85.,90.,$,$,$,$)", 0, 60),
      [&](double s) {
        return power(-95, 7) * std::pow(s, 7) + power(88, 6) * std::pow(s, 6) +
               power(-85, 5) * std::pow(s, 5) + power(90, 4) * std::pow(s, 4);
      },
      60);
  expect_end(
      segment("IFCCOSINESPIRAL(#122,-400.,400.)", 0, 80),
      [](double s) { return 1 / 400.0 - std::cos(pi * s / 80) / 400; }, 80);
  expect_end(
      segment("IFCSINESPIRAL(#122,-1500.,130.,$)", 0, 80),
      [&](double s) { return power(130, 1) * s - std::sin(2 * pi * s / 80) / 1500; }, 80);
  // Against its sense, from an arc of radius 200 to a line.
  expect_end(
      segment("IFCCLOTHOID(#122,-126.49110640673518)", 80, -80), [](double s) { return (80 - s) / 16000; },
      80);
}

TEST(IfcSpirals, APolynomialOfThePlanIsItsPowers) {
  const ImportReport report = segment("IFCPOLYNOMIALCURVE(#122,(0.,1.),(0.,0.,0.,1.E-05),$)", 0, 80);
  ASSERT_EQ(report.curves.size(), 1U) << report.diagnostics.at(0).message;
  const Eigen::Vector3d end = end_of(report.curves[0].curve);
  EXPECT_NEAR(end.y(), 1e-5 * std::pow(end.x(), 3), 1e-6);
  EXPECT_NEAR(length(report.curves[0].curve), 80, 1e-6);
}

TEST(IfcSpirals, OfThirdKindsAreNamed) {
  const ImportReport report = transition("NOCURVE", 0, 200);
  EXPECT_FALSE(report.ok());
  EXPECT_NE(report.diagnostics.at(0).message.find("of kind NO"), std::string::npos)
      << report.diagnostics[0].message;
}

// IFC 4.1 has its own words for them.
TEST(IfcSpirals, OfTheOlderSchemaAreTheSame) {
  for (const char* kind : {"BLOSSCURVE", "BIQUADRATICPARABOLA", "COSINECURVE", "SINECURVE"}) {
    SCOPED_TRACE(kind);
    const ImportReport report = imported(file_of(
        "#90=IFCALIGNMENT('1',$,'track',$,$,#91,#94,$);\n#91=IFCLOCALPLACEMENT($,#6);\n"
        "#94=IFCPRODUCTDEFINITIONSHAPE($,$,(#95));\n#95=IFCSHAPEREPRESENTATION(#5,'Axis','Curve3D',(#100));\n"
        "#100=IFCALIGNMENTCURVE(#101,$,$);\n#101=IFCALIGNMENT2DHORIZONTAL($,(#102));\n"
        "#102=IFCALIGNMENT2DHORIZONTALSEGMENT($,$,$,#103);\n"
        "#103=IFCTRANSITIONCURVESEGMENT2D(#104,0.,80.,$,200.,.T.,.F.,." +
            std::string(kind) + ".);\n#104=IFCCARTESIANPOINT((0.,0.));\n",
        "$"));
    ASSERT_FALSE(report.curves.empty()) << report.diagnostics.at(0).message;
    const std::string modern =
        std::string(kind) == "BIQUADRATICPARABOLA" ? "HELMERTCURVE" : std::string(kind);
    const ImportReport same = transition(modern, 0, -200);
    EXPECT_LE((end_of(report.curves.back().curve) - end_of(same.curves.back().curve)).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace nurbeam::ifc
