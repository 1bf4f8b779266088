#pragma once
#include <Eigen/Core>
#include <vector>

#include "fem/forces/force_offers.h"
#include "fem/mesh/mesh_elements.h"
#include "fem/time_table.h"

namespace nurbeam {

template <int D>
class BoundBodyLoad;

/// A force on a body or on a place of a rigid one, or a moment on a rigid body.
struct BodyLoad {
  template <int D>
  using Bound = BoundBodyLoad<D>;

  int body = 0;    ///< a force acts on this
  int turns = -1;  ///< the rigid body that a moment acts on, and that a follower load turns with
  bool is_moment = false;
  Eigen::Vector3d value = Eigen::Vector3d::Zero();  ///< of a follower load along the own axes [N] or [N m]
  bool follower = false;
  TimeTable time = {};  ///< factor
};

/// A BodyLoad in one mesh.
template <int D>
class BoundBodyLoad {
 public:
  static constexpr ForceOffers offers{.force = true, .work = true, .on_body = true};
  /// `load` must outlive this object.
  BoundBodyLoad(const BodyLoad& load, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn);

  /// Position of the body, then attitude.
  const std::vector<int>& dofs() const { return dofs_; }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>&, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness != 0) sink.own(tangent(state, w.stiffness));
  }
  /// Work between two states on one mesh [J]: the mean of the load over the way or the turn.
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  Eigen::Matrix<double, D, 1> on_body(const MeshedBeams<D>& at, int body, const State& state) const;

 private:
  Eigen::MatrixXd tangent(const State& state, double weight) const;
  double factor(const State& state) const;
  // The load in the axes of the model, with its factor.
  Eigen::Vector3d present(const State& state) const;

  const BodyLoad* load_;
  int p_;  // first coordinate of the attitude, -1 for none
  std::vector<int> dofs_;
};

extern template class BoundBodyLoad<2>;
extern template class BoundBodyLoad<3>;

}  // namespace nurbeam
