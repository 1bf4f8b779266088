#pragma once
#include <vector>

#include "solver/algebra/kkt_solver.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// The factor for a displacement d (n), at most 1, at which differences of the residual give its derivative
/// along d.
double small_part(const SecondOrderSystem& system, const Eigen::VectorXd& d);

/// The linearised make_accelerations_smooth or balance_accelerations: derivatives of the accelerations and
/// multipliers that belong to a state, by the state and by parameters of the system. Their equations
///   rho = M a + G'lambda - f + [(h/2) D + (h^2/4) K] b = 0,   c = G a + curvature = 0,
/// where b is a or its correction, contain products of tangents with accelerations. For a small e and F = -f
///   [(h/2) D + (h^2/4) K] b = (F(q + e d, v + e d') - F(q - e d, v - e d')) / 2e,   d = h^2/4 b, d' = h/2 b.
/// So rho is a sum of residuals of three states, and its derivatives by q and v are those of their tangents.
class StartTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// The tangent for accelerations and multipliers of `state` from make_accelerations_smooth.
  StartTangent(const SecondOrderSystem& system, double h, const State& state);
  /// The tangent for those from balance_accelerations with `around`, starting at accelerations `before` (n).
  StartTangent(const SecondOrderSystem& system, double h, const std::vector<int>& around,
               const Eigen::VectorXd& before, const State& state);

  /// Whether the equations are regular, a precondition of the functions below.
  bool regular() const { return regular_; }

  /// A part of rho: the residual of a state times a factor, and its derivative by q, constraints below (n +
  /// m).
  struct Part {
    State state;
    double factor;
    Eigen::SparseMatrix<double> stiffness;
  };
  const std::vector<Part>& parts() const { return parts_; }

  /// Sets a and lambda of tangents from their q and v, and for balance_accelerations from their a and lambda
  /// before. A column for each parameter: `dynamics` (n), the derivative of rho by the parameter itself and
  /// by t; `curvature` (m), the derivative of c at fixed a.
  void find(const Matrix& dynamics, const Matrix& curvature, MotionTangents& tangents) const;

 private:
  std::vector<Part> parts_;
  Eigen::SparseMatrix<double> stiffness_, damping_;  // derivatives of rho by q and v
  // Derivatives of rho and c by a and lambda, with the first n rows and columns scaled.
  Eigen::SparseMatrix<double> kkt_;
  Eigen::SparseMatrix<double> smoothing_;  // (h/2) D + (h^2/4) K for balance_accelerations, else empty
  double scale_ = 1;
  std::vector<int> unknowns_;  // unknowns that are solved for; empty: all
  KktSolver solver_;
  bool regular_ = false;
};

}  // namespace nurbeam
