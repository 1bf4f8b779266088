#include "fem/forces/custom_force.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// Spans that may hold s before the mesh changes: the span itself, and its neighbours over moving nodes.
std::vector<int> spans_around(const Mesh& mesh, int span) {
  const int beam = mesh.spans[span].beam, first = mesh.first_span[beam], end = mesh.first_span[beam + 1];
  std::vector<int> spans{span};
  if (mesh.spans[span].place_a >= 0) spans.push_back(span > first ? span - 1 : end - 1);
  if (mesh.spans[span].place_b >= 0) spans.push_back(span + 1 < end ? span + 1 : first);
  return spans;
}

}  // namespace

// Positions and velocities of the points in one state, with their derivatives by the coordinates dofs_.
template <int D>
struct BoundCustomForce<D>::Points {
  Eigen::Matrix3Xd r, v;
  Eigen::MatrixXd gradient;       // (3 points x dofs) dr/dq
  Eigen::MatrixXd rate_gradient;  // (3 points x dofs) dv/dq
  struct Curved {                 // a point in an element whose ends move
    int element;
    PointField<D> field;
    ElementNodes<D> nodes;
  };
  std::vector<std::optional<Curved>> curved;
};

template <int D>
BoundCustomForce<D>::BoundCustomForce(const CustomForce& force, const MeshedBeams<D>& at,
                                      const Eigen::VectorXd& drawn)
    : force_(&force) {
  if (!force.law) throw std::invalid_argument("a custom force needs a law");
  std::set<int> dofs;
  for (const Grip& point : force.points) {
    if (point.body >= 0) {
      for (int d = 0; d < D; ++d) dofs.insert(at.mesh.bodies[point.body] + d);
      continue;
    }
    const int span = find_span(at.structure, at.mesh, drawn, point.beam, point.s);
    for (const int i : spans_around(at.mesh, span))
      for (const int dof : at.elements[i].dofs)
        if (dof >= 0) dofs.insert(dof);
  }
  dofs_.assign(dofs.begin(), dofs.end());
}

template <int D>
int BoundCustomForce<D>::column(int dof) const {
  return static_cast<int>(std::lower_bound(dofs_.begin(), dofs_.end(), dof) - dofs_.begin());
}

template <int D>
typename BoundCustomForce<D>::Points BoundCustomForce<D>::points(const MeshedBeams<D>& at,
                                                                 const State& state) const {
  using Layout = ElementLayout<D>;
  const Eigen::Index n = static_cast<Eigen::Index>(force_->points.size()),
                     columns = static_cast<Eigen::Index>(dofs_.size());
  Points all;
  all.r = all.v = Eigen::Matrix3Xd::Zero(3, n);
  all.gradient = all.rate_gradient = Eigen::MatrixXd::Zero(3 * n, columns);
  all.curved.resize(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Grip& point = force_->points[i];
    if (point.body >= 0) {
      const int r = at.mesh.bodies[point.body];
      all.r.col(i).template head<D>() = state.q.segment<D>(r);
      all.v.col(i).template head<D>() = state.v.segment<D>(r);
      for (int d = 0; d < D; ++d) all.gradient(3 * i + d, column(r + d)) = 1;
      continue;
    }
    const int index = find_span(at.structure, at.mesh, state.q, point.beam, point.s);
    const MeshElement<D>& e = at.elements[index];
    const ElementState<D> x = gather<D>(e, state);
    const PointShape<D> shape = point_shape<D>(e, state.q, point.s);
    const PointField<D> r = shape.position();
    const std::array<double, 2> w{x.v[Layout::place(0)], x.v[Layout::place(1)]};
    all.r.col(i).template head<D>() = r.value;
    all.v.col(i).template head<D>() = r.rate(shape.nodes, x.node_rates(), w);
    const auto rate_gradient = r.rate_gradient(shape.nodes, x.node_rates(), w);
    for (int k = 0; k < Layout::size; ++k) {
      if (e.dofs[k] < 0) continue;
      all.gradient.template block<D, 1>(3 * i, column(e.dofs[k])) += r.gradient.col(k);
      all.rate_gradient.template block<D, 1>(3 * i, column(e.dofs[k])) += rate_gradient.col(k);
    }
    all.curved[i].emplace(typename Points::Curved{index, r, shape.nodes});
  }
  return all;
}

