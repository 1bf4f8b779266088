#include "fem/element/twist_element.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

constexpr double smallest_cosine = -0.5;  ///< of a tangent with its chart's, and with the one at A
constexpr double largest_turn = 3;        ///< of the turn from its reference [rad]

// int_0^xi of the Lagrange polynomials of the Gauss points on [0, 1].
Eigen::Matrix<double, GaussRule::size, 1> integrated_lagrange(double xi) {
  constexpr auto& x = GaussRule::points;
  Eigen::Matrix<double, GaussRule::size, 1> integral;
  for (int j = 0; j < GaussRule::size; ++j) {
    integral[j] = 0;
    for (int k = 0; k < GaussRule::size; ++k) {  // exact: they are of degree 4
      double L = 1;
      for (int i = 0; i < GaussRule::size; ++i)
        if (i != j) L *= (xi * x[k] - x[i]) / (x[j] - x[i]);
      integral[j] += xi * GaussRule::weights[k] * L;
    }
  }
  return integral;
}

double bubble(double xi) { return 4 * xi * (1 - xi); }
double bubble_slope(double xi) { return 4 * (1 - 2 * xi); }

SectionTriad<double> triad(const DrawnSection& section) { return {section.d1, section.d2, section.t}; }

const BeamProperties& checked(const ReferenceCurve& curve, const BeamProperties& properties) {
  if (!curve.has_sections() || !properties.sections)
    throw std::invalid_argument(
        "a beam with torsion needs the orientation and the stiffness of its sections");
  const SectionStiffness& k = *properties.sections;
  if (!(k.bending_1 > 0 && k.bending_1 * k.bending_2 > k.bending_product * k.bending_product &&
        k.torsion > 0 && k.spin_inertia > 0))
    throw std::invalid_argument(
        "the sections of a beam with torsion need positive inertia and stiffness, got EI1 = " +
        text_of(k.bending_1) + ", EI2 = " + text_of(k.bending_2) + ", EI12 = " + text_of(k.bending_product) +
        ", GJ = " + text_of(k.torsion) + " N m^2 and " + text_of(k.spin_inertia) + " kg m");
  if (properties.curvature != CurvatureMeasure::material)
    throw std::invalid_argument("a beam with torsion has the material curvature");
  return properties;
}

std::array<Eigen::Matrix3d, 2> drawn_charts(const ReferenceCurve& curve, const BeamProperties& properties,
                                            double s_a, double s_b) {
  checked(curve, properties);
  return {triad(curve.section(s_a)).matrix(), triad(curve.section(s_b, true)).matrix()};
}

// Where the reduced coordinates stand.
enum { chord = 0, slope_a = 3, slope_b = 6, angle_a = 9, angle_b = 10, bubble_amount = 11 };
constexpr int slope_of(int end) { return end == 0 ? slope_a : slope_b; }
constexpr int angle_of(int end) { return angle_a + end; }

Eigen::Matrix<double, 12, 1> reduced_of(const TwistLayout::Coordinates& q) {
  Eigen::Matrix<double, 12, 1> x;
  x << q.segment<3>(TwistLayout::r(1)) - q.segment<3>(TwistLayout::r(0)), q.segment<3>(TwistLayout::slope(0)),
      q.segment<3>(TwistLayout::slope(1)), q.tail<3>();
  return x;
}

// The rows of the element's coordinates that a reduced row becomes, and with which sign.
struct Spread {
  int row;
  double sign;
};
std::array<Spread, 2> spread(int i) {
  if (i < slope_a) return {{{TwistLayout::r(1) + i, 1}, {TwistLayout::r(0) + i, -1}}};
  if (i < slope_b) return {{{TwistLayout::slope(0) + i - slope_a, 1}, {0, 0}}};
  if (i < angle_a) return {{{TwistLayout::slope(1) + i - slope_b, 1}, {0, 0}}};
  return {{{TwistLayout::angle(0) + i - angle_a, 1}, {0, 0}}};
}

TwistLayout::Coordinates spread_out(const Eigen::Matrix<double, 12, 1>& x) {
  TwistLayout::Coordinates q = TwistLayout::Coordinates::Zero();
  for (int i = 0; i < 12; ++i)
    for (const auto& [row, sign] : spread(i)) q[row] += sign * x[i];
  return q;
}

TwistLayout::Matrix spread_out(const Eigen::Matrix<double, 12, 12>& reduced) {
  TwistLayout::Matrix K = TwistLayout::Matrix::Zero();
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (const auto& [row, sign] : spread(i))
        for (const auto& [column, other_sign] : spread(j))
          K(row, column) += sign * other_sign * reduced(i, j);
  return K;
}

/// The derivatives that a vector carries.
template <int N>
Eigen::Matrix<double, N, N> derivatives(const Eigen::Matrix<Dual<N>, N, 1>& x) {
  Eigen::Matrix<double, N, N> gradient;
  for (int i = 0; i < N; ++i)
    for (int j = 0; j < N; ++j) gradient(i, j) = x[i].d[j];
  return gradient;
}

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& a) {
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  A(2, 1) = a.x();
  A(1, 2) = -a.x();
  A(0, 2) = a.y();
  A(2, 0) = -a.y();
  A(1, 0) = a.z();
  A(0, 1) = -a.z();
  return A;
}

template <int N, class T>
Eigen::Matrix<Dual<N, T>, N, 1> variables(const Eigen::Matrix<T, N, 1>& x, double seed = 1) {
  Eigen::Matrix<Dual<N, T>, N, 1> y;
  for (int i = 0; i < N; ++i) y[i] = Dual<N, T>::variable(x[i], i, T(seed));
  return y;
}

