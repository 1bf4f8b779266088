// Long because its tests share what they build.
// What we write, judged by OpenCASCADE's own readers, in their default settings, and checkers.

#include <gtest/gtest.h>

#include <BRepAdaptor_Surface.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Eigen/Geometry>
#include <GProp_GProps.hxx>
#include <Geom_Curve.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_IGESModel.hxx>
#include <IGESGeom_BSplineCurve.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <ShapeAnalysis_CheckSmallFace.hxx>
#include <ShapeAnalysis_Edge.hxx>
#include <ShapeAnalysis_FreeBounds.hxx>
#include <ShapeAnalysis_Shell.hxx>
#include <ShapeAnalysis_Wire.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <map>
#include <numbers>
#include <stdexcept>

#include "cad_import/export_curves.h"
#include "cad_import/iges/iges_global.h"
#include "cad_import/import_curves.h"
#include "nurbs/arc_length.h"
#include "nurbs/closest_point.h"
#include "nurbs/curve_chain.h"
#include "nurbs/smooth/smooth_nurbs.h"
#include "tests/cad_import/scratch_directory.h"
#include "tests/support/curves.h"

namespace nurbeam {
namespace {

namespace fs = std::filesystem;
using std::numbers::pi;

/// Elements over `count` equal parts of [0, end] that share position and tangent, each with its own speed and
/// its own weights, as a moving cable leaves them; a closed one ends exactly where it starts.
template <typename Curve, typename Slope>
BezierPath uneven_elements(const Curve& at, const Slope& slope, double end, bool closed, int count,
                           double weight_spread) {
  BezierPath path{{}, {0}, 0};
  const double third = end / count / 3;
  for (int j = 0; j < count; ++j) {
    const double a = end * j / count, b = end * (closed ? (j + 1) % count : j + 1) / count;
    const double uneven = 1 + 0.2 * std::sin(double(7 * j));
    Eigen::Matrix3Xd controls(3, 4);
    controls << at(a), at(a) + uneven * third * slope(a), at(b) - third / uneven * slope(b), at(b);
    Eigen::Matrix4d points;
    for (int i = 0; i < 4; ++i) {
      const double weight = 1 + weight_spread * std::sin(double(3 * j + 5 * i));
      points.col(i) << weight * controls.col(i), weight;
    }
    path.segments.emplace_back(points);
    path.breaks.push_back(path.breaks.back() + length(path.segments.back()));
  }
  return path;
}

BezierPath wavy_cable(int count, double weight_spread) {
  const auto at = [](double t) { return Eigen::Vector3d(2 * t, 0.2 * std::sin(5 * t), 0.3 * t * t); };
  const auto slope = [](double t) { return Eigen::Vector3d(2, std::cos(5 * t), 0.6 * t); };
  return uneven_elements(at, slope, 1, false, count, weight_spread);
}

NurbsCurve cable(int count, double weight_spread = 0) {
  return smooth_nurbs(wavy_cable(count, weight_spread), CurveParameter::free, 1e-12).curve;
}

/// An arc about the z axis, in quarters of it where it is long, as a rational quadratic.
NurbsCurve arc(double radius, double angle) {
  const int pieces = angle > pi / 2 ? 4 : 1;
  Eigen::Matrix4Xd points(4, 2 * pieces + 1);
  const double half = 0.5 * angle / pieces;
  for (int i = 0; i <= 2 * pieces; ++i) {
    const double weight = i % 2 == 0 ? 1 : std::cos(half), reach = i % 2 == 0 ? radius : radius / weight;
    points.col(i) << weight * reach * std::cos(i * half), weight * reach * std::sin(i * half), 0, weight;
  }
  std::vector<double> knots(3, 0);
  for (int j = 1; j <= pieces; ++j) knots.insert(knots.end(), j < pieces ? 2 : 3, j);
  return {KnotVector(2, std::move(knots)), std::move(points)};
}

/// The curve with its z axis through `centre`, its x axis along `x` and its y axis along `y`.
NurbsCurve placed(const NurbsCurve& curve, const Eigen::Vector3d& centre, const Eigen::Vector3d& x,
                  const Eigen::Vector3d& y) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() << x, y, x.cross(y);
  frame.translation() = centre;
  return {curve.knots(), frame.matrix() * curve.control_points()};
}

/// Three lines and two bends between them, in planes at right angles, one after another.
BezierPath pipe_run() {
  const std::vector<NurbsCurve> parts{
      line({0, 0, 0}, {1, 0, 0}), placed(arc(0.2, pi / 2), {1, 0.2, 0}, {0, -1, 0}, {1, 0, 0}),
      line({1.2, 0.2, 0}, {1.2, 0.7, 0}), placed(arc(0.2, pi / 2), {1.2, 0.7, 0.2}, {0, 0, -1}, {0, 1, 0}),
      line({1.2, 0.9, 0.2}, {1.2, 0.9, 2})};
  return join(parts, find_chains(parts, 1e-9).front(), 1e-9);
}

/// The run cut into short elements whose ends are moved and turned, as it is in motion.
BezierPath bent_pipe_run() {
  BezierPath path{{}, {0}, 0};
  for (const RationalCubic& part : pipe_run().segments)
    for (int i = 0; i < 3; ++i) {
      path.segments.push_back(part.piece(i / 3.0, (i + 1) / 3.0));
      path.breaks.push_back(path.breaks.back() + length(path.segments.back()));
    }
  for (RationalCubic& element : path.segments) {
    Eigen::Matrix4d points = element.points();
    for (const int end : {0, 3}) {  // it and its neighbour are carried by the motion of the end
      const Eigen::Vector3d about = element.control_point(end);
      const Eigen::Isometry3d motion = Eigen::Translation3d(about + 0.02 * about.cwiseProduct(about)) *
                                       Eigen::AngleAxisd(0.1 * about.norm(), Eigen::Vector3d::UnitY()) *
                                       Eigen::Translation3d(-about);
      points.middleCols(end == 0 ? 0 : 2, 2) =
          motion.matrix() * element.points().middleCols(end == 0 ? 0 : 2, 2);
    }
    element = RationalCubic(points);
  }
  return path;
}

/// The shape that OpenCASCADE makes of a file when left alone.
TopoDS_Shape second_reading(const fs::path& file) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  if (file.extension() == ".step") {
    STEPControl_Reader reader;
    EXPECT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
    reader.TransferRoots();
    return reader.OneShape();
  }
  IGESControl_Reader reader;
  Interface_Static::SetIVal("read.iges.bspline.continuity", 1);  // its default
  EXPECT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
  reader.TransferRoots();
  return reader.OneShape();
}

