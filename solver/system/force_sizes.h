#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// The state without velocities and accelerations, and with as many multipliers as the system has.
State resting(const SecondOrderSystem& system, State state);

/// How large the forces of a system at rest are: each as work over its coordinate's scale, the largest of
/// them [J].
class ForceSizes {
 public:
  explicit ForceSizes(const SecondOrderSystem& system) : system_(system), scale_(system.coordinate_scale()) {}

  /// Of the full load and of what the constraints do; where these alone do something, 0 if that is round-off.
  double applied_force(const State& state) const { return applied(state).largest; }
  /// That, and without a load what moved supports would make if that is more; else the unbalanced internal
  /// force, else 1.
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
