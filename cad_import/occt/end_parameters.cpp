#include "cad_import/occt/end_parameters.h"

#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopoDS_Vertex.hxx>
#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam {
namespace {

// That of the nearest of many points of each span.
struct Start {
  double parameter, step;
};

Start nearest_sample(const Geom_BSplineCurve& curve, const gp_Pnt& point) {
  const int per_span = 8 * (curve.Degree() + 1);
  Start nearest{curve.FirstParameter(), 0};
  double least = std::numeric_limits<double>::infinity();
  for (int knot = 1; knot < curve.NbKnots(); ++knot) {
    const double step = (curve.Knot(knot + 1) - curve.Knot(knot)) / per_span;
    for (int i = 0; i <= per_span; ++i) {
      const double u = curve.Knot(knot) + i * step;
      const double distance = curve.Value(u).SquareDistance(point);
      if (!(distance < least)) continue;
      least = distance;
      nearest = {u, step};
    }
  }
  return nearest;
}

}  // namespace

double closest_parameter(const Geom_BSplineCurve& curve, const gp_Pnt& point) {
  constexpr int most_steps = 50;
  const auto [start, step] = nearest_sample(curve, point);
  const double low = std::max(start - step, curve.FirstParameter()),
               high = std::min(start + step, curve.LastParameter());
  double u = start;
  for (int i = 0; i < most_steps; ++i) {
    gp_Pnt at;
    gp_Vec along, bend;
    curve.D2(u, at, along, bend);
    const gp_Vec off(point, at);
    const double slope = off.Dot(along), curvature = along.SquareMagnitude() + off.Dot(bend);
    if (!(curvature > 0)) break;
    const double next = std::clamp(u - slope / curvature, low, high);
    if (std::abs(next - u) <= 1e-15 * (high - low)) break;
    u = next;
  }
  return u;
}

void correct_ends(const TopoDS_Edge& edge, const Geom_BSplineCurve& curve, double& first, double& last) {
  if (curve.IsPeriodic() || curve.IsClosed()) return;
  constexpr double digits = 1e-5, closer = 1e-2;
  const double size = curve.Value(first).Distance(curve.Value(last));
  const auto corrected = [&](const TopoDS_Vertex& vertex, double parameter) {
    if (vertex.IsNull()) return parameter;
    // Without its place: the curve is in that of its edge.
    const gp_Pnt wanted = BRep_Tool::Pnt(vertex);
    const double off = curve.Value(parameter).Distance(wanted);
    if (off <= digits * size) return parameter;
    const double other = closest_parameter(curve, wanted);
    return curve.Value(other).Distance(wanted) <= closer * off ? other : parameter;
  };
  const double begin = corrected(TopExp::FirstVertex(edge), first),
               end = corrected(TopExp::LastVertex(edge), last);
  if (!(begin < end)) return;
  first = begin;
  last = end;
}

}  // namespace nurbeam