std::vector<TopoDS_Edge> edges_of(const TopoDS_Shape& shape) {
  TopTools_IndexedMapOfShape map;
  TopExp::MapShapes(shape, TopAbs_EDGE, map);
  std::vector<TopoDS_Edge> edges;
  for (int i = 1; i <= map.Extent(); ++i) edges.push_back(TopoDS::Edge(map(i)));
  return edges;
}

void expect_sound_edges(const TopoDS_Shape& shape) {
  ASSERT_FALSE(shape.IsNull());
  EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
  for (const TopoDS_Edge& edge : edges_of(shape)) {
    ShapeAnalysis_Edge check;
    EXPECT_TRUE(check.HasCurve3d(edge));
    EXPECT_FALSE(check.CheckVerticesWithCurve3d(edge));
    EXPECT_LE(BRep_Tool::Tolerance(edge), 1e-7);
  }
}

struct WrittenTarget {
  const char* file;
  LengthUnit unit;
  double in_millimetres;
};

class WrittenFile : public ::testing::TestWithParam<WrittenTarget> {};

TEST_P(WrittenFile, OfASmoothCableIsOneSoundEdgeToASecondReader) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / GetParam().file;
  for (const int count : {1, 2, 10, 60})
    for (const double weight_spread : {0.0, 0.01}) {
      SCOPED_TRACE(::testing::Message() << count << " elements, weights " << weight_spread);
      ASSERT_TRUE(export_curves(file, {{"cable", cable(count, weight_spread)}}, GetParam().unit).empty());
      const TopoDS_Shape shape = second_reading(file);
      expect_sound_edges(shape);
      EXPECT_EQ(edges_of(shape).size(), 1u);
    }
}

