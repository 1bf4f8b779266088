// What drawings hold beside plain entities: splines of other programs, letters, units, and kinds that are not
// read.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/drawing_text_of.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

std::string place(int code, const Eigen::Vector3d& at) {
  char text[120];
  std::snprintf(text, sizeof text, " %d %.17g %d %.17g %d %.17g", code, at.x(), code + 10, at.y(), code + 20,
                at.z());
  return text;
}

bool says(const Diagnostic& diagnostic, const std::string& words) {
  return diagnostic.message.find(words) != std::string::npos;
}

// -------------------------------------------------------------------------------------------------------
// polylines fitted by splines

/// A POLYLINE fitted by a spline (kind: group 75) with this frame, and places drawn on it.
std::string fitted_polyline(int flags, int kind, const std::vector<Eigen::Vector3d>& frame,
                            const std::vector<Eigen::Vector3d>& drawn) {
  std::string text = "0 POLYLINE 66 1 70 " + std::to_string(flags) + " 75 " + std::to_string(kind);
  for (const auto& at : drawn) text += " 0 VERTEX 70 8" + place(10, at);
  for (const auto& at : frame) text += " 0 VERTEX 70 16" + place(10, at);
  return text + " 0 SEQEND";
}

TEST(FittedPolylines, AreTheCubicSplineOfTheirFrame) {
  // With four corners in the frame it is one Bezier curve: (3u, 3u (1 - u)).
  const std::vector<Eigen::Vector3d> frame{{0, 0, 0}, {1, 1, 0}, {2, 1, 0}, {3, 0, 0}};
  std::vector<Eigen::Vector3d> drawn;
  for (int i = 0; i <= 8; ++i) drawn.emplace_back(3 * i / 8.0, 3 * i / 8.0 * (1 - i / 8.0), 0);
  const ImportReport report = import_drawing(drawing_of(fitted_polyline(4, 6, frame, drawn)));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(report.diagnostics.empty());
  const NurbsCurve& curve = report.curves[0].curve;
  EXPECT_EQ(curve.degree(), 3);
  for (double u = 0; u <= 1; u += 0.1)
    EXPECT_LE((curve.point(u) - Eigen::Vector3d(3 * u, 3 * u * (1 - u), 0)).norm(), 1e-15);
}

TEST(FittedPolylines, OfTwoSpansHaveTheUniformKnotBetweenThem) {
  // A parabola is its own spline: its frame for the knots 0 0 0 1 2 2 2 is the blossom of (u, u^2).
  const std::vector<Eigen::Vector3d> frame{{0, 0, 5}, {0.5, 0, 5}, {1.5, 2, 5}, {2, 4, 5}};
  const std::vector<Eigen::Vector3d> drawn{{0, 0, 5}, {0.5, 0.25, 5}, {1, 1, 5}, {1.5, 2.25, 5}, {2, 4, 5}};
  const ImportReport report = import_drawing(drawing_of(fitted_polyline(8 | 4, 5, frame, drawn)));
  ASSERT_EQ(report.curves.size(), 1U);
  const NurbsCurve& curve = report.curves[0].curve;
  EXPECT_EQ(curve.degree(), 2);
  EXPECT_EQ(curve.control_points().cols(), 4);
  for (double u = 0; u <= 2; u += 0.1)
    EXPECT_LE((curve.point(u) - Eigen::Vector3d(u, u * u, 5)).norm(), 1e-14);
}

TEST(FittedPolylines, ClosedOnesGoAroundSmoothly) {
  // The uniform quadratic around a square touches the middles of its sides.
  const std::vector<Eigen::Vector3d> frame{{1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}, {1, -1, 0}};
  const std::vector<Eigen::Vector3d> drawn{{0, 1, 0},         {-0.75, 0.75, 0}, {-1, 0, 0},
                                           {-0.75, -0.75, 0}, {0, -1, 0},       {1, 0, 0}};
  const ImportReport report = import_drawing(drawing_of(fitted_polyline(1 | 4, 5, frame, drawn)));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(report.diagnostics.empty());
  const NurbsCurve& curve = report.curves[0].curve;
  EXPECT_LE((start_of(curve) - end_of(curve)).norm(), 1e-15);
  const double start = curve.knots().start(), end = curve.knots().end();
  EXPECT_LE((curve.derivatives(start, 1).col(1) - curve.derivatives(end, 1).col(1)).norm(), 1e-14);
  // Four parabolas (1 - t)^2, 2t (1 - t), t^2 of the middles of two sides and the corner between them.
  EXPECT_NEAR(length(curve), 4 * (std::numbers::sqrt2 + std::asinh(1.0)) / std::numbers::sqrt2, 1e-13);
}

