#pragma once
#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <array>
#include <complex>
#include <vector>

#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/sparse_lu.h"
#include "solver/steps/radau_method.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Correction of a stage: in q, v, a (n each) and lambda (m).
struct StageCorrection {
  Eigen::VectorXd q, v, a, lambda;
};

/// The linearised equations of the stages of one step of RadauMethod, for corrections of all stages:
///
///   (M delta_ij + h a_ij D + h^2 (a^2)_ij K) da_j + G'dlambda_i = -(dynamics)_i,
///   h^2 (a^2)_ij G da_j = -(constraints)_i.
///
/// M, D, K and G belong to one place. The equations are diagonalised as `a` is: a real and a complex system
/// of n+m unknowns. The dynamic rows are multiplied by (h gamma)^2 / (mass scale), as those of the residuals
/// are.
class StageEquations {
 public:
  static constexpr int stages = RadauMethod::stages;
  using Residuals = std::array<Eigen::VectorXd, stages>;

  /// `system` must outlive this object.
  StageEquations(const SecondOrderSystem& system, const State& start);

  /// The divisor of the dynamic rows (mass_scale.h), from the start or from another integrator.
  double mass_scale() const { return mass_scale_; }
  void scale_masses_by(double mass_scale) { mass_scale_ = mass_scale; }

  /// Takes the matrices at a place for steps of h; returns whether they are regular.
  [[nodiscard]] bool linearise(const State& place, double h, double tolerance);
  /// Scales the residuals (n+m each). Returns the largest over its reference (measure_balance), not a number
  /// if one is not finite.
  double scale(Residuals& residuals) const;
  /// Finds the corrections for scaled residuals. Broyden's good update changes the matrices with every
  /// correction since they were taken (Kelley, Iterative Methods, 1995, 7.3). Returns the largest correction
  /// of q over the coordinate scale, not a number if one is not finite.
  double solve(const Residuals& residuals, std::array<StageCorrection, stages>& corrections);
  /// Largest x over the coordinate scale, for an error of q (n) filtered by the equations of first order, (1
  /// - h gamma J) (x, y) = (of_q, 0): without motions that are quicker than the step.
  double filtered(const Eigen::VectorXd& of_q) const;

 private:
  /// Corrections of all stages, in the coordinates in which the equations are diagonal.
  struct Diagonal {
    Eigen::VectorXd real;
    Eigen::VectorXcd complex;
  };

  double product(const Diagonal& x, const Diagonal& y) const;
  void update(Diagonal& correction);
  std::array<StageCorrection, stages> of_stages(const Diagonal& x) const;

  const SecondOrderSystem* system_;
  Eigen::Index n_, m_;
  double mass_scale_ = 1, h_ = 0;
  Eigen::VectorXd inverse_scale_;    // (n) of the coordinates
  Eigen::VectorXd reference_;        // (n+m) inverse of the reference
  std::vector<int> of_constraints_;  // indices of the values of G and dF/dlambda
  Eigen::SparseMatrix<double> mass_, damping_, stiffness_, real_;
  Eigen::SparseMatrix<std::complex<double>> complex_;
  KktSolver real_solver_;
  SparseLu<std::complex<double>> complex_solver_;
  bool is_analysed_ = false, is_regular_ = false;  // is_analysed_: the pattern of the complex matrix is known
  std::vector<Diagonal> before_;                   // corrections since the matrices were taken
};

}  // namespace nurbeam
