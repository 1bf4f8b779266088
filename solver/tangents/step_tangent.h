#pragma once
#include "solver/algebra/kkt_solver.h"
#include "solver/steps/linear_step.h"

namespace nurbeam {

/// The derivatives by many parameters of a motion and of what generalized-alpha keeps between its steps.
struct MotionTangents {
  /// Of vectors, a column for each parameter.
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::RowVectorXd t, last_step;
  Matrix q, v, a, lambda;
  Matrix algorithmic_acceleration, jerk;

  static MotionTangents zero(Eigen::Index coordinates, Eigen::Index constraints, Eigen::Index parameters);

  Eigen::Index parameters() const { return t.size(); }
  /// By one parameter, of t, q, v, a and lambda; what else a state has is left alone.
  State of(Eigen::Index parameter) const;
  /// Adds a part of the tangent of a state to that by one parameter.
  void move(Eigen::Index parameter, const State& tangent, double part);
  /// That by one parameter where an integrator starts afresh.
  void start_afresh(Eigen::Index parameter, const State& tangent);
  /// Those by all where one starts afresh from where they are.
  void start_afresh();
};

/// Steps of generalized-alpha with one system, each linearised where it has ended: the tangents of many
/// parameters from its start to its end, all with one matrix, which is taken and factorised there.
class StepTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// `system` must outlive it.
  StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system);

  /// Takes a step from `before`, with that history, to `after`, which must be converged. `repeated`: as by
  /// Integrator::repeat.
  void take(const State& before, const IntegratorHistory& history, const State& after, bool repeated);
  /// How the residual at `after` changes with q, constraints below (n + m).
  const Eigen::SparseMatrix<double>& stiffness() const { return step_.stiffness; }
  /// Whether the matrix of that step is regular.
  [[nodiscard]] bool factorise();
  /// Precondition: factorise() returned true. The tangents at its end, where its length changes by `step`, of
  /// each parameter. `dynamics` (n), `constraints` (m), a column for each: how the residual at `after`
  /// changes with the parameter itself, by the system and by t, while q, v, a and lambda stay.
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
  std::vector<Entry> entries_;   // of the columns of coordinates, row by row
  std::vector<int> row_starts_;  // of each row in `entries_`, and the end
  KktSolver solver_;
};

}  // namespace nurbeam
