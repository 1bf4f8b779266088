#include "cad_import/import_curves.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <thread>
#include <vector>

#include "cad_import/files/child_process.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/imported_text.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

ImportReport curves_in_text(const std::string& text, const ImportOptions& options = {}) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("curves.step", text), options);
}

ImportedCurve only_curve(const std::string& text) {
  const ImportReport report = curves_in_text(text);
  if (report.curves.size() != 1) throw std::runtime_error("expected one curve");
  return report.curves[0];
}

// The conic between two of its parameters; `sense` is .T. or .F.
std::string trimmed(const std::string& conic, double first, double last, const std::string& sense = ".T.") {
  return "#100 = TRIMMED_CURVE('arc',#101,(PARAMETER_VALUE(" + std::to_string(first) +
         ")),(PARAMETER_VALUE(" + std::to_string(last) + "))," + sense + ",.PARAMETER.);\n#101 = " + conic +
         ";";
}

template <class Function>
void at_many_points(const NurbsCurve& curve, const Function& check) {
  const double first = curve.knots().start();
  const double last = curve.knots().end();
  for (int i = 0; i <= 500; ++i) check(curve.point(first + (last - first) * i / 500));
}

TEST(ImportCurves, ACircleIsARationalQuadraticWithItsRadiusToRoundOff) {
  const ImportedCurve circle = only_curve(step_text_of("#100", "#100 = CIRCLE('ring',#11,2000.);"));
  EXPECT_EQ(circle.entity, "circle");
  EXPECT_EQ(circle.name, "ring");
  EXPECT_EQ(circle.curve.degree(), 2);
  EXPECT_NEAR(length(circle.curve), 4 * pi, 1e-12);
  at_many_points(circle.curve, [](const Eigen::Vector3d& r) { EXPECT_NEAR(r.norm(), 2, 6e-15); });
}

TEST(ImportCurves, AnEllipseSatisfiesItsEquation) {
  const ImportedCurve arc =
      only_curve(step_text_of("#100", trimmed("ELLIPSE('',#11,3000.,1000.)", 0.5, 4.0)));
  EXPECT_EQ(arc.entity, "ellipse");
  EXPECT_TRUE(arc.exact);
  EXPECT_LT((start_of(arc.curve) - Eigen::Vector3d(3 * std::cos(0.5), std::sin(0.5), 0)).norm(), 1e-14);
  EXPECT_LT((end_of(arc.curve) - Eigen::Vector3d(3 * std::cos(4.0), std::sin(4.0), 0)).norm(), 1e-14);
  at_many_points(arc.curve,
                 [](const Eigen::Vector3d& r) { EXPECT_NEAR(r.x() * r.x() / 9 + r.y() * r.y(), 1, 1e-14); });
}

TEST(ImportCurves, AParabolaSatisfiesItsEquation) {
  const ImportedCurve arc = only_curve(step_text_of("#100", trimmed("PARABOLA('',#11,500.)", -1, 2)));
  EXPECT_EQ(arc.entity, "parabola");
  EXPECT_EQ(arc.curve.degree(), 2);
  EXPECT_FALSE(arc.curve.is_rational());
  // y^2 = 4 f x with f = 0.5 m
  at_many_points(arc.curve, [](const Eigen::Vector3d& r) { EXPECT_NEAR(r.y() * r.y(), 2 * r.x(), 1e-14); });
}

TEST(ImportCurves, AHyperbolaSatisfiesItsEquation) {
  const ImportedCurve arc =
      only_curve(step_text_of("#100", trimmed("HYPERBOLA('',#11,2000.,1000.)", -0.5, 1.5)));
  EXPECT_EQ(arc.entity, "hyperbola");
  EXPECT_EQ(arc.curve.degree(), 2);
  at_many_points(arc.curve,
                 [](const Eigen::Vector3d& r) { EXPECT_NEAR(r.x() * r.x() / 4 - r.y() * r.y(), 1, 1e-13); });
}

TEST(ImportCurves, ALineHasDegreeOne) {
  const std::string line = trimmed("LINE('',#12,#102)", 0, 2000) + "#102 = VECTOR('',#14,1.);";
  const ImportedCurve curve = only_curve(step_text_of("#100", line));
  EXPECT_EQ(curve.entity, "line");
  EXPECT_EQ(curve.curve.degree(), 1);
  EXPECT_LT((start_of(curve.curve) - Eigen::Vector3d(0, 0, 0)).norm(), 1e-15);
  EXPECT_LT((end_of(curve.curve) - Eigen::Vector3d(2, 0, 0)).norm(), 1e-15);
}

