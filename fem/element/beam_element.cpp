#include "fem/element/beam_element.h"

#include <stdexcept>

#include "fem/element/moving_point.h"

namespace nurbeam {

namespace {

Eigen::Vector4d row(const std::array<double, 4>& values) {
  return Eigen::Map<const Eigen::Vector4d>(values.data());
}

// Strain energy less the work of the dead load at one moving point: w (psi(z, kappa0) - load . r).
template <int D>
class Potential {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  Potential(const BeamProperties& properties, const MovingPoint<D>& p, const Vector& load)
      : p_(p),
        load_(load),
        elastic_(elastic_response<D>(properties, p.rs.value, p.rss.value, p.kappa0.value())),
        psi_q_(p.B.transpose() * elastic_.gradient - elastic_.moment * p.kappa_q),
        load_q_(p.r.gradient.transpose() * load) {}

  void add_force(ElementVector<D>& f) const {
    const ElementVector<D>& w_q = p_.weight_gradient();
    f -= p_.weight * load_q_ + load_.dot(p_.r.value) * w_q;
    f += p_.weight * psi_q_ + elastic_.energy.total() * w_q;
  }

  void add_tangent(const ElementNodes<D>& e, double k, ElementMatrix<D>& K) const {
    const double w = p_.weight, EI = elastic_.bending_stiffness;
    const auto& B = p_.B;
    const ElementVector<D>&w_q = p_.weight_gradient(), &kappa_q = p_.kappa_q;
    const ElementVector<D> potential_q = psi_q_ - load_q_;
    const ElementVector<D> moment_q = B.transpose() * elastic_.moment_gradient;
    K += k * (w * (B.transpose() * elastic_.hessian * B - kappa_q * moment_q.transpose() -
                   moment_q * kappa_q.transpose() + EI * kappa_q * kappa_q.transpose()) +
              potential_q * w_q.transpose() + w_q * potential_q.transpose());
    p_.rs.add_hessian(elastic_.gradient.template head<D>(), k * w, e, K);
    p_.rss.add_hessian(elastic_.gradient.template tail<D>(), k * w, e, K);
    p_.r.add_hessian(load_, -k * w, e, K);
    using Layout = ElementLayout<D>;
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j)
        K(Layout::place(i), Layout::place(j)) -= k * w * elastic_.moment * p_.kappa0.d(i, j);
  }

 private:
  const MovingPoint<D>& p_;
  const Vector& load_;
  ElasticResponse<D> elastic_;
  ElementVector<D> psi_q_, load_q_;
};

// Damping at one moving point: w Z' y(z, zeta).
template <int D>
class Damping {
 public:
  Damping(const BeamProperties& properties, const ShapeFunctions<Jet>& shape, const MovingPoint<D>& p)
      : p_(p),
        rates_(p.rates(shape)),
        damping_(damping_response<D>(properties, p.rs.value, p.rss.value, rates_.zeta)) {}

  void add_force(ElementVector<D>& f) const { f += p_.weight * rates_.Z.transpose() * damping_.stress; }

  void add_tangent(const ElementNodes<D>& e, const TangentWeights& t, ElementMatrix<D>& K) const {
    const auto& Z = rates_.Z;
    const double w = p_.weight;
    if (t.damping != 0) K += (t.damping * w) * Z.transpose() * damping_.by_rate * Z;
    if (t.stiffness == 0) return;
    const double k = t.stiffness;
    const auto [zeta_q, z_s_q] = p_.rate_gradients(rates_);
    K += k * (Z.transpose() * damping_.stress * p_.weight_gradient().transpose() +
              w * (Z.transpose() * (damping_.by_z * p_.B + damping_.by_rate * zeta_q) -
                   p_.inertia.place_gradient() * (z_s_q.transpose() * damping_.stress).transpose()));
    p_.rs.add_hessian(damping_.stress.template head<D>(), k * w, e, K);
    p_.rss.add_hessian(damping_.stress.template tail<D>(), k * w, e, K);
  }

 private:
  const MovingPoint<D>& p_;
  typename MovingPoint<D>::Rates rates_;
  DampingResponse<D> damping_;
};

}  // namespace

