#include "fem/forces/section_load.h"

#include "fem/forces/load_place.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

namespace {

// The moment of a force beside the axis. A force that follows the section has a moment that does too, given
// in the axes of the drawing.
SectionMoment moment_of(const LoadAtPlace& load, const DrawnSection& drawn, const Eigen::Vector3d& force) {
  if (!load.follower) return {force, false, load.offset};
  return {(load.offset[0] * drawn.d1 + load.offset[1] * drawn.d2).cross(force), true, {}};
}

}  // namespace

std::optional<SectionLoad> SectionLoad::of(const LoadAtPlace& load, OnSection kind, const MeshedBeams<3>& at,
                                           const State& state, bool with_gradient) {
  const Beam& beam = at.structure.beams[load.beam];
  const std::optional<double> there = place_of(load, beam, state.t);
  if (!there) return std::nullopt;
  const double s = *there;
  SectionLoad on{find_span(at.structure, at.mesh, state.q, load.beam, s), {}, {}};
  const MeshElement<3>& e = at.elements[on.element];
  const TwistElement& twist = e.twist->element;
  const TwistLayout::Coordinates q = gather_twist(e, state.q);
  const double place = beam.curve.unrolled(s, (e.span->s_a + e.span->s_b) / 2);
  const Eigen::Vector3d value = state.load * value_and_slope(load.time, state.t).first * load.value;
  on.force.setZero();
  on.gradient.setZero();
  const auto add_moment = [&](const SectionMoment& moment) {
    on.force += twist.moment_force(q, place, moment);
    if (with_gradient) on.gradient += twist.moment_gradient(q, place, moment);
  };
  if (kind == OnSection::moment) {
    add_moment({value, load.follower, {}});
    return on;
  }
  if (load.offset != Eigen::Vector2d::Zero()) add_moment(moment_of(load, beam.curve.section(place), value));
  TwistElement::TurnedWithSection f{value, Eigen::Matrix<double, 3, TwistLayout::size>::Zero()};
  if (load.follower) f = twist.turned(q, place, value);
  const PointShape<3> shape = point_shape<3>(e, state.q, s);
  const PointField<3> r = shape.position();
  on.force.head<TwistLayout::first>() += r.gradient.transpose() * f.value;
  if (!with_gradient) return on;
  auto axis = on.gradient.topLeftCorner<TwistLayout::first, TwistLayout::first>();
  r.add_hessian(f.value, 1, shape.nodes, axis);
  on.gradient.topRows<TwistLayout::first>() += r.gradient.transpose() * f.gradient;
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
