#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/constant_weight_basis.h"
#include "fem/element/derivatives.h"
#include "fem/element/moving_rows.h"
#include "fem/element/rancf_basis.h"

namespace nurbeam {

/// With H = W r the numerator of an element's field is a cubic in u, given by its values and slopes (P, Q) at
/// u_A and (R, T) at u_B. At fixed u its derivative in s_A is a cubic again:
///   P_a - Q u_A', Q_a - H''(u_A) u_A', R_a, T_a,
/// and so on (in s_B alike). All derivatives of all four shape functions are Hermite cubics, found once for
/// the element. At a point they are evaluated together, H / W and its derivatives in s. For a point that
/// moves with the ends the chain rule adds its terms (docs/theory.md, moving elements).
///
/// Where u is s but for a factor and W is constant (arc length as chart, straight lines) the shape functions
/// are the Hermite ones of xi = (s - s_A) / l times powers of l: at a fixed fraction xi of the element only
/// these powers have derivatives. Charts with constant weights, whose W moves with the ends, have a basis of
/// their own.
class MovingBasis {
 public:
  /// `wanted`: one is enough for rows_at().
  MovingBasis(const ReferenceCurve& curve, const Chart& chart, const Jet& s_a, const Jet& s_b,
              Derivatives wanted = Derivatives::two);

  /// Shape functions at a point whose place is linear in the end positions, `s` = value and derivatives.
  /// Third derivatives are set for the shape functions themselves only; of d3 the first derivatives are set.
  ShapeFunctions<Jet> at(const Jet& s) const;
  /// The part of the shape functions that forces need, and with two derivatives wanted also tangents.
  MovingRows rows_at(const Jet& s) const;
  /// The row of r at a place that stays, with first derivatives.
  MovingRows::Series positions_at(double s) const;

 private:
  static constexpr int derivatives = 10;  // 1, a, b, aa, ab, bb, aaa, aab, abb, bbb

  // l^1, l^-1, l^-2, l^-3 as series, for an element with u = s but for a factor.
  struct Uniform {
    Jet s_a, l, l_1, l_2, l_3;
  };
  /// xi at s, and whether it stays fixed when the ends move.
  std::pair<double, bool> fraction(const Jet& s) const;
  ShapeFunctions<Jet> uniform_at(const Jet& s) const;
  MovingRows uniform_rows(double xi) const;
  MovingRows rational_rows(const Jet& s) const;
  bool has_curvature() const { return !curve_->straight() && segment_ < 0; }  // for a uniform chart

  const ReferenceCurve* curve_;
  int segment_;
  Derivatives wanted_;
  std::optional<Uniform> uniform_;
  double u_a_ = 0, length_ = 0;
  /// (P, Q, R, T) of the four shape functions (columns), by derivative; the last four are unset when one
  /// derivative is wanted.
  std::array<Eigen::Matrix4d, derivatives> data_;
  std::optional<ConstantWeightBasis> constant_weights_;
};

}  // namespace nurbeam
