#pragma once
#include "solver/step_tangent.h"

namespace nurbeam {

/// Steps of generalized-alpha with one system, each linearised where it has ended, as by StepTangent, whose
/// transpose this is: derivatives of many quantities by a motion, and by what generalized-alpha keeps between
/// its steps, from the end of a step back to its start, all with one matrix.
class StepAdjoint {
 public:
  using Matrix = MotionTangents::Matrix;

  /// `system` must outlive it.
  StepAdjoint(const GeneralizedAlpha& settings, const SecondOrderSystem& system);

  /// As StepTangent::take.
  [[nodiscard]] bool take(const State& before, const IntegratorHistory& history, const State& after,
                          bool repeated);
  /// How the residual at `after` changes with q, constraints below (n + m). Precondition here and below: take
  /// returned true.
  const Eigen::SparseMatrix<double>& stiffness() const { return step_.stiffness; }

  /// (n + m) x quantities mu of a step: the quantities change by -mu . dR where the residual at its end does
  /// by dR while q, v, a and lambda stay. `end`: their derivatives by what the step ends with, a column for
  /// each.
  Matrix multipliers(const MotionTangents& end) const;
  /// The derivatives by what the step begins with. Its length changes by `by_time` of what t does at its
  /// start, and the residual at `after` by `later` (n + m) with t; where that is empty
  /// nothing changes times, and what they would do is left out.
  MotionTangents start(const MotionTangents& end, const Matrix& multipliers, double by_time,
                       const Eigen::VectorXd& later) const;

 private:
  LinearStep step_;
  Eigen::SparseMatrix<double> transposed_;
  std::vector<int> values_;  // of each value in transposed_, that of the matrix
  KktSolver solver_;
};

}  // namespace nurbeam
