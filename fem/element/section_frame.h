#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>

#include "fem/element/dual.h"

/// A section is a right-handed triad d1, d2, t, where d1 and d2 are along the section's axes and t =
/// r_s/|r_s|. Its state is one angle in a chart: a fixed triad M = (M1, M2, m), columns, from which the
/// smallest rotation takes m to t.
namespace nurbeam {

template <class T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

template <class T>
struct SectionTriad {
  Vector3<T> d1, d2, t;

  Eigen::Matrix<T, 3, 3> matrix() const {
    Eigen::Matrix<T, 3, 3> columns;
    columns << d1, d2, t;
    return columns;
  }
};

/// The vector `x`, across m, turned by the smallest rotation that takes m to t; undefined for t = -m.
template <class T>
Vector3<T> turned_with(const Vector3<T>& x, const Vector3<T>& m, const Vector3<T>& t) {
  return x - (m + t) * (t.dot(x) / (1.0 + m.dot(t)));
}

/// The section at a node with slope r_s and angle theta in `chart`.
template <class T>
SectionTriad<T> section_at_node(const Eigen::Matrix3d& chart, const Vector3<T>& rs, const T& theta) {
  using std::cos, std::sin, std::sqrt;
  const Vector3<T> M1 = chart.col(0).cast<T>(), M2 = chart.col(1).cast<T>(), m = chart.col(2).cast<T>();
  const T n = sqrt(rs.dot(rs));
  const Vector3<T> t = rs / n;
  const Vector3<T> e1 = turned_with(M1, m, t), e2 = turned_with(M2, m, t);
  const T c = cos(theta), s = sin(theta);
  return {c * e1 + s * e2, c * e2 - s * e1, t};
}

/// c(r_s): the section's spin about t is theta' + c . r_s', and the variation of its triad the spin
/// (r_s x dr_s)/|r_s|^2 + t (dtheta + c . dr_s). Zero where t = m.
template <class T>
Vector3<T> spin_row(const Eigen::Matrix3d& chart, const Vector3<T>& rs) {
  using std::sqrt;
  const Vector3<T> m = chart.col(2).cast<T>();
  const T n = sqrt(rs.dot(rs));
  return m.cross(rs) / (-(n * (n + rs.dot(m))));
}

/// Forces on (r_s, theta) of a node from a moment mu on its section, by the virtual work of mu on the spin.
template <class T>
Eigen::Matrix<T, 4, 1> node_force(const Eigen::Matrix3d& chart, const Vector3<T>& rs, const Vector3<T>& mu) {
  using std::sqrt;
  const T a = rs.dot(rs), along = mu.dot(rs) / sqrt(a);
  Eigen::Matrix<T, 4, 1> force;
  force << mu.cross(rs) / a + along * spin_row(chart, rs), along;
  return force;
}

/// The angle by which section b is turned about the tangent against section a, without the swing of the
/// tangent. Among values 2 pi apart it is the one nearest to `near` [rad]. Undefined for t_b = -t_a.
///
/// S, C are bilinear in the two triads.
template <class T>
struct SectionTurn {
  T S, C, angle;

  SectionTurn(const SectionTriad<T>& a, const SectionTriad<T>& b, double near)
      : S(a.d2.dot(b.d1) - a.d1.dot(b.d2)), C(a.d1.dot(b.d1) + a.d2.dot(b.d2)) {
    using std::atan2, std::cos, std::sin;
    const double c = cos(near), s = sin(near);
    angle = near + atan2(S * c - C * s, C * c + S * s);
  }
};

/// The angle of a section, a triad of columns, in a chart [rad]: the inverse of section_at_node.
inline double angle_in(const Eigen::Matrix3d& chart, const Eigen::Matrix3d& section) {
  const auto triad = [](const Eigen::Matrix3d& columns) -> SectionTriad<double> {
    return {columns.col(0), columns.col(1), columns.col(2)};
  };
  return SectionTurn<double>(triad(chart), triad(section), 0).angle;
}

/// Section `a` carried to the tangent t by the smallest rotation and turned about it by `angle`.
template <class T>
SectionTriad<T> carried_section(const SectionTriad<T>& a, const Vector3<T>& t, const T& angle) {
  using std::cos, std::sin;
  const Vector3<T> e1 = turned_with(a.d1, a.t, t), e2 = turned_with(a.d2, a.t, t);
  const T c = cos(angle), s = sin(angle);
  return {c * e1 + s * e2, c * e2 - s * e1, t};
}

/// The rate, per reference length, at which parallel transport turns against the smallest rotation from the
/// tangent t_a, for the curvature vector K = r_s x r_ss/|r_s|^2 at the tangent t.
template <class T>
T transport_rate(const Vector3<T>& K, const Vector3<T>& t, const Vector3<T>& t_a) {
  return K.dot(t_a) / (1.0 + t.dot(t_a));
}

}  // namespace nurbeam