TEST_P(WrittenFile, OfAPipeRunIsOneC1EdgeToASecondReader) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / GetParam().file;
  for (const BezierPath& path : {pipe_run(), bent_pipe_run()}) {
    const NurbsCurve curve = smooth_nurbs(path, CurveParameter::free, 1e-12).curve;
    ASSERT_TRUE(export_curves(file, {{"run", curve}}, GetParam().unit).empty());
    const TopoDS_Shape shape = second_reading(file);
    expect_sound_edges(shape);
    ASSERT_EQ(edges_of(shape).size(), 1u);
    double first = 0, last = 0;
    EXPECT_GE(BRep_Tool::Curve(edges_of(shape)[0], first, last)->Continuity(), GeomAbs_C1);
  }
}

TEST_P(WrittenFile, OfACurveOfTheCorpusWithoutCornersIsOneEdgeToASecondReader) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / GetParam().file;
  int whole_conics = 0;
  for (const auto& entry : fs::directory_iterator(corpus_file(""))) {
    if (entry.path().extension() == ".md") continue;
    SCOPED_TRACE(entry.path());
    std::vector<NamedCurve> curves;
    for (const ImportedCurve& imported : import_curves(entry.path()).curves) {
      const double size = length(imported.curve);
      const BezierPath path = BezierPath::from_nurbs(imported.curve, 1e-6 * size);
      if (!path.corners(1e-12).empty()) continue;
      curves.push_back({imported.name, smooth_nurbs(path, CurveParameter::free, 2e-13 * size).curve});
      whole_conics += imported.curve.degree() == 2 && is_closed(imported.curve, 1e-9 * size);
    }
    if (curves.empty()) continue;
    ASSERT_TRUE(export_curves(file, curves, GetParam().unit).empty());
    const TopoDS_Shape shape = second_reading(file);
    expect_sound_edges(shape);
    EXPECT_EQ(edges_of(shape).size(), curves.size());
  }
  EXPECT_EQ(whole_conics, 29);
}

TEST_P(WrittenFile, HasItsPlaceInMillimetresToASecondReader) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / GetParam().file;
  const NurbsCurve curve = cable(10);
  ASSERT_TRUE(export_curves(file, {{"cable", curve}}, GetParam().unit).empty());
  const std::vector<TopoDS_Edge> edges = edges_of(second_reading(file));
  ASSERT_EQ(edges.size(), 1u);
  double first = 0, last = 0;
  const auto read = BRep_Tool::Curve(edges[0], first, last);
  for (const double t : {0.0, 0.3, 1.0}) {
    const gp_Pnt there = read->Value(first + t * (last - first));
    const KnotVector& knots = curve.knots();
    const Eigen::Vector3d here = 1000 * curve.point(knots.start() + t * (knots.end() - knots.start()));
    EXPECT_LE((Eigen::Vector3d(there.X(), there.Y(), there.Z()) - here).norm(), 1e-11);
  }
}

