#pragma once
#include <array>
#include <type_traits>
#include <vector>

#include "fem/element/quadrature.h"
#include "fem/element/section_frame.h"
#include "fem/material/section_moments.h"

/// Internal kinematics of TwistElement (docs/theory.md, "Torsion"), for any scalar. P is the scalar of the
/// places of the element's ends, double where they are fixed, and T the scalar of the coordinates. N is the
/// number of quadrature points, or Eigen::Dynamic.
namespace nurbeam::twist {

/// Positions of the coordinates that count: r_B - r_A, r_sA, r_sB, both angles and the bubble; then both
/// places where they move.
enum Row { chord = 0, slope_a = 3, slope_b = 6, angle_a = 9, angle_b = 10, bubble = 11, place_a = 12 };
inline constexpr int reduced = 12;  ///< rows without the places
constexpr int slope_of(int end) { return end == 0 ? slope_a : slope_b; }
constexpr int angle_of(int end) { return angle_a + end; }

template <class T>
using Reduced = Eigen::Matrix<T, reduced, 1>;

template <class P>
P bubble_shape(const P& xi) {
  return 4.0 * xi * (1.0 - xi);
}
template <class P>
P bubble_slope(const P& xi) {
  return 4.0 - 8.0 * xi;
}

/// int_0^xi of the Lagrange polynomial j of the Gauss points on [0, 1].
template <class P>
P integrated_lagrange(int j, const P& xi) {
  constexpr auto& x = GaussRule::points;
  P integral = 0.0;
  for (int k = 0; k < GaussRule::size; ++k) {  // exact for this integrand of degree 4
    P L = GaussRule::weights[k] * xi;
    for (int i = 0; i < GaussRule::size; ++i)
      if (i != j) L = L * (xi * x[k] - x[i]) / (x[j] - x[i]);
    integral += L;
  }
  return integral;
}

/// A material point: its shape functions, and the drawing there.
template <class P, int N>
struct Point {
  P xi;               ///< (s - s_A)/h
  Vector3<P> S1, S2;  ///< of r_s and r_ss, on r_B - r_A, r_sA, r_sB
  /// Omega at the point is this times the rates at the quadrature points [m]
  Eigen::Matrix<P, N, 1> transport;
  P angle;   ///< angle of the drawn section against A, less Omega [rad]
  P k1, k2;  ///< curvatures of the stress-free shape [1/m]
};

/// N values, or any number of them.
template <class T, int N>
using Several =
    std::conditional_t<N == Eigen::Dynamic, std::vector<T>, std::array<T, N == Eigen::Dynamic ? 0 : N>>;

/// The drawn element.
template <class P, int N>
struct Drawing {
  P h;  ///< [m]
  Several<Point<P, N>, N> points;
  Eigen::Matrix<P, N, 1> weights;  ///< [m]
  P end_angle;                     ///< Theta_0 - Omega_0 at B
};

/// The axis at a point, and its section by directions at A.
template <class T>
struct PointField {
  Vector3<T> rs, rss, K, t;
  T a, n, f;        ///< |r_s|^2, |r_s|, rate of transport
  T alpha;          ///< angle of the section against the smallest rotation from A
  T cosine, sine;   ///< cosine and sine of alpha
  T k1, k2, gamma;  ///< curvatures about the section's axes; strain of twist
};

/// The present element.
template <class T, int N>
struct Fields {
  Reduced<T> x;
  SectionTriad<T> a, b;
  Eigen::Matrix<T, N, 1> rates;  ///< rates of transport
  T turn, twist;                 ///< Theta and theta_B
  Several<PointField<T>, N> at;
};

template <class T, class P, int N>
PointField<T> axis_at(const Point<P, N>& p, const Reduced<T>& x, const Vector3<T>& t_a) {
  using std::sqrt;
  PointField<T> at;
  const auto sum = [&x](const Vector3<P>& S) -> Vector3<T> {
    return x.template segment<3>(chord) * S[0] + x.template segment<3>(slope_a) * S[1] +
           x.template segment<3>(slope_b) * S[2];
  };
  at.rs = sum(p.S1);
  at.rss = sum(p.S2);
  at.a = at.rs.dot(at.rs);
  at.n = sqrt(at.a);
  at.t = at.rs / at.n;
  at.K = at.rs.cross(at.rss) / at.a;
  at.f = transport_rate(at.K, at.t, t_a);
  return at;
}

/// Sets angle and strains at a point whose axis is known, in an element of length h.
template <class T, class P, int N>
void set_strain(const Point<P, N>& p, const P& h, const Fields<T, N>& fields, PointField<T>& at) {
  using std::cos, std::sin;
  const T& beta = fields.x[bubble];
  at.alpha = fields.twist * p.xi + beta * bubble_shape(p.xi) + p.angle;
  for (Eigen::Index j = 0; j < fields.rates.size(); ++j) at.alpha += fields.rates[j] * p.transport[j];
  at.cosine = cos(at.alpha);
  at.sine = sin(at.alpha);
  const T P1 = at.K.dot(fields.a.d1) - at.f * at.t.dot(fields.a.d1);
  const T P2 = at.K.dot(fields.a.d2) - at.f * at.t.dot(fields.a.d2);
  at.k1 = P1 * at.cosine + P2 * at.sine;
  at.k2 = P2 * at.cosine - P1 * at.sine;
  at.gamma = (fields.twist + beta * bubble_slope(p.xi)) / h;
}

/// The fields of an element. `near`: an approximate turn, to choose between angles 2 pi apart [rad].
template <class T, class P, int N>
Fields<T, N> fields_of(const Drawing<P, N>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
                       double near, const Reduced<T>& x) {
  Fields<T, N> fields;
  fields.x = x;
  fields.a = section_at_node<T>(charts[0], x.template segment<3>(slope_a), x[angle_a]);
  fields.b = section_at_node<T>(charts[1], x.template segment<3>(slope_b), x[angle_b]);
  const std::size_t n = drawing.points.size();
  if constexpr (N == Eigen::Dynamic) {
    fields.rates.resize(static_cast<Eigen::Index>(n));
    fields.at.resize(n);
  }
  fields.turn = SectionTurn<T>(fields.a, fields.b, near).angle;
  fields.twist = fields.turn - drawing.end_angle;
  for (std::size_t g = 0; g < n; ++g) {
    fields.at[g] = axis_at<T>(drawing.points[g], x, fields.a.t);
    fields.rates[g] = fields.at[g].f;
    fields.twist -= fields.rates[g] * drawing.weights[g];
  }
  for (std::size_t g = 0; g < n; ++g) set_strain<T>(drawing.points[g], drawing.h, fields, fields.at[g]);
  return fields;
}

/// The section at a point whose strain is known.
template <class T, int N>
SectionTriad<T> section_at(const Fields<T, N>& fields, const PointField<T>& at) {
  return carried_section<T>(fields.a, at.t, at.alpha);
}

/// The gradient of the turn of section b against a: it varies by this times the spin of b less that of a.
template <class T>
Vector3<T> turn_gradient(const Vector3<T>& t_a, const Vector3<T>& t_b) {
  return (t_a + t_b) / (1.0 + t_a.dot(t_b));
}

template <class T>
void add_node_force(const Eigen::Matrix3d& chart, int end, const Vector3<T>& mu, const Reduced<T>& x,
                    Reduced<T>& f) {
  const Eigen::Matrix<T, 4, 1> force = node_force<T>(chart, x.template segment<3>(slope_of(end)), mu);
  f.template segment<3>(slope_of(end)) += force.template head<3>();
  f[angle_of(end)] += force[3];
}

/// The derivative by x of sum_g w_g (M1 k1 + M2 k2 + Mt gamma) + on_twist theta_B at fixed moments: the chain
/// rule backwards through fields_of.
template <class T, class P, int N, class Moments>
Reduced<T> gradient_of(const Drawing<P, N>& drawing, const std::array<Eigen::Matrix3d, 2>& charts,
                       const Fields<T, N>& fields, const Moments& moments, const T& on_twist) {
  const SectionTriad<T>&a = fields.a, &b = fields.b;
  const std::size_t n = drawing.points.size();
  Reduced<T> force = Reduced<T>::Zero();
  std::remove_const_t<decltype(fields.rates)> F1 = fields.rates, F2 = F1, Q = F1;
  T twist_force = on_twist;
  for (std::size_t g = 0; g < n; ++g) {
    const PointField<T>& p = fields.at[g];
    const P &w = drawing.weights[g], &xi = drawing.points[g].xi, w_by_h = w / drawing.h;
    const auto& [M1, M2, Mt] = moments[g];
    F1[g] = (M1 * p.cosine - M2 * p.sine) * w;
    F2[g] = (M1 * p.sine + M2 * p.cosine) * w;
    Q[g] = (M1 * p.k2 - M2 * p.k1) * w;
    twist_force += Q[g] * xi + Mt * w_by_h;
    force[bubble] += Q[g] * bubble_shape(xi) + Mt * P(w_by_h * bubble_slope(xi));
  }
  // Moments on the triad of A.
  Vector3<T> on_d1 = Vector3<T>::Zero(), on_d2 = Vector3<T>::Zero(), on_t = Vector3<T>::Zero();
  for (std::size_t j = 0; j < n; ++j) {
    const PointField<T>& p = fields.at[j];
    T y = -(twist_force * drawing.weights[j]);
    for (std::size_t g = 0; g < n; ++g) y += Q[g] * drawing.points[g].transport[j];
    y = (y - F1[j] * p.t.dot(a.d1) - F2[j] * p.t.dot(a.d2)) / (1.0 + p.t.dot(a.t));
    const Vector3<T> on_K = F1[j] * a.d1 + F2[j] * a.d2 + y * a.t, on_tangent = -p.f * on_K;
    const Vector3<T> u = p.K - p.f * p.t;
    const Vector3<T> on_rs = p.rss.cross(on_K) / p.a - p.rs * (2.0 * p.K.dot(on_K) / p.a) +
                             (on_tangent - p.t * p.t.dot(on_tangent)) / p.n;
    const Vector3<T> on_rss = on_K.cross(p.rs) / p.a;
    for (int k = 0; k < 3; ++k)
      force.template segment<3>(3 * k) += on_rs * drawing.points[j].S1[k] + on_rss * drawing.points[j].S2[k];
    on_d1 += F1[j] * u;
    on_d2 += F2[j] * u;
    on_t += y * u;
  }
  const Vector3<T> on_turn = twist_force * turn_gradient<T>(a.t, b.t);
  const Vector3<T> on_a = a.d1.cross(on_d1) + a.d2.cross(on_d2) + a.t.cross(on_t) - on_turn;
  add_node_force<T>(charts[0], 0, on_a, fields.x, force);
  add_node_force<T>(charts[1], 1, on_turn, fields.x, force);
  return force;
}

/// A vector of variables.
template <int N, class T>
Eigen::Matrix<Dual<N, T>, N, 1> variables(const Eigen::Matrix<T, N, 1>& x, double seed = 1) {
  Eigen::Matrix<Dual<N, T>, N, 1> y;
  for (int i = 0; i < N; ++i) y[i] = Dual<N, T>::variable(x[i], i, T(seed));
  return y;
}

/// The vector x + v dt, with the derivative by time.
template <class T, int N>
Eigen::Matrix<Dual<1, T>, N, 1> moving(const Eigen::Matrix<T, N, 1>& x, const Eigen::Matrix<T, N, 1>& v) {
  Eigen::Matrix<Dual<1, T>, N, 1> y;
  for (int i = 0; i < N; ++i) y[i] = Dual<1, T>::variable(x[i], 0, v[i]);
  return y;
}

/// The derivatives that a vector of dual numbers carries.
template <int N>
Eigen::Matrix<double, N, N> derivatives(const Eigen::Matrix<Dual<N>, N, 1>& x) {
  Eigen::Matrix<double, N, N> gradient;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) gradient(i, j) = x[i].d[j];
  return gradient;
}

}  // namespace nurbeam::twist
