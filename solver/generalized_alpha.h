#pragma once
#include <limits>

#include "solver/kkt_solver.h"
#include "solver/second_order_system.h"

namespace nurbeam {

/// Settings of the index-3 generalized-alpha method (Arnold & Bruels 2007).
struct GeneralizedAlpha {
  double rho_infinity = 0.8;        ///< spectral radius at infinite frequency, [0,1]
  double newton_tolerance = 1e-10;  ///< on the scaled correction and residual, relative
  int max_iterations = 12;
  int max_halvings = 12;            ///< of a failed step, before giving up
  double tolerance = 0;             ///< relative local error per step; 0: fixed steps
};

enum class StepStatus { converged, not_converged, singular_matrix, inadmissible };

struct StepReport {
  StepStatus status = StepStatus::converged;
  double step = 0;             ///< the step taken [s] (may be shorter than asked)
  double next_step = 0;        ///< what error control would take next [s]; the asked step without it
  int newton_iterations = 0;   ///< over all attempts
  int rejected = 0;            ///< attempts thrown away
  double residual_norm = 0;    ///< scaled, last attempt
  double local_error = 0;      ///< estimated, relative
};

/// Advances one state; keeps the method's own acceleration variable and the factorisation between steps.
class GeneralizedAlphaIntegrator {
 public:
  /// `start` must be consistent (a and lambda too); the method's own acceleration variable is set to a.
  GeneralizedAlphaIntegrator(GeneralizedAlpha settings, const SecondOrderSystem& system, State start);

  const State& state() const { return state_; }
  /// The method's own acceleration variable (for a restart point).
  const Eigen::VectorXd& algorithmic_acceleration() const { return algorithmic_acceleration_; }
  void set_algorithmic_acceleration(Eigen::VectorXd value) { algorithmic_acceleration_ = std::move(value); }

  /// One step of at most `step` seconds (shortened by system.step_limit, by retries and by error control).
  /// On any status but `converged` the state is unchanged.
  [[nodiscard]] StepReport advance(double step);

 private:
  GeneralizedAlpha settings_;
  const SecondOrderSystem* system_;
  State state_;
  Eigen::VectorXd algorithmic_acceleration_;
  double last_step_ = 0;
  KktSolver solver_;
  Eigen::SparseMatrix<double> kkt_;
};

}  // namespace nurbeam