std::string written_text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_P(WrittenFile, DeclaresItsUnit) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / GetParam().file;
  ASSERT_TRUE(export_curves(file, {{"cable", cable(2)}}, GetParam().unit).empty());
  const std::string text = written_text(file);
  if (file.extension() == ".igs") {
    const IgesGlobal global = parse_iges_global(text);
    EXPECT_DOUBLE_EQ(global.unit_in_metres, 1e-3 * GetParam().in_millimetres);
    EXPECT_EQ(global.scale, 1);
    return;
  }
  const std::string declared = GetParam().in_millimetres == 1000 ? "SI_UNIT($,.METRE.)"
                               : GetParam().in_millimetres == 1  ? "SI_UNIT(.MILLI.,.METRE.)"
                                                                 : "CONVERSION_BASED_UNIT('INCH'";
  EXPECT_NE(text.find(declared), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(All, WrittenFile,
                         ::testing::Values(WrittenTarget{"a.step", LengthUnit::metre, 1000},
                                           WrittenTarget{"a.step", LengthUnit::millimetre, 1},
                                           WrittenTarget{"a.step", LengthUnit::inch, 25.4},
                                           WrittenTarget{"a.igs", LengthUnit::metre, 1000},
                                           WrittenTarget{"a.igs", LengthUnit::millimetre, 1},
                                           WrittenTarget{"a.igs", LengthUnit::inch, 25.4}),
                         [](const auto& test) {
                           return std::string(test.param.file + 2) + "_" +
                                  std::to_string(int(test.param.in_millimetres));
                         });

/// A closed cable in space, else as wavy_cable.
BezierPath wavy_ring(int count, double weight_spread) {
  const auto at = [](double t) {
    return Eigen::Vector3d((1 + 0.1 * std::cos(3 * t)) * std::cos(t), 0.7 * std::sin(t),
                           0.2 * std::sin(2 * t));
  };
  const auto slope = [](double t) {
    return Eigen::Vector3d(-0.3 * std::sin(3 * t) * std::cos(t) - (1 + 0.1 * std::cos(3 * t)) * std::sin(t),
                           0.7 * std::cos(t), 0.4 * std::cos(2 * t));
  };
  return uneven_elements(at, slope, 2 * pi, true, count, weight_spread);
}

TEST_P(WrittenFile, OfARingIsOneClosedEdgeWithOneVertexToASecondReader) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / GetParam().file;
  const auto smooth = [](const BezierPath& path) {
    return smooth_nurbs(path, CurveParameter::free, 1e-12).curve;
  };
  Eigen::Matrix4Xd ellipse = arc(1, 2 * pi).control_points();
  ellipse.row(1) *= 0.6;
  for (const NurbsCurve& ring : {smooth(wavy_ring(24, 0)), smooth(wavy_ring(24, 0.01)),
                                 smooth(BezierPath::from_nurbs({arc(1, 2 * pi).knots(), ellipse}, 1))}) {
    ASSERT_TRUE(export_curves(file, {{"ring", ring}}, GetParam().unit).empty());
    const TopoDS_Shape shape = second_reading(file);
    expect_sound_edges(shape);
    const std::vector<TopoDS_Edge> edges = edges_of(shape);
    ASSERT_EQ(edges.size(), 1u);
    EXPECT_TRUE(BRep_Tool::IsClosed(edges[0]));
    EXPECT_TRUE(TopExp::FirstVertex(edges[0]).IsSame(TopExp::LastVertex(edges[0])));
    EXPECT_TRUE(ShapeAnalysis_Edge().IsClosed3d(edges[0]));
  }
}

// The ring ends where it starts but for round-off.
TEST(WrittenIges, ACurveSaysWhetherItIsClosedAndInWhichPlaneItLies) {
  const Eigen::Vector3d x = Eigen::Vector3d(2, 1, 2) / 3, y = Eigen::Vector3d(-2, 2, 1) / 3;
  struct Expected {
    NurbsCurve curve;
    bool closed;
    Eigen::Vector3d normal;  // zero where there is no one plane
  };
  const Expected expected[] = {{placed(arc(0.3, 2 * pi), {5, -7, 11}, x, y), true, x.cross(y)},
                               {placed(arc(0.3, pi / 3), {5, -7, 11}, x, y), false, x.cross(y)},
                               {line({0, 0, 0}, {1, 2, 3}), false, {0, 0, 0}},
                               {cable(8), false, {0, 0, 0}}};
  for (const auto& [curve, closed, normal] : expected) {
    const ScratchDirectory scratch;
    const fs::path file = scratch.path() / "curve.igs";
    ASSERT_TRUE(export_curves(file, {{"", curve}}, LengthUnit::millimetre).empty());
    IGESControl_Reader reader;
    ASSERT_EQ(reader.ReadFile(file.c_str()), IFSelect_RetDone);
    const auto written = Handle(IGESGeom_BSplineCurve)::DownCast(reader.IGESModel()->Value(1));
    ASSERT_FALSE(written.IsNull());
    EXPECT_EQ(written->IsClosed(), closed);
    EXPECT_EQ(written->IsPlanar(), !normal.isZero());
    const gp_XYZ n = written->Normal();
    EXPECT_NEAR(Eigen::Vector3d(n.X(), n.Y(), n.Z()).cross(normal).norm(), 0, 1e-12);
    EXPECT_NEAR(n.Modulus(), normal.norm(), 1e-12);
  }
}

NurbsCurve straight_line(double size) {
  Eigen::Matrix3Xd points(3, 2);
  points << 0, size, 0, 0.5 * size, 0, 0;
  return make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), points, Eigen::Vector2d::Ones());
}