TEST(FittedPolylines, WhoseFrameIsNotThereOrSaysOtherwiseAreChordsWithANote) {
  const std::vector<Eigen::Vector3d> drawn{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}},
      frame{{0, 0, 0}, {1, 5, 0}, {2, 0, 0}};
  for (const auto& [of, reason] :
       {std::pair{std::vector<Eigen::Vector3d>(), "no frame"}, {frame, "of its size off"}}) {
    const ImportReport report = import_drawing(drawing_of(fitted_polyline(4, 6, of, drawn)));
    ASSERT_EQ(report.curves.size(), 1U);
    EXPECT_NEAR(length(report.curves[0].curve), 2 * std::numbers::sqrt2, 1e-15);
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
    EXPECT_TRUE(says(report.diagnostics[0], reason)) << report.diagnostics[0].message;
  }
}

// -------------------------------------------------------------------------------------------------------
// splines

TEST(DrawnSplines, OfAHelixAreItsFirstClass) {
  // The control points and knots of its spline come before the numbers of the helix, under the same groups.
  const ImportReport report = import_drawing(drawing_of(
      "0 HELIX 8 spring 100 AcDbEntity 100 AcDbSpline 71 2 72 6 73 3 40 0 40 0 40 0 40 1 40 1 40 1 "
      "10 1 20 0 30 0 10 1 20 1 30 0 10 0 20 1 30 0 100 AcDbHelix 90 29 91 63 10 7 20 7 30 7 11 20 "
      "21 0 31 0 12 0 22 0 32 1 40 20 41 1.5 42 15 290 1 280 1"));
  ASSERT_EQ(report.curves.size(), 1U);
  EXPECT_TRUE(report.diagnostics.empty());
  EXPECT_LE((report.curves[0].curve.point(0.5) - Eigen::Vector3d(0.75, 0.75, 0)).norm(), 1e-15);
}

// -------------------------------------------------------------------------------------------------------
// helices without a spline

/// About the axis through (1, 2, 3) along x, from (1, 2, 3 + radius).
std::string helix(double radius, double end_radius, double turns, double height, bool turns_right = true) {
  char numbers[120];
  std::snprintf(numbers, sizeof numbers, " 40 %.17g 41 %.17g 42 %.17g 290 %d", end_radius, turns, height,
                turns_right ? 1 : 0);
  return "0 HELIX 8 spring 100 AcDbEntity 100 AcDbSpline 70 8 71 3 100 AcDbHelix 90 29 91 63" +
         place(10, {1, 2, 3}) + place(11, {1, 2, 3 + radius}) + place(12, {2, 0, 0}) + numbers;
}

TEST(DrawnHelices, LieAtTheirRadiusAndRiseEvenly) {
  const ImportReport report = import_drawing(drawing_of(helix(20, 20, 2.5, 15)));
  ASSERT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_TRUE(says(report.diagnostics[0], "helix without a spline"));
  EXPECT_FALSE(report.curves[0].exact);
  const double turn = std::hypot(2 * pi * 20, 15);
  EXPECT_LE(report.curves[0].deviation, 1e-7 * turn);
  const NurbsCurve& curve = report.curves[0].curve;
  EXPECT_NEAR(length(curve), 2.5 * turn, 1e-6 * turn);
  EXPECT_LE((start_of(curve) - Eigen::Vector3d(1, 2, 23)).norm(), 1e-12);
  EXPECT_LE((end_of(curve) - Eigen::Vector3d(1 + 2.5 * 15, 2, -17)).norm(), 1e-12);
  const double first = curve.knots().start(), last = curve.knots().end();
  for (int i = 0; i <= 1000; ++i) {
    const Eigen::Vector3d at = curve.point(first + (last - first) * i / 1000) - Eigen::Vector3d(1, 2, 3);
    EXPECT_NEAR(std::hypot(at.y(), at.z()), 20, 1e-7 * turn);
    const double angle = 2 * pi * at.x() / 15;  // by the right hand about x, from z towards -y
    EXPECT_NEAR(at.y(), -20 * std::sin(angle), 1e-6 * turn);
  }
}

