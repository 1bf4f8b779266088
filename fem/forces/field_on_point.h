#pragma once
#include "fem/mesh/widened.h"
#include "fem/structure/structure.h"
#include "solver/system/second_order_system.h"

/// The acceleration by a model's MassField of a mass whose first position coordinate is r; zero without one.
namespace nurbeam {

/// Scaled by State::load, as gravity is (D) [m/s^2].
template <int D>
Eigen::Matrix<double, D, 1> field_on_point(const Structure& structure, const State& state, int r) {
  if (!structure.field) return Eigen::Matrix<double, D, 1>::Zero();
  const MassField& field = *structure.field;
  const Eigen::Vector3d a = field.at_rest(widened<D>(state.q.segment<D>(r))) +
                            field.by_velocity() * widened<D>(state.v.segment<D>(r));
  return state.load * a.head<D>();
}

/// Of inertia less force, per mass (D x D).
template <int D>
Eigen::Matrix<double, D, D> field_tangent(const Structure& structure, const State& state, int r,
                                          const TangentWeights& w) {
  if (!structure.field) return Eigen::Matrix<double, D, D>::Zero();
  const MassField& field = *structure.field;
  const Eigen::Matrix3d K =
      w.stiffness * field.gradient(widened<D>(state.q.segment<D>(r))) + w.damping * field.by_velocity();
  return -state.load * K.topLeftCorner<D, D>();
}

/// Potential per mass [J/kg].
template <int D>
double field_potential(const Structure& structure, const State& state, int r) {
  return structure.field ? structure.field->potential(widened<D>(state.q.segment<D>(r))) : 0;
}

}  // namespace nurbeam
