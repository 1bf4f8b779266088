#pragma once
#include "solver/generalized_alpha.h"

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
};

/// One step of generalized-alpha, linearised where it has ended: the tangents of many parameters from its
/// start to its end, all with one matrix, which is taken and factorised there.
class StepTangent {
 public:
  using Matrix = MotionTangents::Matrix;

  /// A step from `before`, with that history, to `after`, which must be converged. `repeated`: as by
  /// Integrator::repeat.
  StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system, const State& before,
              const IntegratorHistory& history, const State& after, bool repeated);

  bool regular() const { return regular_; }
  /// The tangents at the end of the step, whose length changes by `step`, of each parameter. `dynamics` (n),
  /// `constraints` (m), a column for each: how the residual at `after` changes with the parameter itself, by
  /// the system and by t, while q, v, a and lambda stay. Precondition: regular().
  MotionTangents end(const MotionTangents& start, const Eigen::RowVectorXd& step, const Matrix& dynamics,
                     const Matrix& constraints) const;

 private:
  enum class Start { as_it_is, moved, afresh };  // what becomes of the algorithmic acceleration

  Matrix residual_of(const MotionTangents& end) const;
  Matrix solve(const Matrix& rhs) const;

  GeneralizedAlphaIntegrator::Parameters parameters_;
  State before_;
  double h_, last_step_, mass_scale_;
  Start start_;
  Eigen::VectorXd jerk_, start_algorithmic_, end_algorithmic_;
  Eigen::SparseMatrix<double> mass_, damping_, stiffness_;  // with G, and dF/dlambda in the last
  KktSolver solver_;
  bool regular_;
};

}  // namespace nurbeam