TEST(ExportSolids, ASweptCableIsAValidSolidOfItsVolume) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "solid.step";
  const double radius = 0.02;
  for (const NurbsCurve& curve : {cable(1), cable(10), cable(20, 0.01), straight_line(3)}) {
    ASSERT_TRUE(export_solids(file, {{{"cable", curve}, radius}}, LengthUnit::inch).empty());
    const TopoDS_Shape shape = second_reading(file);
    ASSERT_FALSE(shape.IsNull());
    EXPECT_EQ(shape.ShapeType(), TopAbs_SOLID);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    GProp_GProps properties;
    BRepGProp::VolumeProperties(shape, properties, 1e-7);
    EXPECT_NEAR(1e-9 * properties.Mass() / (pi * radius * radius * length(curve)), 1, 1e-4);
    for (TopExp_Explorer shell(shape, TopAbs_SHELL); shell.More(); shell.Next()) {
      ShapeAnalysis_Shell check;
      check.LoadShells(shell.Current());
      EXPECT_FALSE(check.CheckOrientedShells(shell.Current(), true));
      EXPECT_FALSE(check.HasFreeEdges());
    }
    for (const TopoDS_Edge& edge : edges_of(shape))
      if (!BRep_Tool::Degenerated(edge)) EXPECT_FALSE(ShapeAnalysis_Edge().CheckVerticesWithCurve3d(edge));
  }
}

/// By the integration that CAD systems built on OpenCASCADE do [m^3].
double volume_of(const TopoDS_Shape& shape) {
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return 1e-9 * properties.Mass();
}

/// The number of wires of each plane face.
std::vector<int> rims_of_plane_faces(const TopoDS_Shape& shape) {
  std::vector<int> rims;
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
    if (BRepAdaptor_Surface(TopoDS::Face(face.Current())).GetType() != GeomAbs_Plane) continue;
    TopTools_IndexedMapOfShape wires;
    TopExp::MapShapes(face.Current(), TopAbs_WIRE, wires);
    rims.push_back(wires.Extent());
  }
  return rims;
}

TEST(ExportSolids, APipeRunIsOfCylindersAndToriExactly) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "run.step";
  for (const double bore : {0.0, 0.04}) {
    const NurbsCurve run = smooth_nurbs(pipe_run(), CurveParameter::free, 1e-12).curve;
    ASSERT_TRUE(export_solids(file, {{{"run", run}, 0.05, bore}}, LengthUnit::millimetre).empty());
    const TopoDS_Shape shape = second_reading(file);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    const double exact = pi * (0.0025 - bore * bore) * (1 + 0.5 + 1.8 + 0.2 * pi);
    EXPECT_NEAR(volume_of(shape) / exact, 1, 1e-12);
    std::map<GeomAbs_SurfaceType, int> kinds;
    for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next())
      ++kinds[BRepAdaptor_Surface(TopoDS::Face(face.Current())).GetType()];
    const int walls = bore > 0 ? 2 : 1;
    EXPECT_EQ(kinds, (std::map<GeomAbs_SurfaceType, int>{
                         {GeomAbs_Plane, 2}, {GeomAbs_Cylinder, 3 * walls}, {GeomAbs_Torus, 2 * walls}}));
  }
}

TEST(ExportSolids, ABentPipeRunHasItsVolume) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "run.step";
  const NurbsCurve run = smooth_nurbs(bent_pipe_run(), CurveParameter::free, 1e-12).curve;
  for (const double bore : {0.0, 0.04}) {
    ASSERT_TRUE(export_solids(file, {{{"run", run}, 0.05, bore}}, LengthUnit::millimetre).empty());
    const TopoDS_Shape shape = second_reading(file);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    EXPECT_NEAR(volume_of(shape) / (pi * (0.0025 - bore * bore) * length(run)), 1, 1e-8);
  }
}

