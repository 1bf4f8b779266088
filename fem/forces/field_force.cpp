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

// Calls visit(point, xi, length) for the Gauss points of an element, at start + xi length.
template <int D, class Visit>
void for_each_point(const MeshElement<D>& e, const State& state, const ElementState<D>& x, Visit&& visit) {
  const double start = e.span->start(state.q), length = e.span->end(state.q) - start;
  for (int g = 0; g < GaussRule::size; ++g) {
    const double xi = GaussRule::points[g];
    visit(FieldPoint<D>(e, state, x, start + xi * length, GaussRule::weights[g] * length), xi, length);
  }
}

}  // namespace

template <int D>
void FieldOnBeams<D>::add_force(const MeshedBeams<D>& at, const State& state,
                                Eigen::Ref<Eigen::VectorXd> dynamics) const {
  for (const MeshElement<D>& e : at.elements) {
    const ElementState<D> x = gather<D>(e, state);
    ElementVector<D> sum = ElementVector<D>::Zero();
    for_each_point<D>(e, state, x, [&](const FieldPoint<D>& p, double, double) {
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
  for_each_point<D>(e, state, x, [&](const FieldPoint<D>& p, double xi, double length) {
    const auto& G = p.r.gradient;
    const double m = state.load * p.mass;
    const Eigen::Matrix<double, D, D> by_r = m * field.gradient(p.position).template topLeftCorner<D, D>(),
                                      by_v = m * field.by_velocity().template topLeftCorner<D, D>();
    const Eigen::Matrix<double, D, 1> force = p.force(field, state.load);
    const auto rate_gradient = p.r.rate_gradient(p.shape.nodes, x.node_rates(), rates);
    K -= G.transpose() * (by_v * (w.damping * G + w.stiffness * rate_gradient) + w.stiffness * by_r * G);
    p.r.add_hessian(force, -w.stiffness, p.shape.nodes, K);
    if (e.element.fixed()) return;
    // The point and its mass move with the ends.
    const PointField<D> rs = p.shape.slope();
    const Eigen::Matrix<double, D, 1> along =
        by_r * rs.value + by_v * rs.rate(p.shape.nodes, x.node_rates(), rates);
    const ElementVector<D> here = G.transpose() * force / length,
                           by_s = rs.gradient.transpose() * force + G.transpose() * along;
    K.col(Layout::place(0)) -= w.stiffness * ((1 - xi) * by_s - here);
    K.col(Layout::place(1)) -= w.stiffness * (xi * by_s + here);
  });
  return K;
}

template <int D>
void FieldOnBeams<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  for (const MeshElement<D>& e : at.elements)
    for_each_point<D>(
        e, state, gather<D>(e, state),
        [&](const FieldPoint<D>& p, double, double) {
          sum.gravity += p.mass * at.structure.field->potential(p.position);
        });
}

template class FieldOnBeams<2>;
template class FieldOnBeams<3>;

}  // namespace nurbeam
