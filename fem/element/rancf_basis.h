#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>

#include "fem/element/dual.h"
#include "fem/element/jet.h"
#include "fem/element/reference_curve.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// Nodal coordinates of Eq. (4) of Ding & Ouyang: columns r_A, r_xA, r_B, r_xB (3 x 4).
using NodalCoordinates = Eigen::Matrix<double, 3, 4>;

/// Eq. (5) of Ding & Ouyang: nodal coordinates of a rational cubic over a label interval of length l.
/// r_x = dr/dx with x = x_A + u l.
NodalCoordinates to_rancf(const RationalCubic& cubic, double l);
/// Eq. (6) of Ding & Ouyang, the inverse of to_rancf for the same weights and l.
RationalCubic to_bezier(const NodalCoordinates& e, const Eigen::Vector4d& weights, double l);

/// The chart of an element, r = H(u) / W, where H is an ordinary cubic Hermite field in u.
///
/// segment >= 0: u is the parameter of that CAD segment, W its weight polynomial (weights follow the
/// material), unless `constant_weights` holds the paper's four weights, which stay with the element. segment
/// < 0: u is reference arc length itself (W = 1 unless `constant_weights`): ALE-ANCF, and any element that
/// spans a break of the drawing.
struct Chart {
  int segment = -1;
  std::optional<std::array<double, 4>> constant_weights;

  bool operator==(const Chart&) const = default;
};

/// The four shape functions and their derivatives with respect to reference arc length s at one material
/// point: r(s) = sum value_k e_k, e = (r_A, r_sA, r_B, r_sB). T = double (fixed ends), or Jet or Dual (moving
/// ends).
template <class T>
struct ShapeFunctions {
  std::array<T, 4> value, d1, d2, d3;
  T kappa0;  ///< curvature of the drawing there [1/m]
};

/// Shape functions of an element between the reference arc lengths s_a and s_b, evaluated at s.
///
/// Let h_1..h_4 be the cubic Hermite functions (Eq. 10 of Ding & Ouyang with l = 1), l = u_B - u_A, and the
/// nodal values those of H = W r. Then
///   s_1 = (h_1 W_A + l h_2 W'_A)/W,  s_2 = l h_2 J_A W_A / W,
///   s_3 = (h_3 W_B + l h_4 W'_B)/W,  s_4 = l h_4 J_B W_B / W;
/// Eq. (9) of Ding & Ouyang is the case of constant weights with l J_A r_s = l r_x.
template <class T>
class ElementBasis {
 public:
  ElementBasis(const ReferenceCurve& curve, const Chart& chart, const T& s_a, const T& s_b);
  /// Precondition: s in the chart's segment (for an arc-length chart anywhere on the element).
  ShapeFunctions<T> at(const T& s) const;
  /// Length of the chart parameter over the element.
  T length() const { return b_.u - a_.u; }
  /// Stretch J at both ends: r_u = J r_s.
  std::array<T, 2> stretches() const { return {a_.J, b_.J}; }
  /// The weights w_0..w_3 of the rational cubic (Eq. 9 of Ding & Ouyang).
  std::array<T, 4> weights() const;

 private:
  struct End {
    T u, J, W, Wu;
  };
  End end(const T& s) const;

  const ReferenceCurve* curve_;
  Chart chart_;
  End a_, b_;
};

extern template class ElementBasis<double>;
extern template class ElementBasis<Jet>;
extern template class ElementBasis<Dual<2>>;
extern template class ElementBasis<Dual<2, Dual<2>>>;

}  // namespace nurbeam
