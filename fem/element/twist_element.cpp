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

// The derivatives that a reduced vector carries.
TwistLayout::Matrix spread_derivatives(const Eigen::Matrix<Dual<12>, 12, 1>& x) {
  TwistLayout::Matrix K = TwistLayout::Matrix::Zero();
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j)
      for (const auto& [row, sign] : spread(i))
        for (const auto& [column, other_sign] : spread(j)) K(row, column) += sign * other_sign * x[i].d[j];
  return K;
}

template <class T>
Eigen::Matrix<Dual<12, T>, 12, 1> variables(const Eigen::Matrix<T, 12, 1>& x, double seed = 1) {
  Eigen::Matrix<Dual<12, T>, 12, 1> y;
  for (int i = 0; i < 12; ++i) y[i] = Dual<12, T>::variable(x[i], i, T(seed));
  return y;
}

// x + v dt.
template <class T>
Eigen::Matrix<Dual<1, T>, 12, 1> moving(const Eigen::Matrix<T, 12, 1>& x, const Eigen::Matrix<T, 12, 1>& v) {
  Eigen::Matrix<Dual<1, T>, 12, 1> y;
  for (int i = 0; i < 12; ++i) y[i] = Dual<1, T>::variable(x[i], 0, v[i]);
  return y;
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
  T S, C;
  Eigen::Matrix<T, points, 1> rates;  // of transport
  T twist;                            // theta_B
  std::array<PointField<T>, points> at;
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
  fields.S = turn.S;
  fields.C = turn.C;
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
  const T square = fields.S * fields.S + fields.C * fields.C;
  const T on_S = twist_force * fields.C / square, on_C = -twist_force * fields.S / square;
  on_d1 += on_C * b.d1 - on_S * b.d2;
  on_d2 += on_S * b.d1 + on_C * b.d2;
  const Vector3<T> on_d1_b = on_S * a.d2 + on_C * a.d1, on_d2_b = on_C * a.d2 - on_S * a.d1;
  add_node_force<T>(charts_[0], 0, a.d1.cross(on_d1) + a.d2.cross(on_d2) + a.t.cross(on_t), fields.x, force);
  add_node_force<T>(charts_[1], 1, b.d1.cross(on_d1_b) + b.d2.cross(on_d2_b), fields.x, force);
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

TwistElement::Coordinates TwistElement::force(const TwistState& x) const {
  const Reduced<double> q = reduced_of(x.q), v = reduced_of(x.v), a = reduced_of(x.a);
  return spread_out(section_force<double>(q, v) + spin_force<double>(q, v, a));
}

TwistElement::Matrix TwistElement::tangent(const TwistState& x, const TangentWeights& w) const {
  using T = Dual<reduced>;
  const auto seeded = [](const Coordinates& y, double seed) {
    return variables<double>(reduced_of(y), seed);
  };
  const Reduced<T> q = seeded(x.q, w.stiffness), v = seeded(x.v, w.damping), a = seeded(x.a, w.mass);
  Reduced<T> force = spin_force<T>(q, v, a);
  if (w.stiffness != 0 || (w.damping != 0 && properties_->damping > 0)) force += section_force<T>(q, v);
  return spread_derivatives(force);
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
  const Reduced<D> x = variables<T>(q);
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
  const Reduced<T> x = variables<double>(reduced_of(q));
  const Fields<T> all = fields<T>(x);
  PointField<T> at = axis_at<T>(p, x, all.a.t);
  set_strain<T>(p, all, x[bubble_amount], at);
  const Vector3<T> turned =
      carried_section<T>(all.a, at.t, at.alpha).matrix() * drawn_components(s, drawn).cast<T>();
  TurnedWithSection result{Eigen::Vector3d::Zero(), Eigen::Matrix<double, 3, TwistLayout::size>::Zero()};
  for (int d = 0; d < 3; ++d) {
    result.value[d] = turned[d].value;
    result.gradient.row(d) = spread_out(Eigen::Map<const Reduced<double>>(turned[d].d.data())).transpose();
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
  return spread_derivatives(
      moment_on<Dual<reduced>>(point_at(s), variables<double>(reduced_of(q)), components, follower));
}

}  // namespace nurbeam
