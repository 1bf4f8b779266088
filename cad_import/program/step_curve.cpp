#include "cad_import/program/step_curve.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <ElCLib.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_CartesianPoint.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Hyperbola.hxx>
#include <StepGeom_BSplineCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Curve.hxx>
#include <StepShape_EdgeCurve.hxx>
#include <StepShape_PolyLoop.hxx>
#include <StepShape_VertexPoint.hxx>
#include <StepToGeom.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "cad_import/occt/edge_curve.h"
#include "cad_import/occt/end_parameters.h"
#include "cad_import/step/spline_values.h"
#include "nurbs/full_knots.h"

namespace nurbeam {
namespace {

Eigen::Vector3d point_of(const Handle(StepGeom_CartesianPoint) & point, double unit) {
  if (point.IsNull() || point->NbCoordinates() != 3)
    throw std::runtime_error("a point has not three coordinates");
  return unit *
         Eigen::Vector3d(point->CoordinatesValue(1), point->CoordinatesValue(2), point->CoordinatesValue(3));
}

std::vector<NurbsCurve> nurbs_of(const StepGeom_BSplineCurve& curve, double unit) {
  const int count = curve.NbControlPointsList();
  if (curve.Degree() < 1 || count < 2) throw std::runtime_error("it has no degree or no control points");
  Eigen::Matrix4Xd points = control_points_of(curve);
  points.topRows<3>() *= unit;
  return split_at_full_knots(curve.Degree(), knots_of(curve), points);
}

NurbsCurve nurbs_of(const StepShape_PolyLoop& loop, double unit) {
  const int count = loop.NbPolygon();
  Eigen::Matrix3Xd points(3, count + 1);  // back to the first
  for (int i = 0; i <= count; ++i) points.col(i) = point_of(loop.PolygonValue(i % count + 1), unit);
  return make_nurbs_curve(KnotVector(1, clamped_knots(1, count)), points, Eigen::VectorXd::Ones(count + 1));
}

gp_Pnt vertex_of(const Handle(StepShape_Vertex) & vertex) {
  const auto known = Handle(StepShape_VertexPoint)::DownCast(vertex);
  const auto place =
      known.IsNull() ? nullptr : Handle(StepGeom_CartesianPoint)::DownCast(known->VertexGeometry());
  if (place.IsNull()) throw std::runtime_error("its vertices have no place");
  return StepToGeom::MakeCartesianPoint(place)->Pnt();
}

/// OpenCASCADE's own search fails where a hyperbola is steep, and on some splines.
std::optional<double> parameter_on(const Handle(Geom_Curve) & curve, const gp_Pnt& point) {
  constexpr double on_it = 1e-4;  // [mm]
  if (const auto hyperbola = Handle(Geom_Hyperbola)::DownCast(curve); !hyperbola.IsNull())
    return ElCLib::Parameter(hyperbola->Hypr(), point);
  const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  if (spline.IsNull() || spline->IsPeriodic() || spline->IsClosed()) return std::nullopt;
  const double parameter = closest_parameter(*spline, point);
  if (spline->Value(parameter).Distance(point) > on_it) return std::nullopt;
  return parameter;
}

void bound(const Handle(Geom_Curve) & curve, const gp_Pnt& start, const gp_Pnt& end,
           BRepBuilderAPI_MakeEdge& maker) {
  const std::optional<double> first = parameter_on(curve, start), last = parameter_on(curve, end);
  if (first && last && *first < *last)
    maker.Init(curve, *first, *last);
  else
    maker.Init(curve, start, end);
}

/// From its first vertex to its last: against its curve where it has not the sense of that.
TopoDS_Edge edge_of(const Handle(Standard_Transient) & entity) {
  const auto edge = Handle(StepShape_EdgeCurve)::DownCast(entity);
  const Handle(Geom_Curve) curve =
      StepToGeom::MakeCurve(edge.IsNull() ? Handle(StepGeom_Curve)::DownCast(entity) : edge->EdgeGeometry());
  if (curve.IsNull()) throw std::runtime_error("OpenCASCADE makes no curve of it");
  BRepBuilderAPI_MakeEdge maker;
  if (edge.IsNull())
    maker.Init(curve);
  else if (edge->SameSense())
    bound(curve, vertex_of(edge->EdgeStart()), vertex_of(edge->EdgeEnd()), maker);
  else
    bound(curve, vertex_of(edge->EdgeEnd()), vertex_of(edge->EdgeStart()), maker);
  if (!maker.IsDone()) throw std::runtime_error("it is not bounded, or its ends are not on it");
  const bool backwards = !edge.IsNull() && !edge->SameSense();
  return backwards ? TopoDS::Edge(maker.Edge().Reversed()) : maker.Edge();
}

}  // namespace

std::vector<ImportedCurve> step_curves(const Handle(Standard_Transient) & entity, double unit,
                                       double tolerance) {
  std::vector<ImportedCurve> curves;
  if (const auto spline = Handle(StepGeom_BSplineCurve)::DownCast(entity)) {
    for (NurbsCurve& curve : nurbs_of(*spline, unit))
      curves.push_back({.entity = "bspline", .curve = std::move(curve)});
    return curves;
  }
  const auto loop = Handle(StepShape_PolyLoop)::DownCast(entity);
  curves.push_back(loop.IsNull() ? imported_curve(edge_of(entity), tolerance)
                                 : ImportedCurve{.entity = "bspline", .curve = nurbs_of(*loop, unit)});
  return curves;
}

}  // namespace nurbeam
