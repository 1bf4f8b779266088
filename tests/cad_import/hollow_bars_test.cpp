// Hollow bars with plane sides: their centre lines meet where the axes do that they were made of.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipeShell.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeHalfSpace.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <ShapeUpgrade_UnifySameDomain.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Pln.hxx>
#include <numbers>

#include "cad_import/import_curves.h"
#include "cad_import/occt/centre_line.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam::hollow_bars_of_shapes {
namespace {

TopoDS_Shape without(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Cut(a, b).Shape(); }
TopoDS_Shape fused(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Fuse(a, b).Shape(); }
TopoDS_Shape in_large_faces(const TopoDS_Shape& shape) {
  ShapeUpgrade_UnifySameDomain faces(shape);
  faces.Build();
  return faces.Shape();
}

TopoDS_Shape compound(const std::vector<TopoDS_Shape>& shapes) {
  TopoDS_Compound all;
  const BRep_Builder builder;
  builder.MakeCompound(all);
  for (const TopoDS_Shape& shape : shapes) builder.Add(all, shape);
  return all;
}

/// About the middle of its z = 0 side, up to this length.
TopoDS_Shape box(double width, double height, double length) {
  return BRepPrimAPI_MakeBox(gp_Pnt(-width / 2, -height / 2, 0), width, height, length).Shape();
}

/// A tube of 40 by 20 by 2 mm along z.
TopoDS_Shape tube(double length) { return without(box(40, 20, length), box(36, 16, length)); }

/// A square along lines from place to place, the first along x.
TopoDS_Shape swept(const std::vector<gp_Pnt>& places, double side, bool closed = false) {
  BRepBuilderAPI_MakePolygon path, square;
  for (const gp_Pnt& place : places) path.Add(place);
  if (closed) path.Close();
  const gp_Pnt& at = places[0];
  for (const auto& [y, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    square.Add(gp_Pnt(at.X(), at.Y() + y * side / 2, at.Z() + z * side / 2));
  square.Close();
  BRepOffsetAPI_MakePipeShell sweep(path.Wire());
  sweep.SetTransitionMode(BRepBuilderAPI_RightCorner);
  sweep.Add(square.Wire());
  sweep.Build();
  sweep.MakeSolid();
  return sweep.Shape();
}

TopoDS_Shape square_tube(const std::vector<gp_Pnt>& places) {
  return without(swept(places, 40), swept(places, 34));
}

/// A centre line as it must be [mm].
struct Expected {
  Eigen::Vector3d start, end;
};

/// That there are these centre lines of hollow bars and no others; returns them.
std::vector<ImportedCurve> expect_lines(const TopoDS_Shape& shape, const std::vector<Expected>& expected) {
  std::vector<ImportedCurve> lines;
  const CentreLines found = centre_lines(shape, 1e-7);
  for (const CentreLine& line : found.lines) lines.push_back(line.curve);
  EXPECT_TRUE(found.remarks.empty()) << found.remarks[0];
  EXPECT_EQ(lines.size(), expected.size());
  for (const Expected& one : expected)
    EXPECT_EQ(std::count_if(
                  lines.begin(), lines.end(),
                  [&](const ImportedCurve& line) {
                    constexpr double round_off = 1e-9;  // [mm]
                    const Eigen::Vector3d start = 1e3 * start_of(line.curve), end = 1e3 * end_of(line.curve);
                    return line.is_centre_line() &&
                           std::min((start - one.start).norm() + (end - one.end).norm(),
                                    (start - one.end).norm() + (end - one.start).norm()) <= round_off;
                  }),
              1)
        << one.start.transpose() << " to " << one.end.transpose();
  return lines;
}

TEST(HollowBars, HaveTheirSection) {
  const std::vector<ImportedCurve> lines = expect_lines(tube(200), {{{0, 0, 0}, {0, 0, 200}}});
  ASSERT_EQ(lines.size(), 1U);
  const BarSection& bar = lines[0].bar;
  EXPECT_NEAR(bar.width, 0.04, 1e-15);
  EXPECT_NEAR(bar.height, 0.02, 1e-15);
  EXPECT_NEAR(bar.area, 224e-6, 1e-18);
  EXPECT_NEAR(bar.second_moments.x(), (40 * std::pow(20, 3) - 36 * std::pow(16, 3)) / 12 * 1e-12, 1e-22);
  EXPECT_NEAR(bar.second_moments.y(), (20 * std::pow(40, 3) - 16 * std::pow(36, 3)) / 12 * 1e-12, 1e-22);
}

TEST(HollowBars, OfRolledTubesAreRoundedAtTheirCorners) {
  const auto rounded = [](const TopoDS_Shape& box, double radius) {
    BRepFilletAPI_MakeFillet fillet(box);
    for (TopExp_Explorer edges(box, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
      const gp_Pnt a = BRep_Tool::Pnt(TopExp::FirstVertex(edge)),
                   b = BRep_Tool::Pnt(TopExp::LastVertex(edge));
      if (std::abs(a.Z() - b.Z()) > 1) fillet.Add(radius, edge);
    }
    return fillet.Shape();
  };
  const std::vector<ImportedCurve> lines = expect_lines(
      without(rounded(box(50, 50, 300), 6), rounded(box(44, 44, 300), 3)), {{{0, 0, 0}, {0, 0, 300}}});
  ASSERT_EQ(lines.size(), 1U);
  const double missing = 4 - std::numbers::pi;  // at the corners, of the square of the radius
  EXPECT_NEAR(lines[0].bar.area, (50 * 50 - missing * 36 - (44 * 44 - missing * 9)) * 1e-6, 1e-15);
}

TEST(HollowBars, SweptAlongAPolylineMeetAtItsCorners) {
  expect_lines(square_tube({{0, 0, 0}, {200, 0, 0}, {200, 180, 0}, {200, 180, 150}}),
               {{{0, 0, 0}, {200, 0, 0}}, {{200, 0, 0}, {200, 180, 0}}, {{200, 180, 0}, {200, 180, 150}}});
}

TEST(HollowBars, OfAFrameInOnePieceAreItsSides) {
  const std::vector<gp_Pnt> corners{{100, 0, 0}, {400, 0, 0}, {400, 250, 0}, {0, 250, 0}, {0, 0, 0}};
  const TopoDS_Shape frame = without(swept(corners, 40, true), swept(corners, 34, true));
  for (const TopoDS_Shape& shape : {frame, in_large_faces(frame)}) {
    const CentreLines found = centre_lines(shape, 1e-7);
    double length = 0;
    for (const CentreLine& line : found.lines)
      length += 1e3 * (end_of(line.curve.curve) - start_of(line.curve.curve)).norm();
    EXPECT_NEAR(length, 2 * (400 + 250), 1e-6);
    EXPECT_TRUE(found.remarks.empty()) << found.remarks[0];
  }
}

TEST(HollowBars, CutByAPlaneEndWhereItMeetsTheCentreLine) {
  // z <= 100 + x / 2
  const TopoDS_Face plane = BRepBuilderAPI_MakeFace(gp_Pln(gp_Pnt(0, 0, 100), gp_Dir(-0.5, 0, 1)));
  const TopoDS_Shape beyond = BRepPrimAPI_MakeHalfSpace(plane, gp_Pnt(0, 0, 200)).Solid();
  expect_lines(without(tube(200), beyond), {{{0, 0, 0}, {0, 0, 100}}});
}

TEST(HollowBars, ThatEndOnAnotherMeetItsCentreLineAndDivideIt) {
  const TopoDS_Shape main = square_tube({{0, 0, 0}, {300, 0, 0}});
  const gp_Trsf move = [] {
    gp_Trsf trsf;
    trsf.SetTranslation(gp_Vec(120, 0, 20));
    return trsf;
  }();
  const TopoDS_Shape branch = tube(200).Moved(TopLoc_Location(move));
  const std::vector<Expected> expected{
      {{0, 0, 0}, {120, 0, 0}}, {{120, 0, 0}, {300, 0, 0}}, {{120, 0, 0}, {120, 0, 220}}};
  expect_lines(compound({main, branch}), expected);
  expect_lines(fused(main, branch), expected);
  const TopoDS_Shape apart = branch.Moved([] {
    gp_Trsf trsf;
    trsf.SetTranslation(gp_Vec(0, 0, 1));
    return TopLoc_Location(trsf);
  }());
  expect_lines(compound({main, apart}), {{{0, 0, 0}, {300, 0, 0}}, {{120, 0, 21}, {120, 0, 221}}});
}

TEST(HollowBars, OfOneWidthFusedAreDividedWhereTheyMeet) {
  const TopoDS_Shape outer = fused(swept({{0, 0, 0}, {300, 0, 0}}, 40), box(40, 40, 200).Moved([] {
    gp_Trsf trsf;
    trsf.SetTranslation(gp_Vec(120, 0, 0));
    return TopLoc_Location(trsf);
  }()));
  const TopoDS_Shape inner = fused(swept({{0, 0, 0}, {300, 0, 0}}, 34), box(34, 34, 200).Moved([] {
    gp_Trsf trsf;
    trsf.SetTranslation(gp_Vec(120, 0, 0));
    return TopLoc_Location(trsf);
  }()));
  const TopoDS_Shape tee = without(outer, inner);
  for (const TopoDS_Shape& shape : {tee, in_large_faces(tee)})
    expect_lines(shape, {{{0, 0, 0}, {120, 0, 0}}, {{120, 0, 0}, {300, 0, 0}}, {{120, 0, 0}, {120, 0, 200}}});
}

TEST(HollowBars, CutByABallEndMidwayWithARemark) {
  const CentreLines found =
      centre_lines(without(tube(200), BRepPrimAPI_MakeSphere(gp_Pnt(5, 3, 220), 60).Shape()), 1e-7);
  ASSERT_EQ(found.lines.size(), 1U);
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_NE(found.remarks[0].find("the hollow bar of 0.04 by 0.02 m is cut neither by a plane"),
            std::string::npos)
      << found.remarks[0];
}

TEST(HollowBars, AreNoSolidBarsPlatesWithHolesOrWindows) {
  for (const TopoDS_Shape& shape : {box(40, 20, 200), without(box(400, 400, 20), box(50, 50, 20)),
                                    without(box(400, 400, 40), box(300, 300, 40))})
    expect_lines(shape, {});
}

TEST(HollowBars, StandInFilesAfterTheirEdges) {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "tube.brep";
  BRepTools::Write(tube(200), file.c_str());
  const ImportReport report = import_curves(file);
  ASSERT_FALSE(report.curves.empty());
  EXPECT_EQ(report.curves.back().entity, "centre line");
  EXPECT_NEAR(report.curves.back().bar.area, 224e-6, 1e-15);
  EXPECT_FALSE(report.curves.back().free);
}

}  // namespace
}  // namespace nurbeam::hollow_bars_of_shapes
