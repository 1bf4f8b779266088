#include "fem/comparison/virtual_work.h"

#include "fem/element/moving_point.h"

namespace nurbeam::virtual_work {

namespace {

template <int D>
using Vector = Eigen::Matrix<double, D, 1>;

// f = int { Z' y + N' (rho A d2r/dt2 - load) } ds: y the stress, Z and N the gradients of z = (r_s, r_ss) and
// r at fixed material point.
template <int D>
struct Density {
  using Pair = typename MovingPoint<D>::Pair;

  Density(const BeamProperties& properties, const ShapeFunctions<Jet>& shape, const MovingPoint<D>& p,
          const Vector<D>& load)
      : rates(p.rates(shape)),
        elastic(elastic_response<D>(properties, p.rs.value, p.rss.value, p.kappa0.value())),
        damping(damping_response<D>(properties, p.rs.value, p.rss.value, rates.zeta)),
        stress(elastic.gradient + damping.stress),
        body(properties.mass_per_length * p.inertia.material_acceleration(p.rss) - load),
        value(rates.Z.transpose() * stress + p.inertia.velocity_gradient().transpose() * body) {}

  typename MovingPoint<D>::Rates rates;
  ElasticResponse<D> elastic;
  DampingResponse<D> damping;
  Pair stress;
  Vector<D> body;
  ElementVector<D> value;
};

template <int D>
void add_stiffness(const MovingPoint<D>& p, const Density<D>& density, double rho, double k,
                   const ElementNodes<D>& e, ElementMatrix<D>& K) {
  using Layout = ElementLayout<D>;
  const auto& [rates, elastic, damping, stress, body, value] = density;
  const double w = p.weight;
  const auto [zeta_q, z_s_q] = p.rate_gradients(rates);
  typename MovingPoint<D>::PairGradient stress_q =
      (elastic.hessian + damping.by_z) * p.B + damping.by_rate * zeta_q;
  for (int i = 0; i < 2; ++i) stress_q.col(Layout::place(i)) -= elastic.moment_gradient * p.kappa0.d(i);
  const ElementVector<D> place_q = z_s_q.transpose() * stress + p.rs.gradient.transpose() * body;
  K += k * (value * p.weight_gradient().transpose() +
            w * (rates.Z.transpose() * stress_q +
                 rho * p.inertia.velocity_gradient().transpose() *
                     p.inertia.material_acceleration_by_position(p.rss) -
                 p.inertia.place_gradient() * place_q.transpose()));
  p.rs.add_hessian(stress.template head<D>(), k * w, e, K);
  p.rss.add_hessian(stress.template tail<D>(), k * w, e, K);
  p.r.add_hessian(body, k * w, e, K);
}

}  // namespace

template <int D>
ElementVector<D> force(const BeamElement<D>& element, const ElementState<D>& x, const Vector<D>& load) {
  const auto motion = MovingPoint<D>::motion(x);
  ElementVector<D> f = ElementVector<D>::Zero();
  element.for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const MovingPoint<D> p(shape, s, weight, motion);
    f += p.weight * Density<D>(element.properties(), shape, p, load).value;
  });
  return f;
}

template <int D>
ElementMatrix<D> tangent(const BeamElement<D>& element, const ElementState<D>& x, const Vector<D>& load,
                         const TangentWeights& t) {
  const auto motion = MovingPoint<D>::motion(x);
  const double rho = element.properties().mass_per_length;
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  element.for_each_point(x.q, [&](const ShapeFunctions<Jet>& shape, const Jet& s, const Jet& weight) {
    const MovingPoint<D> p(shape, s, weight, motion);
    const Density<D> density(element.properties(), shape, p, load);
    const auto& N = p.inertia.velocity_gradient();
    const auto& Z = density.rates.Z;
    const double w = p.weight;
    if (t.mass != 0) K += (t.mass * w * rho) * N.transpose() * N;
    if (t.damping != 0)
      K += (t.damping * w) * (Z.transpose() * density.damping.by_rate * Z +
                              rho * N.transpose() * p.inertia.material_acceleration_by_velocity(p.rss));
    if (t.stiffness != 0) add_stiffness(p, density, rho, t.stiffness, motion.e, K);
  });
  return K;
}

template ElementVector<2> force<2>(const BeamElement<2>&, const ElementState<2>&, const Vector<2>&);
template ElementVector<3> force<3>(const BeamElement<3>&, const ElementState<3>&, const Vector<3>&);
template ElementMatrix<2> tangent<2>(const BeamElement<2>&, const ElementState<2>&, const Vector<2>&,
                                     const TangentWeights&);
template ElementMatrix<3> tangent<3>(const BeamElement<3>&, const ElementState<3>&, const Vector<3>&,
                                     const TangentWeights&);

}  // namespace nurbeam::virtual_work
