#pragma once
#include "solver/algebra/kkt_solver.h"
#include "solver/steps/linear_step.h"

namespace nurbeam {

/// Derivatives of a motion, and of the data that generalized-alpha keeps between steps, by many parameters.
struct MotionTangents {
  /// Derivatives of vectors, a column for each parameter.
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::RowVectorXd t, last_step;
  Matrix q, v, a, lambda;
  Matrix algorithmic_acceleration, jerk;

  static MotionTangents zero(Eigen::Index coordinates, Eigen::Index constraints, Eigen::Index parameters);

  Eigen::Index parameters() const { return t.size(); }
  /// The tangent by one parameter, of t, q, v, a and lambda; other members of the state keep their defaults.
  State of(Eigen::Index parameter) const;
  /// Adds `part` times the tangent of a state to the tangent by one parameter.
  void move(Eigen::Index parameter, const State& tangent, double part);
  /// Sets the tangent by one parameter where an integrator starts afresh.
  void start_afresh(Eigen::Index parameter, const State& tangent);
  /// Sets the tangents by all parameters where an integrator starts afresh from the present ones.
  void start_afresh();
};

/// The tangent of steps of generalized-alpha with one system, each linearised at its end: tangents of many
/// parameters go from its start to its end, all with one matrix, which is taken and factorised at the end.
class StepTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// `system` must outlive this object.
  StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system);

  /// Takes a step from `before`, with its history, to `after`, which must be converged. `repeated`: the step
  /// was taken by Integrator::repeat.
  void take(const State& before, const IntegratorHistory& history, const State& after, bool repeated);
  /// The derivative of the residual at `after` by q, constraints below (n + m).
  const Eigen::SparseMatrix<double>& stiffness() const { return step_.stiffness; }
  /// Factorises the matrix of the step; returns whether it is regular.
  [[nodiscard]] bool factorise();
  /// The tangents at the end of the step. `step`: derivatives of its length by each parameter. `dynamics`
  /// (n), `constraints` (m), a column for each: derivatives of the residual at `after` by the parameter
  /// itself, in the system and in t, at fixed q, v, a and lambda. Precondition: factorise() returned true.
  MotionTangents end(const MotionTangents& start, const Eigen::RowVectorXd& step, const Matrix& dynamics,
                     const Matrix& constraints) const;

 private:
  // An entry of the matrices: its column, and its index among their values.
  struct Entry {
    int column, value;
  };

  void predict(const MotionTangents& start, const Matrix& algorithmic, MotionTangents& end) const;
  void correct(const Matrix& x, const Matrix& algorithmic, MotionTangents& end) const;
  template <class Lanes, int times>
  void find_rhs_of(const MotionTangents& end, const Matrix& dynamics, const Matrix& constraints,
                   Eigen::Index first, Matrix& rhs) const;
  void find_rhs(const MotionTangents& end, const Matrix& dynamics, const Matrix& constraints,
                Matrix& rhs) const;

  LinearStep step_;
  std::vector<Entry> entries_;   // entries in the columns of coordinates, row by row
  std::vector<int> row_starts_;  // start of each row in `entries_`, and the end
  KktSolver solver_;
};

}  // namespace nurbeam
