// The tangent of the force of an element whose ends move: over the points, the sum of the terms of inertia,
// elasticity, load and damping, each by what acts on r, r_s and r_ss. Long because the terms share the point.
#include <tuple>

#include "fem/element/beam_element.h"
#include "fem/element/moving_mass.h"
#include "fem/element/moving_point.h"
#include "fem/element/moving_sums.h"

namespace nurbeam {

namespace {

using Row = MovingRows::Row;

// K = k df/dq + d df/dv + m df/da for the weights k, d, m of TangentWeights. With all rates weighted, one
// increment of the coordinates is one of positions, velocities and accelerations: each field varies by one
// number a node, as it is linear in the nodes, and by one vector a place.
//
//   e, e_rate, e_second  nodes (D x 4) with their rates        w, w_rate      rates of the places s_a, s_b
//   r, rs, rss           the field and its derivatives along s v              of the material, [m/s]
//   A, s                 weight and place of the point         x_rate         dx/dt at the point, which moves
//   x_e, x_i             what x varies by with the nodes, (4), and with place i, by the weighted increment;
//   s_i, A_i, r.first    not weighted: derivatives by place i
//
// The force on node n is on_r R_n + on_rs R_n' + on_rss R_n'' with the rows R of the shape functions; that on
// place i is on_r . r_i + on_rs . rs_i + on_rss . rss_i - pull s_i - lagrangian A_i (a place that moves
// leaves the material behind, and a weight that grows takes in more of it).
template <int D>
class TangentSum {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  using Nodes = ElementNodes<D>;
  using Vectors = std::array<Vector, 2>;

  TangentSum(const BeamProperties& properties, const ElementState<D>& x, const Vector& load,
             const TangentWeights& t)
      : properties_(properties),
        load_(load),
        x_(x),
        t_(t),
        assumed_(properties.axial_strain == AxialStrain::ends_and_mean),
        motion_(MovingPoint<D>::motion(x)) {
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
    add_stretch(p);
    if (properties_.is_damped()) add_damping(p);
  }

  /// `basis`: basis of the points.
  ElementMatrix<D> total(const MovingBasis& basis) const {
    using Layout = ElementLayout<D>;
    constexpr int nodal = Layout::nodal;
    ElementMatrix<D> K = sums_.matrix();
    K.template topLeftCorner<nodal, nodal>() += nodal_;
    if (t_.stiffness == 0 && t_.damping == 0) return K;
    if (!assumed_ && !(properties_.tension_damping > 0)) return K;
    AxialSums<D> axial(x_.q);
    axial.y[0] = stretch_integral_;
    axial.y_q.row(0) = stretch_.vector().transpose();
    axial.take_out(x_.free_strain);
    if (const TautViscosity<D> eta(properties_, axial, x_.free_strain, x_.taut); eta.value != 0)
      K += eta.value * taut_.matrix() + t_.stiffness * taut_force_.vector() * eta.gradient.transpose();
    if (!assumed_) return K;
    PlaceSums<D> I_qq = stretch_rates_;
    I_qq.of_place = I_qq.by_place;
    I_qq.places = stretch_places_;
    if (t_.stiffness != 0) axial.add_tangent(properties_, x_.free_strain, t_.stiffness, I_qq.matrix(), K);
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

  // Where a point is and how it moves.
  struct Point {
    const MovingRows& rows;
    Field r, rs, rss;
    std::array<double, 2> s_i, A_i;
    double A, s_rate, s_second, A_rate;
    Row r1, rs1;                     // rates of the rows of r and r_s,
    std::array<Row, 2> r1_i, rs1_i;  // and their derivatives by the places
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

  // What acts at a point on r, r_s and r_ss, what that varies by with place j, what the force on place i
  // varies by with these fields of the nodes, and what the Lagrangian varies by with place j.
  struct Action {
    Vector on_r, on_rs, on_rss;
    Vectors on_r_i, on_rs_i, on_rss_i;
    Vectors by_r, by_rs, by_rss;
    std::array<double, 2> lagrangian;
  };

  // m (A dv/dt + dA/dt v) on r, and ds/dt m A v on r_s; sets all of the action.
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

  // A dU/dr_s on r_s and A dU/dr_ss on r_ss for the energy U(r_s, r_ss, kappa_0) of the law.
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
      // The moment on kappa_0, which the places change.
      const double moment_i =
          k * (elastic.moment_gradient.dot(z_i) - elastic.moment_slope * rows.kappa0_first[i]);
      for (const int place : {0, 1})
        sums_.places(place, i) -= (A * moment_i + k * p.A_i[i] * elastic.moment) * rows.kappa0_first[place] +
                                  k * A * elastic.moment * rows.kappa0_second[place + i];
    }
  }

