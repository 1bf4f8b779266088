#include "nurbs/interpolated_cubic.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

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

/// Equations for the slopes at the parameters, each of a slope and its neighbours.
struct SlopeEquations {
  std::vector<double> below, diagonal, above;
  Eigen::Matrix3Xd loads;

  explicit SlopeEquations(std::size_t count)
      : below(count, 0.0), diagonal(count, 1.0), above(count, 0.0), loads(3, count) {}

  /// The second derivative is continuous between an interval of length a and one of length b.
  void join(int i, double a, double b, const Eigen::Vector3d& step_a, const Eigen::Vector3d& step_b) {
    below[i] = b;
    diagonal[i] = 2 * (a + b);
    above[i] = a;
    loads.col(i) = 3 * (a / b * step_b + b / a * step_a);
  }
};

/// By elimination along the spline.
Eigen::Matrix3Xd solved(SlopeEquations e) {
  const int n = static_cast<int>(e.diagonal.size());
  for (int i = 1; i < n; ++i) {
    const double factor = e.below[i] / e.diagonal[i - 1];
    e.diagonal[i] -= factor * e.above[i - 1];
    e.loads.col(i) -= factor * e.loads.col(i - 1);
  }
  e.loads.col(n - 1) /= e.diagonal[n - 1];
  for (int i = n - 2; i >= 0; --i)
    e.loads.col(i) = (e.loads.col(i) - e.above[i] * e.loads.col(i + 1)) / e.diagonal[i];
  return e.loads;
}

SlopeEquations inner_equations(const std::vector<double>& t, const Eigen::Matrix3Xd& points) {
  SlopeEquations equations(t.size());
  for (int i = 1; i + 1 < points.cols(); ++i)
    equations.join(i, t[i] - t[i - 1], t[i + 1] - t[i], points.col(i) - points.col(i - 1),
                   points.col(i + 1) - points.col(i));
  return equations;
}

Eigen::Matrix3Xd open_slopes(const std::vector<double>& t, const Eigen::Matrix3Xd& points,
                             const EndSlopes& ends) {
  SlopeEquations equations = inner_equations(t, points);
  const int last = static_cast<int>(points.cols()) - 1;
  const auto end = [&](int at, const std::optional<Eigen::Vector3d>& slope, double& beside, int from) {
    if (slope) {
      equations.loads.col(at) = *slope;
      return;
    }
    equations.diagonal[at] = 2;  // no second derivative
    beside = 1;
    equations.loads.col(at) = 3 * (points.col(from + 1) - points.col(from)) / (t[from + 1] - t[from]);
  };
  end(0, ends.start, equations.above[0], 0);
  end(last, ends.end, equations.below[last], last - 1);
  return solved(std::move(equations));
}

/// Those of a closed spline, whose last point is the first: what ties the first slope to the last but one,
/// outside the three diagonals, by the formula of Sherman and Morrison.
Eigen::Matrix3Xd closed_slopes(const std::vector<double>& t, const Eigen::Matrix3Xd& points) {
  const int count = static_cast<int>(points.cols()) - 1;
  SlopeEquations equations(count);
  for (int i = 0; i < count; ++i) {
    const int before = i > 0 ? i - 1 : count - 1;
    equations.join(i, t[before + 1] - t[before], t[i + 1] - t[i], points.col(before + 1) - points.col(before),
                   points.col(i + 1) - points.col(i));
  }
  const double right = equations.below[0], left = equations.above[count - 1];
  SlopeEquations update = equations;
  const double gamma = -equations.diagonal[0];
  equations.diagonal[0] -= gamma;
  equations.diagonal[count - 1] -= left * right / gamma;
  update.diagonal = equations.diagonal;
  update.loads.setZero();
  update.loads.col(0).setConstant(gamma);
  update.loads.col(count - 1).setConstant(left);
  const Eigen::Matrix3Xd y = solved(std::move(equations)), z = solved(std::move(update));
  const auto along = [&](const Eigen::Matrix3Xd& x) {
    return Eigen::Vector3d(x.col(0) + right / gamma * x.col(count - 1));
  };
  Eigen::Matrix3Xd slopes(3, count + 1);
  slopes.leftCols(count) = y - (along(y).array() / (1 + along(z).array())).matrix().asDiagonal() * z;
  slopes.col(count) = slopes.col(0);
  return slopes;
}

void check(const std::vector<double>& t, const Eigen::Matrix3Xd& points, int least) {
  const int n = static_cast<int>(points.cols());
  if (n >= least && n == static_cast<int>(t.size()) &&
      std::adjacent_find(t.begin(), t.end(), [](double a, double b) { return !(a < b); }) == t.end())
    return;
  throw std::invalid_argument("interpolation needs at least " + std::to_string(least) +
                              " points at increasing parameters, got " + std::to_string(n) + " points and " +
                              std::to_string(t.size()) + " parameters");
}

NurbsCurve hermite_spline(const std::vector<double>& t, const Eigen::Matrix3Xd& points,
                          const Eigen::Matrix3Xd& slopes) {
  const int n = static_cast<int>(points.cols());
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

}  // namespace

NurbsCurve interpolated_cubic(const std::vector<double>& t, const Eigen::Matrix3Xd& points) {
  check(t, points, 2);
  const int n = static_cast<int>(points.cols()), count = std::min(n, 4);
  return interpolated_cubic(
      t, points,
      {polynomial_slope(t, points, 0, count, 0), polynomial_slope(t, points, n - count, count, n - 1)});
}

NurbsCurve interpolated_cubic(const std::vector<double>& t, const Eigen::Matrix3Xd& points,
                              const EndSlopes& ends) {
  check(t, points, 2);
  return hermite_spline(t, points, open_slopes(t, points, ends));
}

NurbsCurve closed_interpolated_cubic(const std::vector<double>& t, const Eigen::Matrix3Xd& points) {
  check(t, points, 4);
  return hermite_spline(t, points, closed_slopes(t, points));
}

}  // namespace nurbeam