// x + v dt.
template <class T>
Eigen::Matrix<Dual<1, T>, 12, 1> moving(const Eigen::Matrix<T, 12, 1>& x, const Eigen::Matrix<T, 12, 1>& v) {
  Eigen::Matrix<Dual<1, T>, 12, 1> y;
  for (int i = 0; i < 12; ++i) y[i] = Dual<1, T>::variable(x[i], 0, v[i]);
  return y;
}

using ReducedMatrix = Eigen::Matrix<double, 12, 12>;

// Of the turn of section b against a, by their spins.
template <class T>
struct TurnGradient {
  Vector3<T> on_a, on_b;

  TurnGradient(const SectionTriad<T>& a, const SectionTriad<T>& b) {
    const T S = a.d2.dot(b.d1) - a.d1.dot(b.d2), C = a.d1.dot(b.d1) + a.d2.dot(b.d2);
    const T square = S * S + C * C, by_S = C / square, by_C = -S / square;
    on_a = a.d1.cross(by_C * b.d1 - by_S * b.d2) + a.d2.cross(by_S * b.d1 + by_C * b.d2);
    on_b = b.d1.cross(by_S * a.d2 + by_C * a.d1) + b.d2.cross(by_C * a.d2 - by_S * a.d1);
  }
};

// (r_s, angle) of an end.
Eigen::Vector4d node_part(const Eigen::Matrix<double, 12, 1>& x, int end) {
  const int i = slope_of(end);
  return {x[i], x[i + 1], x[i + 2], x[angle_of(end)]};
}

// The spin w = theta' + c . r_s' of a node about its tangent, its rate and turn = (dt/dt x t)/|r_s|, with
// their derivatives: c = -(m x r_s)/d, d = |r_s|^2 + |r_s| r_s . m.
struct NodeSpin {
  double rate, second;
  Eigen::Vector3d c, turn;
  Eigen::Vector3d rate_rs, second_rs,
      second_v;  // by r_s and r_s'; by the angles' rates they are 1, and c by r_s''
  Eigen::Matrix3d c_rs, turn_rs, turn_v;

  NodeSpin(const Eigen::Matrix3d& chart, const Eigen::Vector4d& q, const Eigen::Vector4d& velocity,
           const Eigen::Vector4d& acceleration) {
    const Eigen::Vector3d m = chart.col(2), rs = q.head<3>(), v = velocity.head<3>(),
                          a = acceleration.head<3>();
    const double square = rs.squaredNorm(), n = std::sqrt(square), cubed = square * n, along = rs.dot(m);
    const Eigen::Vector3d t = rs / n;
    const double d = square + n * along;
    const Eigen::Vector3d d_rs = 2 * rs + along * t + n * m;
    const double d_v = d_rs.dot(v);
    const Eigen::Vector3d d_rs_v = 2 * v + t.dot(v) * m + along / n * (v - t.dot(v) * t) + m.dot(v) * t;
    c = rs.cross(m) / d;
    c_rs = -(cross_matrix(m) + c * d_rs.transpose()) / d;
    const double c_v = c.dot(v);
    rate = velocity[3] + c_v;
    rate_rs = c_rs.transpose() * v;
    second = acceleration[3] + c.dot(a) - c_v * d_v / d;
    second_rs = c_rs.transpose() * a - (d_v * rate_rs + c_v * d_rs_v - c_v * d_v / d * d_rs) / d;
    second_v = c_rs * v + rate_rs;
    turn = v.cross(rs) / cubed;
    turn_rs = cross_matrix(v) / cubed - 3 / square * turn * rs.transpose();
    turn_v = -cross_matrix(rs) / cubed;
  }
};

// That of the inertia of spin (spin_force) with `mass` on both spins and the bubble's rate.
ReducedMatrix spin_tangent(const std::array<Eigen::Matrix3d, 2>& charts, const Eigen::Matrix3d& mass,
                           const Eigen::Matrix<double, 12, 1>& q, const Eigen::Matrix<double, 12, 1>& v,
                           const Eigen::Matrix<double, 12, 1>& a, const TangentWeights& w) {
  using Rows = Eigen::Matrix<double, 3, 12>;
  const std::array<NodeSpin, 2> nodes{NodeSpin(charts[0], node_part(q, 0), node_part(v, 0), node_part(a, 0)),
                                      NodeSpin(charts[1], node_part(q, 1), node_part(v, 1), node_part(a, 1))};
  Rows spins_x = Rows::Zero(), second_x = Rows::Zero();
  for (const int end : {0, 1}) {
    const NodeSpin& node = nodes[end];
    const int i = slope_of(end), k = angle_of(end);
    spins_x.block<1, 3>(end, i) = (w.stiffness * node.rate_rs + w.damping * node.c).transpose();
    spins_x(end, k) = w.damping;
    second_x.block<1, 3>(end, i) =
        (w.stiffness * node.second_rs + w.damping * node.second_v + w.mass * node.c).transpose();
    second_x(end, k) = w.mass;
  }
  spins_x(2, bubble_amount) = w.damping;
  second_x(2, bubble_amount) = w.mass;
  const Eigen::Vector3d p = mass * Eigen::Vector3d(nodes[0].rate, nodes[1].rate, v[bubble_amount]);
  const Eigen::Vector3d p_rate = mass * Eigen::Vector3d(nodes[0].second, nodes[1].second, a[bubble_amount]);
  const Rows p_x = mass * spins_x, p_rate_x = mass * second_x;
  ReducedMatrix K = ReducedMatrix::Zero();
  for (const int end : {0, 1}) {
    const NodeSpin& node = nodes[end];
    const int i = slope_of(end);
    K.middleRows<3>(i) = node.c * p_rate_x.row(end) + node.turn * p_x.row(end);
    K.block<3, 3>(i, i) +=
        w.stiffness * (p_rate[end] * node.c_rs + p[end] * node.turn_rs) + w.damping * p[end] * node.turn_v;
    K.row(angle_of(end)) = p_rate_x.row(end);
  }
  K.row(bubble_amount) = p_rate_x.row(2);
  return K;
}