/// The root of (2 pi turns r)^2 and what it goes outwards and up, squared, integrated by r.
double length_of_cone(double start, double end, double turns, double height) {
  const double around = 2 * pi * turns, along = std::hypot(end - start, turns * height);
  const auto primitive = [&](double r) {
    const double x = around * r;
    return 0.5 * (x * std::hypot(x, along) + along * along * std::asinh(x / along)) / around;
  };
  return (primitive(end) - primitive(start)) / (end - start);
}

TEST(DrawnHelices, TurnLeftOrMakeConesWhereTheySaySo) {
  const ImportReport left = import_drawing(drawing_of(helix(20, 20, 0.25, 40, false)));
  EXPECT_LE((end_of(left.curves.at(0).curve) - Eigen::Vector3d(11, 22, 3)).norm(), 1e-12);
  const ImportReport cone = import_drawing(drawing_of(helix(20, 5, 3, 10)));
  EXPECT_LE((end_of(cone.curves.at(0).curve) - Eigen::Vector3d(31, 2, 8)).norm(), 1e-12);
  EXPECT_NEAR(length(cone.curves[0].curve), length_of_cone(20, 5, 3, 10), 1e-5);
  const ImportReport from_a_point = import_drawing(drawing_of(helix(0, 5, 3, 10)));
  EXPECT_NEAR(length(from_a_point.curves.at(0).curve), length_of_cone(0, 5, 3, 10), 1e-5);
}

TEST(DrawnHelices, WithoutTheirNumbersAreNamed) {
  for (const auto& [entity, words] :
       {std::pair<std::string, std::string>{helix(20, 20, 0, 15), "0 turns"},
        {helix(0, 0, 2, 15), "radius is 0"},
        {helix(20, -20, 2, 15), "radius is -20"},
        {"0 HELIX 100 AcDbSpline 70 8 100 AcDbHelix 10 0 20 0 30 0 11 1 21 0 31 0", "a number of turns"}}) {
    const ImportReport report = import_drawing(drawing_of(entity + " 0 LINE 10 0 20 0 11 1 21 0"));
    EXPECT_EQ(report.curves.size(), 1U);
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_TRUE(says(report.diagnostics[0], words)) << report.diagnostics[0].message;
  }
}

TEST(DrawnSplines, OfFitPointsAreTheCubicThroughThemByChords) {
  // Along a line they are even; between them the cubic without curvature at its ends.
  const ImportReport straight =
      import_drawing(drawing_of("0 SPLINE 70 8 71 3 74 3 11 0 21 0 31 0 11 3 21 4 31 0 11 6 21 8 31 0"));
  ASSERT_EQ(straight.curves.size(), 1U);
  EXPECT_NEAR(length(straight.curves[0].curve), 10, 1e-14);
  ASSERT_EQ(straight.diagnostics.size(), 1U);
  EXPECT_EQ(straight.diagnostics[0].severity, Severity::note);
  const ImportReport tent =
      import_drawing(drawing_of("0 SPLINE 71 3 74 3 11 -3 21 0 31 0 11 0 21 4 31 0 11 3 21 0 31 0"));
  const NurbsCurve& curve = tent.curves.at(0).curve;  // chords of 5: y = 4 (1.5 t - 0.5 t^3)
  for (double t = 0; t <= 1; t += 0.1)
    EXPECT_LE((curve.point(5 * t) - Eigen::Vector3d(3 * t - 3, 4 * (1.5 * t - 0.5 * t * t * t), 0)).norm(),
              1e-14);
}

