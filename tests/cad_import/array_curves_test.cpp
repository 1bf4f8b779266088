// Arrays of IGES (412, 414): copies of a base entity, in rows and columns or on a circle.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/iges_text_of.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {
namespace {

constexpr int dependent = 10000;  // the entity is a part of another one

const IgesEntity spoke{
    .type = 110, .parameters = "110,0.,0.,0.,1.,0.,0.;", .label = "spoke", .status = dependent};

ImportReport import_entities(const std::vector<IgesEntity>& entities) {
  const ScratchDirectory scratch;
  return import_curves(scratch.file("array.igs", iges_text_of(entities)));
}

/// The start and the direction of each line, start to end [mm].
void expect_lines(const ImportReport& report, const std::vector<Eigen::Vector3d>& starts,
                  const Eigen::Vector3d& run) {
  EXPECT_TRUE(report.diagnostics.empty()) << report.diagnostics.at(0).message;
  ASSERT_EQ(report.curves.size(), starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const NurbsCurve& line = report.curves[i].curve;
    EXPECT_LE((1e3 * line.point(line.knots().start()) - starts[i]).norm(), 1e-12) << i;
    EXPECT_LE((1e3 * line.point(line.knots().end()) - starts[i] - run).norm(), 1e-12) << i;
  }
}

TEST(ArrayCurves, ARectangularArrayIsTurnedAndItsCopiesAreNot) {
  // Two columns 10 apart and three rows 5 apart, turned by 90 degrees about the corner, at twice the size.
  const ImportReport report = import_entities(
      {spoke, {.type = 412, .parameters = "412,1,2.,100.,0.,7.,2,3,10.,5.,1.5707963267948966,0,0;"}});
  expect_lines(report, {{100, 0, 7}, {95, 0, 7}, {90, 0, 7}, {100, 10, 7}, {95, 10, 7}, {90, 10, 7}},
               {2, 0, 0});
  for (const ImportedCurve& curve : report.curves) EXPECT_EQ(curve.name, "spoke");
}

TEST(ArrayCurves, AListSaysWhichPositionsAreFilledOrNot) {
  const auto array = [](const char* list) {
    return import_entities(
        {spoke, {.type = 412, .parameters = "412,1,1.,0.,0.,0.,2,2,10.,5.,0.," + std::string(list) + ";"}});
  };
  expect_lines(array("2,0,1,4"), {{0, 0, 0}, {10, 5, 0}}, {1, 0, 0});
  expect_lines(array("1,1,2"), {{0, 0, 0}, {10, 0, 0}, {10, 5, 0}}, {1, 0, 0});
}

TEST(ArrayCurves, ACircularArrayHasItsCopiesOnTheCircle) {
  const ImportReport report = import_entities(
      {spoke,
       {.type = 414, .parameters = "414,1,4,1.,2.,3.,20.,0.,1.5707963267948966,0,0;", .label = "wheel"}});
  expect_lines(report, {{21, 2, 3}, {1, 22, 3}, {-19, 2, 3}, {1, -18, 3}}, {1, 0, 0});
}

TEST(ArrayCurves, ArraysOfArraysAndOfGroupsUnderAMatrixLieWhereTheyShould) {
  // x to y, y to z, z to x, and moved by (1, 2, 3).
  const IgesEntity matrix{.type = 124, .parameters = "124,0.,0.,1.,1.,1.,0.,0.,2.,0.,1.,0.,3.;"};
  const ImportReport report = import_entities(
      {spoke,
       {.type = 412, .parameters = "412,1,1.,0.,0.,0.,2,1,10.,0.,0.,0,0;", .status = dependent},
       {.type = 414, .parameters = "414,3,2,0.,0.,0.,100.,0.,3.1415926535897932,0,0;", .matrix = 7},
       matrix});
  expect_lines(report, {{1, 102, 3}, {1, 112, 3}, {1, -98, 3}, {1, -88, 3}}, {0, 1, 0});
  const ImportReport group = import_entities(
      {spoke,
       {.type = 100, .parameters = "100,0.,0.,0.,2.,0.,2.,0.;", .label = "rim", .status = dependent},
       {.type = 402, .parameters = "402,2,1,3;", .form = 7, .status = dependent},
       {.type = 412, .parameters = "412,5,1.,0.,0.,0.,1,2,0.,50.,0.,0,0;"}});
  ASSERT_EQ(group.curves.size(), 4U);
  EXPECT_TRUE(group.diagnostics.empty());
  EXPECT_EQ(group.curves[3].name, "rim");
  EXPECT_NEAR(length(group.curves[3].curve), 4e-3 * std::numbers::pi, 1e-15);
  EXPECT_NEAR(1e3 * group.curves[3].curve.point(group.curves[3].curve.knots().start()).y(), 50, 1e-12);
}

TEST(ArrayCurves, WhatCannotBeCopiedIsNamed) {
  const auto warning = [](const std::string& parameters, const std::vector<IgesEntity>& more = {}) {
    std::vector<IgesEntity> entities{{.type = 110, .parameters = "110,0.,0.,0.,9.,0.,0.;", .label = "good"},
                                     spoke,
                                     {.type = 412, .parameters = parameters}};
    entities.insert(entities.end(), more.begin(), more.end());
    const ImportReport report = import_entities(entities);
    EXPECT_EQ(report.curves.size(), 1U);
    EXPECT_EQ(report.diagnostics.size(), 1U);
    return report.diagnostics.empty() ? ""
                                      : report.diagnostics[0].where + ": " + report.diagnostics[0].message;
  };
  EXPECT_NE(warning("412,3,1.,0.,0.,0.,0,2,10.,5.,0.,0,0;").find("0 positions"), std::string::npos);
  EXPECT_NE(warning("412,3,1.,0.,0.,0.,70000,70000,10.,5.,0.,0,0;").find("there may be 1 to 100000"),
            std::string::npos);
  const std::string placed = warning(
      "412,3,1.,0.,0.,0.,2,1,10.,5.,0.,0,0;",
      {{.type = 308, .parameters = "308,0,4Hpart,1,5;"}, {.type = 408, .parameters = "408,7,50.,0.,0.,1.;"}});
  EXPECT_NE(placed.find("D5 RectArraySubfigure"), std::string::npos) << placed;
  EXPECT_NE(placed.find("subfigure"), std::string::npos) << placed;
}

}  // namespace
}  // namespace nurbeam
