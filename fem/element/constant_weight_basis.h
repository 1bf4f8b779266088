#pragma once
#include <array>

#include "fem/element/chart_place.h"
#include "fem/element/derivatives.h"
#include "fem/element/hermite_series.h"
#include "fem/element/moving_rows.h"
#include "fem/element/rancf_basis.h"

namespace nurbeam {

/// With xi = (u - u_A) / l and W = W(xi) the shape functions are F_k(xi) c_k, c = (1, l J_A, 1, l J_B), with
/// four rational functions F_k that do not depend on the ends. Only xi, l J_A, l J_B are series, and for
/// derivatives along s also the derivatives of xi = u / l at fixed ends.
class ConstantWeightBasis {
 public:
  /// Precondition: `chart` has constant weights.
  ConstantWeightBasis(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b);

  /// Shape functions at s, as MovingBasis has them.
  ShapeFunctions<Jet> at(const Jet& s) const;
  MovingRows rows_at(const Jet& s, Derivatives wanted) const;

 private:
  /// Series of r to degree N, of r_s and r_ss to degree N - 1, of r_sss to degree N - 2.
  template <int N>
  struct Shapes {
    std::array<EndSeries<N>, 4> value;
    std::array<EndSeries<N - 1>, 4> d1, d2;
    std::array<EndSeries<N - 2>, 4> d3;
    std::array<double, 3> kappa0;
  };
  template <int N>
  Shapes<N> shapes_at(const Jet& s) const;
  /// The functions F: a column each of the four, a row each of the first five xi-derivatives.
  Eigen::Matrix<double, 5, 4> functions_at(double xi) const;

  const ReferenceCurve* curve_;
  int segment_;
  std::array<double, 4> weights_;
  EndSeries<3> u_a_, inverse_length_;
  std::array<EndSeries<3>, 2> gradient_factors_;  ///< l J_A, l J_B
};

}  // namespace nurbeam