TEST(ImportCurves, AnArcAgainstTheSenseOfItsCircleRunsBackwards) {
  const std::string forward = trimmed("CIRCLE('',#11,1000.)", 0.25, 1.25);
  const std::string backward = trimmed("CIRCLE('',#11,1000.)", 1.25, 0.25, ".F.");
  const NurbsCurve a = only_curve(step_text_of("#100", forward)).curve;
  const NurbsCurve b = only_curve(step_text_of("#100", backward)).curve;
  const Eigen::Vector3d from(std::cos(0.25), std::sin(0.25), 0);
  const Eigen::Vector3d to(std::cos(1.25), std::sin(1.25), 0);
  EXPECT_LT((start_of(a) - from).norm(), 1e-14);
  EXPECT_LT((end_of(a) - to).norm(), 1e-14);
  EXPECT_LT((start_of(b) - to).norm(), 1e-14);
  EXPECT_LT((end_of(b) - from).norm(), 1e-14);
}

TEST(ImportCurves, APieceOfABSplineIsExact) {
  const std::string spline =
      R"(#100 = TRIMMED_CURVE('piece',#101,(PARAMETER_VALUE(0.5)),(PARAMETER_VALUE(2.25)),.T.,
.PARAMETER.);
#101 = B_SPLINE_CURVE_WITH_KNOTS('',3,(#110,#111,#112,#113,#114,#115),.UNSPECIFIED.,.F.,.F.,(4,1,1,4),(0.,1.,2.,3.),
.UNSPECIFIED.);
#110 = CARTESIAN_POINT('',(0.,0.,0.));
#111 = CARTESIAN_POINT('',(1000.,2000.,0.));
#112 = CARTESIAN_POINT('',(2000.,-1000.,500.));
#113 = CARTESIAN_POINT('',(3000.,0.,1000.));
#114 = CARTESIAN_POINT('',(4000.,500.,0.));
#115 = CARTESIAN_POINT('',(5000.,0.,0.));)";
  Eigen::Matrix3Xd points(3, 6);
  points << 0, 1, 2, 3, 4, 5, 0, 2, -1, 0, 0.5, 0, 0, 0, 0.5, 1, 0, 0;
  const KnotVector knots(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3});
  const NurbsCurve whole = make_nurbs_curve(knots, points, Eigen::VectorXd::Ones(6));
  const NurbsCurve piece = only_curve(step_text_of("#100", spline)).curve;
  EXPECT_EQ(piece.knots().breaks(), (std::vector<double>{0.5, 1, 2, 2.25}));
  for (double u = 0.5; u <= 2.25; u += 0.125) EXPECT_LT((piece.point(u) - whole.point(u)).norm(), 1e-14);
}

// Control points of the splines below [m].
Eigen::Matrix3Xd four_points() {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1, 2, 3, 0, 2, -1, 0, 0, 0, 0.5, 1;
  return points;
}
const std::string four_points_text = R"(
#110 = CARTESIAN_POINT('',(0.,0.,0.));
#111 = CARTESIAN_POINT('',(1000.,2000.,0.));
#112 = CARTESIAN_POINT('',(2000.,-1000.,500.));
#113 = CARTESIAN_POINT('',(3000.,0.,1000.));)";

void expect_same(const NurbsCurve& curve, const NurbsCurve& expected) {
  const auto at = [](const NurbsCurve& c, int i) -> Eigen::Vector3d {
    return c.point(c.knots().start() + (c.knots().end() - c.knots().start()) * i / 50);
  };
  for (int i = 0; i <= 50; ++i) EXPECT_LT((at(curve, i) - at(expected, i)).norm(), 1e-14);
}

TEST(ImportCurves, EveryKindOfStepSplineIsExact) {
  struct Kind {
    std::string entity;
    KnotVector knots;
    Eigen::Vector4d weights;
  };
  const std::string form = "3,(#110,#111,#112,#113),.UNSPECIFIED.,.F.,.F.";
  const KnotVector bezier(3, {0, 0, 0, 0, 1, 1, 1, 1}), quadratic(2, {0, 0, 0, 1, 2, 2, 2});
  const Eigen::Vector4d ones = Eigen::Vector4d::Ones();
  for (const Kind& kind :
       {Kind{"BEZIER_CURVE(''," + form + ")", bezier, ones},
        Kind{"QUASI_UNIFORM_CURVE('',2" + form.substr(1) + ")", quadratic, ones},
        Kind{"UNIFORM_CURVE('',2" + form.substr(1) + ")", KnotVector(2, {-2, -1, 0, 1, 2, 3, 4}), ones},
        Kind{"( BOUNDED_CURVE() B_SPLINE_CURVE(" + form +
                 ") B_SPLINE_CURVE_WITH_KNOTS((4,4),(0.,1.),.UNSPECIFIED.) CURVE() "
                 "GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE((1.,2.,0.5,1.)) "
                 "REPRESENTATION_ITEM('') )",
             bezier,
             {1, 2, 0.5, 1}}}) {
    SCOPED_TRACE(kind.entity);
    const ImportedCurve curve =
        only_curve(step_text_of("#100", "#100 = " + kind.entity + ";" + four_points_text));
    EXPECT_TRUE(curve.exact);
    EXPECT_EQ(curve.curve.degree(), kind.knots.degree());
    expect_same(curve.curve, make_nurbs_curve(kind.knots, four_points(), kind.weights));
  }
}

