#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "fem/material/curvature_measure.h"

namespace nurbeam {

/// A scalar strain measure at one material point with its gradient in z = (r_s, r_ss).
template <int D>
struct StrainGradient {
  double value;
  Eigen::Matrix<double, 2 * D, 1> gradient;
};

/// The same with its Hessian.
template <int D>
struct StrainMeasure : StrainGradient<D> {
  Eigen::Matrix<double, 2 * D, 2 * D> hessian;
};

/// How many derivatives of a strain are wanted: forces need one, tangents two.
enum class Derivatives { one, two };
template <int D, Derivatives wanted>
using Strain = std::conditional_t<wanted == Derivatives::one, StrainGradient<D>, StrainMeasure<D>>;

/// Green's axial strain (|r_s|^2 - 1)/2 [-].
template <int D, Derivatives wanted = Derivatives::two>
Strain<D, wanted> axial_strain(const Eigen::Matrix<double, D, 1>& rs) {
  Strain<D, wanted> e;
  e.value = (rs.squaredNorm() - 1) / 2;
  e.gradient.setZero();
  e.gradient.template head<D>() = rs;
  if constexpr (wanted == Derivatives::two) {
    e.hessian.setZero();
    e.hessian.template topLeftCorner<D, D>().setIdentity();
  }
  return e;
}

namespace detail {

// c = r_s x r_ss (signed) in the plane; B = |r_s x r_ss|^2 in space.
template <int D, Derivatives wanted>
Strain<D, wanted> cross_measure(const Eigen::Matrix<double, D, 1>& rs,
                                const Eigen::Matrix<double, D, 1>& rss) {
  Strain<D, wanted> c;
  if constexpr (D == 2) {
    c.value = rs.x() * rss.y() - rs.y() * rss.x();
    c.gradient << rss.y(), -rss.x(), -rs.y(), rs.x();
    if constexpr (wanted == Derivatives::two) {
      c.hessian.setZero();
      c.hessian(0, 3) = c.hessian(3, 0) = 1;
      c.hessian(1, 2) = c.hessian(2, 1) = -1;
    }
  } else {
    const double A = rs.squaredNorm(), G = rss.squaredNorm(), F = rs.dot(rss);
    c.value = std::max(0.0, A * G - F * F);
    c.gradient.template head<D>() = 2 * (G * rs - F * rss);
    c.gradient.template tail<D>() = 2 * (A * rss - F * rs);
    if constexpr (wanted == Derivatives::two) {
      const Eigen::Matrix<double, D, D> I = Eigen::Matrix<double, D, D>::Identity();
      c.hessian.template topLeftCorner<D, D>() = 2 * (G * I - rss * rss.transpose());
      c.hessian.template bottomRightCorner<D, D>() = 2 * (A * I - rs * rs.transpose());
      const Eigen::Matrix<double, D, D> mixed =
          4 * rs * rss.transpose() - 2 * rss * rs.transpose() - 2 * F * I;
      c.hessian.template topRightCorner<D, D>() = mixed;
      c.hessian.template bottomLeftCorner<D, D>() = mixed.transpose();
    }
  }
  return c;
}

// c A^-m with A = |r_s|^2, for 2 m = 2, 3, 4 or 6.
template <int D, Derivatives wanted>
Strain<D, wanted> scaled_by_stretch(const Strain<D, wanted>& c, const Eigen::Matrix<double, D, 1>& rs,
                                    int twice_m) {
  const double A = rs.squaredNorm(), m = twice_m / 2.0;
  double p = twice_m == 3 ? 1 / (A * std::sqrt(A)) : 1 / A;
  if (twice_m > 3) p = twice_m == 4 ? p * p : p * p * p;
  Eigen::Matrix<double, 2 * D, 1> a = Eigen::Matrix<double, 2 * D, 1>::Zero();
  a.template head<D>() = 2 * rs;
  Strain<D, wanted> k;
  k.value = p * c.value;
  k.gradient = p * c.gradient - (m * k.value / A) * a;
  if constexpr (wanted == Derivatives::two) {
    k.hessian = p * c.hessian - (m * p / A) * (c.gradient * a.transpose() + a * c.gradient.transpose()) +
                (m * (m + 1) * k.value / (A * A)) * a * a.transpose();
    k.hessian.template topLeftCorner<D, D>().diagonal().array() -= 2 * m * k.value / A;
  }
  return k;
}

}  // namespace detail

/// Curvature in space is rounded near zero, sqrt(K^2 + curvature_rounding^2) [1/m], so that K = 0 is no
/// singular point: with kappa_0 = 0 forces are those of EI K^2/2 exactly, and the energy differs by a
/// constant. Damping sees none of a rate where K is far below it: it is as small as the round-off of r_ss
/// along r_s lets it be.
inline constexpr double curvature_rounding = 1e-6;

/// Signed curvature of a planar axis, rounded curvature of a spatial one [1/m]; undefined at r_s = 0.
template <int D, Derivatives wanted = Derivatives::two>
Strain<D, wanted> curvature(const Eigen::Matrix<double, D, 1>& rs, const Eigen::Matrix<double, D, 1>& rss,
                            CurvatureMeasure measure) {
  const bool material = measure == CurvatureMeasure::material;
  const Strain<D, wanted> cross = detail::cross_measure<D, wanted>(rs, rss);
  if constexpr (D == 2) {
    return detail::scaled_by_stretch<D, wanted>(cross, rs, material ? 2 : 3);
  } else {
    const Strain<D, wanted> square = detail::scaled_by_stretch<D, wanted>(cross, rs, material ? 4 : 6);
    Strain<D, wanted> k;
    k.value = std::sqrt(square.value + curvature_rounding * curvature_rounding);
    k.gradient = square.gradient / (2 * k.value);
    if constexpr (wanted == Derivatives::two)
      k.hessian = (square.hessian / 2 - k.gradient * k.gradient.transpose()) / k.value;
    return k;
  }
}

}  // namespace nurbeam
