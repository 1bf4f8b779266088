#pragma once
#include <array>

#include "fem/material/curvature_measure.h"
#include "fem/material/numbers.h"

/// The strains of the axis at a point as functions of z = (r_s, r_ss), with their derivatives. Numbers are of
/// the kinds of fem/material/numbers.h.
namespace nurbeam {

template <int D, class T>
using Components = std::array<T, D>;
/// A symmetric matrix in z, by rows.
template <int D, class T>
using PairMatrix = std::array<std::array<T, 2 * D>, 2 * D>;

/// Curvature in space is rounded near zero, sqrt(K^2 + curvature_rounding^2) [1/m], so that K = 0 is no
/// singular point. With kappa_0 = 0 forces are exactly those of EI K^2/2, and the energy differs by a
/// constant. Where K is far below the rounding, damping sees no rate of it. The rounding is as small as the
/// round-off of r_ss along r_s allows.
inline constexpr double curvature_rounding = 1e-6;

/// Green's axial strain (|r_s|^2 - 1)/2 [-]; its gradient is r_s.
template <int D, class T>
NURBEAM_WITHIN T green_strain(const std::array<T, D>& rs) {
  return (dot(rs, rs) - 1.) / 2.;
}

/// Signed curvature of a planar axis, rounded curvature of a spatial one [1/m], and its gradients; undefined
/// at r_s = 0. `material`: CurvatureMeasure::material.
template <int D, class T>
struct Curvature {
  T value;
  Components<D, T> by_rs, by_rss;

  NURBEAM_WITHIN Curvature(const Components<D, T>& rs, const Components<D, T>& rss, bool material) {
    const T A = dot(rs, rs), i = 1. / A;
    if constexpr (D == 2) {
      const double twice_m = material ? 2 : 3;
      const T p = material ? i : T(i * square_root(i));
      value = p * (rs[0] * rss[1] - rs[1] * rss[0]);
      const T along = twice_m * value * i;
      by_rs = {p * rss[1] - along * rs[0], -p * rss[0] - along * rs[1]};
      by_rss = {-p * rs[1], p * rs[0]};
    } else {
      const double m = material ? 2 : 3;
      const T G = dot(rss, rss), F = dot(rs, rss);
      const T p = material ? T(i * i) : T(i * i * i);
      const T square = p * positive(T(A * G - F * F));
      value = square_root(T(square + curvature_rounding * curvature_rounding));
      const T q = p / value, along = m * i * square / value;
      for (int d = 0; d < D; ++d) {
        by_rs[d] = q * (G * rs[d] - F * rss[d]) - along * rs[d];
        by_rss[d] = q * (A * rss[d] - F * rs[d]);
      }
    }
  }

  NURBEAM_WITHIN T rate(const Components<D, T>& rs_rate, const Components<D, T>& rss_rate) const {
    return dot(by_rs, rs_rate) + dot(by_rss, rss_rate);
  }
};

/// The curvature with its first and second derivatives in z.
template <int D, class T>
struct CurvatureDerivatives {
  T value;
  std::array<T, 2 * D> gradient;
  PairMatrix<D, T> hessian;

  NURBEAM_WITHIN CurvatureDerivatives(const Components<D, T>& rs, const Components<D, T>& rss,
                                      bool material) {
    const T A = dot(rs, rs);
    for (auto& row : hessian) row.fill(zero<T>());
    if constexpr (D == 2) {
      value = rs[0] * rss[1] - rs[1] * rss[0];
      gradient = {rss[1], -rss[0], -rs[1], rs[0]};
      hessian[0][3] = hessian[3][0] = zero<T>() + 1.;
      hessian[1][2] = hessian[2][1] = zero<T>() - 1.;
      scale_by_stretch(rs, material ? 1 : 1.5, material ? T(1. / A) : T(1. / (A * square_root(A))));
    } else {
      take_square(rs, rss, A);
      scale_by_stretch(rs, material ? 2 : 3, material ? T(1. / (A * A)) : T(1. / (A * A * A)));
      take_root();
    }
  }

  /// K_zz x.
  NURBEAM_WITHIN std::array<T, 2 * D> product(const std::array<T, 2 * D>& x) const {
    std::array<T, 2 * D> product;
    for (int a = 0; a < 2 * D; ++a) product[a] = dot(hessian[a], x);
    return product;
  }

 private:
  // Sets the value to |r_s x r_ss|^2, with derivatives.
  NURBEAM_WITHIN void take_square(const Components<D, T>& rs, const Components<D, T>& rss, const T& A) {
    const T G = dot(rss, rss), F = dot(rs, rss);
    value = positive(T(A * G - F * F));
    for (int a = 0; a < D; ++a) {
      gradient[a] = 2. * (G * rs[a] - F * rss[a]);
      gradient[D + a] = 2. * (A * rss[a] - F * rs[a]);
      for (int b = 0; b < D; ++b) {
        hessian[a][b] = -2. * rss[a] * rss[b];
        hessian[D + a][D + b] = -2. * rs[a] * rs[b];
        hessian[a][D + b] = 4. * rs[a] * rss[b] - 2. * rss[a] * rs[b];
      }
      hessian[a][a] += 2. * G;
      hessian[D + a][D + a] += 2. * A;
      hessian[a][D + a] -= 2. * F;
    }
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) hessian[D + b][a] = hessian[a][D + b];
  }

  // Multiplies a number c by A^-m with A = |r_s|^2, with derivatives.
  NURBEAM_WITHIN void scale_by_stretch(const Components<D, T>& rs, double m, const T& p) {
    const T i = 1. / dot(rs, rs);
    value *= p;
    for (int a = 0; a < 2 * D; ++a) gradient[a] *= p;
    for (int a = 0; a < 2 * D; ++a)
      for (int b = 0; b < 2 * D; ++b) {
        hessian[a][b] *= p;
        if (a < D) hessian[a][b] -= 2 * m * i * gradient[b] * rs[a];
        if (b < D) hessian[a][b] -= 2 * m * i * gradient[a] * rs[b];
        if (a < D && b < D) hessian[a][b] += 4 * m * (m + 1) * value * i * i * rs[a] * rs[b];
      }
    for (int a = 0; a < D; ++a) {
      hessian[a][a] -= 2 * m * i * value;
      gradient[a] -= 2 * m * i * value * rs[a];
    }
  }

  // Takes the rounded square root, with derivatives.
  NURBEAM_WITHIN void take_root() {
    value = square_root(T(value + curvature_rounding * curvature_rounding));
    const T i = 1. / value;
    for (int a = 0; a < 2 * D; ++a) gradient[a] *= 0.5 * i;
    for (int a = 0; a < 2 * D; ++a)
      for (int b = 0; b < 2 * D; ++b) hessian[a][b] = (0.5 * hessian[a][b] - gradient[a] * gradient[b]) * i;
  }
};

}  // namespace nurbeam
