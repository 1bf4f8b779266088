// The forces of an element with torsion whose ends move over the material.
//
// The drawing is a series in both places (DrawnElement). Dual numbers carry the derivatives of the strains by
// the places and by time.
#include <type_traits>

#include "fem/element/twist_element.h"
#include "fem/element/twist_inertia.h"
#include "fem/element/twist_rows.h"

namespace nurbeam {

namespace {

constexpr int rows = twist::reduced + 2;
template <class T>
using Vector = Eigen::Matrix<T, rows, 1>;

enum Direction { by_a, by_b, by_time, directions };

// Coordinates with rates, and the fields that follow from them. D carries the derivatives by both places at
// fixed nodal values, and the derivative by time.
template <class T>
class Motion {
 public:
  using D = Dual<directions, T>;
  // Forces take first derivatives of the drawing, tangents second ones.
  using Drawn =
      twist::DrawnElement<std::conditional_t<std::is_same_v<T, double>, Dual<2>, twist::PlaceSeries>>;
  using Fields = twist::AnyFields<D>;

  Motion(const Drawn& element, const std::array<Eigen::Matrix3d, 2>& charts, double near,
         const BeamProperties& properties, const Vector<T>& q, const Vector<T>& v, const Vector<T>& a)
      : charts_(charts), near_(near), properties_(properties), q_(q), v_(v), a_(a) {
    Eigen::Matrix<D, rows, 1> x;
    for (int i = 0; i < rows; ++i) x[i] = D::variable(q[i], by_time, v[i]);
    for (const int end : {0, 1}) x[twist::place_a + end].d[by_a + end] = 1.0;
    drawing_ = at_places(element.drawing(), x[twist::place_a], x[twist::place_a + 1]);
    now_ = at_places(element.drawing(), q[twist::place_a], q[twist::place_a + 1]);
    moving_ =
        twist::fields_of<D>(drawing_, charts, near, twist::Reduced<D>(x.template head<twist::reduced>()));
    for (const int end : {0, 1}) {
      const twist::NodeSpin<T> node(charts_[end], end, q_, v_, a_);
      spins_[end] = Rate::variable(node.spin, 0, node.rate) -
                    in_time(drawing_.end_twist[end]) * velocity(twist::place_a + end);
    }
  }

  Vector<T> force() const;
  /// strain(): strain of a point against the drawing; material_rate(): its rate at fixed material.
  SectionStrain<D> strain(std::size_t g) const {
    const twist::PointField<D>& p = moving_.at[g];
    return {p.k1 - drawing_.points[g].k1, p.k2 - drawing_.points[g].k2, p.gamma};
  }
  SectionStrain<T> material_rate(std::size_t g) const;
  double weight(std::size_t g) const { return plain(drawing_.weights[g]); }
  std::size_t points() const { return drawing_.points.size(); }
  double kinetic_energy() const;

 private:
  // A value with its time derivative.
  using Rate = Dual<1, T>;
  static Rate in_time(const D& x) { return Rate::variable(x.value, 0, x.d[by_time]); }
  Rate coordinate(int i) const { return Rate::variable(q_[i], 0, v_[i]); }
  Rate velocity(int i) const { return Rate::variable(v_[i], 0, a_[i]); }

  struct Spin;
  struct SpinMomenta;
  Spin spin(std::size_t g) const;
  SpinMomenta momenta() const;
  SectionStrain<T> strain_slope(std::size_t g) const;
  void add_strain_forces(const T& on_twist, Vector<T>& f) const;
  void add_spin_forces(const SpinMomenta& p, Vector<T>& f) const;

