#include "nurbs/interpolated_cubic.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace nurbeam {
namespace {

// The slope at parameters[at] of the polynomial through points first, ..., first + count - 1.
Eigen::Vector3d polynomial_slope(const std::vector<double>& t, const Eigen::Matrix3Xd& points, int first,
                                 int count, int at) {
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  for (int i = first; i < first + count; ++i) {
    double weight = 0;  // of point i: the derivative of its Lagrange polynomial
    for (int k = first; k < first + count; ++k) {
      if (k == i) continue;
      double product = 1 / (t[i] - t[k]);
      for (int m = first; m < first + count; ++m)
        if (m != i && m != k) product *= (t[at] - t[m]) / (t[i] - t[m]);
      weight += product;
    }
    slope += weight * points.col(i);
  }
  return slope;
}

// The slopes that make the second derivative continuous, by elimination along the spline.
Eigen::Matrix3Xd slopes_of(const std::vector<double>& t, const Eigen::Matrix3Xd& points) {
  const int n = static_cast<int>(points.cols()), count = std::min(n, 4);
  Eigen::Matrix3Xd slopes(3, n);
  std::vector<double> diagonal(n, 1.0), above(n, 0.0);
  slopes.col(0) = polynomial_slope(t, points, 0, count, 0);
  slopes.col(n - 1) = polynomial_slope(t, points, n - count, count, n - 1);
  for (int i = 1; i + 1 < n; ++i) {
    const double a = t[i] - t[i - 1], b = t[i + 1] - t[i];
    const Eigen::Vector3d load =
        3 * (a / b * (points.col(i + 1) - points.col(i)) + b / a * (points.col(i) - points.col(i - 1)));
    const double factor = b / diagonal[i - 1];
    diagonal[i] = 2 * (a + b) - factor * above[i - 1];
    above[i] = a;
    slopes.col(i) = load - factor * slopes.col(i - 1);
  }
  for (int i = n - 2; i > 0; --i)
    slopes.col(i) = (slopes.col(i) - above[i] * slopes.col(i + 1)) / diagonal[i];
  return slopes;
}

}  // namespace

NurbsCurve interpolated_cubic(const std::vector<double>& t, const Eigen::Matrix3Xd& points) {
  const int n = static_cast<int>(points.cols());
  if (n < 2 || n != static_cast<int>(t.size()) ||
      std::adjacent_find(t.begin(), t.end(), [](double a, double b) { return !(a < b); }) != t.end())
    throw std::invalid_argument("interpolation needs at least two points at increasing parameters, got " +
                                std::to_string(n) + " points and " + std::to_string(t.size()) +
                                " parameters");
  const Eigen::Matrix3Xd slopes = slopes_of(t, points);
  std::vector<double> knots(4, t.front());
  knots.insert(knots.end(), t.begin() + 1, t.end() - 1);
  knots.insert(knots.end(), 4, t.back());
  Eigen::Matrix3Xd poles(3, n + 2);
  poles.col(0) = points.col(0);
  poles.col(1) = points.col(0) + (t[1] - t[0]) / 3 * slopes.col(0);
  for (int i = 1; i + 1 < n; ++i) {
    // Between the inner Bezier points of the piece after t_i, extended to t_(i-1).
    const double h = t[i + 1] - t[i], back = (t[i - 1] - t[i]) / h;
    const Eigen::Vector3d b1 = points.col(i) + h / 3 * slopes.col(i),
                          b2 = points.col(i + 1) - h / 3 * slopes.col(i + 1);
    poles.col(i + 1) = (1 - back) * b1 + back * b2;
  }
  poles.col(n) = points.col(n - 1) - (t[n - 1] - t[n - 2]) / 3 * slopes.col(n - 1);
  poles.col(n + 1) = points.col(n - 1);
  return make_nurbs_curve(KnotVector(3, std::move(knots)), poles, Eigen::VectorXd::Ones(n + 2));
}

}  // namespace nurbeam
