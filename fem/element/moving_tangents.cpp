// The tangent of the force of an element with moving ends: the sum over the points of the terms of inertia,
// elasticity, load and damping. Each term is given by forces on r, r_s and r_ss.
// Long because the terms are one sum over the points.
#include <optional>
#include <tuple>

#include "fem/element/beam_element.h"
#include "fem/element/moving_mass.h"
#include "fem/element/moving_point.h"
#include "fem/element/moving_strain.h"
#include "fem/element/moving_sums.h"
#include "fem/material/fold_resistance.h"

namespace nurbeam {

namespace {

using Row = MovingRows::Row;

// The tangent K = k df/dq + d df/dv + m df/da for the weights k, d, m of TangentWeights. With all rates
// weighted, one increment of the coordinates is one of positions, velocities and accelerations. Each field
// varies by one number a node, as it is linear in the nodes, and by one vector a place.
//
//   e, e_rate, e_second  nodes (D x 4) with their rates        w, w_rate      rates of the places s_a, s_b
//   r, rs, rss           the field and its derivatives along s v              of the material, [m/s]
//   A, s                 weight and place of the point         x_rate         dx/dt at the point, which moves
//   x_e, x_i             derivatives of x by the nodes (4) and by place i, in the weighted increment;
//   s_i, A_i, r.first    not weighted: derivatives by place i
//
// The force on node n is on_r R_n + on_rs R_n' + on_rss R_n'' with the rows R of the shape functions. The
// force on place i is on_r . r_i + on_rs . rs_i + on_rss . rss_i - pull s_i - lagrangian A_i: a moving place
// leaves the material behind, and a growing weight takes in more of it.
template <int D>
class TangentSum {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  using Nodes = ElementNodes<D>;
  using Vectors = std::array<Vector, 2>;

  TangentSum(const BeamProperties& properties, const AxialRule& axial, const ElementState<D>& x,
             const Vector& load, const TangentWeights& t)
      : properties_(properties),
        axial_(axial),
        load_(load),
        x_(x),
        t_(t),
        assumed_(properties.axial_strain == AxialStrain::ends_and_mean),
        motion_(MovingPoint<D>::motion(x)) {
    if (axial.own_slopes.count() > 0) moments_.emplace();
    nodal_.setZero();
  }

  void add(const MovingRows& rows, const Jet& s, const Jet& weight) {
    const Point p(rows, s, weight, motion_, t_);
    Action acts;
    add_inertia(p, acts);
    add_elastic(p, acts);
    add_load(p, acts);
    add_action(p, acts);
    if (t_.stiffness == 0 && t_.damping == 0) return;
    add_stretch(p, s, weight);
    if (properties_.is_damped()) add_damping(p, s, weight);
  }

  double fold_factor() const { return x_.stabilisation * axial_.fold_resistance; }
  /// Whether FoldResistance acts. Then add_fold() needs each point once more.
  bool folds() const {
    return assumed_ && fold_factor() > 0 && (t_.stiffness != 0 || t_.damping != 0) &&
           squared_residue(residue_[0], residue_[1]) > FoldResistance::r_0 * FoldResistance::r_0;
  }
  void add_fold(const MovingRows& rows, const Jet& s, const Jet& weight) {
    if (!fold_) fold_.emplace();
    const Point p(rows, s, weight, motion_, t_);
    const std::array<Jet, 5> weights = weights_of(s, weight);
    const SlopeMotion motion(p, t_);
    for (const std::size_t k : {0, 1}) {
      add_to((*fold_)[k], p, weights[3 + k]);
      (*fold_)[k].add_rate(strain_at(p), weights[3 + k], motion.rate(p), t_.stiffness);
    }
  }

  /// `basis`: basis of the points.
  ElementMatrix<D> total(const MovingBasis& basis) const {
    using Layout = ElementLayout<D>;
    constexpr int nodal = Layout::nodal;
    ElementMatrix<D> K = sums_.matrix();
    K.template topLeftCorner<nodal, nodal>() += nodal_;
    if (t_.stiffness == 0 && t_.damping == 0) return K;
    if (fold_) add_fold_tangent(K);
    if (!assumed_ && !(properties_.tension_damping > 0)) return K;
    AxialSums<D> axial(x_.q);
    axial.y[0] = stretch_.sum.value;
    axial.y_q.row(0) = stretch_.sum.gradient.vector().transpose();
    if (moments_) take_ends(axial);
    axial.take_out(x_.free_strain);
    if (const TautViscosity<D> eta(properties_, axial, x_.free_strain, x_.taut); eta.value != 0)
      K += eta.value * taut_.matrix() + t_.stiffness * taut_force_.vector() * eta.gradient.transpose();
    if (!assumed_) return K;
    if (t_.stiffness != 0) {
      std::array<ElementMatrix<D>, 3> moments_qq;
      for (int k = 0; moments_ && k < 3; ++k) moments_qq[k] = (*moments_)[k].hessian();
      axial.add_tangent(axial.energy(properties_, x_.free_strain, axial_.buckling_strain), t_.stiffness,
                        stretch_.hessian(), axial_.own_slopes, moments_ ? &moments_qq : nullptr, K);
    }
    if (properties_.damping > 0) add_axial_damping(axial.y[3], basis, K);
    return K;
  }

