#include "fem/element/beam_element.h"

#include <stdexcept>

#include "fem/element/inertia.h"

namespace nurbeam {

namespace {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;
template <int D>
using Nodes = Eigen::Matrix<double, D, 4>;

template <int D>
Nodes<D> nodes(const ElementVector<D>& q) {
  return Eigen::Map<const Nodes<D>>(q.data());
}

template <int D>
std::array<double, 2> ends(const ElementVector<D>& q) {
  return {q[4 * D], q[4 * D + 1]};
}

Eigen::Vector4d row(const std::array<double, 4>& values) {
  return Eigen::Map<const Eigen::Vector4d>(values.data());
}

}  // namespace

template <int D>
BeamElement<D>::BeamElement(const ReferenceCurve& curve, const BeamProperties& properties, Chart chart,
                            double s_a, double s_b, bool fixed, bool straight)
    : curve_(&curve), properties_(&properties), chart_(std::move(chart)), fixed_(fixed), straight_(straight) {
  mass_.setZero();
  load_factor_.setZero();
  if (!fixed_ && curve.metric() == Metric::label)
    throw std::invalid_argument("an element whose ends move needs the metric of the drawn curve");
  if (!fixed_) return;
  for_each_point(s_a, s_b, [&](const ShapeFunctions<double>& shape, double s, double weight) {
    const FixedPoint p{row(shape.value), row(shape.d1), row(shape.d2), weight, straight_ ? 0 : shape.kappa0,
                       curve.strain(s)};
    points_.push_back(p);
    mass_ += properties_->mass_per_length * weight * p.S * p.S.transpose();
    load_factor_ += weight * p.S;
  });
}

template <int D>
template <class T, class Visit>
void BeamElement<D>::for_each_point(const T& s_a, const T& s_b, Visit&& visit) const {
  const ElementBasis<T> basis(*curve_, chart_, s_a, s_b);
  const auto visit_part = [&](const T& lo, const T& hi) {
    for (int g = 0; g < GaussRule::size; ++g) {
      const T s = lo + (hi - lo) * GaussRule::points[g];
      visit(basis.at(s), s, (hi - lo) * GaussRule::weights[g]);
    }
  };
  T lo = s_a;
  if (chart_.segment < 0)
    for (double s = curve_->next_break(value(s_a)); s < value(s_b); s = curve_->next_break(s)) {
      visit_part(lo, T(s));
      lo = T(s);
    }
  visit_part(lo, s_b);
}

template <int D>
void BeamElement<D>::respond(const ElementState<D>& x, const Vector<D>& load, const TangentWeights* weights,
                             ElementResponse<D>& response) const {
  response.force.setZero();
  if (weights) response.tangent.setZero();
  if (fixed_)
    respond_fixed(x, load, weights, response);
  else if (properties_->form == Form::virtual_work)
    respond_virtual_work(x, load, weights, response);
  else
    respond_moving(x, load, weights, response);
}

template <int D>
void BeamElement<D>::respond_fixed(const ElementState<D>& x, const Vector<D>& load,
                                   const TangentWeights* weights, ElementResponse<D>& response) const {
  const Nodes<D> e = nodes<D>(x.q), e_rate = nodes<D>(x.v);
  Eigen::Map<Nodes<D>> force(response.force.data());
  force = nodes<D>(x.a) * mass_ - load * load_factor_.transpose();

  const bool damped = properties_->damping > 0;
  for (const FixedPoint& p : points_) {
    const Vector<D> rs = e * p.S1, rss = e * p.S2;
    const ElasticResponse<D> elastic = elastic_response<D>(*properties_, rs, rss, p.kappa0, p.eps0);
    Eigen::Matrix<double, 2 * D, 1> stress = elastic.gradient;
    Eigen::Matrix<double, 2 * D, 2 * D> H;
    if (weights) H = weights->stiffness * elastic.hessian;
    if (damped) {
      Eigen::Matrix<double, 2 * D, 1> rate;
      rate << e_rate * p.S1, e_rate * p.S2;
      const DampingResponse<D> d = damping_response<D>(*properties_, rs, rss, rate);
      stress += d.stress;
      if (weights) H += weights->stiffness * d.by_z + weights->damping * d.by_rate;
    }
    force += p.weight *
             (stress.template head<D>() * p.S1.transpose() + stress.template tail<D>() * p.S2.transpose());
    if (!weights) continue;
    for (int l = 0; l < 4; ++l) {
      const Eigen::Matrix<double, 2 * D, D> column =
          p.weight * (H.template leftCols<D>() * p.S1[l] + H.template rightCols<D>() * p.S2[l]);
      for (int k = 0; k < 4; ++k)
        response.tangent.template block<D, D>(k * D, l * D) +=
            p.S1[k] * column.template topRows<D>() + p.S2[k] * column.template bottomRows<D>();
    }
  }
  if (!weights) return;
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      response.tangent.template block<D, D>(k * D, l * D).diagonal().array() += weights->mass * mass_(k, l);
}

template <int D>
void BeamElement<D>::respond_moving(const ElementState<D>& x, const Vector<D>& load,
                                    const TangentWeights* weights, ElementResponse<D>& response) const {
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  using PairGradient = Eigen::Matrix<double, 2 * D, element_size<D>>;
  const typename PointInertia<D>::Motion motion{nodes<D>(x.q), nodes<D>(x.v), nodes<D>(x.a), ends<D>(x.v),
                                                ends<D>(x.a)};
  const Nodes<D>& e = motion.e;
  auto& f = response.force;
  auto& K = response.tangent;
  const double rho = properties_->mass_per_length, EI = properties_->bending_stiffness;

  for_each_point(Jet::variable(x.q[4 * D], 0), Jet::variable(x.q[4 * D + 1], 1),
                 [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
                   const PointField<D> r(shape.value, e), rs(shape.d1, e), rss(shape.d2, e);
                   const double w = weight.value();

                   const PointInertia<D> inertia(shape, s, weight, r, rs, motion);
                   inertia.add_force(rho, f);
                   if (weights) inertia.add_tangent(rho, *weights, K);
                   const ElementVector<D>& w_q = inertia.weight_gradient();

                   // External potential -w load . r.
                   const ElementVector<D> load_q = r.gradient.transpose() * load;
                   const double load_r = load.dot(r.value);
                   f -= w * load_q + load_r * w_q;

                   // Strain energy w psi(z, kappa0).
                   ElementVector<D> kappa_q = ElementVector<D>::Zero();
                   if (!straight_)
                     for (int i = 0; i < 2; ++i) kappa_q[4 * D + i] = shape.kappa0.d(i);
                   PairGradient B;
                   B << rs.gradient, rss.gradient;
                   const ElasticResponse<D> elastic = elastic_response<D>(
                       *properties_, rs.value, rss.value, straight_ ? 0 : shape.kappa0.value());
                   const double psi = elastic.energy.total();
                   const ElementVector<D> psi_q = B.transpose() * elastic.gradient - elastic.moment * kappa_q;
                   f += w * psi_q + psi * w_q;

                   if (weights && weights->stiffness != 0) {
                     const double k = weights->stiffness;
                     const ElementVector<D> potential_q = psi_q - load_q;
                     const ElementVector<D> moment_q = B.transpose() * elastic.moment_gradient;
                     K += k * (w * (B.transpose() * elastic.hessian * B - kappa_q * moment_q.transpose() -
                                    moment_q * kappa_q.transpose() + EI * kappa_q * kappa_q.transpose()) +
                               potential_q * w_q.transpose() + w_q * potential_q.transpose());
                     rs.add_hessian(elastic.gradient.template head<D>(), k * w, e, K);
                     rss.add_hessian(elastic.gradient.template tail<D>(), k * w, e, K);
                     r.add_hessian(load, -k * w, e, K);
                     if (!straight_)
                       for (int i = 0; i < 2; ++i)
                         for (int j = 0; j < 2; ++j)
                           K(4 * D + i, 4 * D + j) -= k * w * elastic.moment * shape.kappa0.d(i, j);
                   }

                   if (properties_->damping <= 0) return;
                   // Damping: w Z' y(z, zeta), zeta = dz/dt - z_s ds/dt, Z = dz/dq - z_s s_q'.
                   const PointField<D> rsss(shape.d3, e);
                   const double s_rate = inertia.place_rate();
                   const ElementVector<D>& s_q = inertia.place_gradient();
                   Pair z_s, zeta;
                   z_s << rss.value, rsss.value;
                   zeta << rs.rate(e, motion.e_rate, motion.w), rss.rate(e, motion.e_rate, motion.w);
                   zeta -= z_s * s_rate;
                   const PairGradient Z = B - z_s * s_q.transpose();
                   const DampingResponse<D> damping =
                       damping_response<D>(*properties_, rs.value, rss.value, zeta);
                   f += w * Z.transpose() * damping.stress;
                   if (!weights) return;
                   if (weights->damping != 0)
                     K += (weights->damping * w) * Z.transpose() * damping.by_rate * Z;
                   if (weights->stiffness != 0) {
                     const double k = weights->stiffness;
                     PairGradient z_s_q, zeta_q;
                     z_s_q << rss.gradient, rsss.gradient;
                     zeta_q << rs.rate_gradient(e, motion.e_rate, motion.w),
                         rss.rate_gradient(e, motion.e_rate, motion.w);
                     zeta_q -= s_rate * z_s_q;
                     K += k * (Z.transpose() * damping.stress * w_q.transpose() +
                               w * (Z.transpose() * (damping.by_z * B + damping.by_rate * zeta_q) -
                                    s_q * (z_s_q.transpose() * damping.stress).transpose()));
                     rs.add_hessian(damping.stress.template head<D>(), k * w, e, K);
                     rss.add_hessian(damping.stress.template tail<D>(), k * w, e, K);
                   }
                 });
}

// f = int { Z' y + N' (rho A d2r/dt2 - load) } ds: y the stress, Z and N the gradients of z = (r_s, r_ss) and
// r at fixed material point.
template <int D>
void BeamElement<D>::respond_virtual_work(const ElementState<D>& x, const Vector<D>& load,
                                          const TangentWeights* weights, ElementResponse<D>& response) const {
  using Pair = Eigen::Matrix<double, 2 * D, 1>;
  using PairGradient = Eigen::Matrix<double, 2 * D, element_size<D>>;
  const typename PointInertia<D>::Motion motion{nodes<D>(x.q), nodes<D>(x.v), nodes<D>(x.a), ends<D>(x.v),
                                                ends<D>(x.a)};
  const Nodes<D>& e = motion.e;
  auto& K = response.tangent;
  const double rho = properties_->mass_per_length;

  for_each_point(
      Jet::variable(x.q[4 * D], 0), Jet::variable(x.q[4 * D + 1], 1),
      [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
        const PointField<D> r(shape.value, e), rs(shape.d1, e), rss(shape.d2, e), rsss(shape.d3, e);
        const double w = weight.value();
        const PointInertia<D> inertia(shape, s, weight, r, rs, motion);
        const ElementVector<D>& w_q = inertia.weight_gradient();
        const ElementVector<D>& s_q = inertia.place_gradient();
        const double s_rate = inertia.place_rate();
        const auto& N = inertia.velocity_gradient();

        PairGradient B, z_s_q;
        B << rs.gradient, rss.gradient;
        z_s_q << rss.gradient, rsss.gradient;
        Pair z_s, zeta;
        z_s << rss.value, rsss.value;
        zeta << rs.rate(e, motion.e_rate, motion.w), rss.rate(e, motion.e_rate, motion.w);
        zeta -= z_s * s_rate;
        const PairGradient Z = B - z_s * s_q.transpose();

        const ElasticResponse<D> elastic =
            elastic_response<D>(*properties_, rs.value, rss.value, straight_ ? 0 : shape.kappa0.value());
        const DampingResponse<D> damping = damping_response<D>(*properties_, rs.value, rss.value, zeta);
        const Pair stress = elastic.gradient + damping.stress;
        const Vector<D> body = rho * inertia.material_acceleration(rss) - load;
        const ElementVector<D> density = Z.transpose() * stress + N.transpose() * body;
        response.force += w * density;
        if (!weights) return;

        if (weights->mass != 0) K += (weights->mass * w * rho) * N.transpose() * N;
        if (weights->damping != 0)
          K +=
              (weights->damping * w) * (Z.transpose() * damping.by_rate * Z +
                                        rho * N.transpose() * inertia.material_acceleration_by_velocity(rss));
        if (weights->stiffness == 0) return;
        const double k = weights->stiffness;
        PairGradient zeta_q;
        zeta_q << rs.rate_gradient(e, motion.e_rate, motion.w), rss.rate_gradient(e, motion.e_rate, motion.w);
        zeta_q -= s_rate * z_s_q;
        PairGradient stress_q = (elastic.hessian + damping.by_z) * B + damping.by_rate * zeta_q;
        if (!straight_)
          for (int i = 0; i < 2; ++i) stress_q.col(4 * D + i) -= elastic.moment_gradient * shape.kappa0.d(i);
        const ElementVector<D> place_q = z_s_q.transpose() * stress + rs.gradient.transpose() * body;
        K += k * (density * w_q.transpose() +
                  w * (Z.transpose() * stress_q +
                       rho * N.transpose() * inertia.material_acceleration_by_position(rss) -
                       s_q * place_q.transpose()));
        rs.add_hessian(stress.template head<D>(), k * w, e, K);
        rss.add_hessian(stress.template tail<D>(), k * w, e, K);
        r.add_hessian(body, k * w, e, K);
      });
}

template <int D>
ElementEnergy BeamElement<D>::energy(const ElementState<D>& x, const Vector<D>& load) const {
  ElementEnergy sum;
  const Nodes<D> e = nodes<D>(x.q), e_rate = nodes<D>(x.v);
  const std::array<double, 2> w = ends<D>(x.v);
  for_each_point(
      Jet::variable(x.q[4 * D], 0), Jet::variable(x.q[4 * D + 1], 1),
      [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
        const PointField<D> r(shape.value, e), rs(shape.d1, e), rss(shape.d2, e), rsss(shape.d3, e);
        const double s_rate = s.d(0) * w[0] + s.d(1) * w[1], omega = weight.value();
        const Vector<D> v = r.rate(e, e_rate, w) - rs.value * s_rate;
        const ElasticResponse<D> elastic =
            elastic_response<D>(*properties_, rs.value, rss.value, straight_ ? 0 : shape.kappa0.value(),
                                curve_->strain(s.value()));
        Eigen::Matrix<double, 2 * D, 1> rate;
        rate << rs.rate(e, e_rate, w) - rss.value * s_rate, rss.rate(e, e_rate, w) - rsss.value * s_rate;
        sum.kinetic += omega * properties_->mass_per_length * v.squaredNorm() / 2;
        sum.axial += omega * elastic.energy.axial;
        sum.bending += omega * elastic.energy.bending;
        sum.external -= omega * load.dot(r.value);
        if (properties_->damping > 0)
          sum.dissipation += omega * damping_response<D>(*properties_, rs.value, rss.value, rate).power;
        sum.length += omega * rs.value.norm();
      });
  return sum;
}

template <int D>
ShapeFunctions<double> BeamElement<D>::shape(const ElementVector<D>& q, double s) const {
  return ElementBasis<double>(*curve_, chart_, q[4 * D], q[4 * D + 1]).at(s);
}

template <int D>
ShapeFunctions<Jet> BeamElement<D>::shape_series(const ElementVector<D>& q, double s) const {
  return ElementBasis<Jet>(*curve_, chart_, Jet::variable(q[4 * D], 0), Jet::variable(q[4 * D + 1], 1))
      .at(Jet(s));
}

template <int D>
Eigen::Vector4d BeamElement<D>::bezier_weights(const ElementVector<D>& q) const {
  if (chart_.constant_weights) return row(*chart_.constant_weights);
  if (chart_.segment < 0) return Eigen::Vector4d::Ones();
  const double u_a = curve_->parameter(chart_.segment, q[4 * D]);
  const double u_b = curve_->parameter(chart_.segment, q[4 * D + 1]);
  const auto W_a = curve_->geometry(chart_.segment, u_a).weight,
             W_b = curve_->geometry(chart_.segment, u_b).weight;
  const double l = u_b - u_a;
  return {W_a[0], W_a[0] + l / 3 * W_a[1], W_b[0] - l / 3 * W_b[1], W_b[0]};
}

template <int D>
double BeamElement<D>::place(const ElementVector<D>& q, double u) const {
  const double s_a = q[4 * D], s_b = q[4 * D + 1];
  if (u == 0 || u == 1 || chart_.segment < 0) return u == 1 ? s_b : s_a + u * (s_b - s_a);
  const double u_a = curve_->parameter(chart_.segment, s_a), u_b = curve_->parameter(chart_.segment, s_b);
  return curve_->unrolled(curve_->arc_length(chart_.segment, u_a + u * (u_b - u_a)), (s_a + s_b) / 2);
}

template <int D>
std::array<double, 3> BeamElement<D>::chart_lengths(const ElementVector<D>& q) const {
  if (chart_.segment < 0) return {q[4 * D + 1] - q[4 * D], 1, 1};
  const double u_a = curve_->parameter(chart_.segment, q[4 * D]);
  const double u_b = curve_->parameter(chart_.segment, q[4 * D + 1]);
  return {u_b - u_a, curve_->geometry(chart_.segment, u_a).stretch[0],
          curve_->geometry(chart_.segment, u_b).stretch[0]};
}

template class BeamElement<2>;
template class BeamElement<3>;

}  // namespace nurbeam
