#pragma once
#include <array>

#include "fem/element/lane_arithmetic.h"
#include "fem/material/strain.h"

/// Curvature and energy of bending of eight elements at a point each.
namespace nurbeam {

// As CurvatureLanes has it.
template <int D>
struct Curvature {
  Lanes8 value;
  LaneVector<D> by_rs, by_rss;

  NURBEAM_WITHIN Curvature(const LaneVector<D>& rs, const LaneVector<D>& rss, bool material) {
    const Lanes8 A = dot<D>(rs, rs);
    if constexpr (D == 2) {
      const double twice_m = material ? 2 : 3;
      const Lanes8 i = 1 / A, p = material ? i : i * square_root(i);
      value = p * (rs[0] * rss[1] - rs[1] * rss[0]);
      const Lanes8 along = twice_m * value * i;
      by_rs = {p * rss[1] - along * rs[0], -p * rss[0] - along * rs[1]};
      by_rss = {-p * rs[1], p * rs[0]};
    } else {
      const double m = material ? 2 : 3;
      const Lanes8 G = dot<D>(rss, rss), F = dot<D>(rs, rss);
      const Lanes8 i = 1 / A, p = material ? i * i : i * i * i;
      const Lanes8 square = p * positive(A * G - F * F);
      value = square_root(square + curvature_rounding * curvature_rounding);
      const Lanes8 q = p / value, along = m * i * square / value;
      for (int d = 0; d < D; ++d) {
        by_rs[d] = q * (G * rs[d] - F * rss[d]) - along * rs[d];
        by_rss[d] = q * (A * rss[d] - F * rs[d]);
      }
    }
  }

  NURBEAM_WITHIN Lanes8 rate(const LaneVector<D>& rs_rate, const LaneVector<D>& rss_rate) const {
    return dot<D>(by_rs, rs_rate) + dot<D>(by_rss, rss_rate);
  }
};

// A symmetric matrix in z = (r_s, r_ss).
template <int D>
using PairMatrix = std::array<std::array<Lanes8, 2 * D>, 2 * D>;

// c A^-m with A = |r_s|^2, from c, c_z and c_zz, and its own derivatives in z.
template <int D>
NURBEAM_WITHIN void scale_by_stretch(const LaneVector<D>& rs, double m, const Lanes8& p, Lanes8& value,
                                     std::array<Lanes8, 2 * D>& gradient, PairMatrix<D>& hessian) {
  const Lanes8 i = 1 / dot<D>(rs, rs);
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

// d2/dz2 of EI (K - kappa_0)^2/2, times a factor: strain.h has the formulas.
template <int D>
NURBEAM_WITHIN PairMatrix<D> bending_hessian(const LaneVector<D>& rs, const LaneVector<D>& rss, bool material,
                                             double EI, const Lanes8& kappa0, const Lanes8& factor) {
  PairMatrix<D> H = {};
  std::array<Lanes8, 2 * D> gradient = {};
  Lanes8 value;
  const Lanes8 A = dot<D>(rs, rs);
  if constexpr (D == 2) {
    value = rs[0] * rss[1] - rs[1] * rss[0];
    gradient = {rss[1], -rss[0], -rs[1], rs[0]};
    H[0][3] = H[3][0] = Lanes8{} + 1.;
    H[1][2] = H[2][1] = Lanes8{} - 1.;
    const double m = material ? 1 : 1.5;
    scale_by_stretch<D>(rs, m, material ? 1 / A : 1 / (A * square_root(A)), value, gradient, H);
  } else {
    const Lanes8 G = dot<D>(rss, rss), F = dot<D>(rs, rss);
    value = positive(A * G - F * F);
    for (int a = 0; a < D; ++a) {
      gradient[a] = 2 * (G * rs[a] - F * rss[a]);
      gradient[D + a] = 2 * (A * rss[a] - F * rs[a]);
      for (int b = 0; b < D; ++b) {
        H[a][b] = -2 * rss[a] * rss[b];
        H[D + a][D + b] = -2 * rs[a] * rs[b];
        H[a][D + b] = 4 * rs[a] * rss[b] - 2 * rss[a] * rs[b];
      }
      H[a][a] += 2 * G;
      H[D + a][D + a] += 2 * A;
      H[a][D + a] -= 2 * F;
    }
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) H[D + b][a] = H[a][D + b];
    scale_by_stretch<D>(rs, material ? 2 : 3, material ? 1 / (A * A) : 1 / (A * A * A), value, gradient, H);
    value = square_root(value + curvature_rounding * curvature_rounding);
    const Lanes8 i = 1 / value;
    for (int a = 0; a < 2 * D; ++a) gradient[a] *= 0.5 * i;
    for (int a = 0; a < 2 * D; ++a)
      for (int b = 0; b < 2 * D; ++b) H[a][b] = (0.5 * H[a][b] - gradient[a] * gradient[b]) * i;
  }
  const Lanes8 stiffness = EI * factor, moment = stiffness * (value - kappa0);
  for (int a = 0; a < 2 * D; ++a)
    for (int b = 0; b < 2 * D; ++b) H[a][b] = stiffness * gradient[a] * gradient[b] + moment * H[a][b];
  return H;
}

}  // namespace nurbeam
