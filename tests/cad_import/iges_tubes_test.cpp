// Tubes in IGES, as faces by themselves and as solids (186): their centre lines are those of the shapes.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipeShell.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRep_Tool.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Circ.hxx>
#include <numbers>
#include <vector>

#include "cad_import/import_curves.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam::iges_tubes {
namespace {

TopoDS_Shape without(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Cut(a, b).Shape(); }

/// A closed wire along lines from place to place.
TopoDS_Shape swept(const std::vector<gp_Pnt>& places, const TopoDS_Wire& section) {
  BRepBuilderAPI_MakePolygon path;
  for (const gp_Pnt& place : places) path.Add(place);
  BRepOffsetAPI_MakePipeShell sweep(path.Wire());
  sweep.SetTransitionMode(BRepBuilderAPI_RightCorner);
  sweep.Add(section);
  sweep.Build();
  sweep.MakeSolid();
  return sweep.Shape();
}

TopoDS_Shape round_bar(const std::vector<gp_Pnt>& places, double radius) {
  const gp_Ax2 start(places[0], gp_Dir(gp_Vec(places[0], places[1])));
  return swept(places, BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(start, radius))).Wire());
}

/// About places the first two of which stand along x.
TopoDS_Shape square_bar(const std::vector<gp_Pnt>& places, double side) {
  BRepBuilderAPI_MakePolygon square;
  for (const auto& [y, z] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}})
    square.Add(gp_Pnt(places[0].X(), places[0].Y() + y * side / 2, places[0].Z() + z * side / 2));
  square.Close();
  return swept(places, square.Wire());
}

TopoDS_Shape rounded_box(double side, double length, double radius) {
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(-side / 2, -side / 2, 0), side, side, length).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  for (TopExp_Explorer edges(box, TopAbs_EDGE); edges.More(); edges.Next()) {
    const TopoDS_Edge edge = TopoDS::Edge(edges.Current());
    const gp_Pnt a = BRep_Tool::Pnt(TopExp::FirstVertex(edge)), b = BRep_Tool::Pnt(TopExp::LastVertex(edge));
    if (std::abs(a.Z() - b.Z()) > 1) fillet.Add(radius, edge);
  }
  return fillet.Shape();
}

/// The centre lines in an IGES file of a shape; `solids`: as entities 186, else its faces by themselves.
std::vector<ImportedCurve> lines_in_iges(const TopoDS_Shape& shape, bool solids) {
  IGESControl_Controller::Init();
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "tube.igs";
  IGESControl_Writer writer("MM", solids ? 1 : 0);
  EXPECT_TRUE(writer.AddShape(shape) && writer.Write(file.c_str()));
  std::vector<ImportedCurve> lines;
  for (const ImportedCurve& curve : import_curves(file).curves)
    if (curve.is_centre_line()) lines.push_back(curve);
  return lines;
}

/// A centre line as it must be [mm].
struct Expected {
  Eigen::Vector3d start, end;
};

void expect_lines(const std::vector<ImportedCurve>& lines, const std::vector<Expected>& expected) {
  constexpr double digits = 1e-6;  // [mm]
  EXPECT_EQ(lines.size(), expected.size());
  for (const Expected& one : expected)
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                            [&](const ImportedCurve& line) {
                              const Eigen::Vector3d start = 1e3 * start_of(line.curve),
                                                    end = 1e3 * end_of(line.curve);
                              return std::min((start - one.start).norm() + (end - one.end).norm(),
                                              (start - one.end).norm() + (end - one.start).norm()) <= digits;
                            }),
              1)
        << one.start.transpose() << " to " << one.end.transpose();
}

class IgesTubes : public ::testing::TestWithParam<bool> {};

INSTANTIATE_TEST_SUITE_P(All, IgesTubes, ::testing::Bool(),
                         [](const auto& test) { return test.param ? "solids" : "faces"; });

const std::vector<gp_Pnt> corner{{0, 0, 0}, {200, 0, 0}, {290, 120, 0}};
const std::vector<Expected> legs{{{0, 0, 0}, {200, 0, 0}}, {{200, 0, 0}, {290, 120, 0}}};

TEST_P(IgesTubes, RoundOnesWithMitresHaveTheirCorner) {
  const std::vector<ImportedCurve> lines =
      lines_in_iges(without(round_bar(corner, 12), round_bar(corner, 10)), GetParam());
  expect_lines(lines, legs);
  for (const ImportedCurve& line : lines) {
    EXPECT_NEAR(line.pipe_radius, 0.012, 1e-9);
    EXPECT_NEAR(line.bore_radius, 0.010, 1e-9);
  }
}

TEST_P(IgesTubes, RoundOnesThatEndOnAnotherMeetIt) {
  const TopoDS_Shape main = BRepPrimAPI_MakeCylinder(gp_Ax2({0, 0, 0}, {1, 0, 0}), 20, 300).Shape();
  const TopoDS_Shape branch = BRepPrimAPI_MakeCylinder(gp_Ax2({120, 0, 0}, {0.6, 0.8, 0}), 10, 150).Shape();
  expect_lines(lines_in_iges(BRepAlgoAPI_Fuse(main, branch).Shape(), GetParam()),
               {{{0, 0, 0}, {120, 0, 0}}, {{120, 0, 0}, {300, 0, 0}}, {{120, 0, 0}, {210, 120, 0}}});
}

TEST_P(IgesTubes, SquareOnesWithMitresHaveTheirCornerAndSection) {
  const std::vector<ImportedCurve> lines =
      lines_in_iges(without(square_bar(corner, 40), square_bar(corner, 34)), GetParam());
  expect_lines(lines, legs);
  for (const ImportedCurve& line : lines) {
    EXPECT_NEAR(line.bar.width, 0.04, 1e-9);
    EXPECT_NEAR(line.bar.area, (40 * 40 - 34 * 34) * 1e-6, 1e-12);
  }
}

TEST_P(IgesTubes, RolledOnesAreRoundedAtTheirCorners) {
  const std::vector<ImportedCurve> lines =
      lines_in_iges(without(rounded_box(50, 300, 6), rounded_box(44, 300, 3)), GetParam());
  expect_lines(lines, {{{0, 0, 0}, {0, 0, 300}}});
  const double missing = 4 - std::numbers::pi;  // at the corners, of the square of the radius
  for (const ImportedCurve& line : lines)
    EXPECT_NEAR(line.bar.area, (50 * 50 - missing * 36 - (44 * 44 - missing * 9)) * 1e-6, 1e-12);
}

}  // namespace
}  // namespace nurbeam::iges_tubes