 private:
  // A field at a point and its derivatives by the places, aa, ab, bb.
  struct Field {
    Vector value;
    Vectors first;
    std::array<Vector, 3> second;

    Field(const Nodes& e, const MovingRows::Series& rows)
        : value(e * rows.value),
          first{e * rows.first[0], e * rows.first[1]},
          second{e * rows.second[0], e * rows.second[1], e * rows.second[2]} {}
  };

  static Row along(const std::array<Row, 2>& by, const std::array<double, 2>& w) {
    return by[0] * w[0] + by[1] * w[1];
  }
  static std::array<Row, 2> along(const std::array<Row, 3>& by, const std::array<double, 2>& w) {
    return {by[0] * w[0] + by[1] * w[1], by[1] * w[0] + by[2] * w[1]};
  }

  // Place, fields and motion of a point.
  struct Point {
    const MovingRows& rows;
    Field r, rs, rss;
    std::array<double, 2> s_i, A_i;
    double A, s_rate, s_second, A_rate;
    Row r1, rs1;                     // rates of the rows of r and r_s
    std::array<Row, 2> r1_i, rs1_i;  // their derivatives by the places
    Vector rs_rate, v;
    Row rs_rate_e, v_e;
    Vectors r1_along, rs_rate_i, v_i;

    Point(const MovingRows& rows_, const Jet& s, const Jet& weight,
          const typename MovingPoint<D>::Motion& motion, const TangentWeights& t)
        : rows(rows_),
          r(motion.e, rows.r),
          rs(motion.e, rows.rs),
          rss(motion.e, rows.rss),
          s_i{s.d(0), s.d(1)},
          A_i{weight.d(0), weight.d(1)},
          A(weight.value()) {
      const auto& [e, e_rate, e_second, w, w_rate] = motion;
      const double k = t.stiffness, d = t.damping;
      s_rate = s_i[0] * w[0] + s_i[1] * w[1];
      s_second = s_i[0] * w_rate[0] + s_i[1] * w_rate[1];
      A_rate = A_i[0] * w[0] + A_i[1] * w[1];
      r1 = along(rows.r.first, w);
      rs1 = along(rows.rs.first, w);
      r1_i = along(rows.r.second, w);
      rs1_i = along(rows.rs.second, w);
      rs_rate = e_rate * rows.rs.value + e * rs1;
      v = e_rate * rows.r.value + e * r1 - rs.value * s_rate;
      rs_rate_e = d * rows.rs.value + k * rs1;
      v_e = d * rows.r.value + k * (r1 - s_rate * rows.rs.value);
      for (const int i : {0, 1}) {
        r1_along[i] = e_rate * rows.r.first[i] + e * r1_i[i];
        rs_rate_i[i] = k * (e_rate * rows.rs.first[i] + e * rs1_i[i]) + d * rs.first[i];
        v_i[i] = k * (r1_along[i] - rs.first[i] * s_rate) + d * (r.first[i] - rs.value * s_i[i]);
      }
    }
  };

  // Forces at a point on r, r_s and r_ss, with their derivatives by place j. by_r, by_rs and by_rss:
  // derivatives of the force on place i by these fields of the nodes. lagrangian: derivatives of the
  // Lagrangian by place j.
  struct Action {
    Vector on_r, on_rs, on_rss;
    Vectors on_r_i, on_rs_i, on_rss_i;
    Vectors by_r, by_rs, by_rss;
    std::array<double, 2> lagrangian;
  };

