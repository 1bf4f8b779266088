#include "cad_import/step/spine.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <Eigen/Geometry>
#include <GC_MakeArcOfCircle.hxx>
#include <Geom_Circle.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cad_import/report/length_unit.h"
#include "cad_import/step/millimetres.h"
#include "nurbs/bezier.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

constexpr double same_place = 1e-7;  // what OpenCASCADE takes for one point [mm]

/// A span of the curve.
struct Span {
  BezierPoints points;  // [m]
  bool straight;

  Eigen::Vector3d point(Eigen::Index i) const { return points.col(i).hnormalized(); }
  Eigen::Vector3d start() const { return point(0); }
  Eigen::Vector3d end() const { return point(points.cols() - 1); }
  Eigen::Vector3d start_direction() const { return (point(1) - start()).normalized(); }
  Eigen::Vector3d end_direction() const { return (end() - point(points.cols() - 2)).normalized(); }
};

bool is_straight(const BezierPoints& points) {
  const Eigen::Vector3d start = points.col(0).hnormalized();
  const Eigen::Vector3d along = (points.rightCols<1>().hnormalized() - start).normalized();
  for (const auto& column : points.colwise()) {
    const Eigen::Vector3d offset = column.hnormalized() - start;
    if (along.cross(offset).norm() * millimetres_per_metre > same_place) return false;
  }
  return true;
}

/// By what angle the tangent turns between two spans [rad]; 0 where they meet smoothly.
double corner_angle(const Span& before, const Span& after) {
  constexpr double smooth = 1e-4;
  const Eigen::Vector3d in = before.end_direction(), out = after.start_direction();
  const double angle = std::atan2(in.cross(out).norm(), in.dot(out));
  return angle < smooth ? 0 : angle;
}

/// What corner there is between two spans, in words; nothing where they meet smoothly.
std::optional<std::string> corner_between(const Span& before, const Span& after) {
  const double angle = corner_angle(before, after);
  if (angle == 0) return std::nullopt;
  return "a corner of " + text_of(angle * 180 / std::numbers::pi) + " degrees at " + text_of(after.start());
}

std::vector<Span> all_spans(const NurbsCurve& curve) {
  std::vector<Span> spans;
  const std::vector<double> breaks = curve.knots().breaks();
  for (std::size_t j = 0; j + 1 < breaks.size(); ++j) {
    const BezierPoints points = curve.bezier_points(curve.knots().find_span(breaks[j]));
    spans.push_back({points, is_straight(points)});
  }
  return spans;
}

/// The spans, those of one line as one.
std::vector<Span> merged_spans(const NurbsCurve& curve) {
  std::vector<Span> spans;
  for (const Span& next : all_spans(curve)) {
    BezierPoints both(4, 3);
    if (!spans.empty()) both << spans.back().points.col(0), next.points.col(0), next.points.rightCols<1>();
    if (next.straight && !spans.empty() && spans.back().straight && is_straight(both))
      spans.back().points = both;
    else
      spans.push_back(next);
  }
  return spans;
}

NurbsCurve curve_of(const Span& span) {
  if (span.straight) return straight_span(span.start(), span.end());
  const int degree = static_cast<int>(span.points.cols()) - 1;
  std::vector<double> knots(degree + 1, 0);
  knots.resize(2 * degree + 2, 1);
  return {KnotVector(degree, std::move(knots)), span.points};
}

/// The arc of a circle that the span is, or null.
Handle(Geom_Curve) arc_of(const BezierPoints& span) {
  constexpr int samples = 16;
  const auto place = [&](double u) { return in_millimetres(part(span, u, 1).col(0).hnormalized()); };
  const GC_MakeArcOfCircle maker(place(0), place(0.5), in_millimetres(span.rightCols<1>().hnormalized()));
  if (!maker.IsDone()) return nullptr;
  const auto circle = Handle(Geom_Circle)::DownCast(maker.Value()->BasisCurve());
  const gp_Dir normal = circle->Axis().Direction();
  for (int i = 1; i < samples; ++i) {
    const gp_Vec out(circle->Location(), place(double(i) / samples));
    if (std::abs(out.Magnitude() - circle->Radius()) > same_place || std::abs(out.Dot(normal)) > same_place)
      return nullptr;
  }
  return Handle(Geom_Curve)(maker.Value());
}

}  // namespace