template <int D>
BeamElement<D>::BeamElement(const ReferenceCurve& curve, const BeamProperties& properties, Chart chart,
                            double s_a, double s_b, Ends ends)
    : curve_(&curve), properties_(&properties), chart_(std::move(chart)), ends_(ends) {
  mass_.setZero();
  load_factor_.setZero();
  if (!fixed() && curve.metric() == Metric::label)
    throw std::invalid_argument("an element whose ends move needs the metric of the drawn curve");
  if (!fixed()) return;
  for_each_point(s_a, s_b, [&](const ShapeFunctions<double>& shape, double s, double weight) {
    const FixedPoint p{row(shape.value), row(shape.d1), row(shape.d2), weight, shape.kappa0, curve.strain(s)};
    points_.push_back(p);
    mass_ += properties_->mass_per_length * weight * p.S * p.S.transpose();
    load_factor_ += weight * p.S;
  });
}

template <int D>
ElementVector<D> BeamElement<D>::force(const ElementState<D>& x, const Vector& load) const {
  if (fixed()) return fixed_force(x, load);
  const auto motion = MovingPoint<D>::motion(x);
  ElementVector<D> f = ElementVector<D>::Zero();
  for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const MovingPoint<D> p(shape, s, weight, motion);
    p.inertia.add_force(properties_->mass_per_length, f);
    Potential<D>(*properties_, p, load).add_force(f);
    if (properties_->damping > 0) Damping<D>(*properties_, shape, p).add_force(f);
  });
  return f;
}

template <int D>
ElementMatrix<D> BeamElement<D>::tangent(const ElementState<D>& x, const Vector& load,
                                         const TangentWeights& t) const {
  if (fixed()) return fixed_tangent(x, t);
  const auto motion = MovingPoint<D>::motion(x);
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const MovingPoint<D> p(shape, s, weight, motion);
    p.inertia.add_tangent(properties_->mass_per_length, t, K);
    if (t.stiffness != 0) Potential<D>(*properties_, p, load).add_tangent(motion.e, t.stiffness, K);
    if (properties_->damping > 0) Damping<D>(*properties_, shape, p).add_tangent(motion.e, t, K);
  });
  return K;
}

template <int D>
ElementVector<D> BeamElement<D>::fixed_force(const ElementState<D>& x, const Vector& load) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  ElementVector<D> f = ElementVector<D>::Zero();
  Eigen::Map<ElementNodes<D>> force(f.data());
  force = ElementLayout<D>::nodes(x.a) * mass_ - load * load_factor_.transpose();
  for (const FixedPoint& p : points_) {
    const Vector rs = e * p.S1, rss = e * p.S2;
    Eigen::Matrix<double, 2 * D, 1> stress =
        elastic_response<D>(*properties_, rs, rss, p.kappa0, p.eps0).gradient;
    if (properties_->damping > 0) {
      Eigen::Matrix<double, 2 * D, 1> rate;
      rate << e_rate * p.S1, e_rate * p.S2;
      stress += damping_response<D>(*properties_, rs, rss, rate).stress;
    }
    force += p.weight *
             (stress.template head<D>() * p.S1.transpose() + stress.template tail<D>() * p.S2.transpose());
  }
  return f;
}

template <int D>
ElementMatrix<D> BeamElement<D>::fixed_tangent(const ElementState<D>& x, const TangentWeights& w) const {
  const ElementNodes<D> e = x.nodes(), e_rate = x.node_rates();
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  for (const FixedPoint& p : points_) {
    const Vector rs = e * p.S1, rss = e * p.S2;
    Eigen::Matrix<double, 2 * D, 2 * D> H =
        w.stiffness * elastic_response<D>(*properties_, rs, rss, p.kappa0, p.eps0).hessian;
    if (properties_->damping > 0) {
      Eigen::Matrix<double, 2 * D, 1> rate;
      rate << e_rate * p.S1, e_rate * p.S2;
      const DampingResponse<D> d = damping_response<D>(*properties_, rs, rss, rate);
      H += w.stiffness * d.by_z + w.damping * d.by_rate;
    }
    for (int l = 0; l < 4; ++l) {
      const Eigen::Matrix<double, 2 * D, D> column =
          p.weight * (H.template leftCols<D>() * p.S1[l] + H.template rightCols<D>() * p.S2[l]);
      for (int k = 0; k < 4; ++k)
        K.template block<D, D>(k * D, l * D) +=
            p.S1[k] * column.template topRows<D>() + p.S2[k] * column.template bottomRows<D>();
    }
  }
  for (int k = 0; k < 4; ++k)
    for (int l = 0; l < 4; ++l)
      K.template block<D, D>(k * D, l * D).diagonal().array() += w.mass * mass_(k, l);
  return K;
}