TEST(DrawnSplines, OfFitPointsHaveTheirEndTangents) {
  const ImportReport report = import_drawing(
      drawing_of("0 SPLINE 71 3 74 2 12 0 22 7 32 0 13 0 23 -2 33 0 11 0 21 0 31 0 11 4 21 0 31 0"));
  const NurbsCurve& arch = report.curves.at(0).curve;  // Hermite: slopes of length 1 over a chord of 4
  EXPECT_LE((arch.derivatives(0, 1).col(1) - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((arch.derivatives(4, 1).col(1) + Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LE((arch.point(2) - Eigen::Vector3d(2, 1, 0)).norm(), 1e-15);
}

TEST(DrawnSplines, ClosedOnesOfFitPointsAreSmoothWhereTheyMeet) {
  std::string points;
  for (int i = 0; i < 12; ++i) points += place(11, {std::cos(i * pi / 6), std::sin(i * pi / 6), 0});
  const ImportReport report = import_drawing(drawing_of("0 SPLINE 70 1 71 3 74 12" + points));
  const NurbsCurve& ring = report.curves.at(0).curve;
  const Eigen::Matrix3Xd start = ring.derivatives(ring.knots().start(), 2),
                         end = ring.derivatives(ring.knots().end(), 2);
  EXPECT_LE((start - end).norm(), 1e-12);
  EXPECT_NEAR(length(ring), 2 * pi, 2e-3);
  for (double u = ring.knots().start(); u <= ring.knots().end(); u += 0.01)
    EXPECT_NEAR(ring.point(u).norm(), 1, 3e-4);
}

TEST(DrawnSplines, ChainsOfBezierCurvesAreSplitAndJoinedWhereTheyMeet) {
  const std::string knots = "0 SPLINE 71 1 40 0 40 0 40 1 40 1 40 2 40 2 ";
  const ImportReport joined =
      import_drawing(drawing_of(knots + "10 0 20 0 30 0 10 3 20 4 30 0 10 3 20 4 30 0 10 3 20 5 30 0"));
  ASSERT_EQ(joined.curves.size(), 1U);
  EXPECT_NEAR(length(joined.curves[0].curve), 6, 1e-15);
  const ImportReport apart =
      import_drawing(drawing_of(knots + "10 0 20 0 30 0 10 3 20 4 30 0 10 7 20 4 30 0 10 7 20 5 30 0"));
  ASSERT_EQ(apart.curves.size(), 2U);
  EXPECT_NEAR(length(apart.curves[0].curve), 5, 1e-15);
  EXPECT_NEAR(length(apart.curves[1].curve), 1, 1e-15);
}

// -------------------------------------------------------------------------------------------------------
// binary drawings

/// Pairs as bytes.
class BinaryDrawing {
 public:
  explicit BinaryDrawing(bool short_codes) : short_codes_(short_codes) {}
  BinaryDrawing& text(int code, const std::string& value) {
    add_code(code);
    bytes_ += value + '\0';
    return *this;
  }
  template <class Number>
  BinaryDrawing& number(int code, Number value) {
    add_code(code);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    return *this;
  }
  BinaryDrawing& chunk(int code, const std::string& value) {
    add_code(code);
    bytes_ += static_cast<char>(value.size());
    bytes_ += value;
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void add_code(int code) {
    if (short_codes_ && code < 255) {
      bytes_ += static_cast<char>(code);
      return;
    }
    if (short_codes_) bytes_ += '\xFF';
    bytes_ += static_cast<char>(code & 0xFF);
    bytes_ += static_cast<char>(code >> 8);
  }
  bool short_codes_;
  std::string bytes_ = std::string("AutoCAD Binary DXF\r\n\x1A", 21) + '\0';
};

/// A spline and, around it, pairs of every kind of value.
std::string binary_parabola(bool short_codes) {
  BinaryDrawing out(short_codes);
  out.text(0, "SECTION").text(2, "HEADER").text(9, "$INSUNITS").number<std::int16_t>(70, 6).text(0, "ENDSEC");
  out.text(0, "SECTION").text(2, "ENTITIES").text(0, "SPLINE").text(8, "ab\nle").text(330, "1F");
  out.number<std::int16_t>(71, 2).number<std::int32_t>(420, 0xFF8000).number<std::int64_t>(160, -5);
  out.number<std::uint8_t>(290, 1)
      .chunk(310, "chunk\0of bytes")
      .number<double>(210, 0)
      .number<std::int16_t>(370, -1);
  for (const double knot : {0, 0, 0, 1, 1, 1}) out.number<double>(40, knot);
  for (const double x : {0.0, 0.5, 1.0})
    out.number<double>(10, x).number<double>(20, x == 0.5 ? 1.0 / 3 : 0).number<double>(30, 0);
  out.text(1001, "ACAD").text(1000, "text").chunk(1004, "xx").number<double>(1010, 0.5);
  out.number<std::int16_t>(1070, 3).number<std::int32_t>(1071, 4);
  return out.text(0, "ENDSEC").text(0, "EOF").bytes();
}

TEST(BinaryDrawings, AreReadAsTheirText) {
  for (const bool short_codes : {false, true}) {
    const ImportReport report = import_drawing(binary_parabola(short_codes));
    ASSERT_EQ(report.curves.size(), 1U) << report.diagnostics.at(0).message;
    EXPECT_TRUE(report.diagnostics.empty());
    EXPECT_EQ(report.curves[0].layer, "ab le");
    EXPECT_EQ(report.curves[0].colour, "#ff8000");
    EXPECT_EQ(report.unit, "m");
    const NurbsCurve& curve = report.curves[0].curve;
    for (double u = 0; u <= 1; u += 0.125)
      EXPECT_LE((curve.point(u) - Eigen::Vector3d(u, 2.0 / 3 * u * (1 - u), 0)).norm(), 1e-16);
  }
}

TEST(BinaryDrawings, ThatAreCutOffOrOfUnknownGroupsAreNamed) {
  const std::string whole = binary_parabola(false);
  for (std::size_t size = 23; size < whole.size(); size += 7) {
    const ImportReport report = import_drawing(whole.substr(0, size));
    ASSERT_TRUE(has_errors(report.diagnostics)) << size;
    EXPECT_TRUE(says(report.diagnostics[0], "truncated") || says(report.diagnostics[0], "group code"))
        << report.diagnostics[0].message;
  }
  BinaryDrawing out(false);
  out.text(0, "SECTION").text(6000, "x");
  EXPECT_TRUE(says(import_drawing(out.bytes()).diagnostics.at(0), "the group code 6000 at byte"));
}

// -------------------------------------------------------------------------------------------------------
// letters

std::string layer_of(const std::string& layer, const std::string& header) {
  const ImportReport report = import_drawing(drawing_of(
      "0 LINE 8 " + layer + " 10 0 11 1", "9 $INSUNITS 70 6" + (header.empty() ? "" : " " + header)));
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics[0].message;
  return report.curves.at(0).layer;
}

TEST(LettersOfDrawings, AreThoseOfTheCodePage) {
  const std::string before_2007 = "9 $ACADVER 1 AC1015 9 $DWGCODEPAGE 3 ";
  for (const auto& [page, bytes, letters] : {std::tuple{"ANSI_1251", "\xEA\xE0\xE1\xE5\xEB\xFC", "кабель"},
                                             {"ansi_1250", "\xE8\xE1ra", "čára"},
                                             {"ANSI_1252", "Tr\xE4ger", "Träger"},
                                             {"ANSI_1253", "\xEA\xE1\xEB", "καλ"},
                                             {"DOS850", "Tr\x84ger", "Träger"},
                                             {"dos866", "\xAA\xA0\xA1", "каб"},
                                             {"ISO8859-2", "\xB1", "ą"},
                                             {"MACINTOSH", "Tr\x8Ager", "Träger"},
                                             {"ANSI_932", "\x83\x50\x81\x5B\x83\x75\x83\x8B", "ケーブル"},
                                             {"ANSI_936", "\xB5\xE7\xC0\xC2", "电缆"},
                                             {"GB2312", "\xC1\xAA\xCD\xA8", "联通"},
                                             {"ANSI_949", "\xC0\xFC\xBC\xB1", "전선"},
                                             {"ANSI_950", "\xB9\x71\xC6\x6C", "電纜"},
                                             {"ANSI_874", "\xCA\xD2\xC2", "สาย"}})
    EXPECT_EQ(layer_of(bytes, before_2007 + page), letters) << page;
}

TEST(LettersOfDrawings, InUtf8StaySoWhateverTheyDeclare) {
  EXPECT_EQ(layer_of("кабель", "9 $ACADVER 1 AC1021 9 $DWGCODEPAGE 3 ANSI_1252"), "кабель");
  EXPECT_EQ(layer_of("Träger", "9 $ACADVER 1 AC1015 9 $DWGCODEPAGE 3 ANSI_1252"), "Träger");
  EXPECT_EQ(layer_of("电缆", "9 $ACADVER 1 AC1015 9 $DWGCODEPAGE 3 ANSI_936"), "电缆");
  EXPECT_EQ(layer_of("Tr\xE4ger", ""), "Träger");
  EXPECT_EQ(layer_of("\x80uro", ""), "€uro");  // Windows-1252
}

TEST(LettersOfDrawings, OfSeveralBytesMayBeWrittenByTheirNumbers) {
  EXPECT_EQ(layer_of("\\M+5B5E7\\M+5C0C2", ""), "电缆");
  EXPECT_EQ(layer_of("\\M+18350x", ""), "ケx");
  EXPECT_EQ(layer_of("\\M+9B5E7", ""), "\\M+9B5E7");
  EXPECT_EQ(layer_of("\\M+5B5", ""), "\\M+5B5");
}

TEST(LettersOfDrawings, OfAnUnknownCodePageAreNamed) {
  const ImportReport report =
      import_drawing(drawing_of("0 LINE 8 Tr\xE4ger 11 1", "9 $INSUNITS 70 6 9 $DWGCODEPAGE 3 EBCDIC"));
  EXPECT_EQ(report.curves.at(0).layer, "Träger");
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_TRUE(says(report.diagnostics[0], "'EBCDIC'"));
  EXPECT_TRUE(import_drawing(drawing_of("0 LINE 8 a 11 1", "9 $INSUNITS 70 6 9 $DWGCODEPAGE 3 EBCDIC"))
                  .diagnostics.empty());
}

// -------------------------------------------------------------------------------------------------------
// units, ends, and kinds

TEST(UnitsOfDrawings, WithoutInsunitsAreThoseOfMeasurement) {
  const auto report_with = [](const std::string& header) {
    return import_drawing(drawing_of("0 LINE 11 3 21 4", header));
  };
  const ImportReport inches = report_with("9 $MEASUREMENT 70 0");
  EXPECT_NEAR(length(inches.curves.at(0).curve), 0.127, 1e-16);
  EXPECT_EQ(inches.unit, "inch");
  ASSERT_EQ(inches.diagnostics.size(), 1U);
  EXPECT_EQ(inches.diagnostics[0].severity, Severity::note);
  EXPECT_TRUE(says(inches.diagnostics[0], "$MEASUREMENT"));
  EXPECT_NEAR(length(report_with("9 $MEASUREMENT 70 1").curves.at(0).curve), 0.005, 1e-17);
  EXPECT_NEAR(length(report_with("9 $MEASUREMENT 70 0 9 $INSUNITS 70 5").curves.at(0).curve), 0.05, 1e-16);
  const ImportReport unitless = report_with("9 $INSUNITS 70 0 9 $MEASUREMENT 70 0");
  EXPECT_EQ(unitless.unit, "inch");
  EXPECT_EQ(unitless.diagnostics.at(0).severity, Severity::warning);
}

TEST(EndsOfDrawings, TextBehindEofIsPassedOver) {
  const ImportReport report = import_drawing(drawing_of("0 LINE 11 5") + "written by\nsome program");
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  EXPECT_TRUE(says(report.diagnostics[0], "23 bytes"));
  EXPECT_TRUE(import_drawing(drawing_of("0 LINE 8 EOF 11 5") + "\r\n \n\x1A").diagnostics.empty());
}

TEST(KindsThatAreNotRead, AreOneNoteWithTheirNumbers) {
  const std::string kinds =
      "0 LINE 11 5 0 LEADER 10 0 0 HATCH 10 0 0 AECC_ALIGNMENT 10 1 0 HATCH 10 1 0 TEXT 1 x 0 POINT 10 1 0 POLYLINE 70 "
      "64 0 VERTEX 70 192 0 SEQEND 0 HATCH 67 1";
  const ImportReport report = import_drawing(drawing_of(kinds));
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
  EXPECT_TRUE(says(report.diagnostics[0],
                   "4 kind(s) are not read: 1 AECC_ALIGNMENT, 2 HATCH, 1 LEADER, 1 POLYLINE (mesh)"))
      << report.diagnostics[0].message;
}

TEST(KindsThatAreNotRead, InBlocksCountOnceHoweverOftenTheseStand) {
  std::string text = drawing_of("0 INSERT 2 b 0 INSERT 2 b 10 5 0 INSERT 2 b 10 9");
  text = with(
      text, "0\nSECTION\n2\nENTITIES",
      dxf_pairs(
          "0 SECTION 2 BLOCKS 0 BLOCK 2 b 0 LINE 11 1 0 LEADER 10 1 0 ARC 40 -1 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES"));
  const ImportReport report = import_drawing(with(text, "ENTITIES\n\n", "ENTITIES\n"));
  EXPECT_EQ(report.curves.size(), 3U);
  ASSERT_EQ(report.diagnostics.size(), 2U);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_FALSE(says(report.diagnostics[0], "in all"));
  EXPECT_TRUE(says(report.diagnostics[1], "1 LEADER"));
}

TEST(KindsThatAreNotRead, DamagedEntitiesOfOneReasonAreOneWarning) {
  const ImportReport report =
      import_drawing(drawing_of("0 ARC 40 -1 0 LINE 11 5 0 ARC 40 -2 0 CIRCLE 40 -1"));
  EXPECT_EQ(report.curves.size(), 1U);
  ASSERT_EQ(report.diagnostics.size(), 1U);
  EXPECT_NE(report.diagnostics[0].where.find("entity 1 ARC"), std::string::npos);
  EXPECT_TRUE(says(report.diagnostics[0], "3 entities in all"));
}

TEST(ManyBlocks, AreReadInTimeThatGrowsWithTheirNumber) {
  // 5000 blocks, 20000 inserts: a search through all blocks for each insert would take a minute.
  std::string blocks = "0 SECTION 2 BLOCKS", inserts = "0 LINE 11 1";
  for (int i = 0; i < 5000; ++i)
    blocks += " 0 BLOCK 2 part_" + std::to_string(i) + " 0 LINE 10 0 20 0 11 3 21 4 0 ENDBLK";
  for (int i = 0; i < 20000; ++i)
    inserts += " 0 INSERT 2 PART_" + std::to_string(i * 7 % 5000) + " 10 " + std::to_string(i);
  std::string text = drawing_of(inserts);
  text = with(text, "0\nSECTION\n2\nENTITIES", dxf_pairs(blocks + " 0 ENDSEC 0 SECTION 2 ENTITIES"));
  const ScratchDirectory scratch;
  ImportOptions options;
  options.time_limit = std::chrono::seconds(5);
  const ImportReport report =
      import_curves(scratch.file("drawing.dxf", with(text, "ENTITIES\n\n", "ENTITIES\n")), options);
  ASSERT_EQ(report.curves.size(), 20001U) << report.diagnostics.at(0).message;
  EXPECT_LE((start_of(report.curves[20000].curve) - Eigen::Vector3d(19999, 0, 0)).norm(), 1e-10);
  EXPECT_EQ(report.curves[20000].name, "part_" + std::to_string(19999 * 7 % 5000));
}

}  // namespace
}  // namespace nurbeam
