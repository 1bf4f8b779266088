#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>

#include "fem/element/layout.h"
#include "fem/element/quadrature.h"
#include "fem/material/strain.h"

namespace nurbeam {

/// One number at each Gauss point of a part of an element, side by side; a last lane makes their count even,
/// as the processor likes it.
using Lanes = Eigen::Array<double, GaussRule::size + GaussRule::size % 2, 1>;

/// The Gauss points of a part of an element whose ends are fixed: first and second derivatives of the shape
/// functions, weights [m], curvature of the stress-free shape [1/m] and strain of its label. Lanes beyond the
/// points repeat the last one without weight.
struct PointPack {
  static constexpr int points = GaussRule::size, lanes = Lanes::SizeAtCompileTime;

  std::array<Lanes, 4> S1, S2;
  Lanes weight, kappa0, eps0;

  /// S1 and S2 at one point.
  std::pair<Eigen::Vector4d, Eigen::Vector4d> derivatives(int point) const {
    Eigen::Vector4d first, second;
    for (int k = 0; k < 4; ++k) {
      first[k] = S1[k][point];
      second[k] = S2[k][point];
    }
    return {first, second};
  }
};

/// A vector at each Gauss point.
template <int D>
using VectorLanes = std::array<Lanes, D>;

template <int D>
Lanes dot(const VectorLanes<D>& a, const VectorLanes<D>& b) {
  Lanes sum = a[0] * b[0];
  for (int d = 1; d < D; ++d) sum += a[d] * b[d];
  return sum;
}

/// sum_k e_k S_k.
template <int D>
VectorLanes<D> combination(const ElementNodes<D>& e, const std::array<Lanes, 4>& S) {
  VectorLanes<D> sum;
  for (int d = 0; d < D; ++d) sum[d] = e(d, 0) * S[0] + e(d, 1) * S[1] + e(d, 2) * S[2] + e(d, 3) * S[3];
  return sum;
}

/// Curvature (strain.h) [1/m] and its gradients in r_s and r_ss.
template <int D>
struct CurvatureLanes {
  Lanes value;
  VectorLanes<D> by_rs, by_rss;

  CurvatureLanes(const VectorLanes<D>& rs, const VectorLanes<D>& rss, CurvatureMeasure measure) {
    const Lanes A = dot<D>(rs, rs);
    const bool material = measure == CurvatureMeasure::material;
    if constexpr (D == 2) {
      const double twice_m = material ? 2 : 3;
      const Lanes p = material ? Lanes(1 / A) : Lanes(1 / (A * A.sqrt()));
      value = p * (rs[0] * rss[1] - rs[1] * rss[0]);
      const Lanes along = twice_m * value / A;
      by_rs = {p * rss[1] - along * rs[0], -p * rss[0] - along * rs[1]};
      by_rss = {-p * rs[1], p * rs[0]};
    } else {
      const double m = material ? 2 : 3;
      const Lanes G = dot<D>(rss, rss), F = dot<D>(rs, rss);
      const Lanes p = material ? Lanes(1 / (A * A)) : Lanes(1 / (A * A * A));
      const Lanes square = p * (A * G - F * F).max(0.0);
      value = (square + curvature_rounding * curvature_rounding).sqrt();
      const Lanes q = p / value, along = m * square / (A * value);
      for (int d = 0; d < D; ++d) {
        by_rs[d] = q * (G * rs[d] - F * rss[d]) - along * rs[d];
        by_rss[d] = q * (A * rss[d] - F * rs[d]);
      }
    }
  }

  Lanes rate(const VectorLanes<D>& rs_rate, const VectorLanes<D>& rss_rate) const {
    return dot<D>(by_rs, rs_rate) + dot<D>(by_rss, rss_rate);
  }
};

}  // namespace nurbeam
