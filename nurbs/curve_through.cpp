#include "nurbs/curve_through.h"

#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>
#include <string>

#include "nurbs/interpolated_cubic.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

using PointList = std::vector<Eigen::Vector3d>;

Eigen::Matrix3Xd columns_of(const PointList& points) {
  Eigen::Matrix3Xd columns(3, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = points[i];
  return columns;
}

std::string point_name(std::size_t i) { return "point " + std::to_string(i + 1); }

void check_point_list(const PointList& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw std::invalid_argument(point_name(i) + " is not finite");
    if (i > 0 && points[i] == points[i - 1])
      throw std::invalid_argument(point_name(i) + ", " + text_of(points[i]) +
                                  ", is the same as the one before; remove one");
  }
}

std::vector<double> chord_lengths(const PointList& points) {
  std::vector<double> sums{0};
  for (std::size_t i = 1; i < points.size(); ++i)
    sums.push_back(sums.back() + (points[i] - points[i - 1]).norm());
  return sums;
}

// The basis functions of degree p that are not zero at u in knots[span] <= u <= knots[span + 1] (The NURBS
// Book, A2.2).
std::vector<double> basis_at(const std::vector<double>& knots, int p, int span, double u) {
  std::vector<double> N{1};
  for (int j = 1; j <= p; ++j) {
    double saved = 0;
    for (int r = 0; r < j; ++r) {
      const double right = knots[span + r + 1] - u, left = u - knots[span + 1 - j + r];
      const double part = N[r] / (right + left);
      N[r] = saved + right * part;
      saved = left * part;
    }
    N.push_back(saved);
  }
  return N;
}

// Of any degree, by averaged knots.
NurbsCurve spline_through(const PointList& points, const std::vector<double>& at, int p) {
  const int n = static_cast<int>(points.size());
  std::vector<double> knots(p + 1, 0.0);
  for (int j = 1; j < n - p; ++j) {
    double sum = 0;
    for (int i = j; i < j + p; ++i) sum += at[i];
    knots.push_back(sum / p);
  }
  knots.insert(knots.end(), p + 1, at.back());
  const KnotVector vector(p, knots);
  Eigen::MatrixXd N = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    const int span = vector.find_span(at[i]);
    const std::vector<double> basis = basis_at(knots, p, span, at[i]);
    for (int k = 0; k <= p; ++k) N(i, span - p + k) = basis[k];
  }
  const Eigen::MatrixXd control = N.partialPivLu().solve(columns_of(points).transpose());
  return make_nurbs_curve(vector, control.transpose(), Eigen::VectorXd::Ones(n));
}

// Cubics between points with a unit tangent at each.
NurbsCurve hermite_through(const PointList& points, const std::vector<double>& at,
                           const PointList& tangents) {
  const std::size_t n = points.size();
  PointList control{points[0]};
  std::vector<double> knots(4, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double third = (at[i + 1] - at[i]) / 3;
    control.emplace_back(points[i] + third * tangents[i]);
    control.emplace_back(points[i + 1] - third * tangents[i + 1]);
    if (i > 0) knots.insert(knots.end(), 2, at[i]);
  }
  control.push_back(points[n - 1]);
  knots.insert(knots.end(), 4, at.back());
  return make_nurbs_curve(KnotVector(3, knots), columns_of(control),
                          Eigen::VectorXd::Ones(static_cast<Eigen::Index>(control.size())));
}

PointList directions(const PointList& tangents) {
  PointList directions;
  for (std::size_t i = 0; i < tangents.size(); ++i) {
    if (!(tangents[i].norm() > 0) || !tangents[i].allFinite())
      throw std::invalid_argument("tangent " + std::to_string(i + 1) + " has no direction");
    directions.push_back(tangents[i].normalized());
  }
  return directions;
}

void check_counts(const PointList& points, const ThroughPoints& how) {
  const std::size_t n = points.size(), count = how.tangents.size();
  if (how.degree < 1)
    throw std::invalid_argument("the degree is " + std::to_string(how.degree) + "; must be 1 or more");
  if (count == 0 && !how.closed && n < static_cast<std::size_t>(how.degree) + 1)
    throw std::invalid_argument(std::to_string(n) + " points for a curve of degree " +
                                std::to_string(how.degree) + ", which needs " +
                                std::to_string(how.degree + 1) + "; give more, or a lower degree");
  if (count > 0 && count != n && (count != 2 || how.closed))
    throw std::invalid_argument(std::to_string(count) + " tangents for " + std::to_string(n) +
                                " points; give " +
                                (how.closed ? "one at each" : "two, at the ends, or one at each"));
  if ((count > 0 || how.closed) && how.degree != 3)
    throw std::invalid_argument("the degree is " + std::to_string(how.degree) +
                                "; tangents and closed curves are of degree 3");
}

}  // namespace

NurbsCurve curve_through(const PointList& given, const ThroughPoints& how) {
  check_point_list(given);
  PointList points = given, tangents = directions(how.tangents);
  const bool repeats = points.size() > 1 && points.front() == points.back();
  if (how.closed && repeats) {
    points.pop_back();
    if (tangents.size() == given.size()) tangents.pop_back();
  }
  if (points.size() < (how.closed ? 3u : 2u))
    throw std::invalid_argument(std::to_string(points.size()) + " different points; a " +
                                (how.closed ? "closed curve has at least 3" : "curve has at least 2"));
  ThroughPoints checked = how;
  checked.tangents = tangents;
  check_counts(points, checked);
  if (how.closed) {
    points.push_back(points.front());
    if (!tangents.empty()) tangents.push_back(tangents.front());
  }
  const std::vector<double> at = chord_lengths(points);
  if (!tangents.empty() && tangents.size() == points.size() && (points.size() > 2 || how.closed))
    return hermite_through(points, at, tangents);
  if (!tangents.empty())
    return interpolated_cubic(at, columns_of(points), {tangents.front(), tangents.back()});
  if (how.closed) return closed_interpolated_cubic(at, columns_of(points));
  return how.degree == 3 ? interpolated_cubic(at, columns_of(points))
                         : spline_through(points, at, how.degree);
}

}  // namespace nurbeam
