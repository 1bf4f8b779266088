#include "cad_import/occt/edge_curve.h"

#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <GeomConvert.hxx>
#include <GeomConvert_ApproxCurve.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_Circle.hxx>
#include <Geom_Ellipse.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Precision.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cad_import/occt/end_parameters.h"
#include "cad_import/report/length_unit.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

struct TrimmedCurve {
  Handle(Geom_Curve) curve;
  double first;
  double last;
};

struct Approximation {
  Handle(Geom_BSplineCurve) curve;
  double deviation = 0;  // [mm]
};

// What an offset of the curve is exactly: of a line one beside it, of a circle in its plane one about its
// centre. The curve itself where it is no such offset.
Handle(Geom_Curve) plain_form(const Handle(Geom_Curve) & curve) {
  const auto offset = Handle(Geom_OffsetCurve)::DownCast(curve);
  if (offset.IsNull()) return curve;
  Handle(Geom_Curve) basis = offset->BasisCurve();
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(basis)) basis = trimmed->BasisCurve();
  const gp_Dir normal = offset->Direction();
  if (const auto line = Handle(Geom_Line)::DownCast(basis)) {
    const gp_Dir along = line->Position().Direction();
    if (along.IsParallel(normal, Precision::Angular())) return curve;
    const gp_Vec shift = offset->Offset() * gp_Vec(along.Crossed(normal));
    return new Geom_Line(line->Position().Location().Translated(shift), along);
  }
  const auto circle = Handle(Geom_Circle)::DownCast(basis);
  if (circle.IsNull() || !circle->Axis().Direction().IsParallel(normal, Precision::Angular())) return curve;
  const double outwards = circle->Axis().Direction().Dot(normal) > 0 ? 1 : -1;
  const double radius = circle->Radius() + outwards * offset->Offset();
  return radius > Precision::Confusion() ? Handle(Geom_Curve)(new Geom_Circle(circle->Position(), radius))
                                         : curve;
}

TrimmedCurve curve_of(TopoDS_Edge edge) {
  TrimmedCurve trimmed{};
  trimmed.curve = BRep_Tool::Curve(edge, trimmed.first, trimmed.last);
  if (trimmed.curve.IsNull() && BRepLib::BuildCurve3d(edge))
    trimmed.curve = BRep_Tool::Curve(edge, trimmed.first, trimmed.last);
  if (trimmed.curve.IsNull()) throw std::runtime_error("the edge has no 3D curve");
  while (const auto inner = Handle(Geom_TrimmedCurve)::DownCast(trimmed.curve))
    trimmed.curve = inner->BasisCurve();
  trimmed.curve = plain_form(trimmed.curve);
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(trimmed.curve); !spline.IsNull())
    correct_ends(edge, *spline, trimmed.first, trimmed.last);
  if (Precision::IsInfinite(trimmed.first) || Precision::IsInfinite(trimmed.last))
    throw std::runtime_error("the curve is unbounded; trim it in the CAD system");
  if (!(trimmed.first < trimmed.last)) throw std::runtime_error("the parameter range of the curve is empty");
  return trimmed;
}

std::string entity_name(const Handle(Geom_Curve) & curve) {
  if (curve->IsKind(STANDARD_TYPE(Geom_Line))) return "line";
  if (curve->IsKind(STANDARD_TYPE(Geom_Circle))) return "circle";
  if (curve->IsKind(STANDARD_TYPE(Geom_Ellipse))) return "ellipse";
  if (curve->IsKind(STANDARD_TYPE(Geom_Parabola))) return "parabola";
  if (curve->IsKind(STANDARD_TYPE(Geom_Hyperbola))) return "hyperbola";
  if (curve->IsKind(STANDARD_TYPE(Geom_BSplineCurve))) return "bspline";
  if (curve->IsKind(STANDARD_TYPE(Geom_BezierCurve))) return "bezier";
  if (curve->IsKind(STANDARD_TYPE(Geom_OffsetCurve))) return "offset";
  return "other";
}

bool is_clamped(const Geom_BSplineCurve& curve) {
  const int full = curve.Degree() + 1;
  return curve.Multiplicity(1) == full && curve.Multiplicity(curve.NbKnots()) == full;
}

// Moves what the digits of a file have set beside an end of the curve onto that end: BREP files have ranges
// with fewer digits than knots, and OpenCASCADE cuts off no piece as short.
void snap_to_ends(const Geom_BSplineCurve& curve, double& first, double& last) {
  const double begin = curve.FirstParameter(), end = curve.LastParameter(), near = 1e-12 * (end - begin);
  if (std::abs(first - begin) <= near) first = begin;
  if (std::abs(last - end) <= near) last = end;
}

