#pragma once
#include "fem/forces/turned_vector.h"
#include "fem/mesh/point_on_beam.h"

namespace nurbeam {

/// A vector at one place of a beam, which may move along it: what a force and a moment have in common.
struct LoadAtPlace {
  int beam = 0;
  double s = 0;                                     ///< place at t = 0 [m]
  double speed = 0;                                 ///< ds/dt of the place [m/s]
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< [N] or [N m]
  bool follower = false;                            ///< turns with the tangent
  TimeTable time = {};                              ///< factor
};

/// Where such a load is at a moment: nothing is there when it has left the beam.
template <int D>
struct LoadedPoint {
  int element;
  PointShape<D> shape;
  PointField<D> rs;
  TurnedVector vector;  ///< without its factor
  double factor;        ///< of time and of State::load

  static std::optional<LoadedPoint> of(const LoadAtPlace& load, const MeshedBeams<D>& at,
                                       const State& state) {
    const Beam& beam = at.structure.beams[load.beam];
    const double s = load.s + load.speed * state.t;
    if (!beam.is_ring() && (s < 0 || s > beam.curve.length())) return std::nullopt;
    const int index = find_span(at.structure, at.mesh, state.q, load.beam, s);
    const PointShape<D> shape = point_shape<D>(at.elements[index], state.q, s);
    const PointField<D> rs = shape.slope();
    TurnedVector vector{load.value, Eigen::Matrix3d::Zero()};
    if (load.follower) vector = turned_with_tangent(load.value, beam.curve.tangent(s), widened<D>(rs.value));
    return LoadedPoint{index, shape, rs, vector, state.load * value_and_slope(load.time, state.t).first};
  }

  /// The force f conjugate to the field `loaded` on the dynamics: less loaded_q' f.
  void add_force(const MeshedBeams<D>& at, const PointField<D>& loaded, const TurnedVector& f,
                 Eigen::Ref<Eigen::VectorXd> dynamics) const {
    const Eigen::Matrix<double, D, 1> value = factor * f.value.template head<D>();
    const auto& dofs = at.elements[element].dofs;
    for (int k = 0; k < element_size<D>; ++k)
      if (dofs[k] >= 0) dynamics[dofs[k]] -= loaded.gradient.col(k).dot(value);
  }
  ElementMatrix<D> stiffness(const PointField<D>& loaded, const TurnedVector& f, double weight) const {
    const Eigen::Matrix<double, D, 1> value = factor * f.value.template head<D>();
    const Eigen::Matrix<double, D, D> gradient = factor * f.gradient.template topLeftCorner<D, D>();
    ElementMatrix<D> K = -weight * loaded.gradient.transpose() * gradient * rs.gradient;
    loaded.add_hessian(value, -weight, shape.nodes, K);
    return K;
  }
};

/// A force on a material point [N].
struct PointLoad : LoadAtPlace {
  template <int D>
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const {
    if (const auto p = LoadedPoint<D>::of(*this, at, state))
      p->add_force(at, p->shape.position(), p->vector, dynamics);
  }
  template <int D, class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness == 0) return;
    if (const auto p = LoadedPoint<D>::of(*this, at, state))
      sink.element(p->element, p->stiffness(p->shape.position(), p->vector, w.stiffness));
  }
};

}  // namespace nurbeam
