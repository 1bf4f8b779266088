#pragma once
#include "solver/generalized_alpha.h"

namespace nurbeam {

/// The derivative by one parameter of a motion and of what generalized-alpha keeps between its steps.
struct MotionTangent {
  State state;  ///< of t, q, v, a and lambda; what else a state has is left alone
  Eigen::VectorXd algorithmic_acceleration, jerk;
  double last_step = 0;

  static MotionTangent zero(int coordinates, int constraints);
};

/// One step of generalized-alpha, linearised where it has ended: the tangents of many parameters from its
/// start to its end, all with one matrix, which is taken and factorised there.
class StepTangent {
 public:
  /// A step from `before`, with that history, to `after`, which must be converged. `repeated`: as by
  /// Integrator::repeat.
  StepTangent(const GeneralizedAlpha& settings, const SecondOrderSystem& system, const State& before,
              const IntegratorHistory& history, const State& after, bool repeated);

  bool regular() const { return regular_; }
  /// The tangent at the end of the step, whose length changes by `step`. `dynamics` (n), `constraints` (m):
  /// how the residual at `after` changes with the parameter itself, by the system and by t, while q, v, a and
  /// lambda stay. Precondition: regular().
  MotionTangent end(const MotionTangent& start, double step, const Eigen::VectorXd& dynamics,
                    const Eigen::VectorXd& constraints) const;

 private:
  enum class Start { as_it_is, moved, afresh };  // what becomes of the algorithmic acceleration

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