  // Sets all of the action: m (A dv/dt + dA/dt v) on r, and ds/dt m A v on r_s.
  void add_inertia(const Point& p, Action& acts) {
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const MovingRows& rows = p.rows;
    const double k = t_.stiffness, d = t_.damping, mass = t_.mass;
    const double m = properties_.mass_per_length, A = p.A;
    const Row r2 = along(p.r1_i, w) + along(rows.r.first, w_rate);
    std::array<Row, 2> r2_i = along(rows.r.second, w_rate);
    for (const int i : {0, 1})
      r2_i[i] += rows.r_third[i] * (w[0] * w[0]) + rows.r_third[i + 1] * (2 * w[0] * w[1]) +
                 rows.r_third[i + 2] * (w[1] * w[1]);
    const Vector acceleration =
        e_second * rows.r.value + 2 * e_rate * p.r1 + e * r2 - p.rs_rate * p.s_rate - p.rs.value * p.s_second;
    const Vector momentum_rate = m * (A * acceleration + p.A_rate * p.v), momentum = (m * A) * p.v;
    const Row acceleration_e =
        mass * rows.r.value + 2 * d * p.r1 + k * (r2 - p.s_second * rows.rs.value) - p.s_rate * p.rs_rate_e;
    const Row momentum_rate_e = m * (A * acceleration_e + p.A_rate * p.v_e), momentum_e = (m * A) * p.v_e;
    acts.on_r = momentum_rate;
    acts.on_rs = p.s_rate * momentum;
    acts.on_rss.setZero();
    sums_.isotropic.noalias() += rows.r.value * momentum_rate_e.transpose();
    sums_.isotropic.noalias() += rows.rs.value * (p.s_rate * momentum_e).transpose();
    for (const int i : {0, 1}) {
      const Vector acceleration_i = k * (e_second * rows.r.first[i] + 2 * e_rate * p.r1_i[i] + e * r2_i[i] -
                                         p.s_second * p.rs.first[i]) +
                                    d * (2 * p.r1_along[i] - p.s_i[i] * p.rs_rate) +
                                    mass * (p.r.first[i] - p.s_i[i] * p.rs.value) - p.s_rate * p.rs_rate_i[i];
      const Vector momentum_rate_i =
          m * (A * acceleration_i + k * p.A_i[i] * acceleration + p.A_rate * p.v_i[i] + d * p.A_i[i] * p.v);
      const Vector momentum_i = m * (A * p.v_i[i] + k * p.A_i[i] * p.v);
      acts.on_r_i[i] = momentum_rate_i;
      acts.on_rs_i[i] = p.s_rate * momentum_i + d * p.s_i[i] * momentum;
      acts.on_rss_i[i].setZero();
      acts.by_r[i].setZero();
      acts.by_rs[i] = -(p.s_i[i] * k) * momentum_rate;
      acts.by_rss[i].setZero();
      acts.lagrangian[i] = m * p.v.dot(p.v_i[i]);
      Nodes& of_nodes = sums_.of_place[i];
      of_nodes.noalias() += (p.r.first[i] - p.s_i[i] * p.rs.value) * momentum_rate_e.transpose();
      of_nodes.noalias() += (p.s_rate * p.rs.first[i] - p.s_i[i] * p.rs_rate) * momentum_e.transpose();
      of_nodes.noalias() -= (p.s_i[i] * momentum) * p.rs_rate_e.transpose();
      of_nodes.noalias() -= (p.A_i[i] * m) * p.v * p.v_e.transpose();
      // pull = r_s . d(momentum)/dt + dr_s/dt . momentum.
      const double pull_i = k * p.rs.first[i].dot(momentum_rate) + p.rs.value.dot(momentum_rate_i) +
                            p.rs_rate_i[i].dot(momentum) + p.rs_rate.dot(momentum_i);
      for (const int place : {0, 1}) sums_.places(place, i) -= pull_i * p.s_i[place];
    }
  }

  // Adds A dU/dr_s on r_s and A dU/dr_ss on r_ss, for the energy U(r_s, r_ss, kappa_0) of the law.
  void add_elastic(const Point& p, Action& acts) {
    const MovingRows& rows = p.rows;
    const double k = t_.stiffness, A = p.A;
    const ElasticResponse<D> elastic = elastic_response<D>(properties_, p.rs.value, p.rss.value, rows.kappa0);
    const Vector g_s = elastic.gradient.template head<D>(), g_t = elastic.gradient.template tail<D>();
    acts.on_rs += A * g_s;
    acts.on_rss += A * g_t;
    add_elastic_nodes(elastic.hessian, k * A, rows);
    for (const int i : {0, 1}) {
      Pair z_i;
      z_i << p.rs.first[i], p.rss.first[i];
      const Pair g_i = elastic.hessian * z_i - elastic.moment_gradient * rows.kappa0_first[i];
      const Vector by_s = (k * A) * g_i.template head<D>() + k * p.A_i[i] * g_s,
                   by_t = (k * A) * g_i.template tail<D>() + k * p.A_i[i] * g_t;
      acts.on_rs_i[i] += by_s;
      acts.on_rss_i[i] += by_t;
      acts.by_rs[i] += by_s;
      acts.by_rss[i] += by_t;
      acts.lagrangian[i] -=
          k * (g_s.dot(p.rs.first[i]) + g_t.dot(p.rss.first[i]) - elastic.moment * rows.kappa0_first[i]);
      // The moment on kappa_0, which changes with the places.
      const double moment_i =
          k * (elastic.moment_gradient.dot(z_i) - elastic.moment_slope * rows.kappa0_first[i]);
      for (const int place : {0, 1})
        sums_.places(place, i) -= (A * moment_i + k * p.A_i[i] * elastic.moment) * rows.kappa0_first[place] +
                                  k * A * elastic.moment * rows.kappa0_second[place + i];
    }
  }

