#include "fem/element/twist_drawing.h"

#include <type_traits>

namespace nurbeam::twist {

namespace {

PlaceSeries series(const Jet& f) {
  PlaceSeries y;
  y.value.value = f.value();
  for (int i = 0; i < 2; ++i) {
    y.value.d[i] = y.d[i].value = f.d(i);
    for (int j = 0; j < 2; ++j) y.d[i].d[j] = f.d(i, j);
  }
  return y;
}

PlaceSeries variable(double value, int index) {
  return PlaceSeries::variable(Dual<2>::variable(value, index), index);
}

// A function of s, by its derivatives where s is.
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

// A series in both places as one in these and a third, which it does not vary with, and by its derivatives by
// that, series too, where it does.
SlidingSeries by_third(const Jet& f, const Jet& slope, double second) {
  SlidingSeries y;
  y.value.value = f.value();
  for (int i = 0; i < 2; ++i) {
    y.value.d[i] = y.d[i].value = f.d(i);
    for (int j = 0; j < 2; ++j) y.d[i].d[j] = f.d(i, j);
    y.d[i].d[2] = y.d[2].d[i] = slope.d(i);
  }
  y.value.d[2] = y.d[2].value = slope.value();
  y.d[2].d[2] = second;
  return y;
}
template <class P>
P widened(const PlaceSeries& f) {
  if constexpr (std::is_same_v<P, PlaceSeries>) return f;
  P y;
  y.value.value = f.value.value;
  for (int i = 0; i < 2; ++i) {
    y.value.d[i] = y.d[i].value = f.value.d[i];
    for (int j = 0; j < 2; ++j) y.d[i].d[j] = f.d[i].d[j];
  }
  return y;
}
template <class P>
SectionTriad<P> widened(const SectionTriad<PlaceSeries>& a) {
  const auto each = [](const Vector3<PlaceSeries>& x) {
    return Vector3<P>(widened<P>(x[0]), widened<P>(x[1]), widened<P>(x[2]));
  };
  return {each(a.d1), each(a.d2), each(a.t)};
}

Vector3<PlaceSeries> on_reduced(const std::array<Jet, 4>& row) {
  return {series(row[2]), series(row[1]), series(row[3])};
}

}  // namespace

DrawnElement::DrawnElement(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b)
    : curve_(&curve),
      chart_(chart),
      s_a_(s_a),
      s_b_(s_b),
      basis_(curve, chart, Jet::variable(s_a, 0), Jet::variable(s_b, 1)) {
  const DrawnSectionSeries a = section(s_a, false), b = section(s_b, true);
  a_ = triad_along(a, variable(s_a, 0));
  drawing_.h = variable(s_b, 1) - variable(s_a, 0);
  drawing_.end_twist = {along(a.twist, variable(s_a, 0)), along(b.twist, variable(s_b, 1))};
  add_parts();
  set_rates(a, b);
  for (const Jet& s : places_) {
    drawing_.points.push_back(point(s));
    DrawnSectionSeries here = section(s.value(), s.value() > (s_a + s_b) / 2);
    if (curve.straight()) here.k1 = here.k2 = {};
    const PlaceSeries place = series(s);
    drawing_.slides.push_back({place, on_reduced(basis_.at(s).d3), along(here.twist, place),
                               along({here.k1[1], here.k1[2], 0}, place),
                               along({here.k2[1], here.k2[2], 0}, place)});
  }
  const AnyPoint<PlaceSeries> end = point(Jet::variable(s_b, 1));
  drawing_.end_angle = end.angle;
  turn_ = plain(end.angle);
  for (Eigen::Index j = 0; j < rates_.size(); ++j) turn_ += plain(end.transport[j]) * plain(rates_[j]);
}

void DrawnElement::add_parts() {
  const auto add = [&](const Jet& lo, const Jet& hi) {
    parts_.push_back({series(lo), series(hi)});
    for (const double x : GaussRule::points) places_.push_back(lo + (hi - lo) * x);
  };
  Jet lo = Jet::variable(s_a_, 0);
  if (chart_.segment < 0)
    for (double s = curve_->next_break(s_a_); s < s_b_; s = curve_->next_break(s)) {
      add(lo, Jet(s));
      lo = Jet(s);
    }
  add(lo, Jet::variable(s_b_, 1));
  drawing_.weights.resize(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t g = 0; g < places_.size(); ++g) {
    const Part& part = parts_[g / GaussRule::size];
    drawing_.weights[g] = (part.hi - part.lo) * GaussRule::weights[g % GaussRule::size];
  }
}

// Of transport along the drawing, as the element's own nodal values have it.
void DrawnElement::set_rates(const DrawnSectionSeries& a, const DrawnSectionSeries& b) {
  const auto position = [&](double s, const DrawnSectionSeries& section, int end) {
    return along({curve_->position(s), section.t[0], section.t[1]}, variable(s, end));
  };
  Reduced<PlaceSeries> drawn = Reduced<PlaceSeries>::Zero();
  drawn.segment<3>(chord) = position(s_b_, b, 1) - position(s_a_, a, 0);
  drawn.segment<3>(slope_a) = a_.t;
  drawn.segment<3>(slope_b) = along(b.t, variable(s_b_, 1));
  rates_.resize(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t g = 0; g < places_.size(); ++g) {
    AnyPoint<PlaceSeries> p;
    set_axis(places_[g], p);
    rates_[g] = axis_at<PlaceSeries>(p, drawn, a_.t).f;
  }
}

DrawnSectionSeries DrawnElement::section(double s, bool from_left) const {
  return curve_->section_series(chart_.segment < 0 ? curve_->segment_at(s, from_left) : chart_.segment, s);
}

void DrawnElement::set_axis(const Jet& s, AnyPoint<PlaceSeries>& p) const {
  const ShapeFunctions<Jet> shape = basis_.at(s);
  p.S1 = on_reduced(shape.d1);
  p.S2 = on_reduced(shape.d2);
}

template <class P>
Eigen::Matrix<P, Eigen::Dynamic, 1> DrawnElement::transport(const P& s) const {
  constexpr int n = GaussRule::size;
  Eigen::Matrix<P, Eigen::Dynamic, 1> row(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const P lo = widened<P>(parts_[i].lo), hi = widened<P>(parts_[i].hi);
    const bool behind = i + 1 < parts_.size() && plain(s) >= plain(hi), ahead = i > 0 && plain(s) < plain(lo);
    for (int j = 0; j < n; ++j) {
      P& at = row[static_cast<Eigen::Index>(i * n + j)];
      if (ahead)
        at = 0.0;
      else if (behind)
        at = (hi - lo) * GaussRule::weights[j];
      else
        at = (hi - lo) * integrated_lagrange(j, P((s - lo) / (hi - lo)));
    }
  }
  return row;
}

// Of the drawn section at s against A, less transport.
template <class P>
P DrawnElement::angle(const DrawnSectionSeries& here, const P& s,
                      const Eigen::Matrix<P, Eigen::Dynamic, 1>& transport) const {
  P transported = 0.0;
  for (Eigen::Index j = 0; j < rates_.size(); ++j) transported += transport[j] * widened<P>(rates_[j]);
  const double near = curve_->section_turn(s_a_, plain(s)) + plain(transported);
  return SectionTurn<P>(widened<P>(a_), triad_along<P>(here, s), near).angle - transported;
}

SlidingPoint DrawnElement::sliding_point(double place) const {
  const SlidingSeries s = SlidingSeries::variable(Dual<3>::variable(place, 2), 2);
  const ShapeFunctions<Jet> shape = basis_.at(Jet(place));
  const auto S1 = [&](int k) { return by_third(shape.d1[k], shape.d2[k], shape.d3[k].value()); };
  SlidingPoint p;
  p.S1 = {S1(2), S1(1), S1(3)};
  p.xi = (s - widened<SlidingSeries>(variable(s_a_, 0))) / widened<SlidingSeries>(drawing_.h);
  p.transport = transport<SlidingSeries>(s);
  p.angle = angle<SlidingSeries>(section(place, place > (s_a_ + s_b_) / 2), s, p.transport);
  return p;
}

AnyPoint<PlaceSeries> DrawnElement::point(const Jet& at) const {
  const PlaceSeries s = series(at);
  DrawnSectionSeries here = section(plain(s), plain(s) > (s_a_ + s_b_) / 2);
  AnyPoint<PlaceSeries> p;
  set_axis(at, p);
  p.xi = (s - variable(s_a_, 0)) / drawing_.h;
  p.transport = transport<PlaceSeries>(s);
  p.angle = angle<PlaceSeries>(here, s, p.transport);
  if (curve_->straight()) here.k1 = here.k2 = {};
  p.k1 = along(here.k1, s);
  p.k2 = along(here.k2, s);
  return p;
}

}  // namespace nurbeam::twist