TEST(ImportCurves, APolylineIsABSplineOfDegreeOne) {
  const ImportedCurve curve =
      only_curve(step_text_of("#100", "#100 = POLYLINE('',(#110,#111,#112,#113));" + four_points_text));
  EXPECT_TRUE(curve.exact);
  EXPECT_EQ(curve.curve.degree(), 1);
  const Eigen::Matrix3Xd points = curve.curve.control_points().colwise().hnormalized();
  EXPECT_LT((points - four_points()).norm(), 1e-15);
}

TEST(ImportCurves, ACompositeCurveIsItsParts) {
  const std::string entities = trimmed("CIRCLE('',#11,1000.)", 0, 1) +
                               R"(#200 = COMPOSITE_CURVE('whole',(#201,#202),.F.);
#201 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#100);
#202 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#203);
#203 = POLYLINE('',(#204,#205));
#204 = CARTESIAN_POINT('',(540.302305868139717,841.470984807896507,0.));
#205 = CARTESIAN_POINT('',(0.,2000.,0.));)";
  const ImportReport report = curves_in_text(step_text_of("#200", entities));
  ASSERT_EQ(report.curves.size(), 2U);
  EXPECT_EQ(report.curves[0].entity, "circle");
  EXPECT_EQ(report.curves[0].name, "whole");
  EXPECT_LT((end_of(report.curves[0].curve) - start_of(report.curves[1].curve)).norm(), 1e-14);
}

TEST(ImportCurves, AnOffsetCurveIsApproximatedWithItsMeasuredDeviation) {
  const std::string offset = R"(#100 = OFFSET_CURVE_3D('wide',#101,250.,.F.,#13);
#101 = ELLIPSE('',#11,3000.,1000.);)";
  const ImportReport report = curves_in_text(step_text_of("#100", offset));
  ASSERT_EQ(report.curves.size(), 1U);
  const ImportedCurve& curve = report.curves[0];
  EXPECT_EQ(curve.entity, "offset");
  EXPECT_FALSE(curve.exact);
  EXPECT_GT(curve.deviation, 0);
  EXPECT_LE(curve.deviation, ImportOptions{}.tolerance);
  // A parallel curve of a convex one is longer by 2 pi times the distance, outside or inside.
  const double ellipse =
      length(only_curve(step_text_of("#100", "#100 = ELLIPSE('',#11,3000.,1000.);")).curve);
  EXPECT_NEAR(std::abs(length(curve.curve) - ellipse), 2 * pi * 0.25, 1e-6);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  EXPECT_NE(report.diagnostics[0].where.find("wide"), std::string::npos);
}

TEST(ImportCurves, TheOffsetOfALineOrOfACircleInItsPlaneIsExact) {
  const std::string circle = "#101 = CIRCLE('',#11,3000.);";
  const ImportedCurve wide =
      only_curve(step_text_of("#100", "#100 = OFFSET_CURVE_3D('',#101,250.,.F.,#13);\n" + circle));
  EXPECT_TRUE(wide.exact);
  EXPECT_EQ(wide.entity, "circle");
  // Along direction x tangent (ISO 10303-42): inwards, and to the left.
  for (int i = 0; i <= 16; ++i) {
    const double u =
        wide.curve.knots().start() + (wide.curve.knots().end() - wide.curve.knots().start()) * i / 16;
    EXPECT_NEAR(wide.curve.point(u).norm(), 2.75, 1e-14);
  }
  const ImportedCurve beside =
      only_curve(step_text_of("#100", trimmed("OFFSET_CURVE_3D('',#110,5.,.F.,#13)", 0, 40) +
                                          "#110 = LINE('',#12,#111);\n#111 = VECTOR('',#14,1.);\n"));
  EXPECT_TRUE(beside.exact);
  EXPECT_EQ(beside.entity, "line");
  EXPECT_LE((start_of(beside.curve) - Eigen::Vector3d(0, 0.005, 0)).norm(), 1e-17);
  EXPECT_LE((end_of(beside.curve) - Eigen::Vector3d(0.04, 0.005, 0)).norm(), 1e-16);
}

TEST(ImportCurves, ACurveWithoutANameTakesThatOfItsSet) {
  EXPECT_EQ(only_curve(step_text_of("#100", "#100 = CIRCLE('',#11,1.);", "zipline")).name, "zipline");
  EXPECT_EQ(only_curve(step_text_of("#100", "#100 = CIRCLE('own',#11,1.);", "zipline")).name, "own");
}

