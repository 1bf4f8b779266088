#include "fem/element/twist_drawing.h"

#include <utility>

namespace nurbeam::twist {

namespace {

// The place of an end as a variable.
template <class P>
P variable(double value, int index) {
  if constexpr (std::is_same_v<P, PlaceSeries>)
    return PlaceSeries::variable(Dual<2>::variable(value, index), index);
  else if constexpr (std::is_same_v<P, double>)
    return value;
  else
    return P::variable(value, index);
}

// A function of s, from its derivatives at the plain value of s.
template <class P>
P along(const std::array<double, 3>& f, const P& s) {
  const P step = s - plain(s);
  return P(f[0]) + f[1] * step + (f[2] / 2) * (step * step);
}
template <class P>
Vector3<P> along(const std::array<Eigen::Vector3d, 3>& f, const P& s) {
  Vector3<P> y;
  for (int d = 0; d < 3; ++d) y[d] = along<P>({f[0][d], f[1][d], f[2][d]}, s);
  return y;
}
template <class P>
SectionTriad<P> triad_along(const DrawnSectionSeries& section, const P& s) {
  return {along(section.d1, s), along(section.d2, s), along(section.t, s)};
}

// A series in both places as a series in three: f does not vary with the third place, unless its derivatives
// by it are given: `slope`, a series too, and `second`.
SlidingSeries by_third(const PlaceSeries& f, const PlaceSeries& slope, double second) {
  SlidingSeries y;
  y.value.value = f.value.value;
  for (int i = 0; i < 2; ++i) {
    y.value.d[i] = y.d[i].value = f.value.d[i];
    for (int j = 0; j < 2; ++j) y.d[i].d[j] = f.d[i].d[j];
    y.d[i].d[2] = y.d[2].d[i] = slope.value.d[i];
  }
  y.value.d[2] = y.d[2].value = plain(slope);
  y.d[2].d[2] = second;
  return y;
}
template <class T, class P>
T widened(const P& f) {
  if constexpr (std::is_same_v<T, P>) {
    return f;
  } else {
    T y;
    y.value.value = f.value.value;
    for (int i = 0; i < 2; ++i) {
      y.value.d[i] = y.d[i].value = f.value.d[i];
      for (int j = 0; j < 2; ++j) y.d[i].d[j] = f.d[i].d[j];
    }
    return y;
  }
}
template <class T, class P>
SectionTriad<T> widened(const SectionTriad<P>& a) {
  const auto each = [](const Vector3<P>& x) {
    return Vector3<T>(widened<T>(x[0]), widened<T>(x[1]), widened<T>(x[2]));
  };
  return {each(a.d1), each(a.d2), each(a.t)};
}

template <class P>
Vector3<P> on_reduced(const std::array<P, 4>& row) {
  return {row[2], row[1], row[3]};
}

// integrated_lagrange at the Gauss points.
const std::array<std::array<double, GaussRule::size>, GaussRule::size> integrals_to_points = [] {
  std::array<std::array<double, GaussRule::size>, GaussRule::size> A{};
  for (int g = 0; g < GaussRule::size; ++g)
    for (int j = 0; j < GaussRule::size; ++j) A[g][j] = integrated_lagrange(j, GaussRule::points[g]);
  return A;
}();

}  // namespace

template <class P>
QuadraturePlaces<P>::QuadraturePlaces(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b)
    : basis(curve, chart, variable<P>(s_a, 0), variable<P>(s_b, 1)) {
  P start = variable<P>(s_a, 0);
  if (chart.segment < 0)
    for (double s = curve.next_break(s_a); s < s_b; s = curve.next_break(s)) {
      parts.push_back({start, P(s) - start});
      start = P(s);
    }
  parts.push_back({start, variable<P>(s_b, 1) - start});
}

template <class P>
DrawnElement<P>::DrawnElement(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b)
    : curve_(&curve), chart_(chart), s_a_(s_a), s_b_(s_b), places_(curve, chart, s_a, s_b) {
  const P start = variable<P>(s_a, 0), end = variable<P>(s_b, 1);
  const DrawnSectionSeries a = section(s_a, false), b = section(s_b, true);
  std::vector<DrawnSectionSeries> between;
  a_ = triad_along(a, start);
  drawing_.h = end - start;
  drawing_.end_twist = {along(a.twist, start), along(b.twist, end)};
  drawing_.weights.resize(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t g = 0; g < places_.size(); ++g) {
    between.push_back(section_between(plain(places_.place(g))));
    add_point(g, between.back());
  }
  set_rates(a, b);
  for (std::size_t g = 0; g < places_.size(); ++g) {
    AnyPoint<P>& p = drawing_.points[g];
    p.angle = angle<P>(between[g], drawing_.slides[g].s, p.transport);
  }
  drawing_.end_angle = angle<P>(b, end, drawing_.weights);
  turn_ = plain(drawing_.end_angle);
  for (Eigen::Index j = 0; j < rates_.size(); ++j) turn_ += plain(drawing_.weights[j]) * plain(rates_[j]);
}

// Adds a quadrature point, without its angle.
template <class P>
void DrawnElement<P>::add_point(std::size_t g, const DrawnSectionSeries& here) {
  const P s = places_.place(g);
  const ShapeFunctions<P> shape = places_.basis.at(s);
  drawing_.weights[static_cast<Eigen::Index>(g)] = places_.weight(g);
  drawing_.points.push_back(axis_point(s, shape, here, transport_to(g)));
  const bool bent = !curve_->straight();
  const auto slope = [&](const std::array<double, 3>& k) {
    return bent ? along<P>({k[1], k[2], 0}, s) : P(0.0);
  };
  drawing_.slides.push_back({s, on_reduced(shape.d3), along(here.twist, s), slope(here.k1), slope(here.k2)});
}

template <class P>
AnyPoint<P> DrawnElement<P>::axis_point(const P& s, const ShapeFunctions<P>& shape,
                                        const DrawnSectionSeries& here, Row<P> transport) const {
  AnyPoint<P> p;
  p.S1 = on_reduced(shape.d1);
  p.S2 = on_reduced(shape.d2);
  p.xi = (s - variable<P>(s_a_, 0)) / drawing_.h;
  p.transport = std::move(transport);
  const bool bent = !curve_->straight();
  p.k1 = bent ? along(here.k1, s) : P(0.0);
  p.k2 = bent ? along(here.k2, s) : P(0.0);
  return p;
}

// Sets the rates of transport along the drawing, as the element's own nodal values give them.
template <class P>
void DrawnElement<P>::set_rates(const DrawnSectionSeries& a, const DrawnSectionSeries& b) {
  const auto position = [&](double s, const DrawnSectionSeries& section, int end) {
    return along({curve_->position(s), section.t[0], section.t[1]}, variable<P>(s, end));
  };
  Reduced<P> drawn = Reduced<P>::Zero();
  drawn.template segment<3>(chord) = position(s_b_, b, 1) - position(s_a_, a, 0);
  drawn.template segment<3>(slope_a) = a_.t;
  drawn.template segment<3>(slope_b) = along(b.t, variable<P>(s_b_, 1));
  rates_.resize(static_cast<Eigen::Index>(places_.size()));
  for (Eigen::Index g = 0; g < rates_.size(); ++g)
    rates_[g] = axis_at<P>(drawing_.points[static_cast<std::size_t>(g)], drawn, a_.t).f;
}

template <class P>
DrawnSectionSeries DrawnElement<P>::section(double s, bool from_left) const {
  return curve_->section_series(chart_.segment < 0 ? curve_->segment_at(s, from_left) : chart_.segment, s);
}

// Row of transport to a quadrature point.
template <class P>
typename DrawnElement<P>::template Row<P> DrawnElement<P>::transport_to(std::size_t g) const {
  constexpr std::size_t n = GaussRule::size;
  Row<P> row = Row<P>::Zero(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t j = 0; j < places_.size() && j / n <= g / n; ++j)
    row[static_cast<Eigen::Index>(j)] =
        j / n < g / n ? places_.weight(j) : places_.parts[g / n].length * integrals_to_points[g % n][j % n];
  return row;
}

template <class P>
template <class T>
typename DrawnElement<P>::template Row<T> DrawnElement<P>::transport(const T& s) const {
  constexpr std::size_t n = GaussRule::size;
  Row<T> row = Row<T>::Zero(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t i = 0; i < places_.parts.size(); ++i) {
    const T start = widened<T>(places_.parts[i].start), length = widened<T>(places_.parts[i].length);
    const bool behind = i + 1 < places_.parts.size() && plain(s) >= plain(start) + plain(length);
    if (i > 0 && plain(s) < plain(start)) break;
    for (std::size_t j = 0; j < n; ++j)
      row[static_cast<Eigen::Index>(i * n + j)] =
          behind ? T(length * GaussRule::weights[j])
                 : T(length * integrated_lagrange(static_cast<int>(j), T((s - start) / length)));
  }
  return row;
}

// Angle of the drawn section at s against A, less transport.
template <class P>
template <class T>
T DrawnElement<P>::angle(const DrawnSectionSeries& here, const T& s, const Row<T>& transport) const {
  T transported = 0.0;
  for (Eigen::Index j = 0; j < rates_.size(); ++j) transported += transport[j] * widened<T>(rates_[j]);
  const double near = curve_->section_turn(s_a_, plain(s)) + plain(transported);
  return SectionTurn<T>(widened<T>(a_), triad_along<T>(here, s), near).angle - transported;
}

template <class P>
SlidingPoint DrawnElement<P>::sliding_point(double place) const requires std::is_same_v<P, PlaceSeries> {
  const SlidingSeries s = SlidingSeries::variable(Dual<3>::variable(place, 2), 2);
  const ShapeFunctions<P> shape = places_.basis.at(P(place));
  const auto S1 = [&](int k) { return by_third(shape.d1[k], shape.d2[k], plain(shape.d3[k])); };
  SlidingPoint p;
  p.S1 = {S1(2), S1(1), S1(3)};
  p.xi = (s - widened<SlidingSeries>(variable<P>(s_a_, 0))) / widened<SlidingSeries>(drawing_.h);
  p.transport = transport<SlidingSeries>(s);
  p.angle = angle<SlidingSeries>(section_between(place), s, p.transport);
  return p;
}

template <class P>
AnyPoint<P> DrawnElement<P>::point(double place) const {
  const P s(place);
  const DrawnSectionSeries here = section_between(place);
  AnyPoint<P> p = axis_point(s, places_.basis.at(s), here, transport<P>(s));
  p.angle = angle<P>(here, s, p.transport);
  return p;
}

template struct QuadraturePlaces<double>;
template DrawnElement<double>::DrawnElement(const ReferenceCurve&, const Chart&, double, double);
template AnyPoint<double> DrawnElement<double>::point(double) const;
template DrawnElement<Dual<2>>::DrawnElement(const ReferenceCurve&, const Chart&, double, double);
template class DrawnElement<PlaceSeries>;

}  // namespace nurbeam::twist
