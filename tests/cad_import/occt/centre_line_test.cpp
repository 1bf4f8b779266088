// Centre lines of pipes, found again in solids that OpenCASCADE makes along known curves.

#include <gtest/gtest.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>
#include <STEPControl_Writer.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shape.hxx>
#include <TopoDS_Wire.hxx>
#include <algorithm>
#include <cmath>
#include <gp_Circ.hxx>
#include <map>
#include <numbers>

#include "cad_import/import_curves.h"
#include "nurbs/bezier_path.h"
#include "tests/cad_import/scratch_directory.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

ImportReport written_and_read(const TopoDS_Shape& shape, const std::string& name = "solid.step") {
  const ScratchDirectory scratch;
  const std::filesystem::path file = scratch.path() / name;
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  if (file.extension() == ".igs") {
    IGESControl_Writer writer;
    EXPECT_TRUE(writer.AddShape(shape) && writer.Write(file.c_str()));
  } else {
    STEPControl_Writer writer;
    EXPECT_EQ(writer.Transfer(shape, STEPControl_AsIs), IFSelect_RetDone);
    EXPECT_EQ(writer.Write(file.c_str()), IFSelect_RetDone);
  }
  const ImportReport report = import_curves(file);
  EXPECT_TRUE(report.ok());
  return report;
}

std::vector<ImportedCurve> centre_lines_of(const ImportReport& report) {
  std::vector<ImportedCurve> lines;
  std::copy_if(report.curves.begin(), report.curves.end(), std::back_inserter(lines),
               [](const ImportedCurve& c) { return c.is_centre_line(); });
  return lines;
}

std::vector<ImportedCurve> centre_lines_of(const TopoDS_Shape& shape) {
  return centre_lines_of(written_and_read(shape));
}

TopoDS_Wire circle(const gp_Ax2& axes, double radius) {
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Circ(axes, radius)).Edge()).Wire();
}

// 100 mm along z, a quarter of a circle of 50 mm towards x, 80 mm along x.
TopoDS_Wire elbow_path() {
  const gp_Circ bend(gp_Ax2(gp_Pnt(50, 0, 100), gp_Dir(0, 1, 0), gp_Dir(-1, 0, 0)), 50);
  return BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(0, 0, 100)).Edge(),
                                 BRepBuilderAPI_MakeEdge(bend, gp_Pnt(0, 0, 100), gp_Pnt(50, 0, 150)).Edge(),
                                 BRepBuilderAPI_MakeEdge(gp_Pnt(50, 0, 150), gp_Pnt(130, 0, 150)).Edge())
      .Wire();
}

void expect_elbow(const std::vector<ImportedCurve>& lines) {
  ASSERT_EQ(lines.size(), 3U);
  const double expected[] = {0.1, 0.05 * pi / 2, 0.08};
  const bool backwards = std::abs(length(lines[0].curve) - 0.08) < 1e-9;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(lines[i].entity, "centre line");
    EXPECT_FALSE(lines[i].free);
    EXPECT_TRUE(lines[i].exact);
    EXPECT_NEAR(lines[i].pipe_radius, 5e-3, 1e-12);
    EXPECT_NEAR(length(lines[i].curve), expected[backwards ? 2 - i : i], 1e-12);
    if (i == 0) continue;
    const NurbsCurve &before = lines[i - 1].curve, &after = lines[i].curve;
    EXPECT_LT((before.point(before.knots().end()) - after.point(after.knots().start())).norm(), 1e-12);
  }
}

TEST(CentreLine, OfAPipeOfCylindersAndATorusIsOneChainOfLinesAndAnArc) {
  const BRepBuilderAPI_MakeFace disc(circle(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 5));
  expect_elbow(centre_lines_of(BRepOffsetAPI_MakePipe(elbow_path(), disc.Face()).Shape()));
}

TEST(CentreLine, OfTheSamePipeInBSplineSurfacesIsTheSame) {
  const BRepBuilderAPI_MakeFace disc(circle(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), 5));
  BRepOffsetAPI_MakePipe pipe(elbow_path(), disc.Face());
  const ImportReport report = written_and_read(BRepBuilderAPI_NurbsConvert(pipe.Shape()).Shape());
  // Nothing but B-splines is in the file.
  for (const ImportedCurve& curve : report.curves)
    EXPECT_TRUE(curve.entity == "bspline" || curve.is_centre_line());
  expect_elbow(centre_lines_of(report));
}

