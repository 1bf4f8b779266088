// A torque about the tangent along an element with torsion.
#include "fem/element/twist_element.h"
#include "fem/element/twist_rows.h"

namespace nurbeam {

namespace {

// A unit torque on the section at s, per weight.
SectionMoment unit_torque(const ReferenceCurve& curve, double s) { return {curve.section(s).t, true, {}}; }

}  // namespace

// Generalised force of a unit torque per length. The spin at a point, from the spins w_A, w_B at the ends and
// beta', is
//   (1 - xi) w_A + xi w_B + b beta' - sum_j (transport_j - xi w_j) K_j . r_s'_j/|r_s_j|,
// as transport takes the swing of the tangent in between with it. The sum over the points is
//   h/2 (w_A + w_B) + 2 h/3 beta' - h sum_j w_j (1/2 - xi_j) K_j . r_s'_j/|r_s_j|.
template <class T>
TwistElement::Reduced<T> TwistElement::fixed_torque(const Reduced<T>& q) const {
  const double h = drawing_.h;
  const auto& at = drawing_.points;
  Reduced<T> force = Reduced<T>::Zero();
  std::array<Vector3<T>, 2> tangents;
  for (const int end : {0, 1}) {
    const Vector3<T> rs = q.template segment<3>(twist::slope_of(end));
    using std::sqrt;
    tangents[end] = rs / sqrt(rs.dot(rs));
    const Vector3<T> moment = (h / 2) * tangents[end];
    twist::add_node_force<T>(charts_[end], end, moment, q, force);
  }
  force[twist::bubble] = 2 * h / 3;
  for (int j = 0; j < points; ++j) {
    const twist::PointField<T> p = twist::axis_at<T>(at[j], q, tangents[0]);
    const Vector3<T> on_rs = p.K * ((at[j].xi - 0.5) * h * drawing_.weights[j] / p.n);
    for (int k = 0; k < 3; ++k) force.template segment<3>(3 * k) += on_rs * at[j].S1[k];
  }
  return force;
}

TwistElement::Coordinates TwistElement::torque_force(const Coordinates& q) const {
  if (fixed()) return twist::spread_out<fixed_rows>(fixed_torque<double>(twist::reduced_of<fixed_rows>(q)));
  const twist::QuadraturePlaces<double> places(*curve_, chart_, q[TwistLayout::place(0)],
                                               q[TwistLayout::place(1)]);
  Coordinates force = Coordinates::Zero();
  for (std::size_t g = 0; g < places.size(); ++g) {
    const double s = places.place(g);
    force += places.weight(g) * moment_force(q, s, unit_torque(*curve_, s));
  }
  return force;
}

// The gradient of the torque; with moving ends the points move too.
TwistElement::Matrix TwistElement::torque_gradient(const Coordinates& q) const {
  if (fixed())
    return twist::spread_out<fixed_rows>(twist::derivatives<fixed_rows>(fixed_torque<Dual<fixed_rows>>(
        twist::variables<fixed_rows, double>(twist::reduced_of<fixed_rows>(q)))));
  const twist::AnyDrawing<twist::PlaceSeries> drawing = drawn_element<twist::PlaceSeries>(q).drawing();
  Matrix K = Matrix::Zero();
  for (std::size_t g = 0; g < drawing.slides.size(); ++g) {
    const twist::PlaceSeries &s = drawing.slides[g].s, &w = drawing.weights[static_cast<Eigen::Index>(g)];
    const SectionMoment torque = unit_torque(*curve_, plain(s));
    K += plain(w) * moment_gradient(q, plain(s), torque);
    PlacedSection::Coordinates<double> x;
    x << q, plain(s);
    const PlacedSection section = placed(x);
    const auto moved = twist::moving<double, PlacedSection::size>(
        x, PlacedSection::Coordinates<double>::Unit(PlacedSection::size - 1));
    const Vector3<Dual<1>> t = section.triad<Dual<1>>(moved).t;
    const auto force = section.force<Dual<1>>(moved, t);
    for (const int end : {0, 1})
      for (int i = 0; i < TwistLayout::size; ++i)
        K(i, TwistLayout::place(end)) +=
            w.value.d[end] * force[i].value + plain(w) * s.value.d[end] * force[i].d[0];
  }
  return K;
}

}  // namespace nurbeam
