#include "nurbs/joined_curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

#include "nurbs/bezier.h"

namespace nurbeam {
namespace {

/// Knots without the first and the last, and control points.
struct Strand {
  std::vector<double> knots;
  Eigen::Matrix4Xd points;
};

bool is_clamped(const KnotVector& knots) {
  return knots.multiplicity(knots.start()) == knots.degree() + 1 &&
         knots.multiplicity(knots.end()) == knots.degree() + 1;
}

/// The Bezier curves between all breaks, written with this degree.
Strand bezier_strand(const NurbsCurve& curve, int degree) {
  const std::vector<double> breaks = curve.knots().breaks();
  const auto count = static_cast<Eigen::Index>(breaks.size()) - 1;
  Strand strand{{}, Eigen::Matrix4Xd(4, degree * count + 1)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const double start = breaks[static_cast<std::size_t>(i)];
    strand.points.middleCols(degree * i, degree + 1) =
        elevated(curve.bezier_points(curve.knots().find_span(start)), degree);
    strand.knots.insert(strand.knots.end(), degree, start);
  }
  strand.knots.insert(strand.knots.end(), degree, breaks.back());
  return strand;
}

Strand strand_of(const NurbsCurve& curve, int degree) {
  if (curve.degree() < degree || !is_clamped(curve.knots())) return bezier_strand(curve, degree);
  const std::vector<double>& knots = curve.knots().knots();
  return {{knots.begin() + 1, knots.end() - 1}, curve.control_points()};
}

/// Appends a strand that begins where this one ends; how far apart they were [m].
double append(Strand& strand, const Strand& next, int degree) {
  const Eigen::Index n = strand.points.cols(), m = next.points.cols();
  const double shift = strand.knots.back() - next.knots.front();
  const auto first = next.knots.begin() + degree;
  std::transform(first, next.knots.end(), std::back_inserter(strand.knots),
                 [=](double u) { return u + shift; });
  const Eigen::Vector3d end = strand.points.col(n - 1).hnormalized(),
                        start = next.points.col(0).hnormalized();
  const double weight = strand.points(3, n - 1);
  strand.points.conservativeResize(4, n + m - 1);
  strand.points.rightCols(m - 1) = weight / next.points(3, 0) * next.points.rightCols(m - 1);
  strand.points.col(n - 1).head<3>() = weight * 0.5 * (end + start);
  return (end - start).norm();
}

double close(Eigen::Matrix4Xd& points) {
  const Eigen::Index last = points.cols() - 1;
  const Eigen::Vector3d start = points.col(0).hnormalized(), end = points.col(last).hnormalized();
  for (const Eigen::Index i : {Eigen::Index(0), last})
    points.col(i).head<3>() = points(3, i) * 0.5 * (start + end);
  return (end - start).norm();
}

}  // namespace

JoinedCurve joined_curve(const std::vector<NurbsCurve>& curves, const Chain& chain) {
  int degree = 1;
  for (const int i : chain.curves) degree = std::max(degree, curves.at(i).degree());
  const auto strand_at = [&](std::size_t i) {
    const NurbsCurve& curve = curves[chain.curves[i]];
    return strand_of(chain.reversed[i] ? curve.reversed() : curve, degree);
  };
  Strand strand = strand_at(0);
  double gap = 0;
  for (std::size_t i = 1; i < chain.curves.size(); ++i)
    gap = std::max(gap, append(strand, strand_at(i), degree));
  if (chain.closed) gap = std::max(gap, close(strand.points));
  strand.knots.insert(strand.knots.begin(), strand.knots.front());
  strand.knots.push_back(strand.knots.back());
  return {NurbsCurve(KnotVector(degree, std::move(strand.knots)), std::move(strand.points)), gap};
}

NurbsCurve moved_curve(const NurbsCurve& curve, const Eigen::Matrix<double, 3, 4>& map) {
  Eigen::Matrix4Xd points = curve.control_points();
  points.topRows<3>() = (map * points).eval();
  return {curve.knots(), std::move(points)};
}

}  // namespace nurbeam
