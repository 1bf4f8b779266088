// Pipes that are cut obliquely: their centre lines meet where the axes do that they were made of.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepOffsetAPI_MakePipeShell.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <GProp_GProps.hxx>
#include <STEPControl_Reader.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Compound.hxx>
#include <algorithm>
#include <gp_Circ.hxx>
#include <numbers>

#include "cad_import/export_curves.h"
#include "cad_import/import_curves.h"
#include "cad_import/occt/centre_line.h"
#include "nurbs/arc_length.h"
#include "tests/cad_import/curve_ends.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam::oblique_pipes {
namespace {

using std::numbers::pi;

TopoDS_Shape rod(const gp_Pnt& from, const gp_Pnt& to, double radius) {
  const gp_Vec along(from, to);
  return BRepPrimAPI_MakeCylinder(gp_Ax2(from, gp_Dir(along)), radius, along.Magnitude()).Shape();
}

TopoDS_Shape fused(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Fuse(a, b).Shape(); }
TopoDS_Shape without(const TopoDS_Shape& a, const TopoDS_Shape& b) { return BRepAlgoAPI_Cut(a, b).Shape(); }

/// A disk of this radius along lines from place to place.
TopoDS_Shape swept(const std::vector<gp_Pnt>& places, double radius, BRepBuilderAPI_TransitionMode corners) {
  BRepBuilderAPI_MakePolygon path;
  for (const gp_Pnt& place : places) path.Add(place);
  BRepOffsetAPI_MakePipeShell sweep(path.Wire());
  sweep.SetTransitionMode(corners);
  const gp_Ax2 start(places[0], gp_Dir(gp_Vec(places[0], places[1])));
  sweep.Add(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(start, radius))).Wire());
  sweep.Build();
  sweep.MakeSolid();
  return sweep.Shape();
}

/// A centre line as it must be [mm].
struct Expected {
  Eigen::Vector3d start, end;
  double radius, bore = 0;
};

bool is_same(const ImportedCurve& line, const Expected& expected) {
  constexpr double round_off = 1e-9;  // [mm]
  const Eigen::Vector3d start = 1e3 * start_of(line.curve), end = 1e3 * end_of(line.curve);
  const bool forward =
      (start - expected.start).norm() <= round_off && (end - expected.end).norm() <= round_off;
  const bool backward =
      (start - expected.end).norm() <= round_off && (end - expected.start).norm() <= round_off;
  return (forward || backward) && std::abs(1e3 * line.pipe_radius - expected.radius) <= round_off &&
         std::abs(1e3 * line.bore_radius - expected.bore) <= round_off;
}

/// That there are these centre lines and no others; returns them.
std::vector<ImportedCurve> expect_lines(const TopoDS_Shape& shape, const std::vector<Expected>& expected) {
  std::vector<ImportedCurve> lines;
  for (CentreLine& line : centre_lines(shape, 1e-7).lines) lines.push_back(line.curve);
  EXPECT_EQ(lines.size(), expected.size());
  for (const Expected& one : expected)
    EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [&](const auto& line) { return is_same(line, one); }),
              1)
        << one.start.transpose() << " to " << one.end.transpose();
  return lines;
}

const gp_Pnt begin(0, 0, 0), end(200, 0, 0), middle(100, 0, 0);
const Expected first_half{{0, 0, 0}, {100, 0, 0}, 20}, second_half{{100, 0, 0}, {200, 0, 0}, 20};

TEST(ObliquePipes, SweepsAlongAPolylineHaveItsCorners) {
  const std::vector<gp_Pnt> places{{0, 0, 0}, {100, 0, 0}, {100, 80, 0}, {60, 80, 60}};
  const std::vector<Expected> expected{
      {{0, 0, 0}, {100, 0, 0}, 5}, {{100, 0, 0}, {100, 80, 0}, 5}, {{100, 80, 0}, {60, 80, 60}, 5}};
  for (const auto corners : {BRepBuilderAPI_RightCorner, BRepBuilderAPI_RoundCorner})
    expect_lines(swept(places, 5, corners), expected);
}

