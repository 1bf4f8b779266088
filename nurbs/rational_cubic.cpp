#include "nurbs/rational_cubic.h"

#include <cassert>
#include <sstream>
#include <stdexcept>

#include "nurbs/bernstein.h"
#include "nurbs/projection.h"

namespace nurbeam {
namespace {

using Points = Eigen::Matrix4d;

/// Value and derivatives 0..3 of the cubic with the given Bezier points: column k is the k-th derivative.
Points cubic_derivatives(const Points& points, double u) {
  const double v = 1 - u;
  const Eigen::Matrix<double, 4, 3> first = 3 * (points.rightCols<3>() - points.leftCols<3>());
  const Eigen::Matrix<double, 4, 2> second = 2 * (first.rightCols<2>() - first.leftCols<2>());
  Points derivatives;
  derivatives.col(0) = points * cubic_bernstein(u);
  derivatives.col(1) = first * Eigen::Vector3d(v * v, 2 * u * v, u * u);
  derivatives.col(2) = second * Eigen::Vector2d(v, u);
  derivatives.col(3) = second.col(1) - second.col(0);
  return derivatives;
}

}  // namespace

RationalCubic::RationalCubic(const Eigen::Matrix4d& points) : points_(points) {
  const bool finite = points.allFinite();
  if (finite && points.row(3).minCoeff() > 0) return;
  std::ostringstream message;
  message.precision(17);
  if (!finite)
    message << "the control points of a rational cubic must be finite:\n" << points;
  else
    message << "the weights of a rational cubic must be positive: " << points.row(3);
  throw std::invalid_argument(message.str());
}

Eigen::Vector3d RationalCubic::control_point(int i) const { return points_.col(i).head<3>() / weight(i); }

Eigen::Vector3d RationalCubic::point(double u) const {
  const Eigen::Vector4d h = points_ * cubic_bernstein(u);
  return h.head<3>() / h(3);
}

Eigen::Matrix<double, 3, 6> RationalCubic::derivatives(double u) const {
  // Measured from the first control point, so that a curve far from the origin keeps its digits.
  const Eigen::Vector3d origin = control_point(0);
  Points local = points_;
  local.topRows<3>() -= origin * points_.row(3);
  Eigen::Matrix<double, 4, 6> homogeneous = Eigen::Matrix<double, 4, 6>::Zero();
  homogeneous.leftCols<4>() = cubic_derivatives(local, u);
  Eigen::Matrix<double, 3, 6> derivatives = projected_derivatives(homogeneous);
  derivatives.col(0) += origin;
  return derivatives;
}

RationalCubic::WeightedDerivatives RationalCubic::weighted_derivatives(double u) const {
  // As derivatives() does it, to the last bit.
  const Eigen::Vector3d origin = control_point(0);
  Points local = points_;
  local.topRows<3>() -= origin * points_.row(3);
  const Points A = cubic_derivatives(local, u);
  const double W = A(3, 0), W1 = A(3, 1), W2 = A(3, 2), W3 = A(3, 3);
  const Eigen::Vector3d r0 = A.col(0).head<3>() / W, r1 = (A.col(1).head<3>() - W1 * r0) / W,
                        r2 = (A.col(2).head<3>() - 2 * W1 * r1 - W2 * r0) / W,
                        r3 = (A.col(3).head<3>() - 3 * W1 * r2 - 3 * W2 * r1 - W3 * r0) / W,
                        r4 = -(4 * W1 * r3 + 6 * W2 * r2 + 4 * W3 * r1) / W;
  return {{r1, r2, r3, r4}, {W, W1, W2, W3}};
}

Eigen::Matrix<double, 3, 5> RationalCubic::hodograph() const {
  const auto leg = [this](int i, int j) -> Eigen::Vector3d {
    return weight(i) * weight(j) * (control_point(j) - control_point(i));
  };
  Eigen::Matrix<double, 3, 5> coefficients;
  coefficients << 3 * leg(0, 1), 1.5 * leg(0, 2), 0.5 * leg(0, 3) + 1.5 * leg(1, 2), 1.5 * leg(1, 3),
      3 * leg(2, 3);
  return coefficients;
}

std::pair<RationalCubic, RationalCubic> RationalCubic::split(double u) const {
  return {piece(0, u), piece(u, 1)};
}

RationalCubic RationalCubic::piece(double u0, double u1) const {
  assert(0 <= u0 && u0 < u1 && u1 <= 1);
  const auto at = [this](double a, double b, double c) { return blossom(points_, std::array{a, b, c}); };
  Points points;
  points << at(u0, u0, u0), at(u0, u0, u1), at(u0, u1, u1), at(u1, u1, u1);
  return RationalCubic(points);
}

RationalCubic RationalCubic::reversed() const { return RationalCubic(points_.rowwise().reverse()); }

}  // namespace nurbeam
