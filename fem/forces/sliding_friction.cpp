#include "fem/forces/sliding_friction.h"

#include "fem/forces/memory.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/mesh/widened.h"

namespace nurbeam {

template <int D>
SlidingFriction<D>::SlidingFriction(const MeshedBeams<D>& at, const Eigen::VectorXd& drawn, int rider,
                                    int first_multiplier)
    : rider_(rider) {
  const Rider& sliding = at.structure.riders[rider];
  const double mass = at.structure.body_of(sliding).mass;
  const double k = at.structure.stick_stiffness(sliding);
  body_ = {
      &*sliding.friction, k, Friction::stick_damping(k, mass),
      1e-9 * mass * at.structure.gravity.norm() + 1e-18 * k * at.structure.beam_of(sliding).curve.length(),
      sliding.s};
  multiplier_ = first_multiplier;
  place_ = at.mesh.riders[rider].place;
  const double s = at.mesh.plan.places[rider];
  const int node = at.mesh.riders[rider].node;
  carrier_ = at.structure.beam_of(sliding).rigid ? Carrier::guide
             : node >= 0                         ? Carrier::node
                                                 : Carrier::point;
  if (carrier_ == Carrier::guide) segment_ = at.structure.beam_of(sliding).curve.segment_at(s);
  if (carrier_ == Carrier::point) {
    element_ = find_span(at.structure, at.mesh, drawn, sliding.beam, s);
    dofs_.assign(at.elements[element_].dofs.begin(), at.elements[element_].dofs.end());
  }
  if (carrier_ == Carrier::node) {
    slope_left_ = at.mesh.nodes[sliding.beam][node].slope_left;
    slope_right_ = at.mesh.nodes[sliding.beam][node].slope_right;
    for (const int first : {slope_left_, slope_right_})
      for (int d = 0; d < D; ++d) dofs_.push_back(first + d);
  }
  dofs_.push_back(place_);
  for (int d = 0; d < D; ++d) dofs_.push_back(at.mesh.coordinate_count + first_multiplier + d);
}

template <int D>
typename SlidingFriction<D>::Slopes SlidingFriction<D>::slopes(const MeshedBeams<D>& at,
                                                               const State& state) const {
  Slopes slopes;
  slopes.by_place.setZero();
  slopes.by_element.setZero();
  if (carrier_ == Carrier::node) {
    slopes.left = widened<D>(state.q.segment<D>(slope_left_));
    slopes.right = widened<D>(state.q.segment<D>(slope_right_));
    return slopes;
  }
  if (carrier_ == Carrier::guide) {
    const CurvePoint p =
        at.structure.beam_of(at.structure.riders[rider_]).curve.point_in(segment_, state.q[place_]);
    slopes.left = slopes.right = p.tangent;
    slopes.by_place = p.curvature;
    return slopes;
  }
  const CurvedPointShape<D> shape = point_shape<D>(at.elements[element_], state.q, state.q[place_]);
  const PointField<D> rs = shape.slope();
  slopes.left = slopes.right = widened<D>(rs.value);
  slopes.by_place = widened<D>(shape.slope_s().value);
  slopes.by_element = rs.gradient;
  return slopes;
}

template <int D>
FrictionForce SlidingFriction<D>::force_of(const MeshedBeams<D>& at, const Slopes& slopes,
                                           const State& state) const {
  const FrictionPoint point{.force = widened<D>(state.lambda.segment<D>(multiplier_)),
                            .left = slopes.left,
                            .right = slopes.right,
                            .s = state.q[place_],
                            .rate = state.v[place_],
                            .t = state.t};
  return friction_force(body_, point, friction_memory(at.mesh.memory, state.memory, rider_));
}

template <int D>
FrictionForce SlidingFriction<D>::friction(const MeshedBeams<D>& at, const State& state) const {
  return force_of(at, slopes(at, state), state);
}

template <int D>
void SlidingFriction<D>::add_force(const MeshedBeams<D>& at, const State& state,
                                   Eigen::Ref<Eigen::VectorXd> dynamics) const {
  if (state.memory.size() > 0) dynamics[place_] -= friction(at, state).value;
}

template <int D>
typename SlidingFriction<D>::Matrix SlidingFriction<D>::tangent(const MeshedBeams<D>& at, const State& state,
                                                                const TangentWeights& w) const {
  const Slopes now = slopes(at, state);
  const FrictionForce f = force_of(at, now, state);
  const auto n = static_cast<Eigen::Index>(dofs_.size()), row = n - D - 1;
  Matrix K = Matrix::Zero(n, n);
  const Eigen::Vector3d by_both = f.by_left + f.by_right;
  if (carrier_ == Carrier::node) {
    K.template block<1, D>(row, 0) = -w.stiffness * f.by_left.head<D>().transpose();
    K.template block<1, D>(row, D) = -w.stiffness * f.by_right.head<D>().transpose();
  }
  if (carrier_ == Carrier::point)
    K.template block<1, element_size<D>>(row, 0) =
        -w.stiffness * by_both.head<D>().transpose() * now.by_element;
  K(row, row) = -w.stiffness * (f.by_s + by_both.dot(now.by_place)) - w.damping * f.by_rate;
  K.template block<1, D>(row, row + 1) = -f.by_force.head<D>().transpose();
  return K;
}

template <int D>
void SlidingFriction<D>::add_energy(const MeshedBeams<D>& at, const State& state, SystemEnergy& sum) const {
  if (state.memory.size() > 0) sum.spring += stored(friction_memory(at.mesh.memory, state.memory, rider_));
}

template <int D>
double SlidingFriction<D>::loss(const MeshedBeams<D>& at, const State& from, const State& to) const {
  if (from.memory.size() == 0) return 0;
  const double work =
      (friction(at, from).value + friction(at, to).value) / 2 * (to.q[place_] - from.q[place_]);
  return stored(friction_memory(at.mesh.memory, from.memory, rider_)) -
         stored(friction_memory(at.mesh.memory, to.memory, rider_)) - work;
}

template <int D>
void SlidingFriction<D>::commit(const MeshedBeams<D>& at, const State& state, Eigen::VectorXd& memory) const {
  if (memory.size() > 0) set_friction_memory(at.mesh.memory, memory, rider_, friction(at, state).memory);
}

template class SlidingFriction<2>;
template class SlidingFriction<3>;

}  // namespace nurbeam