TEST(ObliquePipes, HollowOnesHaveTheirBores) {
  const std::vector<gp_Pnt> places{{0, 0, 0}, {100, 0, 0}, {100, 80, 0}};
  expect_lines(
      without(swept(places, 5, BRepBuilderAPI_RightCorner), swept(places, 4, BRepBuilderAPI_RightCorner)),
      {{{0, 0, 0}, {100, 0, 0}, 5, 4}, {{100, 0, 0}, {100, 80, 0}, 5, 4}});
  const TopoDS_Shape outer = fused(rod(begin, end, 20), rod(middle, {100, 80, 0}, 10));
  const TopoDS_Shape inner = fused(rod(begin, end, 17), rod(middle, {100, 80, 0}, 8));
  expect_lines(without(outer, inner), {{{0, 0, 0}, {100, 0, 0}, 20, 17},
                                       {{100, 0, 0}, {200, 0, 0}, 20, 17},
                                       {{100, 0, 0}, {100, 80, 0}, 10, 8}});
}

TEST(ObliquePipes, TeesMeetOnTheLineOfTheMain) {
  for (const double radius : {10.0, 20.0})
    expect_lines(fused(rod(begin, end, 20), rod(middle, {100, 80, 0}, radius)),
                 {first_half, second_half, {{100, 0, 0}, {100, 80, 0}, radius}});
  expect_lines(fused(rod(begin, end, 20), rod(middle, {160, 60, 0}, 10)),
               {first_half, second_half, {{100, 0, 0}, {160, 60, 0}, 10}});
}

TEST(ObliquePipes, CopedTubesThatAreSolidsOfTheirOwnMeetToo) {
  TopoDS_Compound both;
  const BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, rod(begin, end, 20));
  builder.Add(both, without(rod(middle, {160, 60, 0}, 10), rod(begin, end, 20)));
  expect_lines(both, {first_half, second_half, {{100, 0, 0}, {160, 60, 0}, 10}});
}

TEST(ObliquePipes, BentOnesMeetAtTheEndsOfTheirArcs) {
  const gp_Ax2 about({100, 50, 0}, gp_Dir(0, 0, 1), gp_Dir(0, -1, 0));
  const TopoDS_Shape bent = fused(rod(begin, middle, 5), BRepPrimAPI_MakeTorus(about, 50, 5, pi / 2).Shape());
  const std::vector<ImportedCurve> lines =
      expect_lines(fused(bent, rod({150, 50, -60}, {150, 50, 60}, 8)), {{{0, 0, 0}, {100, 0, 0}, 5},
                                                                        {{100, 0, 0}, {150, 50, 0}, 5},
                                                                        {{150, 50, -60}, {150, 50, 0}, 8},
                                                                        {{150, 50, 0}, {150, 50, 60}, 8}});
  for (const ImportedCurve& line : lines)
    if (line.curve.degree() == 2) EXPECT_NEAR(length(line.curve), 0.025 * pi, 1e-12);
}

TEST(ObliquePipes, AFrameWithABraceIsOneOfBeams) {
  const std::vector<gp_Pnt> ring{{150, 0, 0}, {300, 0, 0}, {300, 200, 0},
                                 {0, 200, 0}, {0, 0, 0},   {150, 0, 0}};
  const TopoDS_Shape frame =
      fused(swept(ring, 10, BRepBuilderAPI_RightCorner), rod({100, 0, 0}, {100, 200, 0}, 8));
  TopoDS_Shape shape = frame;
  std::vector<ImportedCurve> lines;
  for (CentreLine& line : centre_lines(shape, 1e-7).lines) lines.push_back(line.curve);
  double sum = 0;
  for (const ImportedCurve& line : lines) sum += length(line.curve);
  EXPECT_NEAR(sum, 1.2, 1e-9);
  EXPECT_EQ(
      std::count_if(lines.begin(), lines.end(),
                    [](const ImportedCurve& line) { return std::abs(line.pipe_radius - 0.008) < 1e-12; }),
      1);
}

