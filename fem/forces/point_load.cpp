#include "fem/forces/point_load.h"

#include "fem/forces/load_place.h"

namespace nurbeam {

template <int D>
std::optional<LoadedPoint<D>> LoadedPoint<D>::of(const LoadAtPlace& load, const MeshedBeams<D>& at,
                                                 const State& state) {
  const Beam& beam = at.structure.beams[load.beam];
  const std::optional<double> there = place_of(load, beam, state.t);
  if (!there) return std::nullopt;
  const double s = *there;
  const int index = find_span(at.structure, at.mesh, state.q, load.beam, s);
  const MeshElement<D>& e = at.elements[index];
  const PointShape<D> shape = point_shape<D>(e, state.q, s);
  const PointField<D> rs = shape.slope();
  TurnedVector vector{load.value, Eigen::Matrix3d::Zero()};
  if (load.follower) vector = turned_with_tangent(load.value, beam.curve.tangent(s), widened<D>(rs.value));
  const double local = e.local(gather<D>(e, state.q), s);
  if constexpr (D == 3)
    if (load.follower && e.twist)
      vector.value = e.twist->element.turned(gather_twist(e, state.q), local, load.value).value;
  return LoadedPoint{index, local, shape, rs, vector, state.load * value_and_slope(load.time, state.t).first};
}

namespace {

Eigen::Vector3d section_arm(const MeshElement<3>& e, const State& state, double s,
                            const Eigen::Vector2d& offset) {
  const SectionTriad<double> triad = e.twist->element.section(gather_twist(e, state.q), s).triad;
  return offset[0] * triad.d1 + offset[1] * triad.d2;
}

}  // namespace

template <int D>
void LoadedPoint<D>::add_force(const MeshedBeams<D>& at, const PointField<D>& loaded, const TurnedVector& f,
                               Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const Eigen::Matrix<double, D, 1> value = factor * f.value.template head<D>();
  const auto& dofs = at.elements[element].dofs;
  for (int k = 0; k < element_size<D>; ++k)
    if (dofs[k] >= 0) dynamics[dofs[k]] -= loaded.gradient.col(k).dot(value);
}

template <int D>
ElementMatrix<D> LoadedPoint<D>::stiffness(const PointField<D>& loaded, const TurnedVector& f,
                                           double weight) const {
  const Eigen::Matrix<double, D, 1> value = factor * f.value.template head<D>();
  const Eigen::Matrix<double, D, D> gradient = factor * f.gradient.template topLeftCorner<D, D>();
  ElementMatrix<D> K = -weight * loaded.gradient.transpose() * gradient * rs.gradient;
  loaded.add_hessian(value, -weight, shape.nodes, K);
  return K;
}

template <int D>
LoadedField<D>::LoadedField(const LoadedPoint<D>& p, const PointField<D>& loaded, const TurnedVector& f,
                            const MeshedBeams<D>& at, const State& state)
    : field(loaded.value), force(p.factor * f.value.template head<D>()), power(0) {
  const auto& dofs = at.elements[p.element].dofs;
  for (int k = 0; k < element_size<D>; ++k)
    if (dofs[k] >= 0) power += state.v[dofs[k]] * loaded.gradient.col(k).dot(force);
}

template <int D>
double load_work(const std::optional<LoadedField<D>>& from, const std::optional<LoadedField<D>>& to,
                 bool moves, double time) {
  if (!moves && from && to) return (from->force + to->force).dot(to->field - from->field) / 2;
  return time / 2 * ((from ? from->power : 0) + (to ? to->power : 0));
}

template <int D>
double PointLoad::work(const MeshedBeams<D>& at, const State& from, const State& to) const {
  if constexpr (D == 3)
    if (works_on_section(*this, on_section, at.structure))
      return section_load_work(*this, on_section, at, from, to);
  const auto loaded = [&](const State& state) -> std::optional<LoadedField<D>> {
    const auto p = LoadedPoint<D>::of(*this, at, state);
    if (!p) return std::nullopt;
    return LoadedField<D>(*p, p->shape.position(), p->vector, at, state);
  };
  return load_work<D>(loaded(from), loaded(to), speed != 0, to.t - from.t);
}

template <int D>
void PointLoad::add_force(const MeshedBeams<D>& at, const State& state,
                          Eigen::Ref<Eigen::VectorXd> dynamics) const {
  if constexpr (D == 3)
    if (works_on_section(*this, on_section, at.structure)) {
      if (const auto load = SectionLoad::of(*this, on_section, at, state, false))
        load->add_force(at, dynamics);
      return;
    }
  if (const auto p = LoadedPoint<D>::of(*this, at, state))
    p->add_force(at, p->shape.position(), p->vector, dynamics);
}

template <int D>
std::optional<LoadTangent<D>> PointLoad::tangent(const MeshedBeams<D>& at, const State& state,
                                                 const TangentWeights& w) const {
  if (w.stiffness == 0) return std::nullopt;
  const auto p = LoadedPoint<D>::of(*this, at, state);
  if (!p) return std::nullopt;
  return LoadTangent<D>{p->element, p->stiffness(p->shape.position(), p->vector, w.stiffness)};
}

template <int D>
void PointLoad::add_actions(const MeshedBeams<D>& at, const State& state,
                            std::vector<PointAction>& actions) const {
  const auto p = LoadedPoint<D>::of(*this, at, state);
  if (!p) return;
  actions.push_back({.element = p->element, .s = p->s, .force = p->factor * p->vector.value});
  if constexpr (D == 3)
    if (offset != Eigen::Vector2d::Zero() && at.elements[p->element].twist)
      actions.back().couple =
          section_arm(at.elements[p->element], state, p->s, offset).cross(actions.back().force);
}

template struct LoadedPoint<2>;
template struct LoadedPoint<3>;
template struct LoadedField<2>;
template struct LoadedField<3>;
template double load_work<2>(const std::optional<LoadedField<2>>&, const std::optional<LoadedField<2>>&, bool,
                             double);
template double load_work<3>(const std::optional<LoadedField<3>>&, const std::optional<LoadedField<3>>&, bool,
                             double);
template double PointLoad::work(const MeshedBeams<2>&, const State&, const State&) const;
template double PointLoad::work(const MeshedBeams<3>&, const State&, const State&) const;
template void PointLoad::add_force(const MeshedBeams<2>&, const State&, Eigen::Ref<Eigen::VectorXd>) const;
template void PointLoad::add_force(const MeshedBeams<3>&, const State&, Eigen::Ref<Eigen::VectorXd>) const;
template void PointLoad::add_actions(const MeshedBeams<2>&, const State&, std::vector<PointAction>&) const;
template void PointLoad::add_actions(const MeshedBeams<3>&, const State&, std::vector<PointAction>&) const;
template std::optional<LoadTangent<2>> PointLoad::tangent(const MeshedBeams<2>&, const State&,
                                                          const TangentWeights&) const;
template std::optional<LoadTangent<3>> PointLoad::tangent(const MeshedBeams<3>&, const State&,
                                                          const TangentWeights&) const;

}  // namespace nurbeam
