// Entities whose values nearly agree: they are read as they are meant, and one note tells how many and how
// far.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <sstream>

#include "cad_import/import_curves.h"
#include "cad_import/report/leniency.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/cad_import/step_text_of.h"

namespace nurbeam::nearly_consistent {
namespace {

ImportReport imported(const std::string& text) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("drawing.cad", text));
}

using std::numbers::pi;

std::string text(double value) {
  std::ostringstream out;
  out.precision(6);
  out << std::fixed << value;
  return out.str();
}

/// From angle `first` to `last` about the centre (x, 0), its end `off` times farther from it.
std::string arc(double radius, double first, double last, double off, double x) {
  const double far = radius * (1 + off);
  return "100,0.," + std::to_string(int(x)) + ".,0.," + text(x + radius * std::cos(first)) + "," +
         text(radius * std::sin(first)) + "," + text(x + far * std::cos(last)) + "," +
         text(far * std::sin(last)) + ";";
}

IgesEntity arc_entity(const std::string& parameters, int status = 0) {
  return {.type = 100, .parameters = parameters, .status = status};
}

std::vector<Diagnostic> notes_of(const ImportReport& report) {
  std::vector<Diagnostic> notes;
  for (const Diagnostic& d : report.diagnostics)
    if (d.message.find("repaired") != std::string::npos) notes.push_back(d);
  return notes;
}

// The chord of an arc of 90 degrees is known, and so is its length but for the part that the ends disagree
// by.
TEST(NearlyConsistent, ArcsKeepTheirEndsAndOneNoteTellsOfAll) {
  std::vector<IgesEntity> entities;
  const std::vector<double> offs{0, 1e-4, 1e-3, 5e-3, 9.9e-3};
  for (std::size_t i = 0; i < offs.size(); ++i)
    entities.push_back(arc_entity(arc(40, 0.3, 0.3 + pi / 2, offs[i], 100.0 * double(i))));
  const ImportReport report = imported(iges_text_of(entities));
  ASSERT_EQ(report.curves.size(), offs.size());
  constexpr double digits = 1e-6;  // [mm] of the text
  for (std::size_t i = 0; i < offs.size(); ++i) {
    const NurbsCurve& curve = report.curves[i].curve;
    const double x = 100.0 * double(i), far = 40 * (1 + offs[i]), last = 0.3 + pi / 2;
    const Eigen::Vector3d start(x + 40 * std::cos(0.3), 40 * std::sin(0.3), 0);
    const Eigen::Vector3d end(x + far * std::cos(last), far * std::sin(last), 0);
    EXPECT_LE((start_of(curve) * 1e3 - start).norm(), digits);
    EXPECT_LE((end_of(curve) * 1e3 - end).norm(), digits);
    const double exact = 40 * pi / 2e3;
    EXPECT_GE(length(curve), exact * (1 - 1e-7));
    EXPECT_LE(length(curve), exact * (1 + offs[i] + 1e-7));
  }
  ASSERT_EQ(notes_of(report).size(), 1U);
  const Diagnostic note = notes_of(report)[0];
  EXPECT_EQ(note.severity, Severity::note);
  EXPECT_NE(note.message.find("4 entities"), std::string::npos) << note.message;
  // The centre moves along the chord: (r2^2 - r1^2) / (2 chord).
  const double far = 40 * (1 + 9.9e-3), move = (far * far - 1600) / (2 * std::hypot(40, far));
  const std::size_t at = note.message.find("at most ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(note.message.substr(at + 8)), move, 1e-3 * move + 5e-4) << note.message;
}

TEST(NearlyConsistent, AnArcWhoseEndsDisagreeMoreIsNamedAndNothingElseIsLost) {
  const ImportReport report = imported(
      iges_text_of({arc_entity(arc(40, 0, pi / 2, 0.03, 0)), arc_entity(arc(40, 0, pi / 2, 0, 100))}));
  ASSERT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].where.find("D1 CircularArc"), std::string::npos);
  EXPECT_NE(report.diagnostics[0].message.find("its end 41.2"), std::string::npos);
}

