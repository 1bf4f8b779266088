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

// c = r_s x r_ss (signed) in the plane; B = |r_s x r_ss|^2 in space.
template <int D>
StrainMeasure<D> cross_measure(const Eigen::Matrix<double, D, 1>& rs,
                               const Eigen::Matrix<double, D, 1>& rss) {
  StrainMeasure<D> c;
  if constexpr (D == 2) {
    c.value = rs.x() * rss.y() - rs.y() * rss.x();
    c.gradient << rss.y(), -rss.x(), -rs.y(), rs.x();
    c.hessian.setZero();
    c.hessian(0, 3) = c.hessian(3, 0) = 1;
    c.hessian(1, 2) = c.hessian(2, 1) = -1;
  } else {
    const double A = rs.squaredNorm(), G = rss.squaredNorm(), F = rs.dot(rss);
    const Eigen::Matrix<double, D, D> I = Eigen::Matrix<double, D, D>::Identity();
    c.value = A * G - F * F;
    c.gradient.template head<D>() = 2 * (G * rs - F * rss);
    c.gradient.template tail<D>() = 2 * (A * rss - F * rs);
    c.hessian.template topLeftCorner<D, D>() = 2 * (G * I - rss * rss.transpose());
    c.hessian.template bottomRightCorner<D, D>() = 2 * (A * I - rs * rs.transpose());
    const Eigen::Matrix<double, D, D> mixed = 4 * rs * rss.transpose() - 2 * rss * rs.transpose() - 2 * F * I;
    c.hessian.template topRightCorner<D, D>() = mixed;
    c.hessian.template bottomLeftCorner<D, D>() = mixed.transpose();
  }
  return c;
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

/// Signed curvature of a planar axis, rounded curvature of a spatial one [1/m]; undefined at r_s = 0.
template <int D>
StrainMeasure<D> curvature(const Eigen::Matrix<double, D, 1>& rs, const Eigen::Matrix<double, D, 1>& rss,
                           CurvatureMeasure measure) {
  const bool material = measure == CurvatureMeasure::material;
  const StrainMeasure<D> cross = detail::cross_measure<D>(rs, rss);
  if constexpr (D == 2) {
    return detail::scaled_by_stretch<D>(cross, rs, material ? 1.0 : 1.5);
  } else {
    const StrainMeasure<D> square = detail::scaled_by_stretch<D>(cross, rs, material ? 2.0 : 3.0);
    StrainMeasure<D> k;
    k.value = std::sqrt(square.value + curvature_rounding * curvature_rounding);
    k.gradient = square.gradient / (2 * k.value);
    k.hessian = (square.hessian / 2 - k.gradient * k.gradient.transpose()) / k.value;
    return k;
  }
}

}  // namespace nurbeam