  // Adds a dead load on r.
  void add_load(const Point& p, Action& acts) const {
    const double k = t_.stiffness;
    acts.on_r -= p.A * load_;
    for (const int i : {0, 1}) {
      acts.on_r_i[i] -= k * p.A_i[i] * load_;
      acts.by_r[i] -= k * p.A_i[i] * load_;
      acts.lagrangian[i] += k * load_.dot(p.r.first[i]);
    }
  }

  // Adds the action of a point to the matrices of the nodes and the places.
  void add_action(const Point& p, const Action& acts) {
    const MovingRows& rows = p.rows;
    const double k = t_.stiffness;
    for (const int i : {0, 1}) {
      Nodes shared = acts.on_r * rows.r.first[i].transpose();
      shared.noalias() += acts.on_rs * rows.rs.first[i].transpose();
      shared.noalias() += acts.on_rss * rows.rss.first[i].transpose();
      Nodes &by_place = sums_.by_place[i], &of_place = sums_.of_place[i];
      by_place.noalias() += acts.on_r_i[i] * rows.r.value.transpose();
      by_place.noalias() += acts.on_rs_i[i] * rows.rs.value.transpose();
      by_place.noalias() += acts.on_rss_i[i] * rows.rss.value.transpose();
      by_place += k * shared;
      of_place.noalias() += acts.by_r[i] * rows.r.value.transpose();
      of_place.noalias() += acts.by_rs[i] * rows.rs.value.transpose();
      of_place.noalias() += acts.by_rss[i] * rows.rss.value.transpose();
      of_place += k * shared;
      for (const int j : {0, 1})
        sums_.places(i, j) += acts.on_r_i[j].dot(p.r.first[i]) + acts.on_rs_i[j].dot(p.rs.first[i]) +
                              acts.on_rss_i[j].dot(p.rss.first[i]) +
                              k * (acts.on_r.dot(p.r.second[i + j]) + acts.on_rs.dot(p.rs.second[i + j]) +
                                   acts.on_rss.dot(p.rss.second[i + j])) -
                              acts.lagrangian[j] * p.A_i[i];
    }
  }

  void add_elastic_nodes(const Eigen::Matrix<double, 2 * D, 2 * D>& hessian, double factor,
                         const MovingRows& rows) {
    using Block = Eigen::Matrix<double, D, D>;
    const Block ss = factor * hessian.template topLeftCorner<D, D>(),
                st = factor * hessian.template topRightCorner<D, D>(),
                tt = factor * hessian.template bottomRightCorner<D, D>();
    const Row &s = rows.rs.value, &t = rows.rss.value;
    for (int k = 0; k < 4; ++k) {
      const Block by_s = s[k] * ss + t[k] * st, by_t = s[k] * st.transpose() + t[k] * tt;
      for (int l = 0; l < 4; ++l) nodal_.template block<D, D>(l * D, k * D) += s[l] * by_s + t[l] * by_t;
    }
  }

  std::array<Jet, 5> weights_of(const Jet& s, const Jet& weight) const {
    using Layout = ElementLayout<D>;
    const Jet s_a = Jet::variable(x_.q[Layout::place(0)], 0), s_b = Jet::variable(x_.q[Layout::place(1)], 1);
    return strain_weights(s, weight, s_a, s_b - s_a);
  }

  static StrainAtPoint<D> strain_at(const Point& p) { return {p.rows.rs, p.rs.value, p.rs.first}; }

  static void add_to(StrainSumTangent<D>& sum, const Point& p, const Jet& weight) {
    sum.add(strain_at(p), weight);
    sum.add_second(strain_at(p), weight.value(), p.rs.second);
  }

  // Adds to I of AxialSums, to e_3 and e_4, and with own slopes to e_0, e_1 and e_2.
  void add_stretch(const Point& p, const Jet& s, const Jet& weight) {
    add_to(stretch_, p, weight);
    const double s_a = x_.q[ElementLayout<D>::place(0)], length = x_.q[ElementLayout<D>::place(1)] - s_a;
    const StrainCoefficients<double> in_strain = strain_weights(s.value(), weight.value(), s_a, length);
    for (const std::size_t k : {0, 1}) residue_[k] += in_strain[3 + k] * strain_at(p).value();
    if (!moments_) return;
    const std::array<Jet, 5> weights = weights_of(s, weight);
    for (std::size_t k = 0; k < 3; ++k) add_to((*moments_)[k], p, weights[k]);
  }

