#pragma once
#include <Eigen/Core>
#include <functional>
#include <memory>
#include <vector>

#include "fem/forces/force_offers.h"
#include "fem/mesh/point_action.h"
#include "fem/mesh/point_on_beam.h"
#include "fem/structure/grip.h"

namespace nurbeam {

template <int D>
class BoundCustomForce;

/// Forces at bodies and at material points of beams by a law of the caller's: springs, magnets, controllers,
/// ...
///
/// It works through a function pointer and with matrices of any size, outside the inner loops of the other
/// forces.
struct CustomForce {
  template <int D>
  using Bound = BoundCustomForce<D>;
  struct Response {
    Eigen::Matrix3Xd force;       ///< (3 x points) [N]
    Eigen::MatrixXd by_position;  ///< (3 points x 3 points) [N/m]; empty: taken by central differences
    Eigen::MatrixXd by_velocity;  ///< (3 points x 3 points) [N s/m]; likewise
  };
  /// From the time and the points' positions and velocities (3 x points), in the model's own frame (third
  /// rows zero in the plane).
  using Law = std::function<Response(double t, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd& v)>;

  /// A law knows of no factor of the loads: it is there as connectors are.
  static constexpr bool permanent = true;

  std::vector<Grip> points;
  Law law;
};

/// A CustomForce in one mesh.
template <int D>
class BoundCustomForce {
 public:
  static constexpr ForceOffers offers{.force = true, .work = true, .actions = true};
  /// `force` must outlive it.
  BoundCustomForce(const CustomForce& force, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn);

  /// Of all elements that may hold a point while this mesh stands, and of the bodies.
  const std::vector<int>& dofs() const { return dofs_; }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  /// Done between two states on one mesh [J]: the mean forces on the way.
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Adds what it does to beams at a moment.
  void add_actions(const MeshedBeams<D>& at, const State& state, std::vector<PointAction>& actions) const;
  template <class Sink>
  void add_tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w, Sink&& sink) const {
    if (w.stiffness != 0 || w.damping != 0) sink.own(tangent(at, state, w));
  }

 private:
  struct Points;
  Eigen::MatrixXd tangent(const MeshedBeams<D>& at, const State& state, const TangentWeights& w) const;
  Points points(const MeshedBeams<D>& at, const State& state) const;
  Eigen::MatrixXd derivative(const State& state, const Points& points, bool by_velocity) const;
  int column(int dof) const;

  const CustomForce* force_;
  std::vector<int> dofs_;  // increasing
};

extern template class BoundCustomForce<2>;
extern template class BoundCustomForce<3>;

}  // namespace nurbeam
