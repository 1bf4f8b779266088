#include "fem/element/constant_weight_basis.h"

#include <algorithm>

namespace nurbeam {

namespace {

// f(s) where s is linear in the end positions, from f and its derivatives along s.
template <int N>
EndSeries<N> at_place(const std::array<double, 4>& f, const Jet& s) {
  const double a = s.d(0), b = s.d(1);
  const std::array<double, 10> c{f[0],
                                 a * f[1],
                                 b * f[1],
                                 a * a * f[2] / 2,
                                 a * b * f[2],
                                 b * b * f[2] / 2,
                                 a * a * a * f[3] / 6,
                                 a * a * b * f[3] / 2,
                                 a * b * b * f[3] / 2,
                                 b * b * b * f[3] / 6};
  return truncated<N>(EndSeries<3>{c});
}

// The fourth derivative of u along s.
double fourth_derivative(const std::array<double, 4>& J) {
  const double i = 1 / J[0], i2 = i * i;
  return (10 * J[0] * J[1] * J[2] - J[0] * J[0] * J[3] - 15 * J[1] * J[1] * J[1]) * i2 * i2 * i2 * i;
}

// The series 1 / x.
EndSeries<3> inverse(const EndSeries<3>& x) {
  const double i = 1 / x.c[0];
  EndSeries<3> y = -i * x;  // 1 - i x
  y.c[0] = 0;
  EndSeries<3> sum = y * (y + y * y) + y;
  sum.c[0] += 1;
  return i * sum;
}

template <int N>
EndSeries<N> constant(double value) {
  EndSeries<N> x;
  x.c[0] = value;
  return x;
}

// The series as a Jet.
template <int N>
Jet jet(const EndSeries<N>& x) {
  Jet::Coefficients c{};
  std::copy(x.c.begin(), x.c.end(), c.begin());
  return Jet(c);
}

}  // namespace

ConstantWeightBasis::ConstantWeightBasis(const ReferenceCurve& curve, const Chart& chart, double s_a,
                                         double s_b)
    : curve_(&curve), segment_(chart.segment), weights_(*chart.constant_weights) {
  const std::array<ChartPlace, 2> ends{place_of(curve, segment_, s_a), place_of(curve, segment_, s_b)};
  u_a_ = of_variable<3>(0, ends[0].u);
  const EndSeries<3> length = of_variable<3>(1, ends[1].u) - u_a_;
  inverse_length_ = inverse(length);
  for (const int end : {0, 1})
    gradient_factors_[end] = length * of_variable<3>(end, along(ends[end].J, ends[end].u));
}

Eigen::Matrix<double, 5, 4> ConstantWeightBasis::functions_at(double xi) const {
  const auto& w = weights_;
  const double a = 3 * (w[1] - w[0]), b = 3 * (w[3] - w[2]);  // slopes of W at both ends
  const double second_a = 6 * (w[0] - 2 * w[1] + w[2]), third = 6 * (w[3] - 3 * w[2] + 3 * w[1] - w[0]);
  const std::array<double, 4> W{w[0] + xi * (a + xi * (second_a / 2 + xi * (third / 6))),
                                a + xi * (second_a + xi * (third / 2)), second_a + xi * third, third};
  Eigen::Matrix<double, 5, 4> F = hermite_along({{xi, 1, 0, 0}, {1, 0, 0, 0}, W, {}}, 0, 1);
  F.col(0) = w[0] * F.col(0) + a * F.col(1);
  F.col(1) *= w[0];
  F.col(2) = w[3] * F.col(2) + b * F.col(3);
  F.col(3) *= w[3];
  return F;
}

template <int N>
ConstantWeightBasis::Shapes<N> ConstantWeightBasis::shapes_at(const Jet& s) const {
  const ChartPlace p = place_of(*curve_, segment_, s.value());
  const double u4 = fourth_derivative(p.J);
  const EndSeries<N> l_1 = truncated<N>(inverse_length_);
  EndSeries<N> x = (at_place<N>(p.u, s) - truncated<N>(u_a_)) * l_1;  // xi, and then its change
  const Eigen::Matrix<double, 5, 4> F = functions_at(x.c[0]);
  x.c[0] = 0;
  const EndSeries<N> x2 = x * x, x3 = x2 * x;
  // xi_s, xi_ss, xi_sss at fixed ends are the factors of the derivatives of F in the derivatives along s.
  const auto low = [](const auto& series) { return truncated<N - 1>(series); };
  const auto least = [](const auto& series) { return truncated<N - 2>(series); };
  const EndSeries<N - 1> y = low(x), y2 = low(x2);
  const EndSeries<N - 1> xi_s = low(l_1) * at_place<N - 1>({p.u[1], p.u[2], p.u[3], 0}, s),
                         xi_ss = low(l_1) * at_place<N - 1>({p.u[2], p.u[3], u4, 0}, s);
  const EndSeries<N - 2> xi_sss = least(l_1) * at_place<N - 2>({p.u[3], u4, 0, 0}, s);
  const EndSeries<N - 1> square = xi_s * xi_s;
  const std::array d1{xi_s, xi_s * y, 0.5 * xi_s * y2};
  const std::array d2{xi_ss, square + xi_ss * y, square * y + 0.5 * xi_ss * y2, 0.5 * square * y2};
  const EndSeries<N - 2> z = least(y), mixed = 3.0 * least(xi_s) * least(xi_ss),
                         cube = least(square) * least(xi_s);
  const std::array d3{xi_sss, mixed + xi_sss * z, cube + mixed * z, cube * z};

  Shapes<N> shapes;
  shapes.kappa0 = p.kappa0;
  for (int k = 0; k < 4; ++k) {
    const auto f = F.col(k);
    shapes.value[k] = constant<N>(f[0]) + f[1] * x + (f[2] / 2) * x2 + (f[3] / 6) * x3;
    shapes.d1[k] = f[1] * d1[0] + f[2] * d1[1] + f[3] * d1[2];
    shapes.d2[k] = f[1] * d2[0] + f[2] * d2[1] + f[3] * d2[2] + f[4] * d2[3];
    shapes.d3[k] = f[1] * d3[0] + f[2] * d3[1] + f[3] * d3[2] + f[4] * d3[3];
    if (k % 2 == 0) continue;
    const EndSeries<3>& factor = gradient_factors_[k / 2];
    shapes.value[k] = shapes.value[k] * truncated<N>(factor);
    shapes.d1[k] = shapes.d1[k] * low(factor);
    shapes.d2[k] = shapes.d2[k] * low(factor);
    shapes.d3[k] = shapes.d3[k] * least(factor);
  }
  return shapes;
}

ShapeFunctions<Jet> ConstantWeightBasis::at(const Jet& s) const {
  const Shapes<3> shapes = shapes_at<3>(s);
  ShapeFunctions<Jet> y;
  for (int k = 0; k < 4; ++k) {
    y.value[k] = jet(shapes.value[k]);
    y.d1[k] = jet(shapes.d1[k]);
    y.d2[k] = jet(shapes.d2[k]);
    y.d3[k] = jet(shapes.d3[k]);
  }
  y.kappa0 = curvature_at(shapes.kappa0, s);
  return y;
}

namespace {

template <int N>
void copy(const std::array<EndSeries<N>, 4>& from, MovingRows::Series& to) {
  for (int k = 0; k < 4; ++k) {
    const auto& c = from[k].c;
    to.value[k] = c[0];
    for (const int end : {0, 1}) to.first[end][k] = c[1 + end];
    if constexpr (N > 1) {
      to.second[0][k] = 2 * c[3];
      to.second[1][k] = c[4];
      to.second[2][k] = 2 * c[5];
    }
  }
}

}  // namespace

MovingRows ConstantWeightBasis::rows_at(const Jet& s, Derivatives wanted) const {
  MovingRows rows;
  const auto set = [&]<int N>(const Shapes<N>& shapes) {
    copy(shapes.value, rows.r);
    copy(shapes.d1, rows.rs);
    copy(shapes.d2, rows.rss);
    for (int k = 0; k < 4; ++k) {
      rows.rsss[k] = shapes.d3[k].c[0];
      if constexpr (N == 3) {
        for (const int end : {0, 1}) rows.rsss_first[end][k] = shapes.d3[k].c[1 + end];
        for (int m = 0; m < 4; ++m)
          rows.r_third[m][k] = (m == 0 || m == 3 ? 6 : 2) * shapes.value[k].c[6 + m];
      }
    }
    rows.set_curvature(curvature_at(shapes.kappa0, s));
  };
  wanted == Derivatives::one ? set(shapes_at<2>(s)) : set(shapes_at<3>(s));
  return rows;
}

}  // namespace nurbeam
