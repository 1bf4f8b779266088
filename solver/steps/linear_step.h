#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "solver/steps/generalized_alpha.h"

namespace nurbeam {

/// A step of generalized-alpha with one system, linearised at its end. StepTangent carries derivatives
/// forward over it, and StepAdjoint back.
struct LinearStep {
  /// The algorithmic acceleration with which a step begins: that of the step before, the same moved to the
  /// new length of the step, or the acceleration itself.
  enum class Start { as_it_is, moved, afresh };

  /// `of` must outlive this object.
  LinearStep(const GeneralizedAlpha& settings, const SecondOrderSystem& of);
  /// Takes the matrices of a step from `before`, with its history, to `after`, which must be converged.
  /// `repeated`: the step was taken by Integrator::repeat.
  void take(const State& before, const IntegratorHistory& history, const State& after, bool repeated);

  /// beta h^2 / (mass scale), the factor of the dynamic rows of `kkt`.
  double scale() const { return parameters.beta * h * h / mass_scale; }
  /// alpha_m - alpha_f: number of steps by which the algorithmic acceleration is later.
  double lag() const { return parameters.alpha_m - parameters.alpha_f; }
  /// Derivatives of q and v at the end by the length of the step, at fixed algorithmic accelerations.
  Eigen::VectorXd q_by_length() const;
  Eigen::VectorXd v_by_length() const;

  GeneralizedAlphaIntegrator::Parameters parameters;
  const SecondOrderSystem* system;
  double h = 0, last_step = 0, mass_scale = 1;
  Start start = Start::as_it_is;
  Eigen::VectorXd start_velocity, jerk, start_algorithmic, end_algorithmic;
  Eigen::SparseMatrix<double> mass, damping, stiffness;  ///< the last one with G and dF/dlambda
  Eigen::SparseMatrix<double> kkt;  ///< matrix of the step's equations, for a correction of q
  bool damped = false;

 private:
  std::vector<int> of_constraints_;    // indices of the values of G and dF/dlambda
  bool has_constant_inertia_ = false;  // mass and damping hold this inertia already
};

}  // namespace nurbeam
