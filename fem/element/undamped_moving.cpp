// The forces and tangents of undamped elements whose ends move: the same as PointInertia, Potential and
// AxialSums, which have them in matrices of all coordinates, by what acts on r, r_s and r_ss.
#include "fem/element/beam_element.h"
#include "fem/element/moving_point.h"

namespace nurbeam {

namespace {

using Row = MovingRows::Row;

// The force, summed over the points.
template <int D>
class ForceSum {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Nodes = ElementNodes<D>;

  ForceSum(const BeamProperties& properties, const ElementState<D>& x, const Vector& load, bool assumed)
      : properties_(properties), load_(load), assumed_(assumed), motion_(MovingPoint<D>::motion(x)) {
    force_.setZero();
    stretch_.setZero();
  }

  void add(const MovingRows& rows, const Jet& s, const Jet& weight) {
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const Vector r = e * rows.r.value, rs = e * rows.rs.value, rss = e * rows.rss.value;
    const std::array<Vector, 2> r_i{e * rows.r.first[0], e * rows.r.first[1]},
        rs_i{e * rows.rs.first[0], e * rows.rs.first[1]}, rss_i{e * rows.rss.first[0], e * rows.rss.first[1]};
    const Row r_rate_row = rows.r.first[0] * w[0] + rows.r.first[1] * w[1];
    const Row second_row = rows.r.second[0] * (w[0] * w[0]) + rows.r.second[1] * (2 * w[0] * w[1]) +
                           rows.r.second[2] * (w[1] * w[1]);
    const double s_rate = s.d(0) * w[0] + s.d(1) * w[1], s_second = s.d(0) * w_rate[0] + s.d(1) * w_rate[1];
    const double dA = weight.value(), dA_rate = weight.d(0) * w[0] + weight.d(1) * w[1];
    const double m = properties_.mass_per_length;

    const Vector rs_rate = e_rate * rows.rs.value + rs_i[0] * w[0] + rs_i[1] * w[1];
    const Vector v = e_rate * rows.r.value + r_i[0] * w[0] + r_i[1] * w[1] - rs * s_rate;
    const Vector r_second = e_second * rows.r.value + 2 * e_rate * r_rate_row + e * second_row +
                            r_i[0] * w_rate[0] + r_i[1] * w_rate[1];
    const Vector momentum_rate = m * (dA * (r_second - rs_rate * s_rate - rs * s_second) + dA_rate * v);
    const Vector momentum = (m * dA) * v;
    const ElasticResponse<D> elastic =
        elastic_response<D, Derivatives::one>(properties_, rs, rss, rows.kappa0);

    const Vector on_r = momentum_rate - dA * load_;
    const Vector on_rs = s_rate * momentum + dA * elastic.gradient.template head<D>();
    const Vector on_rss = dA * elastic.gradient.template tail<D>();
    force_.noalias() += on_r * rows.r.value.transpose();
    force_.noalias() += on_rs * rows.rs.value.transpose();
    force_.noalias() += on_rss * rows.rss.value.transpose();
    const double lagrangian = m * v.squaredNorm() / 2 - elastic.energy.total() + load_.dot(r);
    const double pull = rs.dot(momentum_rate) + rs_rate.dot(momentum);
    for (const int i : {0, 1})
      place_force_[i] += on_r.dot(r_i[i]) + on_rs.dot(rs_i[i]) + on_rss.dot(rss_i[i]) - pull * s.d(i) -
                         dA * elastic.moment * rows.kappa0_first[i] - lagrangian * weight.d(i);
    if (!assumed_) return;
    const double eps = (rs.squaredNorm() - 1) / 2;
    stretch_integral_ += dA * eps;
    stretch_.noalias() += (dA * rs) * rows.rs.value.transpose();
    for (const int i : {0, 1}) place_stretch_[i] += dA * rs.dot(rs_i[i]) + eps * weight.d(i);
  }

