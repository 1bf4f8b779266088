#include "nurbs/bezier.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "nurbs/bernstein.h"

namespace nurbeam {
namespace {

double hull_bound(BezierPoints a, BezierPoints b) {
  if (!(b.row(3).minCoeff() > 0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d origin = a.col(0).hnormalized();
  a.topRows<3>() -= (origin * a.row(3)).eval();
  b.topRows<3>() -= (origin * b.row(3)).eval();
  const BezierPoints difference = a - b;
  const double radius = a.colwise().hnormalized().colwise().norm().maxCoeff();
  return (difference.topRows<3>().colwise().norm().maxCoeff() +
          radius * difference.row(3).cwiseAbs().maxCoeff()) /
         b.row(3).minCoeff();
}

double halved_bound(const BezierPoints& a, const BezierPoints& b, int halvings) {
  if (halvings == 0) return hull_bound(a, b);
  const auto [a_left, a_right] = halves(a);
  const auto [b_left, b_right] = halves(b);
  return std::max(halved_bound(a_left, b_left, halvings - 1), halved_bound(a_right, b_right, halvings - 1));
}

}  // namespace

BezierPoints part(const BezierPoints& points, double a, double b) {
  const Eigen::Index p = points.cols() - 1;
  BezierPoints result(4, p + 1);
  std::vector<double> arguments(p, a);
  for (Eigen::Index i = 0; i <= p; ++i) {
    if (i > 0) arguments[i - 1] = b;
    result.col(i) = blossom(points, arguments);
  }
  return result;
}

std::pair<BezierPoints, BezierPoints> halves(BezierPoints points) {
  BezierPoints left = points;
  for (Eigen::Index r = 1; r < points.cols(); ++r) {
    for (Eigen::Index j = 0; j + r < points.cols(); ++j)
      points.col(j) = 0.5 * (points.col(j) + points.col(j + 1));
    left.col(r) = points.col(0);
  }
  return {std::move(left), std::move(points)};
}

BezierPoints elevated(BezierPoints points, Eigen::Index degree) {
  for (Eigen::Index p = points.cols(); p <= degree; ++p) {
    BezierPoints higher(4, p + 1);
    higher << points, points.rightCols<1>();
    for (Eigen::Index i = 1; i < p; ++i)
      higher.col(i) = (double(i) * points.col(i - 1) + double(p - i) * points.col(i)) / double(p);
    points = std::move(higher);
  }
  return points;
}

double distance_bound(const BezierPoints& a, const BezierPoints& b, int halvings) {
  return halved_bound(a, b * (a(3, 0) / b(3, 0)), halvings);
}

}  // namespace nurbeam