TopoDS_Shape elbow_tube(double radius, double bore) {
  const gp_Ax2 start(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1));
  BRepBuilderAPI_MakeFace ring(circle(start, radius));
  ring.Add(TopoDS::Wire(circle(start, bore).Reversed()));
  return BRepOffsetAPI_MakePipe(elbow_path(), ring.Face()).Shape();
}

TEST(CentreLine, OfATubeKnowsItsBore) {
  const std::vector<ImportedCurve> lines = centre_lines_of(elbow_tube(5, 4));
  expect_elbow(lines);
  for (const ImportedCurve& line : lines) EXPECT_NEAR(line.bore_radius, 4e-3, 1e-12);
}

// IGES has faces only, which do not say where the material is.
TEST(CentreLine, OfATubeInIgesKnowsItsBore) {
  IGESControl_Controller::Init();
  const std::vector<ImportedCurve> lines = centre_lines_of(written_and_read(elbow_tube(5, 4), "tube.igs"));
  ASSERT_EQ(lines.size(), 3U);
  for (const ImportedCurve& line : lines) {
    EXPECT_NEAR(line.pipe_radius, 5e-3, 1e-9);
    EXPECT_NEAR(line.bore_radius, 4e-3, 1e-9);
  }
}

TEST(CentreLine, OfATubeInATubeAreTwoWithABoreEach) {
  TopoDS_Compound both;
  BRep_Builder builder;
  builder.MakeCompound(both);
  builder.Add(both, elbow_tube(5, 4));
  builder.Add(both, elbow_tube(3, 2));
  for (const std::string file : {"tubes.step", "tubes.igs"}) {
    std::map<int, int> bores_in_millimetres;
    for (const ImportedCurve& line : centre_lines_of(written_and_read(both, file)))
      bores_in_millimetres[static_cast<int>(std::lround(1e3 * line.pipe_radius))] =
          static_cast<int>(std::lround(1e3 * line.bore_radius));
    EXPECT_EQ(bores_in_millimetres, (std::map<int, int>{{5, 4}, {3, 2}})) << file;
  }
}

TEST(CentreLine, OfAPipeSweptAlongASplineIsThatSplineWithinTheReportedDeviation) {
  TColgp_Array1OfPnt points(0, 20);
  for (int i = 0; i <= 20; ++i) points(i) = gp_Pnt(10 * i, 30 * std::sin(0.3 * i), 20 * std::cos(0.2 * i));
  const Handle(Geom_BSplineCurve) spine = GeomAPI_PointsToBSpline(points, 3, 3, GeomAbs_C2, 1e-3).Curve();
  gp_Pnt start;
  gp_Vec tangent;
  spine->D1(spine->FirstParameter(), start, tangent);
  const TopoDS_Wire path = BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(spine).Edge()).Wire();
  const BRepBuilderAPI_MakeFace disc(circle(gp_Ax2(start, gp_Dir(tangent)), 4));
  const std::vector<ImportedCurve> lines = centre_lines_of(BRepOffsetAPI_MakePipe(path, disc.Face()).Shape());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].pipe_radius, 4e-3, 1e-6);
  EXPECT_LT(lines[0].deviation, 4e-6);
  const NurbsCurve& centre = lines[0].curve;
  const auto distance_to_spine = [&](const Eigen::Vector3d& p) {
    double least = 1;
    for (int i = 0; i <= 20000; ++i) {
      const double u =
          spine->FirstParameter() + (spine->LastParameter() - spine->FirstParameter()) * i / 20000;
      const gp_Pnt q = spine->Value(u);
      least = std::min(least, (p - 1e-3 * Eigen::Vector3d(q.X(), q.Y(), q.Z())).norm());
    }
    return least;
  };
  for (int i = 0; i <= 20; ++i) {
    const double u = centre.knots().start() + (centre.knots().end() - centre.knots().start()) * i / 20;
    // The spine is sampled every 0.02 mm: next to a sample the distance is second order in that.
    EXPECT_LT(distance_to_spine(centre.point(u)), lines[0].deviation + 1.1e-5);
  }
}