// The piece of the B-spline on the range, with clamped ends; untouched, bit by bit, when it is the whole.
Handle(Geom_BSplineCurve) segment(const Handle(Geom_BSplineCurve) & source, double first, double last) {
  const auto curve = Handle(Geom_BSplineCurve)::DownCast(source->Copy());
  snap_to_ends(*curve, first, last);
  const bool whole = first == curve->FirstParameter() && last == curve->LastParameter();
  if (!whole || !is_clamped(*curve)) curve->Segment(first, last);
  return curve;
}

Approximation approximated(const TrimmedCurve& source, double tolerance) {
  const Handle(Geom_Curve) trimmed = new Geom_TrimmedCurve(source.curve, source.first, source.last);
  const GeomConvert_ApproxCurve approximation(trimmed, tolerance, GeomAbs_C1, /*MaxSegments=*/2000,
                                              /*MaxDegree=*/3);
  if (!approximation.HasResult())
    throw std::runtime_error("the curve cannot be approximated by a cubic B-spline");
  const Handle(Geom_BSplineCurve) curve = approximation.Curve();
  constexpr int samples = 4000;
  double deviation = 0;
  for (int i = 0; i <= samples; ++i) {
    const double u = source.first + (source.last - source.first) * i / samples;
    deviation = std::max(deviation, trimmed->Value(u).Distance(curve->Value(u)));
  }
  return {curve, std::max(deviation, approximation.MaxError())};
}

Handle(Geom_BSplineCurve) exact_bspline(const TrimmedCurve& source) {
  if (const auto bspline = Handle(Geom_BSplineCurve)::DownCast(source.curve))
    return segment(bspline, source.first, source.last);
  if (source.curve->IsKind(STANDARD_TYPE(Geom_BezierCurve)))
    return segment(GeomConvert::CurveToBSplineCurve(source.curve), source.first, source.last);
  // Lines get degree 1, conics the rational quadratic: other parameterisations raise the degree or are not
  // exact.
  const Handle(Geom_Curve) trimmed = new Geom_TrimmedCurve(source.curve, source.first, source.last);
  return GeomConvert::CurveToBSplineCurve(trimmed, Convert_TgtThetaOver2);
}

NurbsCurve nurbs_curve(const Geom_BSplineCurve& source) {
  std::vector<double> knots;
  for (int i = 1; i <= source.NbKnots(); ++i)
    knots.insert(knots.end(), source.Multiplicity(i), source.Knot(i));
  Eigen::Matrix4Xd points(4, source.NbPoles());
  for (int i = 1; i <= source.NbPoles(); ++i) {
    const gp_Pnt pole = source.Pole(i);
    const double weight = source.Weight(i);
    const Eigen::Vector3d metres = Eigen::Vector3d(pole.X(), pole.Y(), pole.Z()) / millimetres_per_metre;
    points.col(i - 1) << weight * metres, weight;
  }
  return NurbsCurve(KnotVector(source.Degree(), std::move(knots)), std::move(points));
}

void check_size(const NurbsCurve& curve) {
  constexpr double largest = 1e15;  // [m]: the lengths of larger ones take for ever
  if (const double size = curve.control_points().cwiseAbs().maxCoeff(); !(size <= largest))
    throw std::runtime_error("it has a coordinate or weight of " + text_of(size) + "; the limit is " +
                             text_of(largest));
  const double l = length(curve);
  if (!(std::isfinite(l) && l > 0))
    throw std::runtime_error("its length is " + text_of(l) + " m; it must be finite and positive");
}

}  // namespace

ImportedCurve imported_curve(const TopoDS_Edge& edge, double tolerance) {
  const TrimmedCurve source = curve_of(edge);
  const std::string entity = entity_name(source.curve);
  const bool exact = entity != "offset" && entity != "other";
  const Approximation result =
      exact ? Approximation{exact_bspline(source)} : approximated(source, tolerance * millimetres_per_metre);
  NurbsCurve curve = nurbs_curve(*result.curve);
  check_size(curve);
  if (edge.Orientation() == TopAbs_REVERSED) curve = curve.reversed();
  return {.entity = entity,
          .exact = exact,
          .deviation = result.deviation / millimetres_per_metre,
          .curve = std::move(curve)};
}

}  // namespace nurbeam
