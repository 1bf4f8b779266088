#pragma once
#include <array>
#include <vector>

#include "solver/algebra/near_solver.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// Steps of generalized-alpha with one system, each linearised where it has ended, as by StepTangent, whose
/// transpose this is: derivatives of many quantities by a motion, and by what generalized-alpha keeps between
/// its steps, from the end of a step back to its start, all with one matrix.
class StepAdjoint {
 public:
  using Matrix = MotionTangents::Matrix;

  /// `system` must outlive it.
  StepAdjoint(const GeneralizedAlpha& settings, const SecondOrderSystem& system);

  /// Takes the next step as StepTangent does. Meanwhile, and until `go_on`, all else is of the one before, by
  /// another thread too.
  void take(const State& before, const IntegratorHistory& history, const State& after, bool repeated);
  /// To the step that has been taken.
  void go_on();
  /// How the residual at `after` changes with q, constraints below (n + m).
  const Eigen::SparseMatrix<double>& stiffness() const { return step().stiffness; }

  /// Finds (n + m) x quantities `mu` of the step: the quantities change by -mu . dR where the residual at its
  /// end does by dR while q, v, a and lambda stay. `end`: their derivatives by what the step ends with, a
  /// column for each. Where these are few, by the factors of a step that has been solved before, as long as
  /// they serve. Returns false where the step's matrix is not regular.
  [[nodiscard]] bool find_multipliers(const MotionTangents& end, Matrix& mu);
  /// The derivatives by what the step begins with. Its length changes by `by_time` of what t does at its
  /// start, and the residual at `after` by `later` (n + m) with t; where that is empty
  /// nothing changes times, and what they would do is left out.
  MotionTangents start(const MotionTangents& end, const Matrix& multipliers, double by_time,
                       const Eigen::VectorXd& later) const;

 private:
  bool factorise();
  bool solve(const Matrix& rhs, Matrix& x);
  struct Solved {
    Eigen::VectorXd last, before, earlier;
    double contraction = unknown_contraction;
  };
  bool solve_from_last(const Eigen::VectorXd& rhs, Solved& solved);

  const LinearStep& step() const { return steps_[present_]; }

  std::array<LinearStep, 2> steps_;  // the present one, and the next
  std::size_t present_ = 0;
  Eigen::SparseMatrix<double> transposed_;
  std::vector<int> values_;  // of each value in transposed_, that of the matrix
  KktSolver solver_;
  bool has_factors_ = false;      // of this step or of one gone over before
  bool factors_are_own_ = false;  // of this step
  std::vector<Solved> solved_;    // of each quantity, where they are few: for it, one after the other
};

}  // namespace nurbeam
