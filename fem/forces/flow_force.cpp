#include "fem/forces/flow_force.h"

#include "fem/element/quadrature.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

namespace {

// rho v^2 of an element's beam [N].
template <int D>
double flow_of(const MeshedBeams<D>& at, const MeshElement<D>& e) {
  const double v = at.structure.beams[e.span->beam].flow;
  return e.element.properties().mass_per_length * v * v;
}

// Calls visit(shape, length) for the Gauss points of an element.
template <int D, class Visit>
void for_each_point(const MeshElement<D>& e, const State& state, Visit&& visit) {
  const double start = e.span->start(state.q), length = e.span->end(state.q) - start;
  for (int g = 0; g < GaussRule::size; ++g)
    visit(point_shape<D>(e, state.q, start + GaussRule::points[g] * length), GaussRule::weights[g] * length);
}

}  // namespace

template <int D>
void FlowForce<D>::add_force(const MeshedBeams<D>& at, const State& state,
                             Eigen::Ref<Eigen::VectorXd> dynamics) const {
  using Layout = ElementLayout<D>;
  for (const MeshElement<D>& e : at.elements) {
    const double flow = flow_of(at, e);
    if (flow == 0) continue;
    ElementVector<D> sum = ElementVector<D>::Zero();
    for_each_point<D>(e, state, [&](const CurvedPointShape<D>& p, double length) {
      const PointField<D> rs = p.slope();
      sum += flow * length * rs.gradient.transpose() * rs.value;
    });
    for (const int end : {0, 1}) {
      if (e.dofs[Layout::place(end)] < 0) continue;
      const double s = end == 0 ? e.span->start(state.q) : e.span->end(state.q);
      sum[Layout::place(end)] +=
          (end == 0 ? -1 : 1) * flow / 2 * point_shape<D>(e, state.q, s).slope().value.squaredNorm();
    }
    for (int k = 0; k < element_size<D>; ++k)
      if (e.dofs[k] >= 0) dynamics[e.dofs[k]] -= sum[k];
  }
}

template <int D>
ElementMatrix<D> FlowForce<D>::tangent(const MeshedBeams<D>& at, const MeshElement<D>& e, const State& state,
                                       double weight) const {
  const double flow = weight * flow_of(at, e);
  ElementMatrix<D> K = ElementMatrix<D>::Zero();
  for_each_point<D>(e, state, [&](const CurvedPointShape<D>& p, double length) {
    const PointField<D> rs = p.slope();
    K -= flow * length * rs.gradient.transpose() * rs.gradient;
    rs.add_hessian(rs.value, -flow * length, p.nodes, K);
  });
  return K;
}

template class FlowForce<2>;
template class FlowForce<3>;

}  // namespace nurbeam
