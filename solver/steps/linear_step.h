#pragma once
#include <Eigen/SparseCore>
#include <vector>

#include "solver/steps/generalized_alpha.h"

namespace nurbeam {

/// A step of generalized-alpha with one system, linearised where it has ended: what StepTangent carries
/// forward over it and StepAdjoint back.
struct LinearStep {
  /// What the algorithmic acceleration that the step begins with is: that of the step before, this moved to
  /// the length of the step, or the acceleration itself.
  enum class Start { as_it_is, moved, afresh };

  /// `of` must outlive it.
  LinearStep(const GeneralizedAlpha& settings, const SecondOrderSystem& of);
  /// Takes the matrices of a step from `before`, with that history, to `after`, which must be converged.
  /// `repeated`: as by Integrator::repeat.
  void take(const State& before, const IntegratorHistory& history, const State& after, bool repeated);

  /// beta h^2 / (mass scale), by which the dynamic rows of `kkt` are multiplied.
  double scale() const { return parameters.beta * h * h / mass_scale; }
  /// alpha_m - alpha_f: by how many steps the algorithmic acceleration is later.
  double lag() const { return parameters.alpha_m - parameters.alpha_f; }
  /// How q and v at the end change with the length of the step, while the algorithmic accelerations stay.
  Eigen::VectorXd q_by_length() const;
  Eigen::VectorXd v_by_length() const;

  GeneralizedAlphaIntegrator::Parameters parameters;
  const SecondOrderSystem* system;
  double h = 0, last_step = 0, mass_scale = 1;
  Start start = Start::as_it_is;
  Eigen::VectorXd start_velocity, jerk, start_algorithmic, end_algorithmic;
  Eigen::SparseMatrix<double> mass, damping, stiffness;  ///< the last with G and dF/dlambda
  Eigen::SparseMatrix<double> kkt;                       ///< of the step's equations, by a correction of q
  bool damped = false;

 private:
  std::vector<int> of_constraints_;    // values of G and dF/dlambda
  bool has_constant_inertia_ = false;  // which mass and damping hold
};

}  // namespace nurbeam
