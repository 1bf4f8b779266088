#pragma once
#include <type_traits>

#include "fem/element/rancf_basis.h"
#include "fem/element/twist_kinematics.h"

namespace nurbeam::twist {

/// A number that varies with the places of both ends of an element: value, gradient and Hessian.
using PlaceSeries = Dual<2, Dual<2>>;

/// The value of a series at the places (a, b), whose plain values are those for which the series was made.
/// Exact for scalars that carry first or second derivatives.
inline double at_places(const Dual<2>& f, double, double) { return f.value; }
template <int N>
Dual<N> at_places(const Dual<2>& f, const Dual<N>& a, const Dual<N>& b) {
  Dual<N> y(f.value);
  for (int k = 0; k < N; ++k) y.d[k] = f.d[0] * a.d[k] + f.d[1] * b.d[k];
  return y;
}
template <int N, class T>
Dual<N, T> at_places(const Dual<2>& f, const Dual<N, T>& a, const Dual<N, T>& b) {
  return f.value + f.d[0] * (a - plain(a)) + f.d[1] * (b - plain(b));
}
inline double at_places(const PlaceSeries& f, double, double) { return f.value.value; }
template <int N, class T>
Dual<N, T> at_places(const PlaceSeries& f, const Dual<N, T>& a, const Dual<N, T>& b) {
  Dual<N, T> y;
  y.value = at_places(f.value, a.value, b.value);
  const T by_a = at_places(f.d[0], a.value, b.value), by_b = at_places(f.d[1], a.value, b.value);
  for (int k = 0; k < N; ++k) y.d[k] = by_a * a.d[k] + by_b * b.d[k];
  return y;
}

/// A number that varies with the places of both ends and of a point in between: value, gradient and Hessian.
using SlidingSeries = Dual<3, Dual<3>>;

/// A point that moves over the material: the members of Point that its section needs.
struct SlidingPoint {
  SlidingSeries xi;
  Vector3<SlidingSeries> S1;
  Eigen::Matrix<SlidingSeries, Eigen::Dynamic, 1> transport;
  SlidingSeries angle;
};

template <class P>
using AnyPoint = Point<P, Eigen::Dynamic>;
template <class P>
using AnyFields = Fields<P, Eigen::Dynamic>;

/// A drawn element whose ends may move, of one or more parts.
template <class P>
struct AnyDrawing : Drawing<P, Eigen::Dynamic> {
  /// Additional numbers of a quadrature point for rates at fixed material.
  struct Slide {
    P s;            ///< place of the point [m]
    Vector3<P> S3;  ///< shape functions of r_sss
    P twist;        ///< twist of the drawing [rad/m]
    P k1_s, k2_s;   ///< derivatives of the drawn curvatures by s [1/m^2]
  };
  std::vector<Slide> slides;
  std::array<P, 2> end_twist;  ///< twist of the drawing at both ends [rad/m]
};

/// Quadrature points of an element between two places, which may move: those of BeamElement::for_each_point.
/// Parts between breaks of the drawing have their own points.
template <class P>
struct QuadraturePlaces {
  struct Part {
    P start, length;
  };
  std::vector<Part> parts;
  ElementBasis<P> basis;

  QuadraturePlaces(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b);
  std::size_t size() const { return parts.size() * GaussRule::size; }
  P place(std::size_t g) const {
    return part(g).start + part(g).length * GaussRule::points[g % GaussRule::size];
  }
  P weight(std::size_t g) const { return part(g).length * GaussRule::weights[g % GaussRule::size]; }

 private:
  const Part& part(std::size_t g) const { return parts[g / GaussRule::size]; }
};

/// The drawing of an element between two places, as series P in both: double has values alone, Dual<2> also
/// gradients, PlaceSeries also Hessians. Transport goes on from part to part.
template <class P>
class DrawnElement {
 public:
  DrawnElement(const ReferenceCurve& curve, const Chart& chart, double s_a, double s_b);