  // The rate of r_s at fixed material, and its derivatives.
  struct SlopeMotion {
    Vector value;
    Row by_nodes;
    Vectors by_places;

    SlopeMotion(const Point& p, const TangentWeights& t)
        : value(p.rs_rate - p.rss.value * p.s_rate),
          by_nodes(p.rs_rate_e - (t.stiffness * p.s_rate) * p.rows.rss.value) {
      for (const int i : {0, 1})
        by_places[i] =
            p.rs_rate_i[i] - (t.stiffness * p.s_rate) * p.rss.first[i] - (t.damping * p.s_i[i]) * p.rss.value;
    }
    SlopeRate<D> rate(const Point& p) const {
      SlopeRate<D> rate{value, by_nodes, by_places, {}, {}, {}};
      for (const int i : {0, 1}) {
        rate.tests[i] = p.rs.first[i] - p.s_i[i] * p.rss.value;
        rate.test_rows[i] = p.rows.rs.first[i] - p.s_i[i] * p.rows.rss.value;
        for (const int j : {0, 1})
          rate.tests_by_places[i][j] = p.rs.second[i + j] - p.s_i[i] * p.rss.first[j];
      }
      return rate;
    }
  };

  void add_damping(const Point& p, const Jet& s, const Jet& weight) {
    if (properties_.mass_damping > 0) add_drag(p.rows.r, p.rows.rs.value, p);
    if (!(properties_.damping > 0 || properties_.tension_damping > 0)) return;
    const SlopeMotion motion(p, t_);
    if (properties_.damping > 0) add_viscosity(p.rows, p, motion.value, motion.by_nodes, motion.by_places);
    const SlopeRate<D> rate = motion.rate(p);
    stretch_.add_rate(strain_at(p), weight, rate, t_.stiffness);
    if (moments_) {
      const std::array<Jet, 5> weights = weights_of(s, weight);
      for (std::size_t k = 0; k < 3; ++k)
        (*moments_)[k].add_rate(strain_at(p), weights[k], rate, t_.stiffness);
    }
    if (properties_.tension_damping > 0) add_taut(p, rate);
  }

  // Adds the tangent of a drag on the material velocity.
  void add_drag(const MovingRows::Series& rows, const Row& along, const Point& p) {
    const double k = t_.stiffness;
    const double c = properties_.mass_damping * properties_.mass_per_length, cA = c * p.A;
    sums_.isotropic.noalias() += (cA * rows.value) * p.v_e.transpose();
    for (const int i : {0, 1}) {
      const Vector test = p.r.first[i] - p.s_i[i] * p.rs.value;
      sums_.by_place[i].noalias() += (cA * p.v_i[i] + (c * k * p.A_i[i]) * p.v) * rows.value.transpose();
      sums_.by_place[i].noalias() += (cA * k) * p.v * rows.first[i].transpose();
      sums_.of_place[i].noalias() += cA * test * p.v_e.transpose();
      sums_.of_place[i].noalias() += (cA * k) * p.v * (rows.first[i] - p.s_i[i] * along).transpose();
      for (const int j : {0, 1})
        sums_.places(i, j) +=
            cA * (test.dot(p.v_i[j]) + k * p.v.dot(p.r.second[i + j] - p.s_i[i] * p.rs.first[j])) +
            (c * k * p.A_i[j]) * test.dot(p.v);
    }
  }

