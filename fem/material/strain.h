#pragma once
#include <Eigen/Core>
#include <cmath>

#include "fem/material/curvature_measure.h"

namespace nurbeam {

/// A scalar strain measure at one material point with its gradient and Hessian in z = (r_s, r_ss).
template <int D>
struct StrainMeasure {
  double value;
  Eigen::Matrix<double, 2 * D, 1> gradient;
  Eigen::Matrix<double, 2 * D, 2 * D> hessian;
};

/// Green's axial strain (|r_s|^2 - 1)/2 [-].
template <int D>
StrainMeasure<D> axial_strain(const Eigen::Matrix<double, D, 1>& rs) {
  StrainMeasure<D> e;
  e.value = (rs.squaredNorm() - 1) / 2;
  e.gradient.setZero();
  e.gradient.template head<D>() = rs;
  e.hessian.setZero();
  e.hessian.template topLeftCorner<D, D>().setIdentity();
  return e;
}

namespace detail {

// c = r_s x r_ss (signed) in the plane.
inline StrainMeasure<2> cross_measure(const Eigen::Vector2d& rs, const Eigen::Vector2d& rss) {
  StrainMeasure<2> c;
  c.value = rs.x() * rss.y() - rs.y() * rss.x();
  c.gradient << rss.y(), -rss.x(), -rs.y(), rs.x();
  c.hessian.setZero();
  c.hessian(0, 3) = c.hessian(3, 0) = 1;
  c.hessian(1, 2) = c.hessian(2, 1) = -1;
  return c;
}

// B = |r_s x r_ss|^2 in space.
inline StrainMeasure<3> cross_measure(const Eigen::Vector3d& rs, const Eigen::Vector3d& rss) {
  const double A = rs.squaredNorm(), G = rss.squaredNorm(), F = rs.dot(rss);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  StrainMeasure<3> B;
  B.value = A * G - F * F;
  B.gradient.head<3>() = 2 * (G * rs - F * rss);
  B.gradient.tail<3>() = 2 * (A * rss - F * rs);
  B.hessian.topLeftCorner<3, 3>() = 2 * (G * I - rss * rss.transpose());
  B.hessian.bottomRightCorner<3, 3>() = 2 * (A * I - rs * rs.transpose());
  const Eigen::Matrix3d mixed = 4 * rs * rss.transpose() - 2 * rss * rs.transpose() - 2 * F * I;
  B.hessian.topRightCorner<3, 3>() = mixed;
  B.hessian.bottomLeftCorner<3, 3>() = mixed.transpose();
  return B;
}

// c A^-m with A = |r_s|^2.
template <int D>
StrainMeasure<D> scaled_by_stretch(const StrainMeasure<D>& c, const Eigen::Matrix<double, D, 1>& rs,
                                   double m) {
  const double A = rs.squaredNorm(), p = std::pow(A, -m);
  Eigen::Matrix<double, 2 * D, 1> a = Eigen::Matrix<double, 2 * D, 1>::Zero();
  a.template head<D>() = 2 * rs;
  StrainMeasure<D> k;
  k.value = p * c.value;
  k.gradient = p * c.gradient - (m * k.value / A) * a;
  k.hessian = p * c.hessian - (m * p / A) * (c.gradient * a.transpose() + a * c.gradient.transpose()) +
              (m * (m + 1) * k.value / (A * A)) * a * a.transpose();
  k.hessian.template topLeftCorner<D, D>().diagonal().array() -= 2 * m * k.value / A;
  return k;
}

}  // namespace detail

/// Curvature in space is rounded near zero, sqrt(K^2 + curvature_rounding^2) [1/m], so that K = 0 is no
/// singular point: with kappa_0 = 0 forces are those of EI K^2/2 exactly, and the energy differs by a
/// constant.
inline constexpr double curvature_rounding = 1e-4;

/// Signed curvature of a planar axis [1/m]; undefined at r_s = 0.
inline StrainMeasure<2> curvature(const Eigen::Vector2d& rs, const Eigen::Vector2d& rss,
                                  CurvatureMeasure measure) {
  return detail::scaled_by_stretch<2>(detail::cross_measure(rs, rss), rs,
                                      measure == CurvatureMeasure::material ? 1.0 : 1.5);
}

/// Rounded curvature of a spatial axis [1/m]; undefined at r_s = 0.
inline StrainMeasure<3> curvature(const Eigen::Vector3d& rs, const Eigen::Vector3d& rss,
                                  CurvatureMeasure measure) {
  const StrainMeasure<3> square = detail::scaled_by_stretch<3>(
      detail::cross_measure(rs, rss), rs, measure == CurvatureMeasure::material ? 2.0 : 3.0);
  StrainMeasure<3> k;
  k.value = std::sqrt(square.value + curvature_rounding * curvature_rounding);
  k.gradient = square.gradient / (2 * k.value);
  k.hessian = (square.hessian / 2 - k.gradient * k.gradient.transpose()) / k.value;
  return k;
}

}  // namespace nurbeam
