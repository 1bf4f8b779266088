#include "fem/element/moving_basis.h"

#include <cmath>

#include "fem/element/chart_place.h"
#include "fem/element/hermite_series.h"

namespace nurbeam {

namespace {

std::array<double, 4> product(const std::array<double, 4>& f, const std::array<double, 4>& g) {
  return {f[0] * g[0], f[1] * g[0] + f[0] * g[1], f[2] * g[0] + 2 * f[1] * g[1] + f[0] * g[2],
          f[3] * g[0] + 3 * f[2] * g[1] + 3 * f[1] * g[2] + f[0] * g[3]};
}

double weight_at(const RationalCubic& cubic, double u) {
  const double v = 1 - u;
  return cubic.weight(0) * v * v * v + 3 * u * v * (cubic.weight(1) * v + cubic.weight(2) * u) +
         cubic.weight(3) * u * u * u;
}

// The series l^m with l = b - a.
Jet power_of_length(double l, int m) {
  const double f = std::pow(l, m), d1 = m * f / l, d2 = (m - 1) * d1 / l / 2, d3 = (m - 2) * d2 / l / 3;
  return Jet(Jet::Coefficients{f, -d1, d1, d2, -2 * d2, d2, -d3, 3 * d3, -3 * d3, d3});
}

// The Hermite functions of x, for an element of length l, at a place that stays. At a fixed x the place would
// move by 1 - x and x times the moves of the ends.
MovingRows::Series uniform_positions(double l, double x) {
  const double x2 = x * x, x3 = x2 * x, H = 3 * x2 - 2 * x3, H1 = 6 / l * (x - x2);
  const double a = x - 2 * x2 + x3, b = x3 - x2;
  const MovingRows::Row along(-H1, 1 - 4 * x + 3 * x2, H1, 3 * x2 - 2 * x);
  MovingRows::Series r;
  r.value << 1 - H, l * a, H, l * b;
  r.first[1] << 0, a, 0, b;
  r.first[0] = -r.first[1] - (1 - x) * along;
  r.first[1] -= x * along;
  return r;
}

}  // namespace

MovingBasis::MovingBasis(const ReferenceCurve& curve, const Chart& chart, const Jet& s_a, const Jet& s_b,
                         Derivatives wanted)
    : curve_(&curve), segment_(chart.segment), wanted_(wanted) {
  if (chart.constant_weights) {
    constant_weights_.emplace(curve, chart, s_a.value(), s_b.value());
    return;
  }
  if (segment_ < 0 || curve.is_uniform_line(segment_)) {
    const double l = s_b.value() - s_a.value();
    uniform_ = {s_a, power_of_length(l, 1), power_of_length(l, -1), power_of_length(l, -2),
                power_of_length(l, -3)};
    return;
  }
  const ChartPlace a = place_of(curve, segment_, s_a.value()), b = place_of(curve, segment_, s_b.value());
  u_a_ = a.u[0];
  length_ = b.u[0] - a.u[0];
  const EndSeries<2> l = of_variable<2>(1, b.u) - of_variable<2>(0, a.u);
  EndSeries<2> x = (1 / length_) * l;  // the series is 1 + x
  x.c[0] = 0;
  EndSeries<2> inverse = x * x - x;
  inverse.c[0] += 1;
  const MovingEnds ends{(1 / length_) * inverse, of_variable<2>(0, {a.u[1], a.u[2], a.u[3], 0}),
                        of_variable<2>(1, {b.u[1], b.u[2], b.u[3], 0})};
  const auto shifted = [](const std::array<double, 4>& f) {
    return std::array<double, 4>{f[1], f[2], f[3], 0};
  };
  const auto set_all = [&]<int N>(std::integral_constant<int, N>) {
    const auto at_end = [&](int end, const ChartPlace& place, const std::array<double, 4>& f) {
      return of_variable<N>(end, along(f, place.u));
    };
    const std::array<Hermite<N>, 4> shapes{Hermite<N>{at_end(0, a, a.W), at_end(0, a, shifted(a.W)), {}, {}},
                                           Hermite<N>{{}, at_end(0, a, product(a.J, a.W)), {}, {}},
                                           Hermite<N>{{}, {}, at_end(1, b, b.W), at_end(1, b, shifted(b.W))},
                                           Hermite<N>{{}, {}, {}, at_end(1, b, product(b.J, b.W))}};
    for (int k = 0; k < 4; ++k) {
      const auto set = [&](int which, const auto& h) {
        data_[which].col(k) << h.P.c[0], h.Q.c[0], h.R.c[0], h.T.c[0];
      };
      const auto by_a = by_start(shapes[k], ends), by_b = by_end(shapes[k], ends);
      const auto by_aa = by_start(by_a, ends), by_ab = by_end(by_a, ends), by_bb = by_end(by_b, ends);
      set(0, shapes[k]);
      set(1, by_a);
      set(2, by_b);
      set(3, by_aa);
      set(4, by_ab);
      set(5, by_bb);
      if constexpr (N == 3) {
        set(6, by_start(by_aa, ends));
        set(7, by_end(by_aa, ends));
        set(8, by_end(by_ab, ends));
        set(9, by_end(by_bb, ends));
      }
    }
  };
  if (wanted == Derivatives::one)
    set_all(std::integral_constant<int, 2>());
  else
    set_all(std::integral_constant<int, 3>());
}

std::pair<double, bool> MovingBasis::fraction(const Jet& s) const {
  constexpr double round_off = 1e-12;
  const double x = (s.value() - uniform_->s_a.value()) * uniform_->l_1.value();
  return {x, std::abs(s.d(0) - (1 - x)) < round_off && std::abs(s.d(1) - x) < round_off};
}

ShapeFunctions<Jet> MovingBasis::uniform_at(const Jet& s) const {
  const Jet &s_a = uniform_->s_a, &l = uniform_->l, &l_1 = uniform_->l_1, &l_2 = uniform_->l_2,
            &l_3 = uniform_->l_3;
  const auto at_fraction = fraction(s);
  const double x = at_fraction.first;
  const bool moves = at_fraction.second;
  const Jet xi = moves ? Jet(x) : (s - s_a) * l_1;
  // A Hermite function of xi from its value and derivatives; its last one is constant.
  const auto at = [&](double f, double f1, double f2, double f3, const Jet& factor) {
    return moves ? f * factor : compose({f, f1, f2, f3}, xi) * factor;
  };
  ShapeFunctions<Jet> shape;
  const double x2 = x * x, x3 = x2 * x;
  const auto place = [&](int k, double sign) {
    const double g = sign * (3 * x2 - 2 * x3) + (sign < 0 ? 1 : 0), g1 = sign * 6 * (x - x2),
                 g2 = sign * (6 - 12 * x), g3 = -12 * sign;
    shape.value[k] = at(g, g1, g2, g3, Jet(1));
    shape.d1[k] = at(g1, g2, g3, 0, l_1);
    shape.d2[k] = at(g2, g3, 0, 0, l_2);
    shape.d3[k] = g3 * l_3;
  };
  const auto slope = [&](int k, double g, double g1, double g2) {
    shape.value[k] = at(g, g1, g2, 6, l);
    shape.d1[k] = at(g1, g2, 6, 0, Jet(1));
    shape.d2[k] = at(g2, 6, 0, 0, l_1);
    shape.d3[k] = 6 * l_2;
  };
  place(0, -1);
  slope(1, x - 2 * x2 + x3, 1 - 4 * x + 3 * x2, 6 * x - 4);
  place(2, 1);
  slope(3, x3 - x2, 3 * x2 - 2 * x, 6 * x - 2);
  if (has_curvature()) shape.kappa0 = curvature_at(place_of(*curve_, segment_, s.value()).kappa0, s);
  return shape;
}

MovingRows MovingBasis::uniform_rows(double x) const {
  const double l = uniform_->l.value(), i = uniform_->l_1.value(), x2 = x * x, x3 = x2 * x;
  const double H = 3 * x2 - 2 * x3, H1 = 6 * i * (x - x2), H2 = i * i * (6 - 12 * x);
  const double a = x - 2 * x2 + x3, a2 = i * (6 * x - 4), b = x3 - x2, b2 = i * (6 * x - 2);
  MovingRows rows;
  rows.r.value << 1 - H, l * a, H, l * b;
  rows.rs.value << -H1, 1 - 4 * x + 3 * x2, H1, 3 * x2 - 2 * x;
  rows.rss.value << -H2, a2, H2, b2;
  rows.r.first[1] << 0, a, 0, b;
  rows.rs.first[1] << i * H1, 0, -i * H1, 0;
  rows.rss.first[1] << 2 * i * H2, -i * a2, -2 * i * H2, -i * b2;
  for (MovingRows::Series* series : {&rows.r, &rows.rs, &rows.rss}) series->first[0] = -series->first[1];
  for (MovingRows::Row& row : rows.r.second) row.setZero();
  const double i2 = i * i;
  rows.rsss << 12 * i2 * i, 6 * i2, -12 * i2 * i, 6 * i2;
  if (wanted_ == Derivatives::one) return rows;
  rows.rs.second[2] << -2 * i * i * H1, 0, 2 * i * i * H1, 0;
  rows.rss.second[2] << -6 * i * i * H2, 2 * i * i * a2, 6 * i * i * H2, 2 * i * i * b2;
  for (MovingRows::Series* series : {&rows.rs, &rows.rss}) {
    series->second[0] = series->second[2];
    series->second[1] = -series->second[2];
  }
  for (MovingRows::Row& row : rows.r_third) row.setZero();
  rows.rsss_first[1] << -36 * i2 * i2, -12 * i2 * i, 36 * i2 * i2, -12 * i2 * i;
  rows.rsss_first[0] = -rows.rsss_first[1];
  return rows;
}

MovingRows MovingBasis::rows_at(const Jet& s) const {
  if (uniform_)
    if (const auto [xi, moves_with_ends] = fraction(s); moves_with_ends) {
      MovingRows rows = uniform_rows(xi);
      if (has_curvature()) rows.set_curvature(curvature_at(place_of(*curve_, segment_, s.value()).kappa0, s));
      return rows;
    }
  if (constant_weights_) return constant_weights_->rows_at(s, wanted_);
  if (!uniform_ && wanted_ == Derivatives::one) return rational_rows(s);
  const ShapeFunctions<Jet> shape = at(s);
  MovingRows rows;
  const auto copy = [](const std::array<Jet, 4>& jets, MovingRows::Series& series) {
    for (int k = 0; k < 4; ++k) {
      series.value[k] = jets[k].value();
      for (const int end : {0, 1}) series.first[end][k] = jets[k].d(end);
      for (int m = 0; m < 3; ++m) series.second[m][k] = jets[k].d(m / 2, (m + 1) / 2);
    }
  };
  copy(shape.value, rows.r);
  copy(shape.d1, rows.rs);
  copy(shape.d2, rows.rss);
  for (int k = 0; k < 4; ++k) {
    for (int m = 0; m < 4; ++m) rows.r_third[m][k] = shape.value[k].d(m / 3, m / 2, (m + 2) / 3);
    rows.rsss[k] = shape.d3[k].value();
    for (const int end : {0, 1}) rows.rsss_first[end][k] = shape.d3[k].d(end);
  }
  rows.set_curvature(shape.kappa0);
  return rows;
}

MovingRows::Series MovingBasis::positions_at(double s) const {
  if (constant_weights_) return rows_at(Jet(s)).r;
  if (uniform_) return uniform_positions(uniform_->l.value(), fraction(Jet(s)).first);
  const double u = curve_->parameter(segment_, s);
  const Eigen::RowVector4d f = hermite_at(u, weight_at(curve_->segment(segment_), u), u_a_, length_);
  MovingRows::Series r;
  r.value = (f * data_[0]).transpose();
  for (const int end : {0, 1}) r.first[end] = (f * data_[1 + end]).transpose();
  return r;
}

MovingRows MovingBasis::rational_rows(const Jet& s) const {
  const ChartPlace p = place_of(*curve_, segment_, s.value());
  const Eigen::Matrix4d f = hermite_along(p, u_a_, length_).topRows<4>();
  const Eigen::Matrix4d still = f * data_[0];  // rows: derivatives along s at fixed ends
  const double a = s.d(0), b = s.d(1);
  MovingRows rows;
  const std::array<MovingRows::Series*, 3> series{&rows.r, &rows.rs, &rows.rss};
  for (int m = 0; m < 3; ++m) series[m]->value = still.row(m);
  rows.rsss = still.row(3);
  std::array<Eigen::Matrix<double, 3, 4>, 2> moved;  // derivatives by the ends, at fixed s
  for (const int end : {0, 1}) {
    moved[end] = f.topRows<3>() * data_[1 + end];
    for (int m = 0; m < 3; ++m)
      series[m]->first[end] = (moved[end].row(m) + s.d(end) * still.row(m + 1)).transpose();
  }
  const auto second = [&](int which) -> MovingRows::Row { return (f.row(0) * data_[which]).transpose(); };
  const auto& along = still.row(2);
  rows.r.second[0] = second(3) + (2 * a * moved[0].row(1) + a * a * along).transpose();
  rows.r.second[1] = second(4) + (b * moved[0].row(1) + a * moved[1].row(1) + a * b * along).transpose();
  rows.r.second[2] = second(5) + (2 * b * moved[1].row(1) + b * b * along).transpose();
  rows.kappa0 = p.kappa0[0];
  rows.kappa0_first = {a * p.kappa0[1], b * p.kappa0[1]};
  return rows;
}

ShapeFunctions<Jet> MovingBasis::at(const Jet& s) const {
  if (constant_weights_) return constant_weights_->at(s);
  if (uniform_) return uniform_at(s);
  const ChartPlace p = place_of(*curve_, segment_, s.value());
  const Eigen::Matrix<double, 5, 4> f = hermite_along(p, u_a_, length_);
  // rows[m](r, k): derivative m in the ends at fixed s of derivative r along s of shape function k.
  std::array<Eigen::Matrix<double, 5, 4>, 6> rows;
  rows[0] = f * data_[0];
  for (int m = 1; m < 3; ++m) rows[m].topRows<4>() = f.topRows<4>() * data_[m];
  for (int m = 3; m < 6; ++m) rows[m].topRows<3>() = f.topRows<3>() * data_[m];
  Eigen::Matrix4d third;
  for (int m = 6; m < 10; ++m) third.row(m - 6) = f.row(0) * data_[m];

  const double a = s.d(0), b = s.d(1);
  const auto moving = [&](int r, int k, bool second, bool all) {
    const auto x = [&](int m, int order) { return rows[m](r + order, k); };
    Jet::Coefficients c{};
    c[0] = x(0, 0);
    c[1] = x(1, 0) + a * x(0, 1);
    c[2] = x(2, 0) + b * x(0, 1);
    if (!second) return Jet(c);
    c[3] = (x(3, 0) + 2 * a * x(1, 1) + a * a * x(0, 2)) / 2;
    c[4] = x(4, 0) + b * x(1, 1) + a * x(2, 1) + a * b * x(0, 2);
    c[5] = (x(5, 0) + 2 * b * x(2, 1) + b * b * x(0, 2)) / 2;
    if (!all) return Jet(c);
    c[6] = (third(0, k) + 3 * a * x(3, 1) + 3 * a * a * x(1, 2) + a * a * a * x(0, 3)) / 6;
    c[7] = (third(1, k) + b * x(3, 1) + 2 * a * x(4, 1) + 2 * a * b * x(1, 2) + a * a * x(2, 2) +
            a * a * b * x(0, 3)) /
           2;
    c[8] = (third(2, k) + a * x(5, 1) + 2 * b * x(4, 1) + 2 * a * b * x(2, 2) + b * b * x(1, 2) +
            a * b * b * x(0, 3)) /
           2;
    c[9] = (third(3, k) + 3 * b * x(5, 1) + 3 * b * b * x(2, 2) + b * b * b * x(0, 3)) / 6;
    return Jet(c);
  };
  ShapeFunctions<Jet> shape;
  for (int k = 0; k < 4; ++k) {
    shape.value[k] = moving(0, k, true, true);
    shape.d1[k] = moving(1, k, true, false);
    shape.d2[k] = moving(2, k, true, false);
    shape.d3[k] = moving(3, k, false, false);
  }
  shape.kappa0 = curvature_at(p.kappa0, s);
  return shape;
}

}  // namespace nurbeam