template <class T>
void add_node_force(const Eigen::Matrix3d& chart, int end, const Vector3<T>& mu,
                    const Eigen::Matrix<T, 12, 1>& x, Eigen::Matrix<T, 12, 1>& f) {
  const Eigen::Matrix<T, 4, 1> force = node_force<T>(chart, x.template segment<3>(slope_of(end)), mu);
  f.template segment<3>(slope_of(end)) += force.template head<3>();
  f[angle_of(end)] += force[3];
}

}  // namespace

// The axis at a point, and its section in the directions of the one at A.
template <class T>
struct TwistElement::PointField {
  Vector3<T> rs, rss, K, t;
  T a, n, f;        // |r_s|^2, |r_s|, rate of transport
  T alpha;          // against the smallest rotation from A
  T cosine, sine;   // of alpha
  T k1, k2, gamma;  // curvatures about the section's axes; strain of twist
};

template <class T>
struct TwistElement::Fields {
  Reduced<T> x;
  SectionTriad<T> a, b;
  Eigen::Matrix<T, points, 1> rates;  // of transport
  T twist;                            // theta_B
  std::array<PointField<T>, points> at;

  ReducedMatrix stiffness(const TwistElement& element) const;
  void add_node_stiffness(const TwistElement& element, const Eigen::Vector3d& moment, double twist_force,
                          ReducedMatrix& H) const;
};

TwistElement::TwistElement(const ReferenceCurve& curve, const BeamProperties& properties, const Chart& chart,
                           double s_a, double s_b)
    : TwistElement(curve, properties, chart, s_a, s_b, drawn_charts(curve, properties, s_a, s_b), 0) {
  turn_ = drawn_turn_;
}

TwistElement::TwistElement(const ReferenceCurve& curve, const BeamProperties& properties, const Chart& chart,
                           double s_a, double s_b, const std::array<SectionChart, 2>& charts, double turn)
    : curve_(&curve),
      properties_(&checked(curve, properties)),
      chart_(chart),
      s_a_(s_a),
      h_(s_b - s_a),
      charts_(charts),
      turn_(turn) {
  const DrawnSection drawn_a = curve.section(s_a), drawn_b = curve.section(s_b, true);
  Reduced<double> drawn = Reduced<double>::Zero();
  drawn.segment<3>(chord) = curve.position(s_b) - curve.position(s_a);
  drawn.segment<3>(slope_a) = drawn_a.t;
  drawn.segment<3>(slope_b) = drawn_b.t;
  const ElementBasis<double> basis(curve, chart, s_a, s_b);
  for (int g = 0; g < points; ++g) {
    Point& p = points_[g];
    const ShapeFunctions<double> shape = basis.at(s_a + h_ * GaussRule::points[g]);
    p.S1 << shape.d1[2], shape.d1[1], shape.d1[3];
    p.S2 << shape.d2[2], shape.d2[1], shape.d2[3];
    drawn_rates_[g] = axis_at<double>(p, drawn, drawn_a.t).f;
  }
  for (int g = 0; g < points; ++g) points_[g] = point_at(s_a + h_ * GaussRule::points[g]);
  const Point b = point_at(s_b);
  drawn_transport_ = h_ * b.transport.dot(drawn_rates_);
  drawn_turn_ = b.angle + drawn_transport_;
  spin_mass_.setZero();
  for (int g = 0; g < points; ++g) {
    const double xi = GaussRule::points[g];
    const Eigen::Vector3d N(1 - xi, xi, bubble(xi));
    spin_mass_ += properties.sections->spin_inertia * h_ * GaussRule::weights[g] * N * N.transpose();
  }
}

TwistElement::Point TwistElement::point_at(double s) const {
  const double s_b = s_a_ + h_;
  const ShapeFunctions<double> shape = ElementBasis<double>(*curve_, chart_, s_a_, s_b).at(s);
  const DrawnSection at_a = curve_->section(s_a_), here = curve_->section(s, s > s_a_ + h_ / 2);
  Point p;
  p.xi = (s - s_a_) / h_;
  p.S1 << shape.d1[2], shape.d1[1], shape.d1[3];
  p.S2 << shape.d2[2], shape.d2[1], shape.d2[3];
  p.transport = integrated_lagrange(p.xi);
  const double transport = h_ * p.transport.dot(drawn_rates_);
  const double near = curve_->section_turn(s_a_, s) + transport;
  p.angle = SectionTurn<double>(triad(at_a), triad(here), near).angle - transport;
  const Eigen::Vector3d K = curve_->straight() ? Eigen::Vector3d::Zero() : here.curvature;
  p.k1 = K.dot(here.d1);
  p.k2 = K.dot(here.d2);
  return p;
}