  const AnyDrawing<P>& drawing() const { return drawing_; }
  /// Theta_0 at B [rad].
  double turn() const { return turn_; }
  /// Rate of transport in the drawing at quadrature point j [1/m].
  double rate(int j) const { return plain(rates_[j]); }
  /// The drawn point at material point s between the ends.
  AnyPoint<P> point(double s) const;
  /// The drawn point at a place s between the ends that may move.
  SlidingPoint sliding_point(double s) const requires std::is_same_v<P, PlaceSeries>;

 private:
  template <class T>
  using Row = Eigen::Matrix<T, Eigen::Dynamic, 1>;
  DrawnSectionSeries section(double s, bool from_left) const;
  DrawnSectionSeries section_between(double s) const { return section(s, s > (s_a_ + s_b_) / 2); }
  AnyPoint<P> axis_point(const P& s, const ShapeFunctions<P>& shape, const DrawnSectionSeries& here,
                         Row<P> transport) const;
  void add_point(std::size_t g, const DrawnSectionSeries& here);
  void set_rates(const DrawnSectionSeries& a, const DrawnSectionSeries& b);
  Row<P> transport_to(std::size_t g) const;
  template <class T>
  Row<T> transport(const T& s) const;
  template <class T>
  T angle(const DrawnSectionSeries& here, const T& s, const Row<T>& transport) const;

  const ReferenceCurve* curve_;
  Chart chart_;
  double s_a_, s_b_;
  QuadraturePlaces<P> places_;
  SectionTriad<P> a_;
  Row<P> rates_;  // rates of transport in the drawing, at the points
  AnyDrawing<P> drawing_;
  double turn_;
};

extern template struct QuadraturePlaces<double>;
extern template DrawnElement<double>::DrawnElement(const ReferenceCurve&, const Chart&, double, double);
extern template AnyPoint<double> DrawnElement<double>::point(double) const;
extern template DrawnElement<Dual<2>>::DrawnElement(const ReferenceCurve&, const Chart&, double, double);
extern template class DrawnElement<PlaceSeries>;

/// The point or the drawing at the places (a, b); with Dual<2> for scalars of first derivatives alone.
template <class P, class T>
AnyPoint<T> at_places(const AnyPoint<P>& p, const T& a, const T& b) {
  AnyPoint<T> y;
  const auto at = [&](const P& f) { return at_places(f, a, b); };
  y.xi = at(p.xi);
  for (int k = 0; k < 3; ++k) {
    y.S1[k] = at(p.S1[k]);
    y.S2[k] = at(p.S2[k]);
  }
  y.transport.resize(p.transport.size());
  for (Eigen::Index j = 0; j < p.transport.size(); ++j) y.transport[j] = at(p.transport[j]);
  y.angle = at(p.angle);
  y.k1 = at(p.k1);
  y.k2 = at(p.k2);
  return y;
}
template <class P, class T>
AnyDrawing<T> at_places(const AnyDrawing<P>& drawing, const T& a, const T& b) {
  AnyDrawing<T> y;
  const auto at = [&](const P& f) { return at_places(f, a, b); };
  y.h = at(drawing.h);
  y.end_angle = at(drawing.end_angle);
  y.weights.resize(drawing.weights.size());
  for (Eigen::Index g = 0; g < drawing.weights.size(); ++g) y.weights[g] = at(drawing.weights[g]);
  for (const AnyPoint<P>& p : drawing.points) y.points.push_back(at_places(p, a, b));
  for (const auto& slide : drawing.slides)
    y.slides.push_back({at(slide.s),
                        {at(slide.S3[0]), at(slide.S3[1]), at(slide.S3[2])},
                        at(slide.twist),
                        at(slide.k1_s),
                        at(slide.k2_s)});
  y.end_twist = {at(drawing.end_twist[0]), at(drawing.end_twist[1])};
  return y;
}

}  // namespace nurbeam::twist