TEST(ImportCurves, EncodedLettersInStepNamesAreDecoded) {
  EXPECT_EQ(only_curve(step_text_of("#100", "#100 = CIRCLE('K\\X2\\00E4\\X0\\se',#11,1.);")).name,
            "K\xC3\xA4se");
}

TEST(ImportCurves, TheLengthUnitOfAStepFileIsReportedAndApplied) {
  struct Case {
    std::string entity, name;
    double in_metres;
  };
  for (const Case& unit : {Case{"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT($,.METRE.) )", "m", 1},
                           Case{"( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.CENTI.,.METRE.) )", "cm", 0.01},
                           Case{"( CONVERSION_BASED_UNIT('INCH',#40) LENGTH_UNIT() NAMED_UNIT(#41) );\n"
                                "#40 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#42);\n"
                                "#41 = DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
                                "#42 = ( LENGTH_UNIT() NAMED_UNIT(*) SI_UNIT(.MILLI.,.METRE.) )",
                                "inch", 0.0254}}) {
    const ImportReport report =
        curves_in_text(step_text_of("#100", "#100 = CIRCLE('',#11,1.);", "", unit.entity));
    ASSERT_EQ(report.curves.size(), 1U);
    EXPECT_EQ(report.unit, unit.name);
    EXPECT_DOUBLE_EQ(report.unit_in_metres, unit.in_metres);
    EXPECT_NEAR(length(report.curves[0].curve), 2 * pi * unit.in_metres, 1e-13);
  }
}

TEST(ImportCurves, AFootOfTwelveInchesIsTwelveInches) {
  const std::string feet =
      "( CONVERSION_BASED_UNIT('FOOT',#34) LENGTH_UNIT() NAMED_UNIT(#33) );\n"
      "#34 = LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(12.),#35);\n#35 = " +
      inches;
  const ImportReport report = curves_in_text(step_text_of("#100", "#100 = CIRCLE('',#11,2.);", "", feet));
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(report.unit_in_metres, 0.3048, 1e-16);
  EXPECT_NEAR(start_of(report.curves[0].curve).x(), 2 * 0.3048, 1e-15);
}

TEST(ImportCurves, TheFormatIsFoundByContentNotByName) {
  const ScratchDirectory scratch;
  const auto step_named_iges = scratch.file("a.igs", content_of(corpus_file("dealii-line.step")));
  const auto iges_named_text = scratch.file("b.txt", content_of(corpus_file("dealii-line.iges")));
  EXPECT_EQ(import_curves(step_named_iges).curves.size(), 1U);
  EXPECT_EQ(import_curves(iges_named_text).curves.size(), 1U);
}

TEST(ImportCurves, AWrongHollerithCountIsAnErrorNotASilentInch) {
  const ScratchDirectory scratch;
  const std::string text = content_of(corpus_file("igesio-sample-curves.igs"));
  const ImportReport report = import_curves(scratch.file("a.igs", with(text, "18HIGESio", "17HIGESio")));
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(report.curves.empty());
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].message.find("Hollerith"), std::string::npos);
}

TEST(ImportCurves, UnitsThatDisagreeAreAnErrorThatNamesBoth) {
  const ScratchDirectory scratch;
  const std::string text = content_of(corpus_file("iges-126-bsplines.igs"));
  const ImportReport report = import_curves(scratch.file("a.igs", with(text, "1,2HIN", "1,2HMM")));
  EXPECT_FALSE(report.ok());
  EXPECT_TRUE(report.curves.empty());
  ASSERT_FALSE(report.diagnostics.empty());
  EXPECT_NE(report.diagnostics.back().message.find("agree"), std::string::npos)
      << report.diagnostics.back().message;
}

TEST(ImportCurves, AModelSpaceScaleThatIsNotAppliedIsNoted) {
  const ImportReport report = import_curves(corpus_file("iges-126-bsplines.igs"));
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  EXPECT_NE(report.diagnostics[0].message.find("scale"), std::string::npos);
}

TEST(ImportCurves, ManyThreadsMayReadAtOnce) {
  std::vector<std::size_t> counts(4 * 5);
  std::vector<std::thread> threads;
  for (std::size_t t = 0; t < 4; ++t) {
    threads.emplace_back([&counts, t] {
      for (std::size_t i = 0; i < 5; ++i)
        counts[5 * t + i] = import_curves(corpus_file("igesio-sample-curves.igs")).curves.size();
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(counts, std::vector<std::size_t>(4 * 5, 10));
}

TEST(ImportCurves, AToleranceThatIsNotPositiveIsRefused) {
  EXPECT_THROW(import_curves(corpus_file("dealii-line.step"), {.tolerance = 0}), std::invalid_argument);
  EXPECT_THROW(import_curves(corpus_file("dealii-line.step"), {.tolerance = std::nan("")}),
               std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