// The Global section of iges_text_of says 1e-3.
TEST(NearlyConsistent, TinyArcsAreReadWithinTheResolutionOfTheFile) {
  const ImportReport report = imported(iges_text_of({arc_entity(arc(0.02, 0, pi / 2, 0.04, 0))}));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.02e-3 * pi / 2, 0.04 * 0.02e-3 * pi / 2);
}

TEST(NearlyConsistent, AnAlmostWholeCircleIsClosed) {
  const ImportReport report = imported(iges_text_of({arc_entity("100,0.,0.,0.,40.,0.,40.0001,-0.0002;")}));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_NEAR(length(report.curves[0].curve), 0.08 * pi, 1e-9);
  EXPECT_EQ(notes_of(report).size(), 1U);
}

TEST(NearlyConsistent, AnArcBetweenLinesClosesTheChain) {
  constexpr int part = 10000;
  const ImportReport report =
      imported(iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,10.,0.,0.;", .status = part},
                             arc_entity("100,0.,10.,7.05,10.,0.,17.05,7.08;", part),
                             {.type = 110, .parameters = "110,17.05,7.08,0.,17.05,20.,0.;", .status = part},
                             {.type = 102, .parameters = "102,3,1,3,5;"}}));
  ASSERT_EQ(report.curves.size(), 3U);
  for (int i = 0; i < 2; ++i)
    EXPECT_LE((end_of(report.curves[i].curve) - start_of(report.curves[i + 1].curve)).norm(), 1e-12);
}

// A gap of 0.01 mm between lines of 10 mm, in IGES and STEP; one of 1 mm stays.
TEST(NearlyConsistent, PartsOfACompositeCurveMeet) {
  constexpr int part = 10000;
  const auto iges = [&](const std::string& x) {
    return iges_text_of({{.type = 110, .parameters = "110,0.,0.,0.,10.,0.,0.;", .status = part},
                         {.type = 110, .parameters = "110," + x + ",0.,0.,20.,5.,0.;", .status = part},
                         {.type = 102, .parameters = "102,2,1,3;"}});
  };
  const auto step = [](const std::string& x) {
    return step_text_of("#100",
                        "#100 = COMPOSITE_CURVE('c',(#101,#102),.F.);\n"
                        "#101 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#103);\n"
                        "#102 = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#104);\n"
                        "#103 = POLYLINE('',(#12,#105));\n#104 = POLYLINE('',(#106,#107));\n"
                        "#105 = CARTESIAN_POINT('',(10.,0.,0.));\n#106 = CARTESIAN_POINT('',(" +
                            x + ",0.,0.));\n#107 = CARTESIAN_POINT('',(20.,5.,0.));\n");
  };
  for (const std::string& file : {iges("10.01"), step("10.01")}) {
    const ImportReport report = imported(file);
    ASSERT_EQ(report.curves.size(), 2U);
    for (const Eigen::Vector3d& end : {end_of(report.curves[0].curve), start_of(report.curves[1].curve)})
      EXPECT_LE((1e3 * end - Eigen::Vector3d(10.005, 0, 0)).norm(), 1e-12);
    ASSERT_EQ(notes_of(report).size(), 1U);
    EXPECT_NE(notes_of(report)[0].message.find("0.01 mm"), std::string::npos);
  }
  for (const std::string& file : {iges("11."), step("11.")}) {
    const ImportReport report = imported(file);
    ASSERT_EQ(report.curves.size(), 2U);
    EXPECT_NEAR(1e3 * start_of(report.curves[1].curve).x(), 11, 1e-12);
  }
}