/// How far the walls are from this distance to the curve, at most [m].
double error_of_walls(const TopoDS_Shape& shape, const NurbsCurve& curve, double radius) {
  constexpr int places = 64, directions = 3;
  const BezierPath axis = BezierPath::from_nurbs(curve, 1);
  const ClosestPoints closest(axis.segments);
  double largest = 0;
  for (TopExp_Explorer face(shape, TopAbs_FACE); face.More(); face.Next()) {
    const BRepAdaptor_Surface wall(TopoDS::Face(face.Current()));
    if (wall.GetType() == GeomAbs_Plane) continue;
    const double u = wall.FirstUParameter(), v = wall.FirstVParameter();
    const double du = (wall.LastUParameter() - u) / directions, dv = (wall.LastVParameter() - v) / places;
    for (int i = 0; i < directions; ++i)
      for (int j = 0; j <= places; ++j) {
        const gp_Pnt place = wall.Value(u + i * du, v + j * dv);  // [mm]
        const double distance = closest.to(1e-3 * Eigen::Vector3d(place.X(), place.Y(), place.Z())).distance;
        largest = std::max(largest, std::abs(distance - radius));
      }
  }
  return largest;
}

/// One element of a cantilever whose tip is so far down.
NurbsCurve cantilever(double down) {
  Eigen::Matrix3Xd points(3, 4);
  points << 0, 1. / 3, 2. / 3, 1, 0, 0, 0, 0, 0, 0, -down / 2, -down;
  return make_nurbs_curve(KnotVector(3, {0, 0, 0, 0, 1, 1, 1, 1}), points, Eigen::VectorXd::Ones(4));
}

TEST(ExportSolids, WallsAreAsNearAsIsSaidHoweverTheCurveBends) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "bar.step";
  for (const double radius : {0.01, 0.001})
    for (const double down : {0.002, 0.006, 0.0085, 0.012, 0.03, 0.1, 0.4}) {
      const NurbsCurve bar = cantilever(down);
      const auto problem = export_solids(file, {{{"bar", bar}, radius}}, LengthUnit::metre);
      ASSERT_TRUE(problem.empty()) << down << " " << problem[0].message;
      const TopoDS_Shape shape = second_reading(file);
      EXPECT_NEAR(volume_of(shape) / (pi * radius * radius * length(bar)), 1, 1e-6) << down;
      EXPECT_LE(error_of_walls(shape, bar, radius), 1e-6 * radius) << down;
    }
  const NurbsCurve ring = smooth_nurbs(wavy_ring(24, 0), CurveParameter::free, 1e-12).curve;
  const Eigen::Matrix4d straight = cantilever(1e-5).control_points();
  const NurbsCurve uneven(cantilever(1e-5).knots(),
                          straight * Eigen::Vector4d(1, 0.5, 0.4, 1.5).asDiagonal());
  for (const NurbsCurve& curve : {cable(1), cable(20, 0.01), ring, uneven}) {
    ASSERT_TRUE(export_solids(file, {{{"curve", curve}, 0.02}}, LengthUnit::metre).empty());
    EXPECT_LE(error_of_walls(second_reading(file), curve, 0.02), 1e-6 * 0.02);
  }
}

TEST(ExportSolids, AHollowCableIsATubeWithAnnularEnds) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "tube.step";
  const double radius = 0.02, bore = 0.015, area = pi * (radius * radius - bore * bore);
  for (const NurbsCurve& curve : {cable(1), cable(10), cable(20, 0.01), straight_line(3)}) {
    ASSERT_TRUE(export_solids(file, {{{"tube", curve}, radius, bore}}, LengthUnit::inch).empty());
    const TopoDS_Shape shape = second_reading(file);
    ASSERT_EQ(shape.ShapeType(), TopAbs_SOLID);
    EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
    EXPECT_NEAR(volume_of(shape) / (area * length(curve)), 1, 1e-6);
    EXPECT_EQ(rims_of_plane_faces(shape), (std::vector<int>{2, 2}));
    ShapeAnalysis_Shell check;
    check.LoadShells(shape);
    EXPECT_FALSE(check.HasFreeEdges());
  }
}

