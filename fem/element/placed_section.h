#pragma once
#include "fem/element/layout.h"
#include "fem/element/twist_drawing.h"

namespace nurbeam {

/// The section of an element with torsion at a place that may move over the material. It is a function of the
/// element's coordinates (TwistLayout) and, last, of the place.
///
/// The object is made for given places and holds series in them. Third derivatives by the places alone are
/// missing in scalars that carry them.
class PlacedSection {
 public:
  static constexpr int size = TwistLayout::size + 1;
  template <class T>
  using Coordinates = Eigen::Matrix<T, size, 1>;
  using Charts = std::array<Eigen::Matrix3d, 2>;

  /// `turn`: see TwistElement; `x`: the coordinates whose places the object is made for.
  PlacedSection(const ReferenceCurve& curve, const Chart& chart, const Charts& charts, double turn,
                const Coordinates<double>& x)
      : PlacedSection(twist::DrawnElement<twist::PlaceSeries>(curve, chart, x[TwistLayout::place(0)],
                                                              x[TwistLayout::place(1)]),
                      charts, turn, x) {}

  template <class T>
  SectionTriad<T> triad(const Coordinates<T>& x) const;
  /// Forces on the coordinates from a moment on the section.
  template <class T>
  Coordinates<T> force(const Coordinates<T>& x, const Vector3<T>& moment) const;

 private:
  PlacedSection(const twist::DrawnElement<twist::PlaceSeries>& drawn, const Charts& charts, double turn,
                const Coordinates<double>& x)
      : drawing_(drawn.drawing()),
        point_(drawn.sliding_point(x[size - 1])),
        charts_(charts),
        turn_(turn),
        places_{x[TwistLayout::place(0)], x[TwistLayout::place(1)], x[size - 1]} {}

  twist::AnyDrawing<twist::PlaceSeries> drawing_;
  twist::SlidingPoint point_;
  Charts charts_;
  double turn_;
  std::array<double, 3> places_;
};

template <class T>
SectionTriad<T> PlacedSection::triad(const Coordinates<T>& x) const {
  using std::sqrt;
  const auto segment = [&](int first) { return Vector3<T>(x.template segment<3>(first)); };
  twist::Reduced<T> q;
  q << segment(TwistLayout::r(1)) - segment(TwistLayout::r(0)), segment(TwistLayout::slope(0)),
      segment(TwistLayout::slope(1)), segment(TwistLayout::angle(0));
  const T &s_a = x[TwistLayout::place(0)], &s_b = x[TwistLayout::place(1)];
  const auto all = twist::fields_of<T>(at_places(drawing_, s_a, s_b), charts_, turn_, q);
  const std::array<T, 3> step{s_a - places_[0], s_b - places_[1], x[size - 1] - places_[2]};
  const auto at = [&](const twist::SlidingSeries& f) {
    T y = plain(f);
    for (int i = 0; i < 3; ++i) {
      T slope = f.d[i].value;
      for (int k = 0; k < 3; ++k) slope += (f.d[i].d[k] / 2) * step[k];
      y += slope * step[i];
    }
    return y;
  };
  const Vector3<T> rs =
      segment(TwistLayout::r(1)) * at(point_.S1[0]) - segment(TwistLayout::r(0)) * at(point_.S1[0]) +
      segment(TwistLayout::slope(0)) * at(point_.S1[1]) + segment(TwistLayout::slope(1)) * at(point_.S1[2]);
  const Vector3<T> t = rs / sqrt(rs.dot(rs));
  const T xi = at(point_.xi);
  T alpha = all.twist * xi + x[TwistLayout::bubble] * twist::bubble_shape(xi) + at(point_.angle);
  for (Eigen::Index j = 0; j < all.rates.size(); ++j) alpha += all.rates[j] * at(point_.transport[j]);
  return carried_section<T>(all.a, t, alpha);
}

// A moment works on the variation sum_k a_k x da_k/2 of the triad a_k.
template <class T>
PlacedSection::Coordinates<T> PlacedSection::force(const Coordinates<T>& x, const Vector3<T>& moment) const {
  using D = Dual<size, T>;
  const SectionTriad<D> varied = triad<D>(twist::variables<size, T>(x));
  Coordinates<T> f = Coordinates<T>::Zero();
  for (const Vector3<D>* axis : {&varied.d1, &varied.d2, &varied.t}) {
    const Vector3<T> a((*axis)[0].value, (*axis)[1].value, (*axis)[2].value);
    const Vector3<T> turned = 0.5 * moment.cross(a);
    for (int i = 0; i < size; ++i)
      f[i] += turned[0] * (*axis)[0].d[i] + turned[1] * (*axis)[1].d[i] + turned[2] * (*axis)[2].d[i];
  }
  return f;
}

}  // namespace nurbeam
