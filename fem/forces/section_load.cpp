#include "fem/forces/section_load.h"

namespace nurbeam {

std::optional<SectionLoad> SectionLoad::of(const LoadAtPlace& load, OnSection kind, const MeshedBeams<3>& at,
                                           const State& state, bool with_gradient) {
  const Beam& beam = at.structure.beams[load.beam];
  const double s = load.s + load.speed * state.t;
  if (!beam.is_ring() && (s < 0 || s > beam.curve.length())) return std::nullopt;
  SectionLoad on{find_span(at.structure, at.mesh, state.q, load.beam, s), {}, {}};
  const MeshElement<3>& e = at.elements[on.element];
  const TwistElement& twist = e.twist->element;
  const TwistLayout::Coordinates q = gather_twist(e, state.q);
  const double place = beam.curve.unrolled(s, (e.s_a + e.s_b) / 2);
  const Eigen::Vector3d value = state.load * value_and_slope(load.time, state.t).first * load.value;
  if (kind == OnSection::moment) {
    on.force = twist.moment_force(q, place, value, load.follower);
    if (with_gradient) on.gradient = twist.moment_gradient(q, place, value, load.follower);
    return on;
  }
  const TwistElement::TurnedWithSection f = twist.turned(q, place, value);
  const ShapeFunctions<double> shape = e.element.shape(q.head<TwistLayout::first>(), place);
  on.force.setZero();
  on.gradient.setZero();
  for (int k = 0; k < 4; ++k) {
    on.force.segment<3>(3 * k) = shape.value[k] * f.value;
    on.gradient.middleRows<3>(3 * k) = shape.value[k] * f.gradient;
  }
  return on;
}

void SectionLoad::add_force(const MeshedBeams<3>& at, Eigen::Ref<Eigen::VectorXd> dynamics) const {
  const auto& dofs = at.elements[element].twist->dofs;
  for (int k = 0; k < TwistLayout::size; ++k)
    if (dofs[k] >= 0) dynamics[dofs[k]] -= force[k];
}

double SectionLoad::power(const MeshedBeams<3>& at, const Eigen::VectorXd& v) const {
  const auto& dofs = at.elements[element].twist->dofs;
  double sum = 0;
  for (int k = 0; k < TwistLayout::size; ++k)
    if (dofs[k] >= 0) sum += v[dofs[k]] * force[k];
  return sum;
}

double section_load_work(const LoadAtPlace& load, OnSection kind, const MeshedBeams<3>& at, const State& from,
                         const State& to) {
  const auto power = [&](const State& state) {
    const auto on = SectionLoad::of(load, kind, at, state, false);
    return on ? on->power(at, state.v) : 0;
  };
  return (to.t - from.t) / 2 * (power(from) + power(to));
}

}  // namespace nurbeam