template <class T>
TwistElement::PointField<T> TwistElement::axis_at(const Point& p, const Reduced<T>& x,
                                                  const Vector3<T>& t_a) const {
  using std::sqrt;
  PointField<T> at;
  const auto sum = [&x](const Eigen::Vector3d& S) -> Vector3<T> {
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

template <class T>
void TwistElement::set_strain(const Point& p, const Fields<T>& fields, const T& beta,
                              PointField<T>& at) const {
  using std::cos, std::sin;
  T transport = 0.0;
  for (int j = 0; j < points; ++j) transport += p.transport[j] * fields.rates[j];
  at.alpha = p.angle + h_ * transport + p.xi * fields.twist + bubble(p.xi) * beta;
  at.cosine = cos(at.alpha);
  at.sine = sin(at.alpha);
  const T P1 = at.K.dot(fields.a.d1) - at.f * at.t.dot(fields.a.d1);
  const T P2 = at.K.dot(fields.a.d2) - at.f * at.t.dot(fields.a.d2);
  at.k1 = P1 * at.cosine + P2 * at.sine;
  at.k2 = P2 * at.cosine - P1 * at.sine;
  at.gamma = (fields.twist + bubble_slope(p.xi) * beta) / h_;
}

template <class T>
TwistElement::Fields<T> TwistElement::fields(const Reduced<T>& x) const {
  Fields<T> fields;
  fields.x = x;
  fields.a = section_at_node<T>(charts_[0], x.template segment<3>(slope_a), x[angle_a]);
  fields.b = section_at_node<T>(charts_[1], x.template segment<3>(slope_b), x[angle_b]);
  T transport = 0.0;
  for (int g = 0; g < points; ++g) {
    fields.at[g] = axis_at<T>(points_[g], x, fields.a.t);
    fields.rates[g] = fields.at[g].f;
    transport += GaussRule::weights[g] * fields.rates[g];
  }
  const SectionTurn<T> turn(fields.a, fields.b, turn_);
  fields.twist = turn.angle - drawn_turn_ - (h_ * transport - drawn_transport_);
  for (int g = 0; g < points; ++g) set_strain<T>(points_[g], fields, x[bubble_amount], fields.at[g]);
  return fields;
}

// dU/dx for the moments at the Gauss points: the chain rule backwards through `fields`.
template <class T>
TwistElement::Reduced<T> TwistElement::gradient(const Fields<T>& fields,
                                                const std::array<SectionMoments<T>, points>& moments) const {
  using std::sqrt;
  const SectionTriad<T>&a = fields.a, &b = fields.b;
  Reduced<T> force = Reduced<T>::Zero();
  std::array<T, points> F1, F2, Q;
  T twist_force = 0.0;  // dU/d(theta_B)
  for (int g = 0; g < points; ++g) {
    const PointField<T>& p = fields.at[g];
    const double w = h_ * GaussRule::weights[g], xi = GaussRule::points[g];
    const auto& [M1, M2, Mt] = moments[g];
    F1[g] = w * (M1 * p.cosine - M2 * p.sine);
    F2[g] = w * (M1 * p.sine + M2 * p.cosine);
    Q[g] = w * (M1 * p.k2 - M2 * p.k1);
    twist_force += xi * Q[g] + (w / h_) * Mt;
    force[bubble_amount] += bubble(xi) * Q[g] + (w / h_ * bubble_slope(xi)) * Mt;
  }
  Vector3<T> on_d1 = Vector3<T>::Zero(), on_d2 = Vector3<T>::Zero(), on_t = Vector3<T>::Zero();  // of A
  for (int j = 0; j < points; ++j) {
    const PointField<T>& p = fields.at[j];
    T y = -GaussRule::weights[j] * twist_force;
    for (int g = 0; g < points; ++g) y += points_[g].transport[j] * Q[g];
    y = (h_ * y - F1[j] * p.t.dot(a.d1) - F2[j] * p.t.dot(a.d2)) / (1.0 + p.t.dot(a.t));
    const Vector3<T> on_K = F1[j] * a.d1 + F2[j] * a.d2 + y * a.t, on_tangent = -p.f * on_K;
    const Vector3<T> u = p.K - p.f * p.t;
    const Vector3<T> on_rs = p.rss.cross(on_K) / p.a - p.rs * (2.0 * p.K.dot(on_K) / p.a) +
                             (on_tangent - p.t * p.t.dot(on_tangent)) / p.n;
    const Vector3<T> on_rss = on_K.cross(p.rs) / p.a;
    for (int k = 0; k < 3; ++k)
      force.template segment<3>(3 * k) += on_rs * points_[j].S1[k] + on_rss * points_[j].S2[k];
    on_d1 += F1[j] * u;
    on_d2 += F2[j] * u;
    on_t += y * u;
  }
  const TurnGradient<T> turn(a, b);
  const Vector3<T> on_a = a.d1.cross(on_d1) + a.d2.cross(on_d2) + a.t.cross(on_t) + twist_force * turn.on_a;
  add_node_force<T>(charts_[0], 0, on_a, fields.x, force);
  add_node_force<T>(charts_[1], 1, twist_force * turn.on_b, fields.x, force);
  return force;
}

template <class T>
auto TwistElement::strain_rates(const Reduced<T>& q, const Reduced<T>& v) const
    -> std::array<SectionStrain<T>, points> {
  const Fields<Dual<1, T>> moving_fields = fields<Dual<1, T>>(moving<T>(q, v));
  std::array<SectionStrain<T>, points> rates;
  for (int g = 0; g < points; ++g) {
    const PointField<Dual<1, T>>& p = moving_fields.at[g];
    rates[g] = {p.k1.d[0], p.k2.d[0], p.gamma.d[0]};
  }
  return rates;
}

template <class T>
TwistElement::Reduced<T> TwistElement::section_force(const Reduced<T>& q, const Reduced<T>& v) const {
  const Fields<T> at = fields<T>(q);
  const double damping = properties_->damping;
  std::array<SectionStrain<T>, points> strain;
  for (int g = 0; g < points; ++g)
    strain[g] = {at.at[g].k1 - points_[g].k1, at.at[g].k2 - points_[g].k2, at.at[g].gamma};
  if (damping > 0) {
    const std::array<SectionStrain<T>, points> rates = strain_rates<T>(q, v);
    for (int g = 0; g < points; ++g) {
      strain[g].bend_1 += damping * rates[g].bend_1;
      strain[g].bend_2 += damping * rates[g].bend_2;
      strain[g].twist += damping * rates[g].twist;
    }
  }
  std::array<SectionMoments<T>, points> moments;
  for (int g = 0; g < points; ++g) moments[g] = section_moments<T>(*properties_->sections, strain[g]);
  return gradient<T>(at, moments);
}

// With the spins w = (theta' + c . r_s') of both ends and the bubble's rate, p = M w: F_theta = p',
// F_rs = c p' + p (dt/dt x t)/|r_s|, F_beta = p'.
template <class T>
TwistElement::Reduced<T> TwistElement::spin_force(const Reduced<T>& q, const Reduced<T>& v,
                                                  const Reduced<T>& a) const {
  Reduced<T> force = Reduced<T>::Zero();
  std::array<Vector3<T>, 2> c;
  Eigen::Matrix<T, 3, 1> spin, spin_rate;
  for (const int end : {0, 1}) {
    const int i = slope_of(end), k = angle_of(end);
    const Eigen::Matrix<Dual<1, T>, 3, 1> c_moving =
        spin_row<Dual<1, T>>(charts_[end], moving<T>(q, v).template segment<3>(i));
    Vector3<T> c_rate;
    for (int d = 0; d < 3; ++d) {
      c[end][d] = c_moving[d].value;
      c_rate[d] = c_moving[d].d[0];
    }
    spin[end] = v[k] + c[end].dot(v.template segment<3>(i));
    spin_rate[end] = a[k] + c[end].dot(a.template segment<3>(i)) + c_rate.dot(v.template segment<3>(i));
  }
  spin[2] = v[bubble_amount];
  spin_rate[2] = a[bubble_amount];
  const Eigen::Matrix<T, 3, 1> p = spin_mass_.cast<T>() * spin, p_rate = spin_mass_.cast<T>() * spin_rate;
  for (const int end : {0, 1}) {
    using std::sqrt;
    const int i = slope_of(end);
    const Vector3<T> rs = q.template segment<3>(i), rs_rate = v.template segment<3>(i);
    const T square = rs.dot(rs);
    force.template segment<3>(i) =
        c[end] * p_rate[end] + rs_rate.cross(rs) * (p[end] / (square * sqrt(square)));
    force[angle_of(end)] = p_rate[end];
  }
  force[bubble_amount] = p_rate[2];
  return force;
}

// Second derivatives at fixed forces: of the spin at A under `moment`, and of the turn times its force.
template <>
void TwistElement::Fields<double>::add_node_stiffness(const TwistElement& element,
                                                      const Eigen::Vector3d& moment, double twist_force,
                                                      ReducedMatrix& H) const {
  const std::array<SectionChart, 2>& charts = element.charts_;
  Eigen::Matrix<double, 8, 1> nodes;
  nodes << node_part(x, 0), node_part(x, 1);
  const auto nodes_x = variables<8, double>(nodes);
  using T = Dual<8>;
  const Eigen::Matrix<T, 4, 1> node_a = nodes_x.head<4>(), node_b = nodes_x.tail<4>();
  const TurnGradient<T> turn(section_at_node<T>(charts[0], node_a.head<3>(), node_a[3]),
                             section_at_node<T>(charts[1], node_b.head<3>(), node_b[3]));
  const Vector3<T> on_a = twist_force * turn.on_a + moment.cast<T>(), on_b = twist_force * turn.on_b;
  Eigen::Matrix<T, 8, 1> force;
  force << node_force<T>(charts[0], node_a.head<3>(), on_a), node_force<T>(charts[1], node_b.head<3>(), on_b);
  constexpr std::array<int, 8> where{slope_a, slope_a + 1, slope_a + 2, angle_a,
                                     slope_b, slope_b + 1, slope_b + 2, angle_b};
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) H(where[i], where[j]) += force[i].d[j];
}

// d2U/dx2 without damping, in the steps of `gradient`: second derivatives of the strains in the curvatures
// (P1, P2) along the axes of the section at A, in the rates of transport f, in the turn Theta and the bubble;
// those of P1, P2, f in r_s and r_ss as seen from that section; and what its spin adds.
template <>
ReducedMatrix TwistElement::Fields<double>::stiffness(const TwistElement& element) const {
  using Row = Eigen::Matrix<double, 1, reduced>;
  using Rows = Eigen::Matrix<double, 3, reduced>;
  const double h = element.h_;
  const std::array<Point, points>& places = element.points_;
  const SectionStiffness& section = *element.properties_->sections;

  // Spins of both ends by x, and the turn by them.
  std::array<Rows, 2> N{Rows::Zero(), Rows::Zero()};
  for (const int end : {0, 1}) {
    const Eigen::Vector3d rs = x.segment<3>(slope_of(end)), t = end == 0 ? a.t : b.t;
    N[end].middleCols<3>(slope_of(end)) =
        cross_matrix(rs) / rs.squaredNorm() + t * spin_row<double>(element.charts_[end], rs).transpose();
    N[end].col(angle_of(end)) = t;
  }
  const TurnGradient<double> turn(a, b);
  const Row turn_x = turn.on_a.transpose() * N[0] + turn.on_b.transpose() * N[1];

  std::array<Eigen::Matrix<double, 6, reduced>, points> V;  // of (r_s, r_ss), as seen from the section at A
  std::array<Row, points> P1_x, P2_x, f_x;
  std::array<Eigen::Matrix3d, points> T, K_rs;  // derivatives of t and K in r_s
  Row twist_x = turn_x;
  for (int g = 0; g < points; ++g) {
    const PointField<double>& p = at[g];
    V[g].topRows<3>() = cross_matrix(p.rs) * N[0];
    V[g].bottomRows<3>() = cross_matrix(p.rss) * N[0];
    for (int k = 0; k < 3; ++k) {
      V[g].block<3, 3>(0, 3 * k).diagonal().array() += places[g].S1[k];
      V[g].block<3, 3>(3, 3 * k).diagonal().array() += places[g].S2[k];
    }
    T[g] = (Eigen::Matrix3d::Identity() - p.t * p.t.transpose()) / p.n;
    K_rs[g] = (-cross_matrix(p.rss) - 2 * p.K * p.rs.transpose()) / p.a;
    const Rows z_x =
        (K_rs[g] - p.f * T[g]) * V[g].topRows<3>() + cross_matrix(p.rs) / p.a * V[g].bottomRows<3>();
    f_x[g] = a.t.transpose() * z_x / (1 + p.t.dot(a.t));
    P1_x[g] = a.d1.transpose() * z_x - p.t.dot(a.d1) * f_x[g];
    P2_x[g] = a.d2.transpose() * z_x - p.t.dot(a.d2) * f_x[g];
    twist_x -= h * GaussRule::weights[g] * f_x[g];
  }

  ReducedMatrix H = ReducedMatrix::Zero();
  std::array<double, points> F1, F2, Q;
  double twist_force = 0;
  for (int g = 0; g < points; ++g) {
    const PointField<double>& p = at[g];
    const double w = h * GaussRule::weights[g], xi = GaussRule::points[g];
    const auto [M1, M2, Mt] =
        section_moments<double>(section, {p.k1 - places[g].k1, p.k2 - places[g].k2, p.gamma});
    F1[g] = w * (M1 * p.cosine - M2 * p.sine);
    F2[g] = w * (M1 * p.sine + M2 * p.cosine);
    Q[g] = w * (M1 * p.k2 - M2 * p.k1);
    twist_force += xi * Q[g] + w / h * Mt;
    Row alpha_x = xi * twist_x, gamma_x = twist_x / h;
    alpha_x[bubble_amount] += bubble(xi);
    gamma_x[bubble_amount] += bubble_slope(xi) / h;
    for (int j = 0; j < points; ++j) alpha_x += h * places[g].transport[j] * f_x[j];
    Rows strain_x;
    strain_x.row(0) = p.cosine * P1_x[g] + p.sine * P2_x[g] + p.k2 * alpha_x;
    strain_x.row(1) = p.cosine * P2_x[g] - p.sine * P1_x[g] - p.k1 * alpha_x;
    strain_x.row(2) = gamma_x;
    Eigen::Matrix3d C;
    C << section.bending_1, section.bending_product, 0, section.bending_product, section.bending_2, 0, 0, 0,
        section.torsion;
    const Row turned = F1[g] * P2_x[g] - F2[g] * P1_x[g] - w / 2 * (M1 * p.k1 + M2 * p.k2) * alpha_x;
    const Rows moments_x = w * C * strain_x;
    H += strain_x.transpose().lazyProduct(moments_x);
    H += alpha_x.transpose() * turned + turned.transpose() * alpha_x;
  }

  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // on the section at A, of all that turns with it
  Eigen::Matrix3d by_spin = Eigen::Matrix3d::Zero();
  Rows swept = Rows::Zero();
  for (int j = 0; j < points; ++j) {
    const PointField<double>& p = at[j];
    const double opening = 1 + p.t.dot(a.t);
    double y = -GaussRule::weights[j] * twist_force;
    for (int g = 0; g < points; ++g) y += places[g].transport[j] * Q[g];
    y = (h * y - F1[j] * p.t.dot(a.d1) - F2[j] * p.t.dot(a.d2)) / opening;
    const Eigen::Vector3d on_K = F1[j] * a.d1 + F2[j] * a.d2 + y * a.t;
    const double kappa = p.K.dot(on_K);
    const Eigen::Vector3d by_K = (p.rss.cross(on_K) - 2 * kappa * p.rs) / p.a, by_t = -p.f * T[j] * on_K;
    const Eigen::Vector3d on_rs = by_K + by_t, on_rss = on_K.cross(p.rs) / p.a;
    const Eigen::Vector3d y_rs = -T[j] * on_K / opening;
    const Eigen::Vector3d f_rs = (K_rs[j] - p.f * T[j]).transpose() * a.t / opening;
    const Eigen::Vector3d kappa_rs = K_rs[j].transpose() * on_K + p.K.dot(a.t) * y_rs;
    const double on_t_along = -p.f * on_K.dot(p.t);
    Eigen::Matrix<double, 6, 6> second = Eigen::Matrix<double, 6, 6>::Zero();
    second.topLeftCorner<3, 3>() = (p.rss.cross(a.t) * y_rs.transpose() - 2 * p.rs * kappa_rs.transpose() -
                                    2 * by_K * p.rs.transpose()) /
                                       p.a -
                                   T[j] * (on_K * f_rs.transpose() + p.f * a.t * y_rs.transpose()) -
                                   (on_t_along * T[j] + p.t * by_t.transpose()) / p.n -
                                   by_t * p.rs.transpose() / p.a;
    second.topLeftCorner<3, 3>().diagonal().array() -= 2 * kappa / p.a;
    second.bottomLeftCorner<3, 3>() =
        (a.t.cross(p.rs) * y_rs.transpose() + cross_matrix(on_K) - 2 * on_rss * p.rs.transpose()) / p.a;
    second.topRightCorner<3, 3>() = second.bottomLeftCorner<3, 3>().transpose();
    const Eigen::Matrix<double, 6, reduced> forces_x = second.lazyProduct(V[j]);
    H += V[j].transpose().lazyProduct(forces_x);
    moment -= p.rs.cross(on_rs) + p.rss.cross(on_rss);
    by_spin += cross_matrix(p.rs) * cross_matrix(on_rs) + cross_matrix(p.rss) * cross_matrix(on_rss);
    for (int k = 0; k < 3; ++k)
      swept.middleCols<3>(3 * k) +=
          places[j].S1[k] * cross_matrix(on_rs) + places[j].S2[k] * cross_matrix(on_rss);
  }
  const Rows turned_x = by_spin * N[0];
  const ReducedMatrix crossed = N[0].transpose().lazyProduct(swept);
  H += crossed + crossed.transpose();
  H += N[0].transpose().lazyProduct(turned_x);
  add_node_stiffness(element, moment, twist_force, H);
  return H;
}

TwistElement::Coordinates TwistElement::force(const TwistState& x) const {
  const Reduced<double> q = reduced_of(x.q), v = reduced_of(x.v), a = reduced_of(x.a);
  const Reduced<double> force = section_force<double>(q, v) + spin_force<double>(q, v, a);
  return spread_out(force);
}

TwistElement::Matrix TwistElement::tangent(const TwistState& x, const TangentWeights& w) const {
  const Reduced<double> q = reduced_of(x.q), v = reduced_of(x.v), a = reduced_of(x.a);
  ReducedMatrix K = spin_tangent(charts_, spin_mass_, q, v, a, w);
  if (properties_->damping > 0 && (w.stiffness != 0 || w.damping != 0))
    K += derivatives<reduced>(section_force<Dual<reduced>>(variables<reduced, double>(q, w.stiffness),
                                                           variables<reduced, double>(v, w.damping)));
  else if (w.stiffness != 0)
    K += w.stiffness * fields<double>(q).stiffness(*this);
  return spread_out(K);
}

TwistEnergy TwistElement::energy(const TwistState& x) const {
  const Reduced<double> q = reduced_of(x.q), v = reduced_of(x.v);
  const Fields<double> at = fields<double>(q);
  const SectionStiffness& stiffness = *properties_->sections;
  TwistEnergy sum;
  std::array<SectionStrain<double>, points> rates{};
  if (properties_->damping > 0) rates = strain_rates<double>(q, v);
  for (int g = 0; g < points; ++g) {
    const double w = h_ * GaussRule::weights[g];
    const SectionStrain<double> e{at.at[g].k1 - points_[g].k1, at.at[g].k2 - points_[g].k2, at.at[g].gamma};
    const SectionMoments<double> M = section_moments(stiffness, e);
    sum.bending += w / 2 * (M.bending_1 * e.bend_1 + M.bending_2 * e.bend_2);
    sum.torsion += w / 2 * M.torque * e.twist;
    const SectionStrain<double>& rate = rates[g];
    const SectionMoments<double> viscous = section_moments(stiffness, rate);
    sum.dissipation +=
        properties_->damping * w *
        (viscous.bending_1 * rate.bend_1 + viscous.bending_2 * rate.bend_2 + viscous.torque * rate.twist);
  }
  const Eigen::Vector3d spins(spin(x, 0), spin(x, 1), v[bubble_amount]);
  sum.kinetic = spins.dot(spin_mass_ * spins) / 2;
  return sum;
}

double TwistElement::spin(const TwistState& x, int end) const {
  const Eigen::Vector3d rs = x.q.segment<3>(TwistLayout::slope(end));
  return x.v[TwistLayout::angle(end)] +
         spin_row<double>(charts_[end], rs).dot(x.v.segment<3>(TwistLayout::slope(end)));
}

SectionTriad<double> TwistElement::end_section(const Coordinates& q, int end) const {
  return section_at_node<double>(charts_[end], q.segment<3>(TwistLayout::slope(end)),
                                 q[TwistLayout::angle(end)]);
}

// The inverse of node_force: on_slope = (mu x r_s)/|r_s|^2 + (mu . t) c, on_angle = mu . t.
Eigen::Vector3d TwistElement::end_moment(const Coordinates& q, int end, const Eigen::Vector3d& on_slope,
                                         double on_angle) const {
  const Eigen::Vector3d rs = q.segment<3>(TwistLayout::slope(end));
  return rs.cross(on_slope - on_angle * spin_row<double>(charts_[end], rs)) + on_angle * rs.normalized();
}

double TwistElement::turn(const Coordinates& q) const {
  return SectionTurn<double>(end_section(q, 0), end_section(q, 1), turn_).angle;
}

// Whether the tangents are within that cosine of their charts', and the turn that near to its reference.
bool TwistElement::near_charts(const Coordinates& q, double cosine, double turn_reach) const {
  for (const int end : {0, 1})
    if (!(end_section(q, end).t.dot(charts_[end].col(2)) > cosine)) return false;
  return std::abs(turn(q) - turn_) < turn_reach;
}

bool TwistElement::should_recentre(const Coordinates& q) const { return !near_charts(q, 0.5, 2); }

bool TwistElement::admissible(const Coordinates& q) const {
  if (!near_charts(q, smallest_cosine, largest_turn)) return false;
  const Reduced<double> x = reduced_of(q);
  const Eigen::Vector3d t_a = end_section(q, 0).t;
  if (!(t_a.dot(end_section(q, 1).t) > smallest_cosine)) return false;
  return std::all_of(points_.begin(), points_.end(),
                     [&](const Point& p) { return axis_at<double>(p, x, t_a).t.dot(t_a) > smallest_cosine; });
}

SectionPoint TwistElement::section(const Coordinates& q, double s) const {
  const Point p = point_at(s);
  const Reduced<double> x = reduced_of(q);
  const Fields<double> all = fields<double>(x);
  PointField<double> at = axis_at<double>(p, x, all.a.t);
  set_strain<double>(p, all, x[bubble_amount], at);
  const SectionStrain<double> strain{at.k1 - p.k1, at.k2 - p.k2, at.gamma};
  return {carried_section<double>(all.a, at.t, at.alpha), strain,
          section_moments(*properties_->sections, strain)};
}

// The section's spin is (r_s x dr_s)/|r_s|^2 + t dw, dw = d(alpha) + [(t_A x dt_A + t_A dw_A) . (t_A + t)
// - t_A . (t x dt)]/(1 + t . t_A): its rows are taken by dual numbers.
template <class T>
TwistElement::Reduced<T> TwistElement::moment_on(const Point& p, const Reduced<T>& q,
                                                 const Eigen::Vector3d& components, bool follower) const {
  using D = Dual<reduced, T>;
  const Reduced<D> x = variables<reduced, T>(q);
  const Fields<D> all = fields<D>(x);
  PointField<D> at = axis_at<D>(p, x, all.a.t);
  set_strain<D>(p, all, x[bubble_amount], at);
  const auto values = [](const Vector3<D>& y) { return Vector3<T>(y[0].value, y[1].value, y[2].value); };
  const auto derivative = [](const Vector3<D>& y, int i) {
    return Vector3<T>(y[0].d[i], y[1].d[i], y[2].d[i]);
  };
  const Vector3<T> t = values(at.t), t_a = values(all.a.t), rs = values(at.rs);
  Vector3<T> moment = components.cast<T>();
  if (follower) {
    const SectionTriad<T> a{values(all.a.d1), values(all.a.d2), t_a};
    moment = carried_section<T>(a, t, at.alpha.value).matrix() * components.cast<T>();
  }
  const Vector3<T> c_a = spin_row<T>(charts_[0], q.template segment<3>(slope_a));
  const T along = moment.dot(t), opening = 1.0 + t.dot(t_a);
  Reduced<T> force;
  for (int i = 0; i < reduced; ++i) {
    T spin_a = i == angle_a ? 1.0 : 0.0;
    if (i >= slope_a && i < slope_b) spin_a = c_a[i - slope_a];
    const Vector3<T> swing_a = t_a.cross(derivative(all.a.t, i)) + t_a * spin_a;
    const T spin = at.alpha.d[i] + (swing_a.dot(t_a + t) - t_a.dot(t.cross(derivative(at.t, i)))) / opening;
    force[i] = moment.dot(rs.cross(derivative(at.rs, i))) / rs.dot(rs) + along * spin;
  }
  return force;
}

// Along the axes of the drawn section at s.
Eigen::Vector3d TwistElement::drawn_components(double s, const Eigen::Vector3d& vector) const {
  return triad(curve_->section(s, s > s_a_ + h_ / 2)).matrix().transpose() * vector;
}

TwistElement::TurnedWithSection TwistElement::turned(const Coordinates& q, double s,
                                                     const Eigen::Vector3d& drawn) const {
  using T = Dual<reduced>;
  const Point p = point_at(s);
  const Reduced<T> x = variables<reduced, double>(reduced_of(q));
  const Fields<T> all = fields<T>(x);
  PointField<T> at = axis_at<T>(p, x, all.a.t);
  set_strain<T>(p, all, x[bubble_amount], at);
  const Vector3<T> turned =
      carried_section<T>(all.a, at.t, at.alpha).matrix() * drawn_components(s, drawn).cast<T>();
  TurnedWithSection result{Eigen::Vector3d::Zero(), Eigen::Matrix<double, 3, TwistLayout::size>::Zero()};
  for (int d = 0; d < 3; ++d) {
    result.value[d] = turned[d].value;
    result.gradient.row(d) = spread_out(Reduced<double>(turned[d].d.data())).transpose();
  }
  return result;
}

TwistElement::Coordinates TwistElement::moment_force(const Coordinates& q, double s,
                                                     const Eigen::Vector3d& moment, bool follower) const {
  const Eigen::Vector3d components = follower ? drawn_components(s, moment) : moment;
  return spread_out(moment_on<double>(point_at(s), reduced_of(q), components, follower));
}

TwistElement::Matrix TwistElement::moment_gradient(const Coordinates& q, double s,
                                                   const Eigen::Vector3d& moment, bool follower) const {
  const Eigen::Vector3d components = follower ? drawn_components(s, moment) : moment;
  return spread_out(derivatives<reduced>(moment_on<Dual<reduced>>(
      point_at(s), variables<reduced, double>(reduced_of(q)), components, follower)));
}

}  // namespace nurbeam
