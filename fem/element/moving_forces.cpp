// The force of an element with moving ends, from forces on r, r_s and r_ss.
#include "fem/element/beam_element.h"
#include "fem/element/moving_point.h"
#include "fem/element/moving_sums.h"

namespace nurbeam {

namespace {

using Row = MovingRows::Row;

// The force summed over the points.
template <int D>
class ForceSum {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Pair = Eigen::Matrix<double, 2 * D, 1>;

  ForceSum(const BeamProperties& properties, const ElementState<D>& x, const Vector& load)
      : properties_(properties), load_(load), x_(x), motion_(MovingPoint<D>::motion(x)) {}

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

    const double eps = (rs.squaredNorm() - 1) / 2;
    stretch_integral_ += dA * eps;
    stretch_.nodes.noalias() += (dA * rs) * rows.rs.value.transpose();
    for (const int i : {0, 1}) stretch_.places[i] += dA * rs.dot(rs_i[i]) + eps * weight.d(i);
    if (!properties_.is_damped()) return;
    const Vector stretching = dA * (rs_rate - rss * s_rate);
    stretch_rate_ += rs.dot(stretching);
    taut_.nodes.noalias() += stretching * rows.rs.value.transpose();
    for (const int i : {0, 1}) {
      const Vector test = rs_i[i] - rss * s.d(i);
      place_test_[i] += dA * rs.dot(test);
      taut_.places[i] += stretching.dot(test);
    }
  }

  /// `basis`: basis of the points.
  ElementVector<D> total(bool assumed, const MovingBasis& basis) {
    ElementVector<D> f = force_.vector();
    if (!assumed && !(properties_.tension_damping > 0)) return f;
    AxialSums<D> axial(x_.q);
    axial.y[0] = stretch_integral_;
    axial.y_q.row(0) = stretch_.vector().transpose();
    axial.take_out(x_.free_strain);
    f += TautViscosity<D>(properties_, axial, x_.free_strain, x_.taut).value * taut_.vector();
    if (!assumed) return f;
    axial.add_force(properties_, x_.free_strain, f);
    if (properties_.damping > 0) add_axial_damping(axial.y[3], basis, f);
    return f;
  }

 private:
  void add_axial_damping(double l, const MovingBasis& basis, ElementVector<D>& f) const {
    using Layout = ElementLayout<D>;
    Eigen::Vector3d rate(stretch_rate_, 0, 0);
    std::array<Vector, 2> slope, bend;
    for (const int end : {0, 1}) {
      const Jet s = Jet::variable(x_.q[Layout::place(end)], end);
      slope[end] = motion_.e.col(2 * end + 1);
      bend[end] = motion_.e * basis.rows_at(s).rss.value;
      rate[1 + end] = slope[end].dot(motion_.e_rate.col(2 * end + 1) - bend[end] * motion_.w[end]);
    }
    const Eigen::Vector3d stress = AssumedAxialDamping(properties_, l, rate).stress;
    f += stress[0] * Gradient<D>{stretch_.nodes, place_test_}.vector();
    for (const int end : {0, 1}) {
      f.template segment<D>(Layout::slope(end)) += stress[1 + end] * slope[end];
      f[Layout::place(end)] -= stress[1 + end] * slope[end].dot(bend[end]);
    }
  }

  const BeamProperties& properties_;
  const Vector& load_;
  const ElementState<D>& x_;
  typename MovingPoint<D>::Motion motion_;
  Gradient<D> force_;
  double stretch_integral_ = 0;  ///< I of AxialSums; stretch_: its gradient
  Gradient<D> stretch_;
  // For damped elements: the rate of I at fixed material and its gradient in the rates of the places, and the
  // force of a tension of viscosity 1.
  double stretch_rate_ = 0;
  std::array<double, 2> place_test_{};
  Gradient<D> taut_;
};

}  // namespace

template <int D>
ElementVector<D> BeamElement<D>::force(const ElementState<D>& x, const Vector& load) const {
  if (fixed()) return fixed_force(x, load);
  using Layout = ElementLayout<D>;
  const Jet s_a = Jet::variable(x.q[Layout::place(0)], 0), s_b = Jet::variable(x.q[Layout::place(1)], 1);
  const MovingBasis basis(*curve_, chart_, s_a, s_b, Derivatives::one);
  ForceSum<D> sum(*properties_, x, load);
  for_each_place(s_a, s_b, [&](const Jet& s, const Jet& weight) { sum.add(basis.rows_at(s), s, weight); });
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
  ForceSum<D> sum(*properties_, x, load);
  for (const auto& [rows, s, weight] : points.all) sum.add(rows, s, weight);
  return sum.total(assumes_strain(), points.basis);
}

template BeamElement<2>::Points BeamElement<2>::points(const ElementVector<2>&) const;
template BeamElement<3>::Points BeamElement<3>::points(const ElementVector<3>&) const;
template ElementVector<2> BeamElement<2>::force(const ElementState<2>&, const Vector&, const Points&) const;
template ElementVector<3> BeamElement<3>::force(const ElementState<3>&, const Vector&, const Points&) const;
template ElementVector<2> BeamElement<2>::force(const ElementState<2>&, const Vector&) const;
template ElementVector<3> BeamElement<3>::force(const ElementState<3>&, const Vector&) const;

}  // namespace nurbeam