template <int D>
ElementEnergy BeamElement<D>::energy(const ElementState<D>& x, const Vector& load) const {
  ElementEnergy sum;
  const auto motion = MovingPoint<D>::motion(x);
  const ElementNodes<D>&e = motion.e, &e_rate = motion.e_rate;
  const std::array<double, 2>& w = motion.w;
  for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const PointField<D> r(shape.value, e), rs(shape.d1, e), rss(shape.d2, e), rsss(shape.d3, e);
    const double s_rate = s.d(0) * w[0] + s.d(1) * w[1], omega = weight.value();
    const Vector v = r.rate(e, e_rate, w) - rs.value * s_rate;
    const EnergyDensity density = elastic_response<D>(*properties_, rs.value, rss.value, shape.kappa0.value(),
                                                      curve_->strain(s.value()))
                                      .energy;
    Eigen::Matrix<double, 2 * D, 1> rate;
    rate << rs.rate(e, e_rate, w) - rss.value * s_rate, rss.rate(e, e_rate, w) - rsss.value * s_rate;
    sum.kinetic += omega * properties_->mass_per_length * v.squaredNorm() / 2;
    sum.axial += omega * density.axial;
    sum.bending += omega * density.bending;
    sum.external -= omega * load.dot(r.value);
    if (properties_->damping > 0)
      sum.dissipation += omega * damping_response<D>(*properties_, rs.value, rss.value, rate).power;
  });
  return sum;
}

template <int D>
double BeamElement<D>::length(const ElementVector<D>& q) const {
  using Layout = ElementLayout<D>;
  const ElementNodes<D> e = Layout::nodes(q);
  double sum = 0;
  for_each_point(q, [&](const ShapeFunctions<Jet>& shape, const Jet&, const Jet& weight) {
    sum += weight.value() * PointField<D>(shape.d1, e).value.norm();
  });
  return sum;
}

template <int D>
ShapeFunctions<double> BeamElement<D>::shape(const ElementVector<D>& q, double s) const {
  return ElementBasis<double>(*curve_, chart_, q[ElementLayout<D>::place(0)], q[ElementLayout<D>::place(1)])
      .at(s);
}

template <int D>
ShapeFunctions<Jet> BeamElement<D>::shape_series(const ElementVector<D>& q, double s) const {
  return ElementBasis<Jet>(*curve_, chart_, Jet::variable(q[ElementLayout<D>::place(0)], 0),
                           Jet::variable(q[ElementLayout<D>::place(1)], 1))
      .at(Jet(s));
}

template <int D>
Eigen::Vector4d BeamElement<D>::bezier_weights(const ElementVector<D>& q) const {
  if (chart_.constant_weights) return row(*chart_.constant_weights);
  if (chart_.segment < 0) return Eigen::Vector4d::Ones();
  const double u_a = curve_->parameter(chart_.segment, q[ElementLayout<D>::place(0)]);
  const double u_b = curve_->parameter(chart_.segment, q[ElementLayout<D>::place(1)]);
  const auto W_a = curve_->geometry(chart_.segment, u_a).weight,
             W_b = curve_->geometry(chart_.segment, u_b).weight;
  const double l = u_b - u_a;
  return {W_a[0], W_a[0] + l / 3 * W_a[1], W_b[0] - l / 3 * W_b[1], W_b[0]};
}

template <int D>
double BeamElement<D>::place(const ElementVector<D>& q, double u) const {
  const double s_a = q[ElementLayout<D>::place(0)], s_b = q[ElementLayout<D>::place(1)];
  if (u == 0 || u == 1 || chart_.segment < 0) return u == 1 ? s_b : s_a + u * (s_b - s_a);
  const double u_a = curve_->parameter(chart_.segment, s_a), u_b = curve_->parameter(chart_.segment, s_b);
  return curve_->unrolled(curve_->arc_length(chart_.segment, u_a + u * (u_b - u_a)), (s_a + s_b) / 2);
}

template <int D>
std::array<double, 3> BeamElement<D>::chart_lengths(const ElementVector<D>& q) const {
  if (chart_.segment < 0) return {q[ElementLayout<D>::place(1)] - q[ElementLayout<D>::place(0)], 1, 1};
  const double u_a = curve_->parameter(chart_.segment, q[ElementLayout<D>::place(0)]);
  const double u_b = curve_->parameter(chart_.segment, q[ElementLayout<D>::place(1)]);
  return {u_b - u_a, curve_->geometry(chart_.segment, u_a).stretch[0],
          curve_->geometry(chart_.segment, u_b).stretch[0]};
}

template class BeamElement<2>;
template class BeamElement<3>;

}  // namespace nurbeam
