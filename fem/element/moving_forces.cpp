// The force of an element with moving ends, from forces on r, r_s and r_ss.
#include <optional>

#include "fem/element/beam_element.h"
#include "fem/element/moving_point.h"
#include "fem/element/moving_strain.h"
#include "fem/element/moving_sums.h"
#include "fem/material/fold_resistance.h"

namespace nurbeam {

namespace {

using Row = MovingRows::Row;

// The force summed over the points.
template <int D>
class ForceSum {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Pair = Eigen::Matrix<double, 2 * D, 1>;

  ForceSum(const BeamProperties& properties, const AxialRule& axial, const ElementState<D>& x,
           const Vector& load)
      : properties_(properties), axial_(axial), load_(load), x_(x), motion_(MovingPoint<D>::motion(x)) {
    if (axial.own_slopes.count() > 0) moments_.emplace();
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

    Vector on_r = momentum_rate - dA * load_;
    Vector on_rs = s_rate * momentum + dA * elastic.gradient.template head<D>();
    Vector on_rss = dA * elastic.gradient.template tail<D>();
    // Forces at a fixed material point, which a moving place leaves behind.
    double pull = rs.dot(momentum_rate) + rs_rate.dot(momentum);
    const double lagrangian = m * v.squaredNorm() / 2 - elastic.energy.total() + load_.dot(r);
    if (properties_.mass_damping > 0) {
      const Vector drag = properties_.mass_damping * momentum;
      on_r += drag;
      pull += drag.dot(rs);
    }
    if (properties_.damping > 0) {
      const Vector rsss = e * rows.rsss;
      Pair rate;
      rate << rs_rate - rss * s_rate,
          e_rate * rows.rss.value + rss_i[0] * w[0] + rss_i[1] * w[1] - rsss * s_rate;
      const Pair stress = dA * damping_response<D>(properties_, rs, rss, rate).stress;
      on_rs += stress.template head<D>();
      on_rss += stress.template tail<D>();
      pull += stress.template head<D>().dot(rss) + stress.template tail<D>().dot(rsss);
    }
    force_.nodes.noalias() += on_r * rows.r.value.transpose();
    force_.nodes.noalias() += on_rs * rows.rs.value.transpose();
    force_.nodes.noalias() += on_rss * rows.rss.value.transpose();
    for (const int i : {0, 1})
      force_.places[i] += on_r.dot(r_i[i]) + on_rs.dot(rs_i[i]) + on_rss.dot(rss_i[i]) - pull * s.d(i) -
                          dA * elastic.moment * rows.kappa0_first[i] - lagrangian * weight.d(i);

    const StrainAtPoint<D> strain{rows.rs, rs, rs_i};
    stretch_.add(strain, weight);
    const double s_a = x_.q[ElementLayout<D>::place(0)], length = x_.q[ElementLayout<D>::place(1)] - s_a;
    const StrainCoefficients<double> in_strain = strain_weights(s.value(), dA, s_a, length);
    for (const std::size_t k : {0, 1}) residue_[k] += in_strain[3 + k] * strain.value();
    std::array<Jet, 5> weights;
    if (moments_) {
      weights = weights_of(s, weight);
      for (int k = 0; k < 3; ++k) (*moments_)[k].add(strain, weights[k]);
    }
    if (!properties_.is_damped()) return;
    const Vector slope_rate = rs_rate - rss * s_rate;
    const std::array<Vector, 2> tests{rs_i[0] - rss * s.d(0), rs_i[1] - rss * s.d(1)};
    stretch_.add_rate(strain, dA, slope_rate, tests);
    for (int k = 0; moments_ && k < 3; ++k)
      (*moments_)[k].add_rate(strain, weights[k].value(), slope_rate, tests);
    taut_.nodes.noalias() += (dA * slope_rate) * rows.rs.value.transpose();
    for (const int i : {0, 1}) taut_.places[i] += dA * slope_rate.dot(tests[i]);
  }

