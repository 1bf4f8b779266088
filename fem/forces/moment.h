#pragma once
#include "fem/forces/point_load.h"

namespace nurbeam {

/// Force conjugate to r_s of a moment m: m x r_s / |r_s|^2 (virtual work m . (r_s x d r_s)/|r_s|^2), and its
/// derivative in r_s.
inline TurnedVector moment_on_slope(const TurnedVector& m, const Eigen::Vector3d& rs) {
  const double A = rs.squaredNorm();
  const Eigen::Vector3d f = m.value.cross(rs) / A;
  Eigen::Matrix3d gradient;
  for (int i = 0; i < 3; ++i)
    gradient.col(i) =
        (m.value.cross(Eigen::Vector3d::Unit(i)) + m.gradient.col(i).cross(rs)) / A - f * (2 * rs[i] / A);
  return {f, gradient};
}

/// A moment on a section [N m], across the beam: there is no torsion.
struct Moment : LoadAtPlace {
  template <int D>
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const {
    if (const auto p = LoadedPoint<D>::of(*this, at, state))
      p->add_force(at, p->rs, moment_on_slope(p->vector, widened<D>(p->rs.value)), dynamics);
  }
  template <int D, class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness == 0) return;
    const auto p = LoadedPoint<D>::of(*this, at, state);
    if (!p) return;
    const TurnedVector f = moment_on_slope(p->vector, widened<D>(p->rs.value));
    sink.element(p->element, p->stiffness(p->rs, f, w.stiffness));
  }
};

}  // namespace nurbeam