  // Adds the tangent of viscous stress of strains at the point, on r_s and r_ss.
  void add_viscosity(const MovingRows& rows, const Point& p, const Vector& rs_rate, const Row& rs_rate_e,
                     const Vectors& rs_rate_i) {
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const double k = t_.stiffness, d = t_.damping;
    const Vector rsss = e * rows.rsss;
    const Vectors rsss_i{e * rows.rsss_first[0], e * rows.rsss_first[1]};
    const Row rss1 = along(rows.rss.first, w);
    const std::array<Row, 2> rss1_i = along(rows.rss.second, w);
    const Row rss_rate_e = d * rows.rss.value + k * rss1 - (k * p.s_rate) * rows.rsss;
    Pair rate;
    rate << rs_rate, e_rate * rows.rss.value + e * rss1 - rsss * p.s_rate;
    const DampingResponse<D> damping = damping_response<D>(properties_, p.rs.value, p.rss.value, rate);
    const Pair& y = damping.stress;
    std::array<Pair, 2> tests, stress_i;
    for (const int i : {0, 1}) {
      tests[i] << p.rs.first[i] - p.s_i[i] * p.rss.value, p.rss.first[i] - p.s_i[i] * rsss;
      Pair z_i, rate_i;
      z_i << p.rs.first[i], p.rss.first[i];
      rate_i << rs_rate_i[i], k * (e_rate * rows.rss.first[i] + e * rss1_i[i] - p.s_rate * rsss_i[i]) +
                                  d * (p.rss.first[i] - p.s_i[i] * rsss);
      stress_i[i] = k * damping.by_z * z_i + damping.by_rate * rate_i;
    }
    for (int l = 0; l < 4; ++l) {
      using Block = Eigen::Matrix<double, 2 * D, D>;
      const Block stress_e = (k * rows.rs.value[l]) * damping.by_z.template leftCols<D>() +
                             (k * rows.rss.value[l]) * damping.by_z.template rightCols<D>() +
                             rs_rate_e[l] * damping.by_rate.template leftCols<D>() +
                             rss_rate_e[l] * damping.by_rate.template rightCols<D>();
      for (int n = 0; n < 4; ++n)
        nodal_.template block<D, D>(n * D, l * D) +=
            (p.A * rows.rs.value[n]) * stress_e.template topRows<D>() +
            (p.A * rows.rss.value[n]) * stress_e.template bottomRows<D>();
      for (const int i : {0, 1})
        sums_.of_place[i].col(l) +=
            p.A * stress_e.transpose() * tests[i] +
            (k * p.A) * ((rows.rs.first[i][l] - p.s_i[i] * rows.rss.value[l]) * y.template head<D>() +
                         (rows.rss.first[i][l] - p.s_i[i] * rows.rsss[l]) * y.template tail<D>());
    }
    for (const int j : {0, 1}) {
      const Pair on = p.A * stress_i[j] + (k * p.A_i[j]) * y;
      Nodes& by_place = sums_.by_place[j];
      by_place.noalias() += on.template head<D>() * rows.rs.value.transpose();
      by_place.noalias() += on.template tail<D>() * rows.rss.value.transpose();
      by_place.noalias() += (k * p.A) * y.template head<D>() * rows.rs.first[j].transpose();
      by_place.noalias() += (k * p.A) * y.template tail<D>() * rows.rss.first[j].transpose();
      for (const int i : {0, 1}) {
        Pair test_j;
        test_j << p.rs.second[i + j] - p.s_i[i] * p.rss.first[j], p.rss.second[i + j] - p.s_i[i] * rsss_i[j];
        sums_.places(i, j) += on.dot(tests[i]) + (k * p.A) * y.dot(test_j);
      }
    }
  }

  // Adds to the force of a tension of viscosity 1, for r_s alone, and to its tangent.
  void add_taut(const Point& p, const SlopeRate<D>& rate) {
    const double k = t_.stiffness, A = p.A;
    const Row& row = p.rows.rs.value;
    taut_force_.nodes.noalias() += A * rate.value * row.transpose();
    taut_.isotropic.noalias() += (A * row) * rate.by_nodes.transpose();
    for (const int i : {0, 1}) {
      const Vector& test = rate.tests[i];
      taut_force_.places[i] += A * rate.value.dot(test);
      taut_.by_place[i].noalias() += (A * rate.by_places[i] + (k * p.A_i[i]) * rate.value) * row.transpose();
      taut_.by_place[i].noalias() += (k * A) * rate.value * p.rows.rs.first[i].transpose();
      taut_.of_place[i].noalias() += A * test * rate.by_nodes.transpose();
      taut_.of_place[i].noalias() += (k * A) * rate.value * rate.test_rows[i].transpose();
      for (const int j : {0, 1})
        taut_.places(i, j) +=
            A * (test.dot(rate.by_places[j]) + k * rate.value.dot(rate.tests_by_places[i][j])) +
            (k * p.A_i[j]) * rate.value.dot(test);
    }
  }

  // A function of the strain in AssumedAxialDamping: its rate at fixed material, the gradient of the rate in
  // the coordinates (with the rates weighted) and in their rates, and the derivatives of the latter.
  struct Rated {
    double rate = 0;
    ElementVector<D> rate_q = ElementVector<D>::Zero(), test = ElementVector<D>::Zero();
    ElementMatrix<D> test_q = ElementMatrix<D>::Zero();
  };

