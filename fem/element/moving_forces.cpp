// The forces of an element whose ends move, and its choice between these and those of a fixed one.
#include "fem/element/beam_element.h"
#include "fem/element/moving_point.h"

namespace nurbeam {

namespace {

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
  Damping(const BeamProperties& properties, const ShapeFunctions<Jet>& shape, const MovingPoint<D>& p,
          double eta)
      : p_(p),
        rates_(p.rates(shape)),
        damping_(damping_response<D>(properties, p.rs.value, p.rss.value, rates_.zeta, eta)) {}

  /// The derivative of the force by eta.
  ElementVector<D> by_eta() const {
    return p_.weight * rates_.Z.template topRows<D>().transpose() * rates_.zeta.template head<D>();
  }

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
ElementVector<D> BeamElement<D>::force(const ElementState<D>& x, const Vector& load) const {
  if (fixed()) return fixed_force(x, load);
  if (!properties_->is_damped()) return undamped_force(x, load);
  const auto motion = MovingPoint<D>::motion(x);
  const double eta = taut_viscosity(x).value;
  const bool damped = properties_->damping > 0 || eta > 0, assumed = assumes_strain();
  ElementVector<D> f = ElementVector<D>::Zero();
  AxialSums<D> axial(x.q);
  std::optional<AxialRates<D>> axial_rates;
  if (damped && assumed) axial_rates.emplace(motion);
  for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const MovingPoint<D> p(shape, s, weight, motion);
    p.inertia.add_force(properties_->mass_per_length, f);
    if (mass_viscosity() > 0) p.inertia.add_damping(mass_viscosity(), f);
    Potential<D>(*properties_, p, load).add_force(f);
    if (assumed) axial.add_point(p.rs, p.weight, p.weight_gradient());
    if (damped) Damping<D>(*properties_, shape, p, eta).add_force(f);
    if (axial_rates) axial_rates->add(0, p.rs, p.rss, s, weight);
  });
  axial.take_out(x.free_strain);
  if (assumed) axial.add_force(properties_->axial_stiffness, f);
  if (!axial_rates) return f;
  add_ends(x.q, motion.e, *axial_rates);
  axial_rates->add_force(axial_viscosity(), axial.y[3], f);
  return f;
}

template <int D>
ElementMatrix<D> BeamElement<D>::tangent(const ElementState<D>& x, const Vector& load,
                                         const TangentWeights& t) const {
  if (fixed()) return fixed_tangent(x, t);
  if (!properties_->is_damped()) return undamped_tangent(x, load, t);
  const auto motion = MovingPoint<D>::motion(x);
  const TautViscosity eta = taut_viscosity(x);
  const bool damped = properties_->damping > 0 || eta.value > 0, assumed = assumes_strain();
  ElementMatrix<D> K = ElementMatrix<D>::Zero(), I_qq = ElementMatrix<D>::Zero();
  AxialSums<D> axial(x.q);
  std::optional<AxialRates<D>> axial_rates;
  if (damped && assumed) axial_rates.emplace(motion);
  for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const MovingPoint<D> p(shape, s, weight, motion);
    p.inertia.add_tangent(properties_->mass_per_length, t, K);
    if (mass_viscosity() > 0) p.inertia.add_damping_tangent(mass_viscosity(), t, K);
    if (t.stiffness != 0) Potential<D>(*properties_, p, load).add_tangent(motion.e, t.stiffness, K);
    if (t.stiffness != 0 && assumed) {
      axial.add_point(p.rs, p.weight, p.weight_gradient());
      AxialSums<D>::add_hessian(p.rs, p.weight, p.weight_gradient(), motion.e, I_qq);
    }
    if (damped) {
      const Damping<D> damping(*properties_, shape, p, eta.value);
      damping.add_tangent(motion.e, t, K);
      K += t.stiffness * damping.by_eta() * eta.gradient.transpose();
    }
    if (axial_rates) axial_rates->add(0, p.rs, p.rss, s, weight);
  });
  axial.take_out(x.free_strain);
  if (t.stiffness != 0 && assumed) axial.add_tangent(properties_->axial_stiffness, t.stiffness, I_qq, K);
  if (!axial_rates) return K;
  add_ends(x.q, motion.e, *axial_rates);
  axial_rates->add_tangent(axial_viscosity(), axial.y[3], t, K);
  return K;
}

// The ends as points of weight 1.
template <int D>
void BeamElement<D>::add_ends(const ElementVector<D>& q, const ElementNodes<D>& e,
                              AxialRates<D>& rates) const {
  const std::array<Jet, 2> s{Jet::variable(q[ElementLayout<D>::place(0)], 0),
                             Jet::variable(q[ElementLayout<D>::place(1)], 1)};
  const MovingBasis basis(*curve_, chart_, s[0], s[1]);
  for (const int end : {0, 1}) {
    const ShapeFunctions<Jet> shape = basis.at(s[end]);
    rates.add(1 + end, PointField<D>(shape.d1, e), PointField<D>(shape.d2, e), s[end], Jet(1));
  }
}

template ElementVector<2> BeamElement<2>::force(const ElementState<2>&, const Vector&) const;
template ElementVector<3> BeamElement<3>::force(const ElementState<3>&, const Vector&) const;
template ElementMatrix<2> BeamElement<2>::tangent(const ElementState<2>&, const Vector&,
                                                  const TangentWeights&) const;
template ElementMatrix<3> BeamElement<3>::tangent(const ElementState<3>&, const Vector&,
                                                  const TangentWeights&) const;
template void BeamElement<2>::add_ends(const ElementVector<2>&, const ElementNodes<2>&, AxialRates<2>&) const;
template void BeamElement<3>::add_ends(const ElementVector<3>&, const ElementNodes<3>&, AxialRates<3>&) const;

}  // namespace nurbeam
