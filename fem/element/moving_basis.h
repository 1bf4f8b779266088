#pragma once
#include <Eigen/Core>
#include <array>

#include "fem/element/constant_weight_basis.h"
#include "fem/element/derivatives.h"
#include "fem/element/moving_rows.h"
#include "fem/element/rancf_basis.h"

namespace nurbeam {

/// The shape functions of ElementBasis and their derivatives in the end positions, without series at the
/// points.
///
/// With H = W r the numerator of an element's field is a cubic in u, given by its values and slopes (P, Q) at
/// u_A and (R, T) at u_B. At fixed u its derivative in s_A is such a cubic again:
///   P_a - Q u_A', Q_a - H''(u_A) u_A', R_a, T_a,
/// and so on (in s_B alike): all derivatives of all four shape functions are Hermite cubics, found once for
/// the element. At a point they are evaluated together, H / W and its derivatives in s; what a point that
/// moves with the ends adds is the chain rule (docs/theory.md, moving elements).
///
/// Where u is s but for a factor and W is constant (arc length as chart, straight lines) the shape functions
/// are the Hermite ones of xi = (s - s_A) / l times powers of l: at a fixed fraction xi of the element only
/// these powers have derivatives. Charts with constant weights, whose W moves with the ends, have a basis of
/// their own.
class MovingBasis {
 public:
  /// `wanted`: one for rows_at() alone.
  MovingBasis(const ReferenceCurve& curve, const Chart& chart, const Jet& s_a, const Jet& s_b,
              Derivatives wanted = Derivatives::two);

  /// At a point whose place is linear in the end positions, `s` = value and derivatives. Of the third
  /// derivatives only those of the shape functions themselves are set; of d3 the first ones.
  ShapeFunctions<Jet> at(const Jet& s) const;
  /// The part of it that forces need, and with two derivatives wanted tangents.
  MovingRows rows_at(const Jet& s) const;
  /// Of these, r at a place that stays, with first derivatives.
  MovingRows::Series positions_at(double s) const;

 private:
  static constexpr int derivatives = 10;  // 1, a, b, aa, ab, bb, aaa, aab, abb, bbb

  // l^1, l^-1, l^-2, l^-3 as series, of an element with u = s but for a factor.
  struct Uniform {
    Jet s_a, l, l_1, l_2, l_3;
  };
  /// xi at s, and whether the ends leave it as it is.
  std::pair<double, bool> fraction(const Jet& s) const;
  ShapeFunctions<Jet> uniform_at(const Jet& s) const;
  MovingRows uniform_rows(double xi) const;
  MovingRows rational_rows(const Jet& s) const;
  bool has_curvature() const { return !curve_->straight() && segment_ < 0; }  // of a uniform chart

  const ReferenceCurve* curve_;
  int segment_;
  Derivatives wanted_;
  std::optional<Uniform> uniform_;
  double u_a_ = 0, length_ = 0;
  /// (P, Q, R, T) of the four shape functions (columns), by derivative; the last four unset where one is
  /// wanted.
  std::array<Eigen::Matrix4d, derivatives> data_;
  std::optional<ConstantWeightBasis> constant_weights_;
};

}  // namespace nurbeam
