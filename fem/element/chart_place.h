#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/jet.h"
#include "fem/element/reference_curve.h"

namespace nurbeam {

/// The drawn curve at one place, by the parameter u of a chart and along s.
struct ChartPlace {
  std::array<double, 4> u;       ///< the parameter and its s-derivatives
  std::array<double, 4> J, W;    ///< stretch and weight, with their u-derivatives
  std::array<double, 3> kappa0;  ///< curvature [1/m] with its s-derivatives
};

/// The drawn curve at reference arc length s; segment < 0: u is s itself and W is 1 (Chart).
ChartPlace place_of(const ReferenceCurve& curve, int segment, double s);

/// f(u(s)) and its s-derivatives, from f by u and u by s.
std::array<double, 4> along(const std::array<double, 4>& f, const std::array<double, 4>& u);

/// kappa_0 as a series at s, which is linear in the end positions, from kappa_0 and its first two derivatives
/// along s.
Jet curvature_at(const std::array<double, 3>& kappa0, const Jet& s);

/// H / W of the four Hermite functions of u on [u_a, u_a + l], W = `weight`.
Eigen::RowVector4d hermite_at(double u, double weight, double u_a, double l);
/// Rows: H / W of the four Hermite functions of u on [u_a, u_a + l] and its first four s-derivatives.
Eigen::Matrix<double, 5, 4> hermite_along(const ChartPlace& p, double u_a, double l);

}  // namespace nurbeam
