#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The state without velocities and accelerations, and with as many multipliers as the system has.
State resting(const SecondOrderSystem& system, State state);

/// Sizes of the forces of a system at rest: each as work over the scale of its coordinate, the largest of
/// them [J].
class ForceSizes {
 public:
  explicit ForceSizes(const SecondOrderSystem& system) : system_(system), scale_(system.coordinate_scale()) {}

  /// Size of the full load and of the forces that the constraints cause. If the constraints alone cause a
  /// force, it is 0 where that is round-off.
  double applied_force(const State& state) const { return applied(state).largest; }
  /// The applied force; without a load at least the force that moved supports would cause. Where both vanish:
  /// the unbalanced internal force, else 1.
  double largest_force(const State& state) const;

 private:
  struct Applied {
    bool by_load;
    double largest;
  };
  Applied applied(const State& state) const;
  double round_off(const State& state) const;
  State towards_constraints(State state) const;
  Eigen::VectorXd dynamics(const State& state) const;
  double work(const Eigen::VectorXd& force) const {
    return force.cwiseProduct(scale_).lpNorm<Eigen::Infinity>();
  }

  const SecondOrderSystem& system_;
  Eigen::VectorXd scale_;
};

}  // namespace nurbeam