Handle(Geom_BSplineCurve) bspline(const NurbsCurve& curve) {
  const std::vector<double> breaks = [&] {
    std::vector<double> values = curve.knots().knots();
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
  }();
  const int break_count = static_cast<int>(breaks.size());
  TColStd_Array1OfReal knots(1, break_count);
  TColStd_Array1OfInteger multiplicities(1, break_count);
  for (int i = 0; i < break_count; ++i) {
    knots(i + 1) = breaks[i];
    multiplicities(i + 1) = curve.knots().multiplicity(breaks[i]);
  }
  const Eigen::Matrix4Xd& points = curve.control_points();
  const int count = static_cast<int>(points.cols());
  TColgp_Array1OfPnt poles(1, count);
  TColStd_Array1OfReal weights(1, count);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d millimetres = points.col(i).head<3>() / points(3, i) * millimetres_per_metre;
    poles(i + 1) = gp_Pnt(millimetres.x(), millimetres.y(), millimetres.z());
    weights(i + 1) = points(3, i);
  }
  return new Geom_BSplineCurve(poles, weights, knots, multiplicities, curve.degree());
}

TopoDS_Edge edge(const NamedCurve& named) {
  BRepBuilderAPI_MakeEdge maker(bspline(named.curve));
  if (!maker.IsDone())
    throw std::runtime_error("OpenCASCADE makes no edge of the curve '" + named.name + "'");
  return maker.Edge();
}

std::optional<std::string> corner_of(const NurbsCurve& curve) {
  const std::vector<Span> spans = all_spans(curve);
  for (std::size_t i = 0; i + 1 < spans.size(); ++i)
    if (auto corner = corner_between(spans[i], spans[i + 1])) return corner;
  const bool closed = is_closed(curve, same_place / millimetres_per_metre);
  return closed ? corner_between(spans.back(), spans.front()) : std::nullopt;
}

NurbsCurve straight_span(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  return make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), (Eigen::Matrix3Xd(3, 2) << from, to).finished(),
                          Eigen::Vector2d::Ones());
}

Spine spine(const NurbsCurve& curve) {
  const bool closed = is_closed(curve, same_place / millimetres_per_metre);
  std::vector<Span> spans = merged_spans(curve);
  const std::size_t count = spans.size();
  const auto corner_before = [&](std::size_t i) {
    return (i > 0 || closed) && corner_angle(spans[(i + count - 1) % count], spans[i]) > 0;
  };
  std::size_t first = 0;
  while (closed && first < count && !corner_before(first)) ++first;
  std::rotate(spans.begin(), spans.begin() + static_cast<std::ptrdiff_t>(first % count), spans.end());
  Spine spine{{}, closed};
  for (std::size_t i = 0; i < count; ++i) {
    const bool corner = corner_before(i);
    if (i == 0 || corner) spine.runs.emplace_back();
    if (corner) spine.runs.back().before = spans[(i + count - 1) % count].end_direction();
    if (corner && i > 0) spine.runs[spine.runs.size() - 2].after = spans[i].start_direction();
    spine.runs.back().spans.push_back(curve_of(spans[i]));
  }
  if (corner_before(0)) spine.runs.back().after = spans[0].start_direction();
  return spine;
}

TopoDS_Wire wire_of_arcs(const Run& run, bool closed) {
  std::vector<Handle(Geom_Curve)> arcs;
  for (const NurbsCurve& span : run.spans) {
    arcs.push_back(span.degree() == 1 ? nullptr : arc_of(span.control_points()));
    if (span.degree() > 1 && arcs.back().IsNull()) return {};
  }
  const auto place = [](const NurbsCurve& span, double u) {
    return TopoDS_Vertex(BRepBuilderAPI_MakeVertex(in_millimetres(span.point(u))));
  };
  const TopoDS_Vertex first = place(run.spans.front(), 0);
  BRepBuilderAPI_MakeWire wire;
  TopoDS_Vertex from = first;
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    const TopoDS_Vertex to = closed && i + 1 == arcs.size() ? first : place(run.spans[i], 1);
    wire.Add(arcs[i].IsNull() ? BRepBuilderAPI_MakeEdge(from, to).Edge()
                              : BRepBuilderAPI_MakeEdge(arcs[i], from, to).Edge());
    from = to;
  }
  return wire.Wire();
}

}  // namespace nurbeam