  double fold_factor() const { return x_.stabilisation * axial_.fold_resistance; }
  /// Whether FoldResistance acts. Then add_fold() needs each point once more.
  bool folds(bool assumed) const {
    return assumed && fold_factor() > 0 &&
           squared_residue(residue_[0], residue_[1]) > FoldResistance::r_0 * FoldResistance::r_0;
  }
  void add_fold(const MovingRows& rows, const Jet& s, const Jet& weight) {
    if (!fold_) fold_.emplace();
    const auto& [e, e_rate, e_second, w, w_rate] = motion_;
    const Vector rs = e * rows.rs.value, rss = e * rows.rss.value;
    const std::array<Vector, 2> rs_i{e * rows.rs.first[0], e * rows.rs.first[1]};
    const StrainAtPoint<D> strain{rows.rs, rs, rs_i};
    const std::array<Jet, 5> weights = weights_of(s, weight);
    const double s_rate = s.d(0) * w[0] + s.d(1) * w[1];
    const Vector slope_rate = e_rate * rows.rs.value + rs_i[0] * w[0] + rs_i[1] * w[1] - rss * s_rate;
    const std::array<Vector, 2> tests{rs_i[0] - rss * s.d(0), rs_i[1] - rss * s.d(1)};
    for (const std::size_t k : {0, 1}) {
      (*fold_)[k].add(strain, weights[3 + k]);
      (*fold_)[k].add_rate(strain, weights[3 + k].value(), slope_rate, tests);
    }
  }

  /// `basis`: basis of the points.
  ElementVector<D> total(bool assumed, const MovingBasis& basis) {
    ElementVector<D> f = force_.vector();
    if (fold_) add_fold_force(f);
    if (!assumed && !(properties_.tension_damping > 0)) return f;
    AxialSums<D> axial(x_.q);
    axial.y[0] = stretch_.value;
    axial.y_q.row(0) = stretch_.gradient.vector().transpose();
    if (moments_) take_ends(axial);
    axial.take_out(x_.free_strain);
    f += TautViscosity<D>(properties_, axial, x_.free_strain, x_.taut).value * taut_.vector();
    if (!assumed) return f;
    axial.add_force(axial.energy(properties_, x_.free_strain, axial_.buckling_strain), f);
    if (properties_.damping > 0) add_axial_damping(axial.y[3], basis, f);
    return f;
  }

 private:
  std::array<Jet, 5> weights_of(const Jet& s, const Jet& weight) const {
    using Layout = ElementLayout<D>;
    const Jet s_a = Jet::variable(x_.q[Layout::place(0)], 0), s_b = Jet::variable(x_.q[Layout::place(1)], 1);
    return strain_weights(s, weight, s_a, s_b - s_a);
  }

  void add_fold_force(ElementVector<D>& f) const {
    using Layout = ElementLayout<D>;
    const auto& [third, fourth] = *fold_;
    const FoldStresses<double> fold(properties_, fold_factor(), {third.value, fourth.value});
    const double length = x_.q[Layout::place(1)] - x_.q[Layout::place(0)];
    const std::array<double, 2> viscous = fold.viscous_force({third.rate, fourth.rate});
    for (const std::size_t k : {0, 1}) {
      f += (length * fold.force[k]) * (*fold_)[k].gradient.vector();
      f += (length * viscous[k]) * (*fold_)[k].test();
    }
    f[Layout::place(0)] -= fold.energy;
    f[Layout::place(1)] += fold.energy;
  }

  void take_ends(AxialSums<D>& axial) const {
    Eigen::Vector3d values;
    Eigen::Matrix<double, 3, element_size<D>> gradients;
    for (int k = 0; k < 3; ++k) {
      values[k] = (*moments_)[k].value;
      gradients.row(k) = (*moments_)[k].gradient.vector().transpose();
    }
    axial.take_ends(axial_.own_slopes, values, gradients);
  }

