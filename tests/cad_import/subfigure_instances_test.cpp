// Instances (408) of subfigures (308) of IGES: at any scale, under matrices (124), in groups, arrays and each
// other.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/imported_text.h"

namespace nurbeam {
namespace {

constexpr int dependent = 10000;   // the entity is a part of another one
constexpr int definition = 20200;  // and defines what others place

IgesEntity rod(const std::string& numbers = "1.,0.,0.,11.,0.,0.") {
  return {.type = 110, .parameters = "110," + numbers + ";", .label = "rod", .status = dependent};
}
IgesEntity subfigure_of(const std::string& member) {
  return {.type = 308, .parameters = "308,0,3Hsub,1," + member + ";", .status = definition};
}
IgesEntity instance(const std::string& numbers, int matrix = 0, int status = 0) {
  return {.type = 408,
          .parameters = "408," + numbers + ";",
          .label = "placed",
          .status = status,
          .matrix = matrix};
}

using Line = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

/// The lines of the file, start and end in millimetres.
void expect_lines(const ImportReport& report, const std::vector<Line>& lines) {
  ASSERT_EQ(report.curves.size(), lines.size());
  for (std::size_t i = 0; i < lines.size(); ++i) {
    EXPECT_LE((1e3 * start_of(report.curves[i].curve) - lines[i].first).norm(), 1e-12) << i;
    EXPECT_LE((1e3 * end_of(report.curves[i].curve) - lines[i].second).norm(), 1e-12) << i;
  }
}

TEST(SubfigureInstances, AreScaledWithAMatrixAndWithout) {
  const IgesEntity identity{.type = 124, .parameters = "124,1,0,0,0,0,1,0,0,0,0,1,0;", .status = dependent};
  for (const int matrix : {0, 9}) {
    const ImportReport report =
        import_text(iges_text_of({rod(), subfigure_of("1"), instance("3,5.,6.,7.,1.", matrix),
                                  instance("3,5.,6.,7.,3.", matrix), identity}));
    expect_lines(report, {{{6, 6, 7}, {16, 6, 7}}, {{8, 6, 7}, {38, 6, 7}}});
    EXPECT_TRUE(report.diagnostics.empty());
  }
  const ImportReport at_origin =
      import_text(iges_text_of({rod(), subfigure_of("1"), instance("3,0.,0.,0.,0.5")}));
  expect_lines(at_origin, {{{0.5, 0, 0}, {5.5, 0, 0}}});
}

TEST(SubfigureInstances, AreMovedAfterTheirMatrixHasTurnedThem) {
  // By 90 degrees about z, and moved by (1, 2, 3).
  const IgesEntity turn{.type = 124, .parameters = "124,0,-1,0,1,1,0,0,2,0,0,1,3;", .status = dependent};
  for (const double scale : {1.0, 2.0}) {
    const ImportReport report = import_text(
        iges_text_of({rod(), subfigure_of("1"), instance("3,100.,0.,0.," + std::to_string(scale), 7), turn}));
    expect_lines(report, {{{101, 2 + scale, 3}, {101, 2 + 11 * scale, 3}}});
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_EQ(report.diagnostics[0].severity, Severity::note);
    EXPECT_NE(report.diagnostics[0].where.find("'placed'"), std::string::npos);
    EXPECT_NE(report.diagnostics[0].message.find("not turned"), std::string::npos);
  }
}

TEST(SubfigureInstances, OfInstancesInGroupsAndArraysAreScaledToo) {
  expect_lines(import_text(iges_text_of({rod(), subfigure_of("1"), instance("3,1.,0.,0.,2.", 0, dependent),
                                         subfigure_of("5"), instance("7,0.,5.,0.,3.")})),
               {{{9, 5, 0}, {69, 5, 0}}});
  const std::vector<Line> twice{{{3, 0, 0}, {23, 0, 0}}, {{103, 0, 0}, {123, 0, 0}}};
  expect_lines(import_text(iges_text_of({rod(),
                                         subfigure_of("1"),
                                         instance("3,1.,0.,0.,2.", 0, dependent),
                                         instance("3,101.,0.,0.,2.", 0, dependent),
                                         {.type = 402, .parameters = "402,2,5,7;", .form = 7}})),
               twice);
  expect_lines(
      import_text(iges_text_of({rod(),
                                subfigure_of("1"),
                                instance("3,1.,0.,0.,2.", 0, dependent),
                                {.type = 412, .parameters = "412,5,1.,0.,0.,0.,2,1,100.,0.,0.,0,0;"}})),
      twice);
}

TEST(SubfigureInstances, MirrorAndScaleArcs) {
  const IgesEntity mirror{
      .type = 124, .parameters = "124,-1,0,0,10,0,1,0,0,0,0,1,0;", .form = 1, .status = dependent};
  const ImportReport report =
      import_text(iges_text_of({{.type = 100, .parameters = "100,0,0,0,5,0,0,5;", .status = dependent},
                                subfigure_of("1"),
                                instance("3,0.,0.,0.,2.", 7),
                                mirror}));
  expect_lines(report, {{{0, 0, 0}, {10, 10, 0}}});
  EXPECT_NEAR(1e3 * length(report.curves[0].curve), 10 * std::numbers::pi / 2, 1e-12);
}

TEST(SubfigureInstances, ScaleThePipesThatTheyPlace) {
  const ImportReport report =
      import_text(iges_text_of({{.type = 100, .parameters = "100,0,0,0,5,0,5,0;", .status = dependent},
                                {.type = 122, .parameters = "122,1,5.,0.,100.;", .status = dependent},
                                subfigure_of("3"),
                                instance("5,0.,0.,7.,2.")}));
  const auto axis = std::find_if(report.curves.begin(), report.curves.end(),
                                 [](const ImportedCurve& curve) { return curve.is_centre_line(); });
  ASSERT_NE(axis, report.curves.end());
  EXPECT_NEAR(axis->pipe_radius, 10e-3, 1e-12);
  EXPECT_NEAR(length(axis->curve), 0.2, 1e-12);
}

TEST(SubfigureInstances, WithoutAPlaceAreNamedAndHarmNothing) {
  const auto expect_left_out = [](const IgesEntity& bad, const IgesEntity& matrix, const std::string& text) {
    const ImportReport report =
        import_text(iges_text_of({rod(), subfigure_of("1"), bad, instance("3,0.,0.,0.,1."), matrix}));
    expect_lines(report, {{{1, 0, 0}, {11, 0, 0}}});
    ASSERT_EQ(report.diagnostics.size(), 1U);
    EXPECT_NE(report.diagnostics[0].where.find("D5"), std::string::npos) << report.diagnostics[0].where;
    EXPECT_NE(report.diagnostics[0].message.find(text), std::string::npos) << report.diagnostics[0].message;
  };
  const IgesEntity stretch{.type = 124, .parameters = "124,2,0,0,0,0,1,0,0,0,0,1,0;", .status = dependent};
  expect_left_out(instance("3,0.,0.,0.,0."), stretch, "its scale is 0; it must be positive");
  expect_left_out(instance("3,0.,0.,0.,-2."), stretch, "its scale is -2");
  expect_left_out(instance("3,0.,0.,0.,2.", 9), stretch, "stretches");
}

}  // namespace
}  // namespace nurbeam
