#pragma once
#include <array>
#include <vector>

#include "solver/algebra/near_solver.h"
#include "solver/tangents/step_tangent.h"

namespace nurbeam {

/// The adjoint of steps of generalized-alpha with one system, each linearised at its end: the transpose of
/// StepTangent. It carries derivatives of many quantities from the end of a step back to its start, all with
/// one matrix: by the motion, and by the data that generalized-alpha keeps between steps.
class StepAdjoint {
 public:
  using Matrix = MotionTangents::Matrix;

  /// `system` must outlive this object.
  StepAdjoint(const GeneralizedAlpha& settings, const SecondOrderSystem& system);

  /// Takes the next step as StepTangent does. Until `go_on`, all other functions belong to the step before;
  /// another thread may call them meanwhile.
  void take(const State& before, const IntegratorHistory& history, const State& after, bool repeated);
  /// Goes on to the step that has been taken.
  void go_on();
  /// The derivative of the residual at `after` by q, constraints below (n + m).
  const Eigen::SparseMatrix<double>& stiffness() const { return step().stiffness; }

  /// Finds the multipliers `mu` of the step, (n + m) x quantities: the quantities change by -mu . dR if the
  /// residual at its end changes by dR at fixed q, v, a and lambda. `end`: derivatives of the quantities by
  /// the end of the step, a column for each. Few quantities use the factors of an earlier step as long as
  /// these serve. Returns false where the step's matrix is not regular.
  [[nodiscard]] bool find_multipliers(const MotionTangents& end, Matrix& mu);
  /// The derivatives by the start of the step. The step's length changes by `by_time` times the change of t
  /// at its start, and the residual at `after` by `later` (n + m) with t. With an empty `later` times do not
  /// change, and their effect is left out.
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

  std::array<LinearStep, 2> steps_;  // present step and next one
  std::size_t present_ = 0;
  Eigen::SparseMatrix<double> transposed_;
  std::vector<int> values_;  // per value in transposed_: index of the matrix's value
  KktSolver solver_;
  bool has_factors_ = false;      // factors of this step or of one visited before
  bool factors_are_own_ = false;  // factors of this step
  std::vector<Solved> solved_;    // per quantity, if they are few: its last solutions
};

}  // namespace nurbeam