TEST(ExportSolids, ABentTubeHasTheVolumeOfPappusAndGivesItsCentreLineAgain) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "bend.step";
  for (const double bore : {0.0, 0.03, 0.08, 0.099}) {
    ASSERT_TRUE(export_solids(file, {{{"bend", arc(1, 1.5)}, 0.1, bore}}, LengthUnit::metre).empty());
    EXPECT_NEAR(volume_of(second_reading(file)) / (1.5 * pi * (0.01 - bore * bore)), 1, 1e-9);
    const ImportReport report = import_curves(file);
    const auto line = std::find_if(report.curves.begin(), report.curves.end(),
                                   [](const ImportedCurve& curve) { return curve.is_centre_line(); });
    ASSERT_NE(line, report.curves.end());
    EXPECT_NEAR(line->pipe_radius, 0.1, 1e-9);
    EXPECT_NEAR(line->bore_radius, bore, 1e-9);
    EXPECT_NEAR(length(line->curve), 1.5, 1e-8);
  }
}

TEST(ExportSolids, ARingIsATorusAndAHollowOneATorusWithATorusInIt) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "ring.step";
  const NurbsCurve circle = arc(1, 2 * pi);
  const NurbsCurve cubic_circle =
      smooth_nurbs(BezierPath::from_nurbs(circle, 1), CurveParameter::free, 1e-12).curve;
  const NurbsCurve in_space = smooth_nurbs(wavy_ring(24, 0), CurveParameter::free, 1e-12).curve;
  Eigen::Matrix4Xd points = in_space.control_points();
  points.row(2).setZero();
  const NurbsCurve wavy(in_space.knots(), points);
  for (const double bore : {0.0, 0.06}) {
    const double area = pi * (0.01 - bore * bore);
    for (const NurbsCurve& axis : {circle, cubic_circle, wavy, in_space}) {
      const auto problem = export_solids(file, {{{"ring", axis}, 0.1, bore}}, LengthUnit::metre);
      ASSERT_TRUE(problem.empty()) << problem[0].message;
      const TopoDS_Shape shape = second_reading(file);
      EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
      EXPECT_NEAR(volume_of(shape) / (area * length(axis)), 1, 1e-6);
      EXPECT_EQ(rims_of_plane_faces(shape), std::vector<int>{});
    }
    ASSERT_TRUE(export_solids(file, {{{"ring", circle}, 0.1, bore}}, LengthUnit::metre).empty());
    EXPECT_NEAR(volume_of(second_reading(file)) / (2 * pi * area), 1, 1e-9);
  }
}

/// A chain of lines through these points.
NurbsCurve frame(const std::vector<Eigen::Vector3d>& corners) {
  Eigen::Matrix3Xd points(3, corners.size());
  std::vector<double> knots{0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = corners[i];
    knots.push_back(static_cast<double>(i));
  }
  knots.push_back(knots.back());
  return make_nurbs_curve(KnotVector(1, knots), points, Eigen::VectorXd::Ones(points.cols()));
}

TEST(ExportSolids, AFrameHasMitresAtItsCorners) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "frame.step";
  const NurbsCurve bent = frame({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {2, 1, 0.5}});
  const NurbsCurve square = frame({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 0}});
  const NurbsCurve acute = frame({{0, 0, 0}, {1, 0, 0}, {0.1, 0.3, 0}});
  Eigen::Matrix3Xd points(3, 5);
  points << 0, 0.5, 1, 1.2, 1.3, 0, 0.4, 0, 0.5, 1.4, 0, 0, 0, 0.1, 0.5;
  const NurbsCurve curved =
      make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 2}), points, Eigen::VectorXd::Ones(5));
  for (const double bore : {0.0, 0.015})
    for (const NurbsCurve& axis : {bent, square, acute, curved}) {
      const auto problem = export_solids(file, {{{"frame", axis}, 0.02, bore}}, LengthUnit::metre);
      ASSERT_TRUE(problem.empty()) << problem[0].message;
      const TopoDS_Shape shape = second_reading(file);
      EXPECT_TRUE(BRepCheck_Analyzer(shape).IsValid());
      // A mitre takes as much as it adds.
      const double area = pi * (0.02 * 0.02 - bore * bore), allowed = axis.degree() == 1 ? 1e-9 : 1e-7;
      EXPECT_NEAR(volume_of(shape) / (area * length(axis)), 1, allowed);
    }
}

