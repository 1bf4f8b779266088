#include "nurbs/nurbs_curve.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "nurbs/gauss_panels.h"
#include "nurbs/projection.h"

namespace nurbeam {
namespace {

/// Control points of the k-th derivative that act on one span, 4 x (degree + 1 - k), from those of the
/// (k-1)-th. knots: the 2 degree knots around the span, starting at index span - degree + 1.
Eigen::Matrix4Xd differentiated(const Eigen::Matrix4Xd& points, const double* knots, int degree, int k) {
  const int p = degree - k + 1;
  Eigen::Matrix4Xd result(4, p);
  for (int j = 0; j < p; ++j)
    result.col(j) = p * (points.col(j + 1) - points.col(j)) / (knots[j + degree] - knots[j + k - 1]);
  return result;
}

/// Blossom of the B-spline piece of degree p = arguments.size() at the arguments (de Boor). knots: the 2p
/// knots around the span, the span being [knots[p-1], knots[p]].
Eigen::Vector4d blossom(Eigen::Matrix4Xd points, const double* knots, const std::vector<double>& arguments) {
  const int p = static_cast<int>(arguments.size());
  for (int r = 1; r <= p; ++r)
    for (int j = p; j >= r; --j) {
      const double left = knots[j - 1], right = knots[j + p - r];
      const double a = (arguments[r - 1] - left) / (right - left);
      points.col(j) = (1 - a) * points.col(j - 1) + a * points.col(j);
    }
  return points.col(p);
}

}  // namespace

NurbsCurve::NurbsCurve(KnotVector knots, Eigen::Matrix4Xd control_points)
    : knots_(std::move(knots)), control_points_(std::move(control_points)) {
  constexpr double largest = 1e100;  // products of several are finite
  std::ostringstream message;
  message.precision(17);
  if (control_points_.cols() != knots_.control_point_count())
    message << "there are " << control_points_.cols() << " control points; the knots ask for "
            << knots_.control_point_count();
  else if (!control_points_.row(3).allFinite() || control_points_.row(3).minCoeff() <= 0)
    message << "the weights of a NURBS curve must be finite and positive: " << control_points_.row(3);
  else if (!control_points_.allFinite())
    message << "the control points of a NURBS curve must be finite:\n" << control_points_;
  else if (control_points_.cwiseAbs().maxCoeff() > largest)
    message << "the control points of a NURBS curve must be at most " << largest
            << ", so that lengths are numbers:\n"
            << control_points_;
  else
    return;
  throw std::invalid_argument(message.str());
}

bool NurbsCurve::is_rational() const {
  const double largest = control_points_.row(3).maxCoeff();
  return largest - control_points_.row(3).minCoeff() > 1e-14 * largest;
}

Eigen::Vector3d NurbsCurve::point(double u) const { return derivatives(u, 0); }

Eigen::Matrix3Xd NurbsCurve::derivatives(double u, int n) const {
  const int p = degree();
  const int span = knots_.find_span(u);
  const double* knots = knots_.knots().data() + span - p + 1;
  Eigen::Matrix4Xd points = control_points_.middleCols(span - p, p + 1);
  // Measured from a control point, so that a curve far from the origin keeps its digits.
  const Eigen::Vector3d origin = points.col(0).head<3>() / points(3, 0);
  points.topRows<3>() -= (origin * points.row(3)).eval();
  Eigen::Matrix4Xd homogeneous = Eigen::Matrix4Xd::Zero(4, n + 1);
  for (int k = 0; k <= std::min(n, p); ++k) {
    if (k > 0) points = differentiated(points, knots, p, k);
    homogeneous.col(k) = blossom(points, knots + k, std::vector<double>(p - k, u));
  }
  Eigen::Matrix3Xd result = projected_derivatives(homogeneous);
  result.col(0) += origin;
  return result;
}

Eigen::Matrix4Xd NurbsCurve::bezier_points(int span) const {
  const int p = degree();
  const double* knots = knots_.knots().data() + span - p + 1;
  const Eigen::Matrix4Xd points = control_points_.middleCols(span - p, p + 1);
  Eigen::Matrix4Xd bezier(4, p + 1);
  std::vector<double> arguments(p, knots[p - 1]);
  for (int i = 0; i <= p; ++i) {
    if (i > 0) arguments[p - i] = knots[p];
    bezier.col(i) = blossom(points, knots, arguments);
  }
  return bezier;
}

NurbsCurve NurbsCurve::reversed() const {
  const double sum = knots_.start() + knots_.end();
  std::vector<double> mirrored(knots_.knots().rbegin(), knots_.knots().rend());
  for (double& u : mirrored) u = sum - u;
  return {KnotVector(degree(), std::move(mirrored)), control_points_.rowwise().reverse()};
}

NurbsCurve make_nurbs_curve(KnotVector knots, const Eigen::Matrix3Xd& points,
                            const Eigen::VectorXd& weights) {
  if (points.cols() != weights.size()) {
    std::ostringstream message;
    message << "there are " << points.cols() << " control points and " << weights.size()
            << " weights; each point needs one weight";
    throw std::invalid_argument(message.str());
  }
  Eigen::Matrix4Xd homogeneous(4, points.cols());
  homogeneous << points * weights.asDiagonal(), weights.transpose();
  return {std::move(knots), std::move(homogeneous)};
}

bool is_closed(const NurbsCurve& curve, double tolerance) {
  return (curve.point(curve.knots().start()) - curve.point(curve.knots().end())).norm() <= tolerance;
}

double length(const NurbsCurve& curve) {
  const auto speed = [&curve](double u) { return curve.derivatives(u, 1).col(1).norm(); };
  const std::vector<double> breaks = curve.knots().breaks();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
    sum += panels_of(speed, breaks[i], breaks[i + 1]).integrals.back();
  return sum;
}

}  // namespace nurbeam