  // A dead load on r.
  void add_load(const Point& p, Action& acts) const {
    const double k = t_.stiffness;
    acts.on_r -= p.A * load_;
    for (const int i : {0, 1}) {
      acts.on_r_i[i] -= k * p.A_i[i] * load_;
      acts.by_r[i] -= k * p.A_i[i] * load_;
      acts.lagrangian[i] += k * load_.dot(p.r.first[i]);
    }
  }

  // From the point to the nodes and the places.
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

  // I of AxialSums, its gradient and second derivatives.
  void add_stretch(const Point& p) {
    const auto& [rows, rs, A, A_i] = std::tie(p.rows.rs, p.rs, p.A, p.A_i);
    const double eps = (rs.value.squaredNorm() - 1) / 2;
    stretch_integral_ += A * eps;
    stretch_.nodes.noalias() += (A * rs.value) * rows.value.transpose();
    stretch_rates_.isotropic.noalias() += (A * rows.value) * rows.value.transpose();
    const std::array<double, 2> eps_i{rs.value.dot(rs.first[0]), rs.value.dot(rs.first[1])};
    for (const int i : {0, 1}) {
      stretch_.places[i] += A * eps_i[i] + eps * A_i[i];
      Nodes& by_place = stretch_rates_.by_place[i];
      by_place.noalias() += (A * rs.first[i] + A_i[i] * rs.value) * rows.value.transpose();
      by_place.noalias() += (A * rs.value) * rows.first[i].transpose();
      for (const int j : {0, 1})
        stretch_places_(i, j) += A * (rs.first[i].dot(rs.first[j]) + rs.value.dot(rs.second[i + j])) +
                                 A_i[j] * eps_i[i] + A_i[i] * eps_i[j];
    }
  }