TEST(ExportSolids, SharpCornersBetweenBendsKeepTheVolume) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "zigzag.step";
  Eigen::Matrix3Xd points(3, 7);
  for (int i = 0; i < 7; ++i) points.col(i) << 0.25 * i, 0.3 * std::sin(2 * i), 0.2 * std::cos(3 * i);
  const NurbsCurve axis =
      make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 3}), points, Eigen::VectorXd::Ones(7));
  ASSERT_TRUE(export_solids(file, {{{"zigzag", axis}, 0.006}}, LengthUnit::metre).empty());
  EXPECT_NEAR(volume_of(second_reading(file)) / (pi * 0.006 * 0.006 * length(axis)), 1, 1e-7);
}

TEST(ExportSolids, BrepHoldsTheSameSolid) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "solid.brep";
  ASSERT_TRUE(export_solids(file, {{{"bend", arc(1, 1.5)}, 0.1, 0.06}}, LengthUnit::millimetre).empty());
  const std::vector<ImportedCurve> curves = import_curves(file).curves;
  ASSERT_FALSE(curves.empty());
  EXPECT_NEAR(curves.back().pipe_radius, 0.1, 1e-14);
  EXPECT_NEAR(curves.back().bore_radius, 0.06, 1e-14);
  EXPECT_NEAR(length(curves.back().curve), 1.5, 1e-13);
  EXPECT_THROW(static_cast<void>(export_solids(file, {{{"bend", arc(1, 1.5)}, 0.1}}, LengthUnit::inch)),
               std::invalid_argument);
}

TEST(ExportSolids, KeepsEveryNameAndEveryCable) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "solids.step";
  ASSERT_TRUE(export_solids(file, {{{"left", cable(3)}, 0.01}, {{"right", straight_line(1)}, 0.02}},
                            LengthUnit::millimetre)
                  .empty());
  const std::string text = written_text(file);
  EXPECT_NE(text.find("MANIFOLD_SOLID_BREP('left'"), std::string::npos);
  EXPECT_NE(text.find("MANIFOLD_SOLID_BREP('right'"), std::string::npos);
  EXPECT_TRUE(BRepCheck_Analyzer(second_reading(file)).IsValid());
}

TEST(ExportSolids, RefusesWhatCannotBeSweptAndLeavesNoFile) {
  const ScratchDirectory scratch;
  const fs::path file = scratch.path() / "solid.step";
  const auto refused = [](const fs::path& target, const std::vector<NamedPipe>& pipes) {
    EXPECT_THROW(static_cast<void>(export_solids(target, pipes, LengthUnit::metre)), std::invalid_argument);
  };
  refused(file, {{{"cable", cable(3)}, 0}});
  refused(file, {{{"cable", cable(3)}, 0.01, 0.01}});
  refused(file, {{{"cable", cable(3)}, 0.01, -0.001}});
  refused(scratch.path() / "a.igs", {{{"cable", cable(3)}, 0.01}});
  refused(file, {});
  Eigen::Matrix3Xd points(3, 3);
  points << 0, 1, 0.1, 0, 0, 0.1, 0, 0, 0;
  const NurbsCurve corner = make_nurbs_curve(KnotVector(1, {0, 0, 1, 2, 2}), points, Eigen::Vector3d::Ones());
  const auto problem = export_solids(file, {{{"bent cable", corner}, 0.3}}, LengthUnit::metre);
  ASSERT_EQ(problem.size(), 1U);
  EXPECT_EQ(problem[0].where, file.string());
  EXPECT_NE(problem[0].message.find("bent cable"), std::string::npos);
  EXPECT_NE(problem[0].message.find("corner of"), std::string::npos) << problem[0].message;
  Eigen::Matrix3Xd parabola(3, 3);
  parabola << -1, 0, 1, 1, -1, 1, 0, 0, 0;  // its smallest radius of curvature is 0.5
  const NurbsCurve bend =
      make_nurbs_curve(KnotVector(2, {0, 0, 0, 1, 1, 1}), parabola, Eigen::Vector3d::Ones());
  EXPECT_FALSE(export_solids(file, {{{"bend", bend}, 0.51}}, LengthUnit::metre).empty());
  EXPECT_TRUE(fs::is_empty(scratch.path()));
  EXPECT_TRUE(export_solids(file, {{{"bend", bend}, 0.49}}, LengthUnit::metre).empty());
}

}  // namespace
}  // namespace nurbeam
