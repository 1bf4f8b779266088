#pragma once
#include <vector>

#include "solver/algebra/kkt_solver.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// The part of a displacement d (n), up to all of it, over which differences of the residual are its
/// derivative along d.
double small_part(const SecondOrderSystem& system, const Eigen::VectorXd& d);

/// make_accelerations_smooth or balance_accelerations, linearised where it has been: how accelerations and
/// multipliers that belong to a state change with it and with parameters of the system. What is zero of them,
///   rho = M a + G'lambda - f + [(h/2) D + (h^2/4) K] b,   c = G a + curvature,
/// b = a or what it has been corrected by, has products of tangents with accelerations in it. Of these
///   [(h/2) D + (h^2/4) K] b = (F(q + e d, v + e d') - F(q - e d, v - e d')) / 2e,   d = h^2/4 b, d' = h/2 b,
/// for a small e, F = -f, so that rho is a sum of residuals of three states, and its derivatives by q
/// and v are those of their tangents.
class StartTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// Of the accelerations and multipliers of `state`, which make_accelerations_smooth has found.
  StartTangent(const SecondOrderSystem& system, double h, const State& state);
  /// That balance_accelerations has found with `around` from accelerations `before` (n).
  StartTangent(const SecondOrderSystem& system, double h, const std::vector<int>& around,
               const Eigen::VectorXd& before, const State& state);

  /// Whether there is one. Precondition of what follows.
  bool regular() const { return regular_; }

  /// A share of rho: the residual of a state times a factor, and how it changes with q, constraints below
  /// (n + m).
  struct Part {
    State state;
    double factor;
    Eigen::SparseMatrix<double> stiffness;
  };
  const std::vector<Part>& parts() const { return parts_; }

  /// Puts a and lambda of tangents to what q and v of them, and where it has been corrected the ones that
  /// there were, say. A column for each parameter: `dynamics` (n), how rho changes with the parameter itself
  /// and with t; `curvature` (m), how c does with all but a.
  void find(const Matrix& dynamics, const Matrix& curvature, MotionTangents& tangents) const;

 private:
  std::vector<Part> parts_;
  Eigen::SparseMatrix<double> stiffness_, damping_;  // of rho
  Eigen::SparseMatrix<double> kkt_;  // of rho and c by a and lambda, the first n rows and columns scaled
  Eigen::SparseMatrix<double> smoothing_;  // (h/2) D + (h^2/4) K where a has been corrected, else empty
  double scale_ = 1;
  std::vector<int> unknowns_;  // that are solved for, where these are not all
  KktSolver solver_;
  bool regular_ = false;
};

}  // namespace nurbeam
