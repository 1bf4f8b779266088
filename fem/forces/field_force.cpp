#include "fem/forces/field_force.h"

#include <array>

#include "fem/element/quadrature.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

namespace {

// A point of an element's material, with a mass, and what the field does there.
template <int D>
struct FieldPoint {
  double mass;
  PointShape<D> shape;
  PointField<D> r;
  Eigen::Vector3d position, velocity;

  FieldPoint(const MeshElement<D>& e, const State& state, const ElementState<D>& x, double s, double length)
      : mass(length * e.element.properties().mass_per_length),
        shape(point_shape<D>(e, state.q, s)),
        r(shape.position()) {
    using Layout = ElementLayout<D>;
    position = widened<D>(r.value);
    velocity =
        widened<D>(r.rate(shape.nodes, x.node_rates(), {x.v[Layout::place(0)], x.v[Layout::place(1)]}));
  }
  // [N]
  Eigen::Matrix<double, D, 1> force(const MassField& field, double load) const {
    return load * mass * (field.at_rest(position) + field.by_velocity() * velocity).template head<D>();
  }
};

// Calls visit(point) for the Gauss points of an element.
template <int D, class Visit>
void for_each_point(const MeshElement<D>& e, const State& state, const ElementState<D>& x, Visit&& visit) {
  const double start = e.span->start(state.q), length = e.span->end(state.q) - start;
  for (int g = 0; g < GaussRule::size; ++g)
    visit(FieldPoint<D>(e, state, x, start + GaussRule::points[g] * length, GaussRule::weights[g] * length));
}

}  // namespace

template <int D>
void FieldOnBeams<D>::add_force(const MeshedBeams<D>& at, const State& state,
                                Eigen::Ref<Eigen::VectorXd> dynamics) const {
  for (const MeshElement<D>& e : at.elements) {
    const ElementState<D> x = gather<D>(e, state);
    ElementVector<D> sum = ElementVector<D>::Zero();
    for_each_point<D>(e, state, x, [&](const FieldPoint<D>& p) {
      sum += p.r.gradient.transpose() * p.force(*at.structure.field, state.load);
    });
    for (int k = 0; k < element_size<D>; ++k)
      if (e.dofs[k] >= 0) dynamics[e.dofs[k]] -= sum[k];
  }
}

template <int D>
ElementMatrix<D> FieldOnBeams<D>::tangent(const MeshedBeams<D>& at, const MeshElement<D>& e,
                                          const State& state, const TangentWeights& w) const {
  using Layout = ElementLayout<D>;
  const MassField& field = *at.structure.field;
  const ElementState<D> x = gather<D>(e, state);
  const std::array<double, 2> rates{x.v[Layout::place(0)], x.v[Layout::place(1)]};
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  for_each_point<D>(e, state, x, [&](const FieldPoint<D>& p) {
    const auto& G = p.r.gradient;
    const double m = state.load * p.mass;
    const Eigen::Matrix<double, D, D> by_r = m * field.gradient(p.position).template topLeftCorner<D, D>(),
                                      by_v = m * field.by_velocity().template topLeftCorner<D, D>();
    const auto rate_gradient = p.r.rate_gradient(p.shape.nodes, x.node_rates(), rates);
    K -= G.transpose() * (by_v * (w.damping * G + w.stiffness * rate_gradient) + w.stiffness * by_r * G);
    p.r.add_hessian(p.force(field, state.load), -w.stiffness, p.shape.nodes, K);
  });
  // The ends are limits of the integral.
  for (const int end : {0, 1}) {
    if (e.dofs[Layout::place(end)] < 0) continue;
    const FieldPoint<D> p(e, state, x, x.q[Layout::place(end)], end == 0 ? -1 : 1);
    K.col(Layout::place(end)) -= w.stiffness * p.r.gradient.transpose() * p.force(field, state.load);
  }
  return K;
}

template <int D>
void FieldOnBeams<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  for (const MeshElement<D>& e : at.elements)
    for_each_point<D>(
        e, state, gather<D>(e, state),
        [&](const FieldPoint<D>& p) { sum.gravity += p.mass * at.structure.field->potential(p.position); });
}

template class FieldOnBeams<2>;
template class FieldOnBeams<3>;

}  // namespace nurbeam
