#include "nurbs/curve_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "nurbs/largest_value.h"

namespace nurbeam {
namespace {

bool is_cubic_itself(const NurbsCurve& curve) { return curve.degree() <= 3; }

std::vector<BezierPath> paths_of(const std::vector<NurbsCurve>& curves, double closeness) {
  std::vector<BezierPath> paths;
  for (const NurbsCurve& curve : curves) paths.push_back(BezierPath::from_nurbs(curve, closeness));
  return paths;
}

std::vector<RationalCubic> cubics_of(const std::vector<BezierPath>& paths) {
  std::vector<RationalCubic> all;
  for (const BezierPath& path : paths) all.insert(all.end(), path.segments.begin(), path.segments.end());
  return all;
}

/// The distance from the point to the place of the curve that Newton finds from u on.
double distance_near(const NurbsCurve& curve, double u, const Eigen::Vector3d& point) {
  constexpr int most_steps = 20;
  const double start = curve.knots().start(), end = curve.knots().end();
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < most_steps; ++i) {
    const Eigen::Matrix3Xd r = curve.derivatives(u, 2);
    const Eigen::Vector3d offset = r.col(0) - point;
    least = std::min(least, offset.norm());
    const double bend = r.col(1).squaredNorm() + offset.dot(r.col(2));
    if (!(bend > 0)) break;
    const double next = std::clamp(u - offset.dot(r.col(1)) / bend, start, end);
    if (std::abs(next - u) <= 1e-15 * (end - start)) break;
    u = next;
  }
  return least;
}

double size_of(const std::vector<NurbsCurve>& curves) {
  double size = 0;
  for (const NurbsCurve& curve : curves)
    size = std::max(size, curve.control_points().colwise().hnormalized().cwiseAbs().maxCoeff());
  return size;
}

}  // namespace

CurveDistance::CurveDistance(const std::vector<NurbsCurve>& curves, double closeness)
    : CurveDistance(curves, paths_of(curves, closeness), closeness) {}

CurveDistance::CurveDistance(const std::vector<NurbsCurve>& curves, const std::vector<BezierPath>& paths,
                             double closeness)
    : closeness_(closeness),
      cubics_(cubics_of(paths)),
      closest_(cubics_),
      round_off_(1e-14 * size_of(curves)) {
  for (std::size_t k = 0; k < curves.size(); ++k) {
    const NurbsCurve* const curve = is_cubic_itself(curves[k]) ? nullptr : &curves[k];
    for (std::size_t i = 0; i + 1 < paths[k].breaks.size(); ++i)
      sources_.push_back({curve, paths[k].breaks[i], paths[k].breaks[i + 1]});
  }
}

double CurveDistance::to(const Eigen::Vector3d& point) const {
  const ClosestPoint closest = closest_.to(point);
  const Source& source = sources_[closest.segment];
  if (!source.curve) return closest.distance;
  return distance_near(*source.curve, std::lerp(source.start, source.end, closest.u), point);
}

double CurveDistance::largest_from(const NurbsCurve& curve) const {
  const BezierPath path = BezierPath::from_nurbs(curve, closeness_);
  double largest = 0;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const auto place = [&](double u) {
      return is_cubic_itself(curve) ? path.segments[i].point(u)
                                    : curve.point(std::lerp(path.breaks[i], path.breaks[i + 1], u));
    };
    largest = std::max(largest, largest_value([&](double u) { return to(place(u)); }, round_off_));
  }
  return largest;
}

}  // namespace nurbeam
