#pragma once
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// How the equations of an implicit step are scaled: its dynamic rows are multiplied by h2 / mass_scale.
struct StepScale {
  double h2 = 0;          ///< of accelerations in a correction of q, inverse [s^2]
  double mass_scale = 1;  ///< (mass_scale.h)
  double tolerance = 0;   ///< on the scaled residual over its reference
};

/// (n+m) The inverse of what a scaled residual is compared with. Dynamic rows: the largest force, of f and
/// G'lambda, in units of work over the coordinate scale. Constraint rows: what the accelerations move the
/// constraint in the step. Both: the round-off of the matrix times the unknowns, weighted so that it passes
/// the tolerance. `kkt`: values of the system's pattern, of the scaled matrix of `at`; `still`: a copy of
/// `at`, which is worked in and comes back as it was; `inverse_scale` (n) of the coordinates.
void measure_balance(const SecondOrderSystem& system, const State& at, const double* kkt,
                     const StepScale& scale, const Eigen::VectorXd& inverse_scale, State& still,
                     Eigen::VectorXd& reference);

}  // namespace nurbeam