// Ends off the curve of the equation by 0.1 % of the semi-axes, of each kind of conic.
TEST(NearlyConsistent, ConicsGoThroughTheirEnds) {
  const double off = 1.001;
  const std::vector<std::pair<int, std::string>> conics{
      {1, "25.,0.,9.,0.,0.,-225.,0.,3.,0.,0.," + text(5 * off)},
      {1, "25.,0.,9.,0.,0.,-225.,0.,1.8,4.,1.8," + text(-4 * off)},
      {1, "1.,0.,1.,0.,0.,-25.,0.,5.,0.," + text(-3 * off) + ",4."},
      {3, "1.,0.,0.,0.,-4.,0.,0.,-2.,1.,2.," + text(off)},
      {2, "1.,0.,-1.,0.,0.,-9.,0.,5.,-4.,5.," + text(4 * off)}};
  const std::vector<Eigen::Vector3d> ends{
      {0, 5 * off, 0}, {1.8, -4 * off, 0}, {-3 * off, 4, 0}, {2, off, 0}, {5, 4 * off, 0}};
  std::vector<IgesEntity> entities;
  for (const auto& [form, values] : conics)
    entities.push_back({.type = 104, .parameters = "104," + values + ";", .form = form});
  const ImportReport report = imported(iges_text_of(entities));
  ASSERT_EQ(report.curves.size(), conics.size());
  for (std::size_t i = 0; i < ends.size(); ++i)
    EXPECT_LE((1e3 * end_of(report.curves[i].curve) - ends[i]).norm(), 1e-9) << i;
  ASSERT_EQ(notes_of(report).size(), 1U);
  EXPECT_NE(notes_of(report)[0].message.find("5 entities"), std::string::npos);
}

// A spline of the field, once clean and once with knots that differ in their last digits.
const std::string points = "0.,0.,0.,10.,30.,0.,30.,40.,10.,60.,20.,10.,80.,-10.,0.,100.,-20.,0.";

std::string spline_file(const std::string& knots) {
  const std::string values = "126,5,3,0,0,1,0," + knots + ",1.,1.,1.,1.,1.,1.," + points + ",0.,3.,0.,0.,1.;";
  std::string file = iges_text_of({{.type = 126, .parameters = std::string()}});
  // The parameters need several lines.
  std::string lines;
  int count = 0;
  for (std::size_t at = 0; at < values.size();) {
    std::size_t end = values.size() - at <= 64 ? values.size() : values.rfind(',', at + 63) + 1;
    std::ostringstream content;
    content << std::left << std::setw(64) << values.substr(at, end - at) << std::right << std::setw(8) << 1;
    lines += iges_line(content.str(), 'P', ++count);
    at = end;
  }
  const std::size_t begin = file.find(std::string(71, ' ') + "1P");
  file.replace(begin, 81, lines);
  const std::size_t terminate = file.find("P      1", begin + lines.size());
  return file.replace(terminate + 7, 1, std::to_string(count));
}

TEST(NearlyConsistent, KnotsThatDifferInTheirLastDigitsAreOne) {
  const double whole = length(imported(spline_file("0.,0.,0.,0.,1.,2.,3.,3.,3.,3.")).curves.at(0).curve);
  EXPECT_NEAR(whole, 0.1409586445, 1e-10);
  for (const std::string knots :
       {"0.,0.,0.,0.,1.,2.,3.0000001,3.,3.,3.", "0.,0.,0.,1.E-7,1.,2.,3.,3.,3.,3.",
        "0.,0.,0.,0.,1.,2.,2.9999999,3.,3.,3.", "1.E-11,0.,0.,0.,1.,2.,3.,3.,3.,2.9999999999"}) {
    const ImportReport report = imported(spline_file(knots));
    ASSERT_EQ(report.curves.size(), 1U) << knots;
    EXPECT_NEAR(length(report.curves[0].curve), whole, 1e-12) << knots;
    EXPECT_LE((1e3 * end_of(report.curves[0].curve) - Eigen::Vector3d(100, -20, 0)).norm(), 1e-9) << knots;
    EXPECT_EQ(notes_of(report).size(), 1U) << knots;
  }
}