  const std::array<Eigen::Matrix3d, 2>& charts_;
  double near_;
  const BeamProperties& properties_;
  const Vector<T>&q_, &v_, &a_;
  twist::AnyDrawing<D> drawing_;
  twist::AnyDrawing<T> now_;
  Fields moving_;
  // Spins of both ends, without the part that a node sees only as it moves over the drawing.
  std::array<Rate, 2> spins_;
};

// Derivatives of the strains by s in the element.
template <class T>
SectionStrain<T> Motion<T>::strain_slope(std::size_t g) const {
  const auto value = [](const Vector3<D>& y) { return Vector3<T>(y[0].value, y[1].value, y[2].value); };
  const twist::PointField<D>& p = moving_.at[g];
  const auto& slide = now_.slides[g];
  const auto& S3 = slide.S3;
  const auto segment = [&](int first) { return Vector3<T>(q_.template segment<3>(first)); };
  const Vector3<T> rsss =
      segment(twist::chord) * S3[0] + segment(twist::slope_a) * S3[1] + segment(twist::slope_b) * S3[2];
  const Vector3<T> rs = value(p.rs), rss = value(p.rss), K = value(p.K);
  const Vector3<T> K_s = rs.cross(rsss) / p.a.value - K * (2.0 * rs.dot(rss) / p.a.value);
  const SectionTriad<T> a{value(moving_.a.d1), value(moving_.a.d2), value(moving_.a.t)};
  const SectionTriad<T> section = carried_section<T>(a, value(p.t), p.alpha.value);
  const T twist = slide.twist + p.gamma.value, &h = now_.h;
  return {K_s.dot(section.d1) + twist * p.k2.value - slide.k1_s,
          K_s.dot(section.d2) - twist * p.k1.value - slide.k2_s, -8.0 * q_[twist::bubble] / (h * h)};
}

template <class T>
SectionStrain<T> Motion<T>::material_rate(std::size_t g) const {
  const SectionStrain<D> e = strain(g);
  const SectionStrain<T> slope = strain_slope(g);
  const T& slid = drawing_.slides[g].s.d[by_time];
  return {e.bend_1.d[by_time] - slope.bend_1 * slid, e.bend_2.d[by_time] - slope.bend_2 * slid,
          e.twist.d[by_time] - slope.twist * slid};
}

// Forces of the elastic and viscous moments M on the strains e: M de/dq, and on the places the energy
// density. As damping works at fixed material, the work of viscous moments on strains that a point only
// slides past is subtracted.
template <class T>
void Motion<T>::add_strain_forces(const T& on_twist, Vector<T>& f) const {
  const SectionStiffness& stiffness = *properties_.sections;
  const double damping = properties_.damping;
  std::vector<SectionMoments<T>> moments(points());
  for (std::size_t g = 0; g < points(); ++g) {
    const SectionStrain<D> e = strain(g);
    const D& w = drawing_.weights[g];
    SectionMoments<T>& M = moments[g];
    M = section_moments<T>(stiffness, {e.bend_1.value, e.bend_2.value, e.twist.value});
    const auto work = [](const SectionMoments<T>& on, const SectionStrain<T>& y) {
      return T(on.bending_1 * y.bend_1 + on.bending_2 * y.bend_2 + on.torque * y.twist);
    };
    const T density = 0.5 * work(M, {e.bend_1.value, e.bend_2.value, e.twist.value});
    T slid = 0.0;
    if (damping > 0) {
      const SectionMoments<T> viscous = section_moments<T>(stiffness, material_rate(g));
      slid = damping * work(viscous, strain_slope(g)) * w.value;
      M.bending_1 += damping * viscous.bending_1;
      M.bending_2 += damping * viscous.bending_2;
      M.torque += damping * viscous.torque;
    }
    for (const int end : {by_a, by_b})
      f[twist::place_a + end] += work(M, {e.bend_1.d[end], e.bend_2.d[end], e.twist.d[end]}) * w.value +
                                 density * w.d[end] - slid * drawing_.slides[g].s.d[end];
  }
  for (const int end : {by_a, by_b}) f[twist::place_a + end] += on_twist * moving_.twist.d[end];
  const twist::Reduced<T> x = q_.template head<twist::reduced>();
  const twist::AnyFields<T> fields = twist::fields_of<T>(now_, charts_, near_, x);
  f.template head<twist::reduced>() += twist::gradient_of<T>(now_, charts_, fields, moments, on_twist);
}

// The spin of the material at a point, w = (1 - xi) w_A + xi w_B + b beta' - gamma s', with s' = (1 - xi)
// s_A' + xi s_B'.
template <class T>
struct Motion<T>::Spin {
  Rate xi, w, gamma, slid, mass;
};
template <class T>
typename Motion<T>::Spin Motion<T>::spin(std::size_t g) const {
  Spin at;
  at.xi = in_time(drawing_.points[g].xi);
  at.gamma = in_time(moving_.at[g].gamma);
  at.slid = (1.0 - at.xi) * velocity(twist::place_a) + at.xi * velocity(twist::place_a + 1);
  at.w = (1.0 - at.xi) * spins_[0] + at.xi * spins_[1] +
         twist::bubble_shape(at.xi) * velocity(twist::bubble) - at.gamma * at.slid;
  at.mass = properties_.sections->spin_inertia * in_time(drawing_.weights[g]);
  return at;
}

// Derivatives of the kinetic energy T = sum mass w^2/2.
template <class T>
struct Motion<T>::SpinMomenta {
  std::array<Rate, 2> ends, slides;      // by the material spins and the rates of the places of both ends
  Rate bubble;                           // by beta'
  T on_twist = 0.0, on_bubble = 0.0;     // by theta_B and beta
  std::array<T, 2> on_places{0.0, 0.0};  // by the places, theta_B fixed
};
template <class T>
typename Motion<T>::SpinMomenta Motion<T>::momenta() const {
  SpinMomenta p;
  const T &beta = q_[twist::bubble], &beta_rate = v_[twist::bubble], &h = now_.h;
  for (std::size_t g = 0; g < points(); ++g) {
    const Spin at = spin(g);
    const Rate momentum = at.mass * at.w;
    const std::array<Rate, 2> share{1.0 - at.xi, at.xi};
    for (const int end : {0, 1}) {
      p.ends[end] += momentum * share[end];
      p.slides[end] -= momentum * share[end] * at.gamma;
    }
    p.bubble += momentum * twist::bubble_shape(at.xi);
    const T &xi = at.xi.value, &slid = at.slid.value, &w = at.w.value, slope = twist::bubble_slope(xi);
    p.on_twist -= momentum.value * slid / h;
    p.on_bubble -= momentum.value * slope * slid / h;
    const T by_xi = spins_[1].value - spins_[0].value + slope * beta_rate + 8.0 * beta * slid / h -
                    at.gamma.value * (v_[twist::place_a + 1] - v_[twist::place_a]);
    const T by_h = at.gamma.value * slid / h;
    for (const int end : {by_a, by_b})
      p.on_places[end] += momentum.value * (by_xi * drawing_.points[g].xi.d[end] + by_h * drawing_.h.d[end]) +
                          0.5 * properties_.sections->spin_inertia * drawing_.weights[g].d[end] * w * w;
  }
  return p;
}

// Adds d/dt(dT/dv) - dT/dq, without the part that theta_B passes on.
template <class T>
void Motion<T>::add_spin_forces(const SpinMomenta& p, Vector<T>& f) const {
  for (const int end : {0, 1}) {
    const T &momentum = p.ends[end].value, &rate = p.ends[end].d[0];
    twist::NodeSpin<T>(charts_[end], end, q_, v_, a_).add_force(end, momentum, rate, f);
    f[twist::place_a + end] += p.slides[end].d[0] - now_.end_twist[end] * rate - p.on_places[end];
  }
  f[twist::bubble] += p.bubble.d[0] - p.on_bubble;
}

template <class T>
Vector<T> Motion<T>::force() const {
  Vector<T> f = Vector<T>::Zero();
  const SpinMomenta p = momenta();
  add_strain_forces(-p.on_twist, f);
  add_spin_forces(p, f);
  return f;
}

template <class T>
double Motion<T>::kinetic_energy() const {
  double sum = 0;
  for (std::size_t g = 0; g < points(); ++g) {
    const Spin at = spin(g);
    sum += at.mass.value * at.w.value * at.w.value / 2;
  }
  return sum;
}

}  // namespace

TwistElement::Coordinates TwistElement::moving_force(const TwistState& x) const {
  const Vector<double> q = twist::reduced_of<rows>(x.q), v = twist::reduced_of<rows>(x.v),
                       a = twist::reduced_of<rows>(x.a);
  const Motion<double> motion(drawn_element<Dual<2>>(x.q), charts_, turn_, *properties_, q, v, a);
  return twist::spread_out<rows>(motion.force());
}

// Mass matrix of the kinetic energy sum mass w^2/2, where each w is a row times the velocities.
TwistElement::Matrix TwistElement::moving_mass(const Coordinates& q) const {
  const MaterialSpinRows rows(*this, q);
  const twist::QuadraturePlaces<double> places(*curve_, chart_, q[TwistLayout::place(0)],
                                               q[TwistLayout::place(1)]);
  Matrix sum = Matrix::Zero();
  for (std::size_t g = 0; g < places.size(); ++g) {
    const Coordinates row = rows.at(places.place(g));
    sum += properties_->sections->spin_inertia * places.weight(g) * row * row.transpose();
  }
  return sum;
}

TwistElement::Matrix TwistElement::moving_tangent(const TwistState& x, const TangentWeights& w) const {
  if (w.stiffness == 0 && w.damping == 0) return w.mass * moving_mass(x.q);
  using T = Dual<rows>;
  const Vector<T> q = twist::variables<rows, double>(twist::reduced_of<rows>(x.q), w.stiffness),
                  v = twist::variables<rows, double>(twist::reduced_of<rows>(x.v), w.damping),
                  a = twist::variables<rows, double>(twist::reduced_of<rows>(x.a), w.mass);
  const Motion<T> motion(drawn_element<twist::PlaceSeries>(x.q), charts_, turn_, *properties_, q, v, a);
  return twist::spread_out<rows>(twist::derivatives<rows>(motion.force()));
}

TwistEnergy TwistElement::moving_energy(const TwistState& x) const {
  const Vector<double> q = twist::reduced_of<rows>(x.q), v = twist::reduced_of<rows>(x.v),
                       a = Vector<double>::Zero();
  const Motion<double> motion(drawn_element<Dual<2>>(x.q), charts_, turn_, *properties_, q, v, a);
  TwistEnergy sum;
  for (std::size_t g = 0; g < motion.points(); ++g) {
    const auto e = motion.strain(g);
    sum.add({e.bend_1.value, e.bend_2.value, e.twist.value}, motion.material_rate(g), motion.weight(g),
            *properties_);
  }
  sum.kinetic = motion.kinetic_energy();
  return sum;
}

}  // namespace nurbeam