TEST(CentreLine, IsFittedWhereTheParameterisationOfTheSectionsChangesAlongThePipe) {
  // A tube of radius 5 mm about x = 200 v, z = 30 v², whose sections begin alike and run unevenly.
  TColgp_Array2OfPnt points(1, 49, 1, 41);
  for (int i = 0; i <= 48; ++i)
    for (int j = 0; j <= 40; ++j) {
      const double v = j / 40.0, u = 2 * pi * i / 48, angle = u + 0.3 * v * std::sin(u);
      const double slope = std::atan2(60 * v, 200);
      const double across = 5 * std::cos(angle);
      points(i + 1, j + 1) = gp_Pnt(200 * v - across * std::sin(slope), 5 * std::sin(angle),
                                    30 * v * v + across * std::cos(slope));
    }
  GeomAPI_PointsToBSplineSurface surface;
  surface.Interpolate(points);
  const std::vector<ImportedCurve> lines =
      centre_lines_of(BRepBuilderAPI_MakeFace(surface.Surface(), 1e-6).Shape());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].exact);
  EXPECT_GT(lines[0].deviation, 0);
  EXPECT_LT(lines[0].deviation, 5e-6);
  const NurbsCurve& centre = lines[0].curve;
  for (int i = 0; i <= 20; ++i) {
    const Eigen::Vector3d p =
        centre.point(centre.knots().start() + (centre.knots().end() - centre.knots().start()) * i / 20);
    EXPECT_NEAR(p.y(), 0, lines[0].deviation);
    EXPECT_NEAR(p.z(), 0.03 * std::pow(p.x() / 0.2, 2), 2 * lines[0].deviation);
  }
}

TEST(CentreLine, OfATorusIsItsCircle) {
  const std::vector<ImportedCurve> lines = centre_lines_of(BRepPrimAPI_MakeTorus(30, 3).Shape());
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].pipe_radius, 3e-3, 1e-15);
  EXPECT_NEAR(length(lines[0].curve), 2 * pi * 0.03, 1e-12);
  EXPECT_TRUE(is_closed(lines[0].curve, 1e-12));
}

TEST(CentreLine, OfAPlacedRodLiesInTheRod) {
  gp_Trsf placement;
  placement.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 1)), 1);
  const TopoDS_Shape rod = BRepPrimAPI_MakeCylinder(2, 70).Shape();
  const std::vector<ImportedCurve> lines =
      centre_lines_of(BRepBuilderAPI_Transform(rod, placement, /*copy=*/false).Shape());
  ASSERT_EQ(lines.size(), 1U);
  const gp_Pnt a = gp_Pnt(0, 0, 0).Transformed(placement), b = gp_Pnt(0, 0, 70).Transformed(placement);
  const auto is_end = [&](double u) {
    const Eigen::Vector3d p = 1e3 * lines[0].curve.point(u);
    return std::min(a.Distance(gp_Pnt(p.x(), p.y(), p.z())), b.Distance(gp_Pnt(p.x(), p.y(), p.z()))) < 1e-9;
  };
  EXPECT_TRUE(is_end(lines[0].curve.knots().start()));
  EXPECT_TRUE(is_end(lines[0].curve.knots().end()));
  EXPECT_NEAR(length(lines[0].curve), 0.07, 1e-14);
}

TEST(CentreLine, IsNotFoundInAHoleNorInAPartOfACylinder) {
  const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(-20, -20, 0), gp_Pnt(20, 20, 5)).Shape();
  const TopoDS_Shape drill = BRepPrimAPI_MakeCylinder(6, 5).Shape();
  EXPECT_TRUE(centre_lines_of(BRepAlgoAPI_Cut(plate, drill).Shape()).empty());
  EXPECT_TRUE(centre_lines_of(BRepPrimAPI_MakeCylinder(6, 5, pi).Shape()).empty());
}

TEST(CentreLine, EndsInThePlaneThatCutsARodObliquely) {
  gp_Trsf tilt;
  tilt.SetRotation(gp_Ax1(gp_Pnt(0, 0, 50), gp_Dir(1, 0, 0)), 0.5);
  const TopoDS_Shape half_space =
      BRepBuilderAPI_Transform(BRepPrimAPI_MakeBox(gp_Pnt(-50, -50, 50), gp_Pnt(50, 50, 150)).Shape(), tilt);
  const ImportReport report =
      written_and_read(BRepAlgoAPI_Cut(BRepPrimAPI_MakeCylinder(6, 90).Shape(), half_space).Shape());
  const std::vector<ImportedCurve> lines = centre_lines_of(report);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(length(lines[0].curve), 0.05, 1e-12);
  EXPECT_TRUE(report.diagnostics.empty());
}

TEST(CentreLine, OfTheCorpusPipeIsItsAxis) {
  const std::vector<ImportedCurve> lines = centre_lines_of(import_curves(corpus_file("pygem-pipe.step")));
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_NEAR(lines[0].pipe_radius, 1, 1e-9);
  EXPECT_NEAR(length(lines[0].curve), 10, 1e-9);
  // The magnet's section is a rectangle.
  EXPECT_TRUE(centre_lines_of(import_curves(corpus_file("parastell-magnet.step"))).empty());
}

}  // namespace
}  // namespace nurbeam