  ElementVector<D> total(const ElementState<D>& x) {
    using Layout = ElementLayout<D>;
    ElementVector<D> f;
    f.template head<4 * D>() = Eigen::Map<const Eigen::Matrix<double, 4 * D, 1>>(force_.data());
    for (const int i : {0, 1}) f[Layout::place(i)] = place_force_[i];
    if (!assumed_) return f;
    AxialSums<D> axial(x.q);
    axial.y[0] = stretch_integral_;
    axial.y_q.template block<1, 4 * D>(0, 0) =
        Eigen::Map<const Eigen::Matrix<double, 1, 4 * D>>(stretch_.data());
    for (const int i : {0, 1}) axial.y_q(0, Layout::place(i)) = place_stretch_[i];
    axial.take_out(x.free_strain);
    axial.add_force(properties_.axial_stiffness, f);
    return f;
  }

 private:
  const BeamProperties& properties_;
  const Vector& load_;
  bool assumed_;
  typename MovingPoint<D>::Motion motion_;
  Nodes force_;
  std::array<double, 2> place_force_{};
  double stretch_integral_ = 0;  ///< I of AxialSums, and its gradient
  Nodes stretch_;
  std::array<double, 2> place_stretch_{};
};

// Its tangent, summed over the points. With all rates weighted (TangentWeights), one increment of the
// coordinates is one of positions, velocities and accelerations: each field varies by one number a node, as
// it is linear in the nodes, and by one vector a place.
template <int D>
class TangentSum {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  using Nodes = ElementNodes<D>;
  using Vectors = std::array<Vector, 2>;

  TangentSum(const BeamProperties& properties, const ElementState<D>& x, const Vector& load, bool assumed,
             const TangentWeights& t)
      : properties_(properties), load_(load), assumed_(assumed), t_(t), motion_(MovingPoint<D>::motion(x)) {
    elastic_.setZero();
    isotropic_.setZero();
    stretch_.setZero();
    stretch_hessian_.setZero();
    for (const int i : {0, 1}) by_place_[i].setZero(), of_place_[i].setZero(), stretch_by_place_[i].setZero();
    places_.setZero();
    stretch_places_.setZero();
  }