  void add_damping(const Point& p) {
    const MovingRows& rows = p.rows;
    const double k = t_.stiffness, d = t_.damping;
    if (properties_.mass_damping > 0) add_drag(rows.r, rows.rs.value, p);
    if (!(properties_.damping > 0 || properties_.tension_damping > 0)) return;
    // The rate of r_s at fixed material, and its derivatives.
    const Vector rate = p.rs_rate - p.rss.value * p.s_rate;
    const Row rate_e = p.rs_rate_e - (k * p.s_rate) * rows.rss.value;
    Vectors rate_i;
    for (const int i : {0, 1})
      rate_i[i] = p.rs_rate_i[i] - (k * p.s_rate) * p.rss.first[i] - (d * p.s_i[i]) * p.rss.value;
    if (properties_.damping > 0) add_viscosity(rows, p, rate, rate_e, rate_i);
    add_rate_of_stretch(rows, p, rate, rate_e, rate_i);
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

  // Adds to the rate of I at fixed material, and to the force of a tension of viscosity 1, both for r_s
  // alone.
  void add_rate_of_stretch(const MovingRows& rows, const Point& p, const Vector& rate, const Row& rate_e,
                           const Vectors& rate_i) {
    const double k = t_.stiffness, A = p.A;
    const Row& row = rows.rs.value;
    const Vector& rs = p.rs.value;
    stretch_rate_ += A * rs.dot(rate);
    rate_gradient_.nodes.noalias() += (k * A) * rate * row.transpose();
    rate_gradient_.nodes.noalias() += A * rs * rate_e.transpose();
    taut_force_.nodes.noalias() += A * rate * row.transpose();
    taut_.isotropic.noalias() += (A * row) * rate_e.transpose();
    for (const int i : {0, 1}) {
      const Vector test = p.rs.first[i] - p.s_i[i] * p.rss.value;
      const Row test_row = rows.rs.first[i] - p.s_i[i] * rows.rss.value;
      rate_gradient_.places[i] +=
          A * (k * rate.dot(p.rs.first[i]) + rs.dot(rate_i[i])) + (k * p.A_i[i]) * rs.dot(rate);
      test_places_[i] += A * rs.dot(test);
      taut_force_.places[i] += A * rate.dot(test);
      stretch_rates_.of_place[i].noalias() += A * test * row.transpose();
      stretch_rates_.of_place[i].noalias() += A * rs * test_row.transpose();
      taut_.by_place[i].noalias() += (A * rate_i[i] + (k * p.A_i[i]) * rate) * row.transpose();
      taut_.by_place[i].noalias() += (k * A) * rate * rows.rs.first[i].transpose();
      taut_.of_place[i].noalias() += A * test * rate_e.transpose();
      taut_.of_place[i].noalias() += (k * A) * rate * test_row.transpose();
      for (const int j : {0, 1}) {
        const Vector test_j = p.rs.second[i + j] - p.s_i[i] * p.rss.first[j];
        stretch_rates_.places(i, j) +=
            A * (p.rs.first[j].dot(test) + rs.dot(test_j)) + p.A_i[j] * rs.dot(test);
        taut_.places(i, j) +=
            A * (test.dot(rate_i[j]) + k * rate.dot(test_j)) + (k * p.A_i[j]) * rate.dot(test);
      }
    }
  }

  // Adds the tangent of AssumedAxialDamping: stresses on (I, eps_A, eps_B) at fixed material, times their
  // gradients in the rates, Z.
  void add_axial_damping(double l, const MovingBasis& basis, ElementMatrix<D>& K) const {
    using Layout = ElementLayout<D>;
    using Rows = Eigen::Matrix<double, 3, Layout::size>;
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const double k = t_.stiffness, d = t_.damping;
    Eigen::Vector3d rate(stretch_rate_, 0, 0);
    Rows Z = Rows::Zero(), rate_q = Rows::Zero();
    Z.row(0) = Gradient<D>{stretch_.nodes, test_places_}.vector().transpose();
    rate_q.row(0) = rate_gradient_.vector().transpose();
    std::array<ElementMatrix<D>, 2> Z_q{ElementMatrix<D>::Zero(), ElementMatrix<D>::Zero()};
    for (const int end : {0, 1}) {
      // eps' = r_s . (dr_s/dt - r_ss ds/dt), with r_s the node's own slope.
      const MovingRows::Series rss = basis.rows_at(Jet::variable(x_.q[Layout::place(end)], end)).rss;
      const Vector slope = e.col(2 * end + 1), bend = e * rss.value;
      const Vector slope_rate = e_rate.col(2 * end + 1) - bend * w[end];
      const int at = Layout::slope(end), place = Layout::place(end);
      rate[1 + end] = slope.dot(slope_rate);
      Z.template block<1, D>(1 + end, at) = slope.transpose();
      Z(1 + end, place) = -bend.dot(slope);
      Gradient<D> bending;  // gradient of slope . bend by bend alone
      bending.nodes = slope * rss.value.transpose();
      for (const int j : {0, 1}) bending.places[j] = slope.dot(e * rss.first[j]);
      auto own_rate = rate_q.row(1 + end);
      own_rate = -(k * w[end]) * bending.vector().transpose();
      own_rate.template segment<D>(at) += (k * slope_rate + d * slope).transpose();
      own_rate[place] -= d * bend.dot(slope);
      ElementMatrix<D>& own = Z_q[end];
      own.template block<D, D>(at, at).setIdentity();
      own.row(place) = -bending.vector().transpose();
      own.template block<1, D>(place, at) -= bend.transpose();
    }
    const AssumedAxialDamping damping(properties_, l, rate);
    Rows stress_q = damping.by_rate * rate_q;
    stress_q.col(Layout::place(0)) -= k * damping.by_length;
    stress_q.col(Layout::place(1)) += k * damping.by_length;
    K += Z.transpose() * stress_q;
    if (k == 0) return;
    K += (k * damping.stress[0]) * stretch_rates_.matrix();
    for (const int end : {0, 1}) K += (k * damping.stress[1 + end]) * Z_q[end];
  }

  const BeamProperties& properties_;
  const Vector& load_;
  const ElementState<D>& x_;
  const TangentWeights& t_;
  bool assumed_;
  typename MovingPoint<D>::Motion motion_;
  Eigen::Matrix<double, 4 * D, 4 * D> nodal_;
  PlaceSums<D> sums_;
  double stretch_integral_ = 0;  ///< I of AxialSums; stretch_: its gradient
  Gradient<D> stretch_;
  Eigen::Matrix2d stretch_places_ = Eigen::Matrix2d::Zero();  ///< second derivatives of I by the places
  // For damped elements: the rate of I at fixed material and its gradients in the coordinates (with the rates
  // weighted) and in the rates of the places. Further the derivatives of this gradient in all rates; in the
  // rates of the nodes it is the gradient of I.
  double stretch_rate_ = 0;
  Gradient<D> rate_gradient_;
  std::array<double, 2> test_places_{};
  PlaceSums<D> stretch_rates_;
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
  TangentSum<D> sum(*properties_, x, load, t);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) { sum.add(basis.rows_at(s), s, weight); });
  return sum.total(basis);
}

template <int D>
std::array<ElementMatrix<D>, 2> BeamElement<D>::tangents(const ElementState<D>& x, const Vector& load,
                                                         const std::array<TangentWeights, 2>& w) const {
  if (fixed()) return {fixed_tangent(x, w[0]), fixed_tangent(x, w[1])};
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  const MovingBasis basis(*curve_, chart_, s_a, s_b);
  TangentSum<D> first(*properties_, x, load, w[0]), second(*properties_, x, load, w[1]);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) {
    const MovingRows rows = basis.rows_at(s);
    first.add(rows, s, weight);
    second.add(rows, s, weight);
  });
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