// On a ball, which is neither a plane nor a pipe.
TEST(ObliquePipes, ThatEndOnSomethingElseEndMidwayWithARemark) {
  const TopoDS_Shape shape =
      without(rod({0, 0, 0}, {100, 0, 0}, 10), BRepPrimAPI_MakeSphere(gp_Pnt(110, 8, 0), 30).Shape());
  const CentreLines found = centre_lines(shape, 1e-7);
  ASSERT_EQ(found.lines.size(), 1U);
  ASSERT_EQ(found.remarks.size(), 1U);
  EXPECT_NE(found.remarks[0].find("the pipe of radius 0.01 m is cut neither by a plane"), std::string::npos)
      << found.remarks[0];
  EXPECT_NE(found.remarks[0].find("(0.08"), std::string::npos) << found.remarks[0];
  EXPECT_TRUE(centre_lines(rod({0, 0, 0}, {100, 0, 0}, 10), 1e-7).remarks.empty());
}

/// As OpenCASCADE's own readers give it.
TopoDS_Shape shape_of(const std::filesystem::path& file) {
  if (file.extension() == ".brep") {
    TopoDS_Shape shape;
    EXPECT_TRUE(BRepTools::Read(shape, file.c_str(), BRep_Builder()));
    return shape;
  }
  STEPControl_Reader reader;
  EXPECT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  return reader.OneShape();
}

// 2,000 km from the origin OpenCASCADE's tolerances are below the digits of its numbers.
TEST(FarFromTheOrigin, CurvesAndSolidsAreWrittenAndReadAgain) {
  Eigen::Matrix3Xd points(3, 4);
  points << 500000, 500010, 500030, 500060, 2000000, 2000030, 2000040, 2000020, 0, 0, 10, 10;
  const NurbsCurve curve =
      make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 1}), points, Eigen::VectorXd::Ones(4));
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "far.brep";
  ASSERT_TRUE(export_curves(file, {{"far", curve}}, LengthUnit::millimetre).empty());
  EXPECT_TRUE(BRepCheck_Analyzer(shape_of(file)).IsValid());
  const ImportReport back = import_curves(file);
  ASSERT_EQ(back.curves.size(), 1U);
  EXPECT_NEAR(length(back.curves[0].curve), length(curve), 1e-8);
  for (const char* name : {"solid.brep", "solid.step"}) {
    SCOPED_TRACE(name);
    const std::filesystem::path solid = scratch.path() / name;
    const std::vector<Diagnostic> problems =
        export_solids(solid, std::vector<NamedPipe>{{{"far", curve}, 0.5}}, LengthUnit::millimetre);
    ASSERT_TRUE(problems.empty()) << problems[0].message;
    const TopoDS_Shape shape = shape_of(solid);
    ASSERT_FALSE(shape.IsNull());
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    const double volume = pi * 0.25 * length(curve);  // of Pappus
    EXPECT_NEAR(properties.Mass() * 1e-9, volume, 1e-5 * volume);
    const gp_Pnt centre = properties.CentreOfMass();
    EXPECT_LE(
        Eigen::Vector3d(centre.X() * 1e-3 - 500025, centre.Y() * 1e-3 - 2000025, centre.Z() * 1e-3).norm(),
        20);
  }
}

// Whose curves and surfaces lie where they belong, with as many digits as readers find valid.
TEST(FarFromTheOrigin, SolidsOfStepAreValidWhereTheyAre) {
  Eigen::Matrix3Xd points(3, 6);
  points << 500000, 500010, 500030, 500060, 500080, 500100, 2000000, 2000030, 2000040, 2000020, 1999990,
      1999980, 0, 0, 10, 10, 0, 0;
  const NurbsCurve curve =
      make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 2, 3, 3, 3, 3}), points, Eigen::VectorXd::Ones(6));
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / "solid.step";
  for (const double radius : {0.02, 0.1, 0.5}) {
    ASSERT_TRUE(export_solids(file, std::vector<NamedPipe>{{{"far", curve}, radius}}, LengthUnit::millimetre)
                    .empty());
    const TopoDS_Shape shape = shape_of(file);
    ASSERT_FALSE(shape.IsNull());
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid()) << radius;
    EXPECT_TRUE(TopExp_Explorer(shape, TopAbs_SOLID).Current().Location().IsIdentity()) << radius;
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties);
    const double volume = pi * radius * radius * length(curve);  // of Pappus
    EXPECT_NEAR(properties.Mass() * 1e-9, volume, 1e-5 * volume) << radius;
  }
}

}  // namespace
}  // namespace nurbeam::oblique_pipes
