#pragma once
#include "solver/state.h"

namespace nurbeam {

enum class StepStatus { converged, not_converged, singular_matrix, inadmissible };

struct StepReport {
  StepStatus status = StepStatus::converged;
  double step = 0;            ///< the step taken [s] (may be shorter than asked)
  double next_step = 0;       ///< what error control would take next [s]; the asked step without it
  int newton_iterations = 0;  ///< over all attempts
  int rejected = 0;           ///< attempts thrown away
  double residual_norm = 0;   ///< scaled, last attempt
  double local_error = 0;     ///< estimated, relative
};

/// Advances one state of one SecondOrderSystem. What is kept between steps belongs to that system as it was:
/// a system that has changed, or a state that has jumped, needs a new integrator.
class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual const State& state() const = 0;
  /// Moves the state by at most `step` seconds. On any status but `converged` the state is unchanged. A
  /// `step` that is not positive and finite or too small to change t, and a step limit of the system that is
  /// not positive or too small to change t, are `inadmissible`. What the system throws arrives unchanged,
  /// with the state as it was.
  [[nodiscard]] virtual StepReport advance(double step) = 0;
};

}  // namespace nurbeam