template <int D>
double BoundCustomForce<D>::work(const MeshedBeams<D>& at, const State& from, const State& to) const {
  const Points before = points(at, from), after = points(at, to);
  const Eigen::Matrix3Xd sum = from.load * force_->law(from.t, before.r, before.v).force +
                               to.load * force_->law(to.t, after.r, after.v).force;
  return sum.cwiseProduct(after.r - before.r).sum() / 2;
}

template <int D>
void BoundCustomForce<D>::add_actions(const MeshedBeams<D>& at, const State& state,
                                      std::vector<PointAction>& actions) const {
  const Points p = points(at, state);
  const Eigen::Matrix3Xd f = state.load * force_->law(state.t, p.r, p.v).force;
  for (std::size_t i = 0; i < p.curved.size(); ++i) {
    if (!p.curved[i]) continue;
    const MeshElement<D>& e = at.elements[p.curved[i]->element];
    const double s = e.local(gather<D>(e, state.q), force_->points[i].s);
    actions.push_back(
        {.element = p.curved[i]->element, .s = s, .force = f.col(static_cast<Eigen::Index>(i))});
  }
}

template <int D>
void BoundCustomForce<D>::add_force(const MeshedBeams<D>& at, const State& state,
                                    Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Points p = points(at, state);
  const Eigen::Matrix3Xd f = force_->law(state.t, p.r, p.v).force;
  if (f.cols() != p.r.cols())
    throw std::invalid_argument("the law of a custom force gives " + std::to_string(f.cols()) +
                                " forces for its " + std::to_string(p.r.cols()) +
                                " points; give one for each");
  const Eigen::VectorXd generalised =
      state.load * p.gradient.transpose() * Eigen::Map<const Eigen::VectorXd>(f.data(), f.size());
  for (std::size_t k = 0; k < dofs_.size(); ++k)
    dynamics[dofs_[k]] -= generalised[static_cast<Eigen::Index>(k)];
}

template <int D>
Eigen::MatrixXd BoundCustomForce<D>::derivative(const State& state, const Points& p, bool by_velocity) const {
  const Eigen::Index n = p.r.size();
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < n; ++k) {
    if (k % 3 >= D) continue;  // nothing leaves the plane of a planar model
    const double x = by_velocity ? p.v(k) : p.r(k);
    const double h = 1e-6 * std::max(1.0, std::abs(x));
    const auto moved = [&](double by) {
      Eigen::Matrix3Xd r = p.r, v = p.v;
      (by_velocity ? v : r)(k) += by;
      return force_->law(state.t, r, v).force;
    };
    const Eigen::Matrix3Xd change = (moved(h) - moved(-h)) / (2 * h);
    result.col(k) = Eigen::Map<const Eigen::VectorXd>(change.data(), n);
  }
  return result;
}

template <int D>
Eigen::MatrixXd BoundCustomForce<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                             const TangentWeights& w) const {
  const Points p = points(at, state);
  const CustomForce::Response response = force_->law(state.t, p.r, p.v);
  const Eigen::MatrixXd by_r =
      response.by_position.size() ? response.by_position : derivative(state, p, false);
  const Eigen::MatrixXd by_v =
      response.by_velocity.size() ? response.by_velocity : derivative(state, p, true);
  const Eigen::MatrixXd G = p.gradient.transpose();
  Eigen::MatrixXd K = -w.damping * G * by_v * p.gradient;
  K -= w.stiffness * G * (by_r * p.gradient + by_v * p.rate_gradient);
  for (std::size_t i = 0; i < p.curved.size(); ++i) {
    if (!p.curved[i]) continue;
    ElementMatrix<D> bend = ElementMatrix<D>::Zero();
    p.curved[i]->field.add_hessian(response.force.col(static_cast<Eigen::Index>(i)).template head<D>(),
                                   -w.stiffness, p.curved[i]->nodes, bend);
    const auto& dofs = at.elements[p.curved[i]->element].dofs;
    for (int a = 0; a < element_size<D>; ++a)
      for (int b = 0; b < element_size<D>; ++b)
        if (dofs[a] >= 0 && dofs[b] >= 0) K(column(dofs[a]), column(dofs[b])) += bend(a, b);
  }
  return state.load * K;
}

template class BoundCustomForce<2>;
template class BoundCustomForce<3>;

}  // namespace nurbeam