  static Rated rated(const StrainSumTangent<D>& of) {
    return {of.sum.rate, of.rate_gradient.vector(), of.sum.test(), of.test_gradient()};
  }
  // eps' = r_s . (dr_s/dt - r_ss ds/dt) at an end, with r_s the node's own slope.
  Rated rated_at(int end, const MovingBasis& basis) const {
    using Layout = ElementLayout<D>;
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const double k = t_.stiffness, d = t_.damping;
    const MovingRows::Series rss = basis.rows_at(Jet::variable(x_.q[Layout::place(end)], end)).rss;
    const Vector slope = e.col(2 * end + 1), bend = e * rss.value;
    const Vector slope_rate = e_rate.col(2 * end + 1) - bend * w[end];
    const int at = Layout::slope(end), place = Layout::place(end);
    Rated x;
    x.rate = slope.dot(slope_rate);
    x.test.template segment<D>(at) = slope;
    x.test[place] = -bend.dot(slope);
    Gradient<D> bending;  // gradient of slope . bend by bend alone
    bending.nodes = slope * rss.value.transpose();
    for (const int j : {0, 1}) bending.places[j] = slope.dot(e * rss.first[j]);
    x.rate_q = -(k * w[end]) * bending.vector();
    x.rate_q.template segment<D>(at) += k * slope_rate + d * slope;
    x.rate_q[place] -= d * bend.dot(slope);
    x.test_q.template block<D, D>(at, at).setIdentity();
    x.test_q.row(place) = -bending.vector().transpose();
    x.test_q.template block<1, D>(place, at) -= bend.transpose();
    return x;
  }
  // The end values of the assumed strain.
  std::array<Rated, 2> rated_ends(const MovingBasis& basis) const {
    std::array<Rated, 2> nodal{rated_at(0, basis), rated_at(1, basis)};
    if (!moments_) return nodal;
    const Eigen::Matrix<double, 2, 5> rule = matrix_of(assumed_ends(axial_.own_slopes));
    std::array<Rated, 2> ends;
    const auto add = [&](int i, const Rated& part) {
      for (const int end : {0, 1}) {
        ends[end].rate += rule(end, i) * part.rate;
        ends[end].rate_q += rule(end, i) * part.rate_q;
        ends[end].test += rule(end, i) * part.test;
        ends[end].test_q += rule(end, i) * part.test_q;
      }
    };
    for (int i = 0; i < 5; ++i) add(i, i < 2 ? nodal[i] : rated((*moments_)[i - 2]));
    return ends;
  }

  // Adds the tangent of AssumedAxialDamping: stresses on the rates of (I, a, b) at fixed material, times
  // their gradients in the rates.
  void add_axial_damping(double l, const MovingBasis& basis, ElementMatrix<D>& K) const {
    using Layout = ElementLayout<D>;
    using Rows = Eigen::Matrix<double, 3, Layout::size>;
    const double k = t_.stiffness;
    const std::array<Rated, 2> ends = rated_ends(basis);
    Rows Z, rate_q;
    Z << stretch_.sum.test().transpose(), ends[0].test.transpose(), ends[1].test.transpose();
    rate_q << stretch_.rate_gradient.vector().transpose(), ends[0].rate_q.transpose(),
        ends[1].rate_q.transpose();
    const AssumedAxialDamping damping(properties_, l, {stretch_.sum.rate, ends[0].rate, ends[1].rate});
    Rows stress_q = damping.by_rate * rate_q;
    stress_q.col(Layout::place(0)) -= k * damping.by_length;
    stress_q.col(Layout::place(1)) += k * damping.by_length;
    K += Z.transpose() * stress_q;
    if (k == 0) return;
    K += (k * damping.stress[0]) * stretch_.test_gradient();
    for (const int end : {0, 1}) K += (k * damping.stress[1 + end]) * ends[end].test_q;
  }

  // Adds the tangent of FoldResistance and its damping.
  void add_fold_tangent(ElementMatrix<D>& K) const {
    using Layout = ElementLayout<D>;
    const double k = t_.stiffness, length = x_.q[Layout::place(1)] - x_.q[Layout::place(0)];
    const std::array<Rated, 2> x{rated((*fold_)[0]), rated((*fold_)[1])};
    const std::array<ElementVector<D>, 2> x_q{(*fold_)[0].sum.gradient.vector(),
                                              (*fold_)[1].sum.gradient.vector()};
    const FoldStresses<double> fold(properties_, fold_factor(),
                                    {(*fold_)[0].sum.value, (*fold_)[1].sum.value});
    const std::array<double, 2> rate{x[0].rate, x[1].rate}, viscous = fold.viscous_force(rate);
    const auto viscosity = fold.viscosity(), viscous_by_e = fold.viscous_force_by_e(rate);
    ElementVector<D> length_q = ElementVector<D>::Zero();
    length_q[Layout::place(0)] = -1;
    length_q[Layout::place(1)] = 1;
    for (const std::size_t i : {0, 1}) {
      ElementVector<D> force_q = (k * fold.force[i]) * length_q, viscous_q = (k * viscous[i]) * length_q;
      for (const std::size_t j : {0, 1}) {
        force_q += (k * length * fold.stiffness[i][j]) * x_q[j];
        viscous_q += (k * length * viscous_by_e[i][j]) * x_q[j] + (length * viscosity[i][j]) * x[j].rate_q;
      }
      K += x_q[i] * force_q.transpose() + (k * fold.force[i]) * length_q * x_q[i].transpose();
      K += (k * length * fold.force[i]) * (*fold_)[i].hessian();
      K += x[i].test * viscous_q.transpose() + (k * length * viscous[i]) * x[i].test_q;
    }
  }

