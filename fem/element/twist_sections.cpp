// The section at a place of an element with torsion, and moments on it.
#include <type_traits>

#include "fem/element/twist_element.h"
#include "fem/element/twist_rows.h"

namespace nurbeam {

template <class T, int n>
TwistElement::At<T> TwistElement::at_place(const Eigen::Matrix<T, n, 1>& x, double s) const {
  const Reduced<T> nodal = x.template head<fixed_rows>();
  const auto at = [&](const auto& drawing, const auto& place) {
    const auto all = twist::fields_of<T>(drawing, charts_, turn_, nodal);
    At<T> result{all.a, twist::axis_at<T>(place, nodal, all.a.t), {}};
    twist::set_strain<T>(place, drawing.h, all, result.point);
    result.strain = {result.point.k1 - place.k1, result.point.k2 - place.k2, result.point.gamma};
    return result;
  };
  if constexpr (n == fixed_rows) {
    return at(drawing_, fixed_point(s));
  } else if constexpr (std::is_same_v<T, double>) {
    const twist::DrawnElement<double> drawn(*curve_, chart_, x[twist::place_a], x[twist::place_a + 1]);
    return at(drawn.drawing(), drawn.point(s));
  } else {
    const T &a = x[twist::place_a], &b = x[twist::place_a + 1];
    const twist::DrawnElement<twist::PlaceSeries> drawn(*curve_, chart_, plain(a), plain(b));
    return at(at_places(drawn.drawing(), a, b), at_places(drawn.point(s), a, b));
  }
}

TwistElement::At<double> TwistElement::at_place(const Coordinates& q, double s) const {
  return fixed() ? at_place<double, fixed_rows>(twist::reduced_of<fixed_rows>(q), s)
                 : at_place<double, moving_rows>(twist::reduced_of<moving_rows>(q), s);
}

SectionPoint TwistElement::section(const Coordinates& q, double s) const {
  const At<double> at = at_place(q, s);
  return {carried_section<double>(at.a, at.point.t, at.point.alpha), at.strain,
          section_moments(*properties_->sections, at.strain)};
}

double TwistElement::turn_to(const Coordinates& q, double s) const { return at_place(q, s).point.alpha; }

std::array<double, 2> TwistElement::twist_strain(const Coordinates& q) const {
  const Reduced<double> x = twist::reduced_of<fixed_rows>(q);
  const double s_a = q[TwistLayout::place(0)], s_b = q[TwistLayout::place(1)];
  const auto turned = [&](const auto& drawing) {
    return twist::fields_of<double>(drawing, charts_, turn_, x).twist;
  };
  const double twist =
      fixed() ? turned(drawing_) : turned(twist::DrawnElement<double>(*curve_, chart_, s_a, s_b).drawing());
  const auto at = [&](double xi) {
    return (twist + x[twist::bubble] * twist::bubble_slope(xi)) / (s_b - s_a);
  };
  return {at(0), at(1)};
}

// Rows of the material spin. The section at xi = (s - s_A)/h moves over the material with s' = (1 - xi) s_A'
// + xi s_B'. The turn by this motion is subtracted from its spin; at the nodes the drawn twist is.
TwistElement::MaterialSpinRows::MaterialSpinRows(const TwistElement& element, const Coordinates& q)
    : s_a_(q[TwistLayout::place(0)]), h_(q[TwistLayout::place(1)] - s_a_) {
  for (const int end : {0, 1}) {
    const Eigen::Vector3d rs = q.segment<3>(TwistLayout::slope(end));
    ends_[end].setZero();
    ends_[end].segment<3>(TwistLayout::slope(end)) = spin_row<double>(element.charts_[end], rs);
    ends_[end][TwistLayout::angle(end)] = 1;
    if (!element.fixed())
      ends_[end][TwistLayout::place(end)] =
          -element.curve_->section(q[TwistLayout::place(end)], end == 1).twist;
  }
  if (!element.fixed()) strain_ = element.twist_strain(q);
}

TwistElement::Coordinates TwistElement::MaterialSpinRows::at(double s) const {
  const double xi = (s - s_a_) / h_;
  const std::array<double, 2> share{1 - xi, xi};
  Coordinates row = share[0] * ends_[0] + share[1] * ends_[1];
  const double strain = share[0] * strain_[0] + share[1] * strain_[1];
  for (const int end : {0, 1}) row[TwistLayout::place(end)] -= share[end] * strain;
  row[TwistLayout::bubble] = twist::bubble_shape(xi);
  return row;
}

double TwistElement::material_spin(const TwistState& x, double s) const {
  return MaterialSpinRows(*this, x.q).at(s).dot(x.v);
}

// Forces of a moment: the section's spin is (r_s x dr_s)/|r_s|^2 + t dw with
//   dw = d(alpha) + [(t_A x dt_A + t_A dw_A) . (t_A + t) - t_A . (t x dt)]/(1 + t . t_A),
// and dual numbers take the derivatives.
template <class T, int n>
Eigen::Matrix<T, n, 1> TwistElement::moment_on(const Eigen::Matrix<T, n, 1>& q, double s,
                                               const SectionMoment& of) const {
  using D = Dual<n, T>;
  const At<D> at = at_place<D, n>(twist::variables<n, T>(q), s);
  const auto values = [](const Vector3<D>& y) { return Vector3<T>(y[0].value, y[1].value, y[2].value); };
  const auto derivative = [](const Vector3<D>& y, int i) {
    return Vector3<T>(y[0].d[i], y[1].d[i], y[2].d[i]);
  };
  const Vector3<T> t = values(at.point.t), t_a = values(at.a.t), rs = values(at.point.rs);
  Vector3<T> moment = of.value.cast<T>();
  if (of.follower || of.arm) {
    const SectionTriad<T> a{values(at.a.d1), values(at.a.d2), t_a};
    const SectionTriad<T> section = carried_section<T>(a, t, at.point.alpha.value);
    const Vector3<T> turned = of.arm ? Vector3<T>((*of.arm)[0] * section.d1 + (*of.arm)[1] * section.d2)
                                     : Vector3<T>(section.matrix() * moment);
    moment = of.arm ? Vector3<T>(turned.cross(moment)) : turned;
  }
  const Vector3<T> c_a = spin_row<T>(charts_[0], q.template segment<3>(twist::slope_a));
  const T along = moment.dot(t), opening = 1.0 + t.dot(t_a);
  Eigen::Matrix<T, n, 1> force;
  for (int i = 0; i < n; ++i) {
    T spin_a = i == twist::angle_a ? 1.0 : 0.0;
    if (i >= twist::slope_a && i < twist::slope_b) spin_a = c_a[i - twist::slope_a];
    const Vector3<T> swing_a = t_a.cross(derivative(at.a.t, i)) + t_a * spin_a;
    const T spin =
        at.point.alpha.d[i] + (swing_a.dot(t_a + t) - t_a.dot(t.cross(derivative(at.point.t, i)))) / opening;
    force[i] = moment.dot(rs.cross(derivative(at.point.rs, i))) / rs.dot(rs) + along * spin;
  }
  return force;
}

// The components of a vector along the axes of the drawn section at s.
Eigen::Vector3d TwistElement::drawn_components(double s, const Eigen::Vector3d& vector) const {
  const DrawnSection drawn = curve_->section(s, s > (s_a_ + s_b_) / 2);
  return {drawn.d1.dot(vector), drawn.d2.dot(vector), drawn.t.dot(vector)};
}

template <int n>
TwistElement::TurnedWithSection TwistElement::turned_on(const Coordinates& q, double s,
                                                        const Eigen::Vector3d& components) const {
  using T = Dual<n>;
  const At<T> at = at_place<T, n>(twist::variables<n, double>(twist::reduced_of<n>(q)), s);
  const Vector3<T> turned =
      carried_section<T>(at.a, at.point.t, at.point.alpha).matrix() * components.cast<T>();
  TurnedWithSection result{Eigen::Vector3d::Zero(), Eigen::Matrix<double, 3, TwistLayout::size>::Zero()};
  for (int d = 0; d < 3; ++d) {
    result.value[d] = turned[d].value;
    result.gradient.row(d) =
        twist::spread_out<n>(Eigen::Matrix<double, n, 1>(turned[d].d.data())).transpose();
  }
  return result;
}

TwistElement::TurnedWithSection TwistElement::turned(const Coordinates& q, double s,
                                                     const Eigen::Vector3d& drawn) const {
  const Eigen::Vector3d components = drawn_components(s, drawn);
  return fixed() ? turned_on<fixed_rows>(q, s, components) : turned_on<moving_rows>(q, s, components);
}

SectionMoment TwistElement::along_axes(double s, const SectionMoment& moment) const {
  return moment.follower ? SectionMoment{drawn_components(s, moment.value), true, {}} : moment;
}

TwistElement::Coordinates TwistElement::moment_force(const Coordinates& q, double s,
                                                     const SectionMoment& moment) const {
  const SectionMoment along = along_axes(s, moment);
  const auto force = [&]<int n>(const Eigen::Matrix<double, n, 1>& x) {
    return twist::spread_out<n>(moment_on<double, n>(x, s, along));
  };
  return fixed() ? force(twist::reduced_of<fixed_rows>(q)) : force(twist::reduced_of<moving_rows>(q));
}

TwistElement::Matrix TwistElement::moment_gradient(const Coordinates& q, double s,
                                                   const SectionMoment& moment) const {
  const SectionMoment along = along_axes(s, moment);
  // Column by column, as dual numbers with many variables of dual numbers take long.
  const auto gradient = [&]<int n>(const Eigen::Matrix<double, n, 1>& x) {
    Eigen::Matrix<double, n, n> K;
    for (int j = 0; j < n; ++j) {
      const Eigen::Matrix<double, n, 1> direction = Eigen::Matrix<double, n, 1>::Unit(j);
      const auto force = moment_on<Dual<1>, n>(twist::moving<double, n>(x, direction), s, along);
      for (int i = 0; i < n; ++i) K(i, j) = force[i].d[0];
    }
    return twist::spread_out<n>(K);
  };
  return fixed() ? gradient(twist::reduced_of<fixed_rows>(q)) : gradient(twist::reduced_of<moving_rows>(q));
}

}  // namespace nurbeam