TEST(NearlyConsistent, KnotsOfStepToo) {
  const std::string places = R"(#110 = CARTESIAN_POINT('',(0.,0.,0.));
#111 = CARTESIAN_POINT('',(1.,2.,0.));
#112 = CARTESIAN_POINT('',(2.,0.,0.));
#113 = CARTESIAN_POINT('',(3.,1.,0.));
)";
  const auto spline = [&](const std::string& knots) {
    return step_text_of("#100", places +
                                    "#100 = B_SPLINE_CURVE_WITH_KNOTS('s',1,(#110,#111,#112,#113),"
                                    ".UNSPECIFIED.,.F.,.F.,(2,1,1,2),(" +
                                    knots + "),.UNSPECIFIED.);");
  };
  const ImportReport divided = imported(spline("0.,1.,0.9999999,2."));
  ASSERT_EQ(divided.curves.size(), 2U);  // a knot that stands twice divides a curve of degree 1
  EXPECT_NEAR(length(divided.curves[0].curve), std::sqrt(5) * 1e-3, 1e-9);
  EXPECT_NEAR(length(divided.curves[1].curve), std::sqrt(2) * 1e-3, 1e-9);
  EXPECT_EQ(notes_of(divided).size(), 1U);
  const ImportReport ends = imported(spline("0.,1.,1.5,2."));
  ASSERT_EQ(ends.curves.size(), 1U);
  EXPECT_TRUE(ends.diagnostics.empty());
}

/// Two Bezier curves of degree 2 as one spline, whose second begins at (x, 0, 0).
std::string divided_spline(double x, const std::string& weights) {
  const std::string values = "(#110,#111,#112,#113,#114,#115),.UNSPECIFIED.,.F.,.F.";
  const std::string knots = "(3,3,3),(0.,1.,2.),.UNSPECIFIED.";
  return step_text_of(
      "#100",
      "#110 = CARTESIAN_POINT('',(0.,0.,0.));\n#111 = CARTESIAN_POINT('',(1.,2.,0.));\n"
      "#112 = CARTESIAN_POINT('',(2.,0.,0.));\n#113 = CARTESIAN_POINT('',(" +
          text(x) +
          ",0.,0.));\n"
          "#114 = CARTESIAN_POINT('',(3.,-2.,0.));\n#115 = CARTESIAN_POINT('',(4.,0.,0.));\n" +
          (weights.empty()
               ? "#100 = B_SPLINE_CURVE_WITH_KNOTS('s',2," + values + "," + knots + ");"
               : "#100 = ( BOUNDED_CURVE() B_SPLINE_CURVE(2," + values + ") B_SPLINE_CURVE_WITH_KNOTS(" +
                     knots + ") CURVE() GEOMETRIC_REPRESENTATION_ITEM() RATIONAL_B_SPLINE_CURVE(" + weights +
                     ") REPRESENTATION_ITEM('s') );"));
}

// An arc of a parabola y = 2 x - x^2 from 0 to 2: its length is sqrt(5) + asinh(2) / 2.
TEST(NearlyConsistent, SplinesThatKnotsDivideAreOneWhereTheyMeet) {
  const double half = std::sqrt(5) + std::asinh(2) / 2;
  for (const std::string weights : {"", "(1.,1.,1.,2.,2.,2.)"}) {
    const ImportReport report = imported(divided_spline(2, weights));
    ASSERT_EQ(report.curves.size(), 1U) << weights;
    EXPECT_NEAR(length(report.curves[0].curve), 2e-3 * half, 1e-9) << weights;
    EXPECT_EQ(report.curves[0].curve.degree(), 2);
  }
  const ImportReport apart = imported(divided_spline(2.5, ""));
  ASSERT_EQ(apart.curves.size(), 2U);
  EXPECT_NEAR(length(apart.curves[0].curve), 1e-3 * half, 1e-9);
  EXPECT_NEAR(1e3 * start_of(apart.curves[1].curve).x(), 2.5, 1e-12);
}

TEST(NearlyConsistent, TheRuleIsOne) {
  const Leniency fine{0}, coarse{0.05};
  EXPECT_TRUE(fine.repairs(0.01, 1));
  EXPECT_FALSE(fine.repairs(0.011, 1));
  EXPECT_TRUE(coarse.repairs(0.05, 1));
  EXPECT_FALSE(coarse.repairs(0.05, 0.1));  // half of the thing itself
  EXPECT_FALSE(Leniency::is_told(1e-7, 1));
  EXPECT_TRUE(Leniency::is_told(1e-5, 1));
}

}  // namespace
}  // namespace nurbeam::nearly_consistent