  void take_ends(AxialSums<D>& axial) const {
    Eigen::Vector3d values;
    Eigen::Matrix<double, 3, element_size<D>> gradients;
    for (int k = 0; k < 3; ++k) {
      values[k] = (*moments_)[k].sum.value;
      gradients.row(k) = (*moments_)[k].sum.gradient.vector().transpose();
    }
    axial.take_ends(axial_.own_slopes, values, gradients);
  }

  const BeamProperties& properties_;
  const AxialRule& axial_;
  const Vector& load_;
  const ElementState<D>& x_;
  const TangentWeights& t_;
  bool assumed_;
  typename MovingPoint<D>::Motion motion_;
  Eigen::Matrix<double, 4 * D, 4 * D> nodal_;
  PlaceSums<D> sums_;
  StrainSumTangent<D> stretch_;                                // I of AxialSums
  std::optional<std::array<StrainSumTangent<D>, 3>> moments_;  // e_0, e_1 and e_2, with own slopes alone
  std::array<double, 2> residue_{};  // e_3 and e_4, and with derivatives where they resist
  std::optional<std::array<StrainSumTangent<D>, 2>> fold_;
  Gradient<D> taut_force_;
  PlaceSums<D> taut_;
};

}  // namespace

template <int D>
ElementMatrix<D> BeamElement<D>::tangent(const ElementState<D>& x, const Vector& load,
                                         const TangentWeights& t) const {
  if (fixed()) return fixed_tangent(x, t);
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  if (t.stiffness == 0 && t.damping == 0) {
    const MovingBasis basis(*curve_, chart_, s_a, s_b, Derivatives::one);
    MassSum<D> sum(t.mass * properties_->mass_per_length, x.q);
    for_each_place(s_a.value(), s_b.value(),
                   [&](double s, double weight) { sum.add(basis.positions_at(s), weight); });
    return sum.total();
  }
  const MovingBasis basis(*curve_, chart_, s_a, s_b);
  TangentSum<D> sum(*properties_, axial_rule_, x, load, t);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) { sum.add(basis.rows_at(s), s, weight); });
  if (sum.folds())
    for_each_place(s_a, s_b,
                   [&](const Jet& s, const Jet& weight) { sum.add_fold(basis.rows_at(s), s, weight); });
  return sum.total(basis);
}

template <int D>
std::array<ElementMatrix<D>, 2> BeamElement<D>::tangents(const ElementState<D>& x, const Vector& load,
                                                         const std::array<TangentWeights, 2>& w) const {
  if (fixed()) return {fixed_tangent(x, w[0]), fixed_tangent(x, w[1])};
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  const MovingBasis basis(*curve_, chart_, s_a, s_b);
  TangentSum<D> first(*properties_, axial_rule_, x, load, w[0]),
      second(*properties_, axial_rule_, x, load, w[1]);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) {
    const MovingRows rows = basis.rows_at(s);
    first.add(rows, s, weight);
    second.add(rows, s, weight);
  });
  for (TangentSum<D>* sum : {&first, &second})
    if (sum->folds())
      for_each_place(s_a, s_b,
                     [&](const Jet& s, const Jet& weight) { sum->add_fold(basis.rows_at(s), s, weight); });
  return {first.total(basis), second.total(basis)};
}

template std::array<ElementMatrix<2>, 2> BeamElement<2>::tangents(const ElementState<2>&, const Vector&,
                                                                  const std::array<TangentWeights, 2>&) const;
template std::array<ElementMatrix<3>, 2> BeamElement<3>::tangents(const ElementState<3>&, const Vector&,
                                                                  const std::array<TangentWeights, 2>&) const;
template ElementMatrix<2> BeamElement<2>::tangent(const ElementState<2>&, const Vector&,
                                                  const TangentWeights&) const;
template ElementMatrix<3> BeamElement<3>::tangent(const ElementState<3>&, const Vector&,
                                                  const TangentWeights&) const;

}  // namespace nurbeam
