#include "fem/element/twist_drawing.h"

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
PlaceSeries along(const std::array<double, 3>& f, const PlaceSeries& s) {
  const PlaceSeries step = s - plain(s);
  return PlaceSeries(f[0]) + f[1] * step + (f[2] / 2) * (step * step);
}
Vector3<PlaceSeries> along(const std::array<Eigen::Vector3d, 3>& f, const PlaceSeries& s) {
  Vector3<PlaceSeries> y;
  for (int d = 0; d < 3; ++d) y[d] = along({f[0][d], f[1][d], f[2][d]}, s);
  return y;
}
SectionTriad<PlaceSeries> triad_along(const DrawnSectionSeries& section, const PlaceSeries& s) {
  return {along(section.d1, s), along(section.d2, s), along(section.t, s)};
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

Eigen::Matrix<PlaceSeries, Eigen::Dynamic, 1> DrawnElement::transport(const PlaceSeries& s) const {
  constexpr int n = GaussRule::size;
  Eigen::Matrix<PlaceSeries, Eigen::Dynamic, 1> row(static_cast<Eigen::Index>(places_.size()));
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    const auto& [lo, hi] = parts_[i];
    const bool behind = i + 1 < parts_.size() && plain(s) >= plain(hi), ahead = i > 0 && plain(s) < plain(lo);
    for (int j = 0; j < n; ++j) {
      PlaceSeries& at = row[static_cast<Eigen::Index>(i * n + j)];
      if (ahead)
        at = 0.0;
      else if (behind)
        at = (hi - lo) * GaussRule::weights[j];
      else
        at = (hi - lo) * integrated_lagrange(j, PlaceSeries((s - lo) / (hi - lo)));
    }
  }
  return row;
}

AnyPoint<PlaceSeries> DrawnElement::point(const Jet& at) const {
  const PlaceSeries s = series(at);
  DrawnSectionSeries here = section(plain(s), plain(s) > (s_a_ + s_b_) / 2);
  AnyPoint<PlaceSeries> p;
  set_axis(at, p);
  p.xi = (s - variable(s_a_, 0)) / drawing_.h;
  p.transport = transport(s);
  PlaceSeries transported = 0.0;
  for (Eigen::Index j = 0; j < rates_.size(); ++j) transported += p.transport[j] * rates_[j];
  const double near = curve_->section_turn(s_a_, plain(s)) + plain(transported);
  p.angle = SectionTurn<PlaceSeries>(a_, triad_along(here, s), near).angle - transported;
  if (curve_->straight()) here.k1 = here.k2 = {};
  p.k1 = along(here.k1, s);
  p.k2 = along(here.k2, s);
  return p;
}

}  // namespace nurbeam::twist
