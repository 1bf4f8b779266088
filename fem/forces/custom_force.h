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

/// Forces on bodies and on material points of beams by the caller's own law: springs, magnets, controllers,
/// ...
///
/// The law is a function pointer and its matrices may have any size, so it stays outside the inner loops of
/// the other forces.
struct CustomForce {
  template <int D>
  using Bound = BoundCustomForce<D>;
  struct Response {
    Eigen::Matrix3Xd force;       ///< (3 x points) [N]
    Eigen::MatrixXd by_position;  ///< (3 points x 3 points) [N/m]; empty: taken by central differences
    Eigen::MatrixXd by_velocity;  ///< (3 points x 3 points) [N s/m]; empty: taken by central differences
  };
  /// The law gets the time, and positions and velocities of the points (3 x points), in the model's own frame
  /// (third rows zero in the plane).
  using Law = std::function<Response(double t, const Eigen::Matrix3Xd& r, const Eigen::Matrix3Xd& v)>;

  /// A law of its own has no load factor: State::load does not scale it, as it does not scale connectors.
  static constexpr bool permanent = true;

  std::vector<Grip> points;
  Law law;
};

/// A CustomForce in one mesh.
template <int D>
class BoundCustomForce {
 public:
  static constexpr ForceOffers offers{.force = true, .work = true, .actions = true};
  /// `force` must outlive this object.
  BoundCustomForce(const CustomForce& force, const MeshedBeams<D>& at, const Eigen::VectorXd& drawn);

  /// Coordinates of all elements that may hold a point while this mesh stands, and of the bodies.
  const std::vector<int>& dofs() const { return dofs_; }
  void add_force(const MeshedBeams<D>& at, const State& state, Eigen::Ref<Eigen::VectorXd> dynamics) const;
  /// Work of the forces between two states on one mesh [J]: their mean over the displacement.
  double work(const MeshedBeams<D>& at, const State& from, const State& to) const;
  /// Adds the forces on points of beams in a state.
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