  void add_axial_damping(double l, const MovingBasis& basis, ElementVector<D>& f) const {
    using Layout = ElementLayout<D>;
    // Rates of (eps_A, eps_B, e_0, e_1, e_2) at fixed material, and their gradients in the rates.
    Eigen::Matrix<double, 5, 1> rates = Eigen::Matrix<double, 5, 1>::Zero();
    Eigen::Matrix<double, 5, Layout::size> tests = Eigen::Matrix<double, 5, Layout::size>::Zero();
    for (const int end : {0, 1}) {
      const Jet s = Jet::variable(x_.q[Layout::place(end)], end);
      const Vector slope = motion_.e.col(2 * end + 1), bend = motion_.e * basis.rows_at(s).rss.value;
      rates[end] = slope.dot(motion_.e_rate.col(2 * end + 1) - bend * motion_.w[end]);
      tests.template block<1, D>(end, Layout::slope(end)) = slope.transpose();
      tests(end, Layout::place(end)) = -slope.dot(bend);
    }
    for (int k = 0; moments_ && k < 3; ++k) {
      rates[2 + k] = (*moments_)[k].rate;
      tests.row(2 + k) = (*moments_)[k].test().transpose();
    }
    const Eigen::Matrix<double, 2, 5> rule = matrix_of(assumed_ends(axial_.own_slopes));
    const Eigen::Vector2d ends = rule * rates;
    const Eigen::Vector3d stress =
        AssumedAxialDamping(properties_, l, {stretch_.rate, ends[0], ends[1]}).stress;
    f += stress[0] * stretch_.test();
    f += (rule * tests).transpose() * stress.tail<2>();
  }

  const BeamProperties& properties_;
  const AxialRule& axial_;
  const Vector& load_;
  const ElementState<D>& x_;
  typename MovingPoint<D>::Motion motion_;
  Gradient<D> force_;
  StrainSum<D> stretch_;                                // I of AxialSums
  std::optional<std::array<StrainSum<D>, 3>> moments_;  // e_0, e_1 and e_2, with own slopes alone
  std::array<double, 2> residue_{};                     // e_3 and e_4, and with gradients where they resist
  std::optional<std::array<StrainSum<D>, 2>> fold_;
  Gradient<D> taut_;  // the force of a tension of viscosity 1
};

}  // namespace

template <int D>
ElementVector<D> BeamElement<D>::force(const ElementState<D>& x, const Vector& load) const {
  if (fixed()) return fixed_force(x, load);
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  const MovingBasis basis(*curve_, chart_, s_a, s_b, Derivatives::one);
  ForceSum<D> sum(*properties_, axial_rule_, x, load);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) { sum.add(basis.rows_at(s), s, weight); });
  if (sum.folds(assumes_strain()))
    for_each_place(s_a, s_b,
                   [&](const Jet& s, const Jet& weight) { sum.add_fold(basis.rows_at(s), s, weight); });
  return sum.total(assumes_strain(), basis);
}

template <int D>
typename BeamElement<D>::Points BeamElement<D>::points(const ElementVector<D>& q) const {
  using Layout = ElementLayout<D>;
  const std::array<double, 2> ends{q[Layout::place(0)], q[Layout::place(1)]};
  const Jet s_a = Jet::variable(ends[0], 0), s_b = Jet::variable(ends[1], 1);
  Points points{ends, MovingBasis(*curve_, chart_, s_a, s_b, Derivatives::one), {}};
  points.all.reserve(GaussRule::size);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) {
    points.all.push_back({points.basis.rows_at(s), s, weight});
  });
  return points;
}

template <int D>
ElementVector<D> BeamElement<D>::force(const ElementState<D>& x, const Vector& load,
                                       const Points& points) const {
  ForceSum<D> sum(*properties_, axial_rule_, x, load);
  for (const auto& [rows, s, weight] : points.all) sum.add(rows, s, weight);
  if (sum.folds(assumes_strain()))
    for (const auto& [rows, s, weight] : points.all) sum.add_fold(rows, s, weight);
  return sum.total(assumes_strain(), points.basis);
}

template BeamElement<2>::Points BeamElement<2>::points(const ElementVector<2>&) const;
template BeamElement<3>::Points BeamElement<3>::points(const ElementVector<3>&) const;
template ElementVector<2> BeamElement<2>::force(const ElementState<2>&, const Vector&, const Points&) const;
template ElementVector<3> BeamElement<3>::force(const ElementState<3>&, const Vector&, const Points&) const;
template ElementVector<2> BeamElement<2>::force(const ElementState<2>&, const Vector&) const;
template ElementVector<3> BeamElement<3>::force(const ElementState<3>&, const Vector&) const;

}  // namespace nurbeam