  void add(const MovingRows& rows, const Jet& s, const Jet& weight) {
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const double k = t_.stiffness, d = t_.damping, mass = t_.mass;
    const double m = properties_.mass_per_length, A = weight.value();
    const std::array<double, 2> s_i{s.d(0), s.d(1)}, A_i{weight.d(0), weight.d(1)};
    const double s_rate = s_i[0] * w[0] + s_i[1] * w[1], s_second = s_i[0] * w_rate[0] + s_i[1] * w_rate[1],
                 A_rate = A_i[0] * w[0] + A_i[1] * w[1];
    const Field r(e, rows.r), rs(e, rows.rs), rss(e, rows.rss);

    // Rates of the rows and what they vary by with the places.
    const Row r1 = along(rows.r.first, w), rs1 = along(rows.rs.first, w);
    const std::array<Row, 2> r1_i = along(rows.r.second, w), rs1_i = along(rows.rs.second, w);
    const Row r2 = along(r1_i, w) + along(rows.r.first, w_rate);
    std::array<Row, 2> r2_i = along(rows.r.second, w_rate);
    for (const int i : {0, 1})
      r2_i[i] += rows.r_third[i] * (w[0] * w[0]) + rows.r_third[i + 1] * (2 * w[0] * w[1]) +
                 rows.r_third[i + 2] * (w[1] * w[1]);

    const Vector rs_rate = e_rate * rows.rs.value + e * rs1;
    const Vector v = e_rate * rows.r.value + e * r1 - rs.value * s_rate;
    const Vector acceleration =
        e_second * rows.r.value + 2 * e_rate * r1 + e * r2 - rs_rate * s_rate - rs.value * s_second;
    const Vector momentum_rate = m * (A * acceleration + A_rate * v), momentum = (m * A) * v;
    const ElasticResponse<D> elastic = elastic_response<D>(properties_, rs.value, rss.value, rows.kappa0);
    const Vector g_s = elastic.gradient.template head<D>(), g_t = elastic.gradient.template tail<D>();
    const Vector on_r = momentum_rate - A * load_, on_rs = s_rate * momentum + A * g_s, on_rss = A * g_t;

    // What they vary by: of the nodes, then of the places.
    const Row rs_rate_e = d * rows.rs.value + k * rs1;
    const Row v_e = d * rows.r.value + k * (r1 - s_rate * rows.rs.value);
    const Row acceleration_e =
        mass * rows.r.value + 2 * d * r1 + k * (r2 - s_second * rows.rs.value) - s_rate * rs_rate_e;
    const Row momentum_rate_e = m * (A * acceleration_e + A_rate * v_e), momentum_e = (m * A) * v_e;
    Vectors rs_rate_i, v_i, momentum_rate_i, momentum_i, on_r_i, on_rs_i, on_rss_i, elastic_s, elastic_t;
    for (const int i : {0, 1}) {
      const Vector r1_along = e_rate * rows.r.first[i] + e * r1_i[i];
      rs_rate_i[i] = k * (e_rate * rows.rs.first[i] + e * rs1_i[i]) + d * rs.first[i];
      v_i[i] = k * (r1_along - rs.first[i] * s_rate) + d * (r.first[i] - rs.value * s_i[i]);
      const Vector acceleration_i =
          k * (e_second * rows.r.first[i] + 2 * e_rate * r1_i[i] + e * r2_i[i] - s_second * rs.first[i]) +
          d * (2 * r1_along - s_i[i] * rs_rate) + mass * (r.first[i] - s_i[i] * rs.value) -
          s_rate * rs_rate_i[i];
      momentum_rate_i[i] =
          m * (A * acceleration_i + k * A_i[i] * acceleration + A_rate * v_i[i] + d * A_i[i] * v);
      momentum_i[i] = m * (A * v_i[i] + k * A_i[i] * v);
      Pair z;
      z << rs.first[i], rss.first[i];
      const Pair g_i = elastic.hessian * z - elastic.moment_gradient * rows.kappa0_first[i];
      elastic_s[i] = (k * A) * g_i.template head<D>();
      elastic_t[i] = (k * A) * g_i.template tail<D>();
      on_r_i[i] = momentum_rate_i[i] - k * A_i[i] * load_;
      on_rs_i[i] = s_rate * momentum_i[i] + d * s_i[i] * momentum + k * A_i[i] * g_s + elastic_s[i];
      on_rss_i[i] = k * A_i[i] * g_t + elastic_t[i];
    }

    // Forces on the nodes.
    isotropic_.noalias() += rows.r.value * momentum_rate_e.transpose();
    isotropic_.noalias() += rows.rs.value * (s_rate * momentum_e).transpose();
    add_elastic(elastic.hessian, k * A, rows);
    for (const int i : {0, 1}) {
      by_place_[i].noalias() += on_r_i[i] * rows.r.value.transpose();
      by_place_[i].noalias() += on_rs_i[i] * rows.rs.value.transpose();
      by_place_[i].noalias() += on_rss_i[i] * rows.rss.value.transpose();
      Nodes shared = on_r * rows.r.first[i].transpose();
      shared.noalias() += on_rs * rows.rs.first[i].transpose();
      shared.noalias() += on_rss * rows.rss.first[i].transpose();
      by_place_[i] += k * shared;

      // Forces on the places.
      Nodes& of_nodes = of_place_[i];
      of_nodes += k * shared;
      of_nodes.noalias() += r.first[i] * momentum_rate_e.transpose();
      of_nodes.noalias() += rs.first[i] * (s_rate * momentum_e).transpose();
      of_nodes.noalias() +=
          (elastic_s[i] - s_i[i] * k * momentum_rate + A_i[i] * k * g_s) * rows.rs.value.transpose();
      of_nodes.noalias() += (elastic_t[i] + A_i[i] * k * g_t) * rows.rss.value.transpose();
      of_nodes.noalias() -= (A_i[i] * k) * load_ * rows.r.value.transpose();
      of_nodes.noalias() -= (s_i[i] * rs.value) * momentum_rate_e.transpose();
      of_nodes.noalias() -= (s_i[i] * momentum) * rs_rate_e.transpose();
      of_nodes.noalias() -= (s_i[i] * rs_rate) * momentum_e.transpose();
      of_nodes.noalias() -= (A_i[i] * m) * v * v_e.transpose();
    }
    for (const int j : {0, 1}) {
      const double pull_j = k * rs.first[j].dot(momentum_rate) + rs.value.dot(momentum_rate_i[j]) +
                            rs_rate_i[j].dot(momentum) + rs_rate.dot(momentum_i[j]);
      const double lagrangian_j =
          m * v.dot(v_i[j]) + k * (load_.dot(r.first[j]) - g_s.dot(rs.first[j]) - g_t.dot(rss.first[j]) +
                                   elastic.moment * rows.kappa0_first[j]);
      Pair z;
      z << rs.first[j], rss.first[j];
      const double moment_j =
          k * (elastic.moment_gradient.dot(z) - elastic.bending_stiffness * rows.kappa0_first[j]);
      for (const int i : {0, 1})
        places_(i, j) +=
            on_r_i[j].dot(r.first[i]) + on_rs_i[j].dot(rs.first[i]) + on_rss_i[j].dot(rss.first[i]) +
            k * (on_r.dot(r.second[i + j]) + on_rs.dot(rs.second[i + j]) + on_rss.dot(rss.second[i + j])) -
            pull_j * s_i[i] - lagrangian_j * A_i[i] -
            (A * moment_j + k * A_i[j] * elastic.moment) * rows.kappa0_first[i] -
            k * A * elastic.moment * rows.kappa0_second[i + j];
    }
    if (assumed_ && k != 0) add_stretch(rows.rs, rs, A, A_i);
  }

