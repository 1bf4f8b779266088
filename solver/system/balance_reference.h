#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Scaling of the equations of an implicit step: its dynamic rows are multiplied by h2 / mass_scale.
struct StepScale {
  double h2 = 0;          ///< inverse of the change of accelerations per correction of q [s^2]
  double mass_scale = 1;  ///< see mass_scale.h
  double tolerance = 0;   ///< for the scaled residual over its reference
};

/// (n+m) Finds the inverse of the reference of a scaled residual. In dynamic rows the reference is the
/// largest force, of f and G'lambda, in units of work over the coordinate scale. In constraint rows it is the
/// change of the constraint by the accelerations in the step. In both it is at least the round-off of the
/// matrix times the unknowns, weighted so that it passes the tolerance.
///
/// `kkt`: values of the system's pattern, for the scaled matrix of `at`; `still`: a copy of `at`, used as
/// work space and restored; `inverse_scale` (n): of the coordinates.
void measure_balance(const SecondOrderSystem& system, const State& at, const double* kkt,
                     const StepScale& scale, const Eigen::VectorXd& inverse_scale, State& still,
                     Eigen::VectorXd& reference);

}  // namespace nurbeam