  ElementMatrix<D> total(const ElementState<D>& x) const {
    using Layout = ElementLayout<D>;
    constexpr int nodal = Layout::nodal;
    ElementMatrix<D> K = in_coordinates(isotropic_, by_place_, of_place_, places_);
    K.template topLeftCorner<nodal, nodal>() += elastic_;
    if (!assumed_ || t_.stiffness == 0) return K;
    AxialSums<D> axial(x.q);
    axial.y[0] = stretch_integral_;
    axial.y_q.template block<1, nodal>(0, 0) =
        Eigen::Map<const Eigen::Matrix<double, 1, nodal>>(stretch_.data());
    for (const int i : {0, 1}) axial.y_q(0, Layout::place(i)) = place_stretch_[i];
    axial.take_out(x.free_strain);
    axial.add_tangent(properties_.axial_stiffness, t_.stiffness,
                      in_coordinates(stretch_hessian_, stretch_by_place_, stretch_by_place_, stretch_places_),
                      K);
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

  void add_elastic(const Eigen::Matrix<double, 2 * D, 2 * D>& hessian, double factor,
                   const MovingRows& rows) {
    using Block = Eigen::Matrix<double, D, D>;
    const Block ss = factor * hessian.template topLeftCorner<D, D>(),
                st = factor * hessian.template topRightCorner<D, D>(),
                tt = factor * hessian.template bottomRightCorner<D, D>();
    const Row &s = rows.rs.value, &t = rows.rss.value;
    for (int k = 0; k < 4; ++k) {
      const Block by_s = s[k] * ss + t[k] * st, by_t = s[k] * st.transpose() + t[k] * tt;
      for (int l = 0; l < 4; ++l) elastic_.template block<D, D>(l * D, k * D) += s[l] * by_s + t[l] * by_t;
    }
  }

  void add_stretch(const MovingRows::Series& rows, const Field& rs, double A,
                   const std::array<double, 2>& A_i) {
    const double eps = (rs.value.squaredNorm() - 1) / 2;
    stretch_integral_ += A * eps;
    stretch_.noalias() += (A * rs.value) * rows.value.transpose();
    stretch_hessian_.noalias() += (A * rows.value) * rows.value.transpose();
    const std::array<double, 2> eps_i{rs.value.dot(rs.first[0]), rs.value.dot(rs.first[1])};
    for (const int i : {0, 1}) {
      place_stretch_[i] += A * eps_i[i] + eps * A_i[i];
      stretch_by_place_[i].noalias() += (A * rs.first[i] + A_i[i] * rs.value) * rows.value.transpose();
      stretch_by_place_[i].noalias() += (A * rs.value) * rows.first[i].transpose();
      for (const int j : {0, 1})
        stretch_places_(i, j) += A * (rs.first[i].dot(rs.first[j]) + rs.value.dot(rs.second[i + j])) +
                                 A_i[j] * eps_i[i] + A_i[i] * eps_i[j];
    }
  }

  static ElementMatrix<D> in_coordinates(const Eigen::Matrix4d& isotropic,
                                         const std::array<Nodes, 2>& by_place,
                                         const std::array<Nodes, 2>& of_place,
                                         const Eigen::Matrix2d& places) {
    using Layout = ElementLayout<D>;
    using Column = Eigen::Matrix<double, Layout::nodal, 1>;
    ElementMatrix<D> K = ElementMatrix<D>::Zero();
    for (int k = 0; k < 4; ++k)
      for (int l = 0; l < 4; ++l)
        for (int c = 0; c < D; ++c) K(l * D + c, k * D + c) = isotropic(l, k);
    for (const int i : {0, 1}) {
      K.col(Layout::place(i)).template head<Layout::nodal>() = Eigen::Map<const Column>(by_place[i].data());
      K.row(Layout::place(i)).template head<Layout::nodal>() =
          Eigen::Map<const Column>(of_place[i].data()).transpose();
    }
    K.template bottomRightCorner<2, 2>() = places;
    return K;
  }

  const BeamProperties& properties_;
  const Vector& load_;
  bool assumed_;
  const TangentWeights& t_;
  typename MovingPoint<D>::Motion motion_;
  Eigen::Matrix<double, 4 * D, 4 * D> elastic_;
  Eigen::Matrix4d isotropic_;                 ///< what is the same for all components
  std::array<Nodes, 2> by_place_, of_place_;  ///< forces on nodes by the places, on places by the nodes
  Eigen::Matrix2d places_;                    ///< forces on places by the places
  double stretch_integral_ = 0;               ///< I of AxialSums, its gradient and second derivatives
  Nodes stretch_;
  std::array<double, 2> place_stretch_{};
  Eigen::Matrix4d stretch_hessian_;
  std::array<Nodes, 2> stretch_by_place_;
  Eigen::Matrix2d stretch_places_;
};

}  // namespace

template <int D>
ElementVector<D> BeamElement<D>::undamped_force(const ElementState<D>& x, const Vector& load) const {
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  const MovingBasis basis(*curve_, chart_, s_a, s_b, Derivatives::one);
  ForceSum<D> sum(*properties_, x, load, assumes_strain());
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) { sum.add(basis.rows_at(s), s, weight); });
  return sum.total(x);
}

template <int D>
ElementMatrix<D> BeamElement<D>::undamped_tangent(const ElementState<D>& x, const Vector& load,
                                                  const TangentWeights& t) const {
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  const MovingBasis basis(*curve_, chart_, s_a, s_b);
  TangentSum<D> sum(*properties_, x, load, assumes_strain(), t);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) { sum.add(basis.rows_at(s), s, weight); });
  return sum.total(x);
}

template ElementVector<2> BeamElement<2>::undamped_force(const ElementState<2>&, const Vector&) const;
template ElementVector<3> BeamElement<3>::undamped_force(const ElementState<3>&, const Vector&) const;
template ElementMatrix<2> BeamElement<2>::undamped_tangent(const ElementState<2>&, const Vector&,
                                                           const TangentWeights&) const;
template ElementMatrix<3> BeamElement<3>::undamped_tangent(const ElementState<3>&, const Vector&,
                                                           const TangentWeights&) const;

}  // namespace nurbeam
