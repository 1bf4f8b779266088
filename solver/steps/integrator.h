#pragma once
#include <memory>
#include <span>
#include <vector>

#include "solver/system/state.h"

namespace nurbeam {

enum class StepStatus {
  converged,
  not_converged,
  singular_matrix,
  inadmissible,
  inaccurate  ///< rejected by error control
};

struct StepReport {
  StepStatus status = StepStatus::converged;
  double step = 0;            ///< the step taken [s] (may be shorter than asked)
  double next_step = 0;       ///< next step that error control suggests [s]; without it the asked step
  int newton_iterations = 0;  ///< over all attempts; of explicit methods 0
  int rejected = 0;           ///< attempts thrown away
  double residual_norm = 0;   ///< scaled as the method's tolerance is, last attempt; of explicit methods 0
  double local_error = 0;     ///< estimated, relative; 0 where the method makes no estimate
};

/// The state at which an implicit method has taken its matrix, and the step for which.
struct Linearisation {
  State state;
  double step = 0;  ///< [s]
};

/// Data that a method keeps between steps besides the state; only the same method can read them.
struct IntegratorHistory {
  std::vector<double> numbers;
  std::vector<Eigen::VectorXd> vectors;
  std::shared_ptr<const Linearisation>
      linearisation;  ///< of the matrix with which the next step begins, if any
};

/// Advances one state of one SecondOrderSystem. Data kept between steps belong to the unchanged system: a
/// system that has changed, or a state that has jumped, needs a new integrator.
class Integrator {
 public:
  virtual ~Integrator() = default;
  virtual const State& state() const = 0;
  /// Moves the state by at most `step` seconds. On any status but `converged` the state is unchanged. The
  /// status is `inadmissible` if `step` or the system's step limit is not positive or too small to change t,
  /// or if `step` is not finite. Exceptions of the system arrive unchanged, with the state as it was.
  [[nodiscard]] virtual StepReport advance(double step) = 0;
  /// The state before the last step, which must have converged; it is moved out, and can be asked for once.
  virtual State take_before() = 0;
  /// States within the last step, in order of time, if the method has found some; valid until the next step.
  virtual std::span<const State> within() const { return {}; }
  /// Releases memory that the next step allocates anew, such as a matrix and its factors.
  virtual void rest() {}

  /// The history; empty for methods that start afresh from any state.
  virtual IntegratorHistory history() const { return {}; }
  /// Goes on from `state` as an integrator with this history would. Throws std::invalid_argument for a state
  /// or a history of another system or method.
  virtual void restore(State state, const IntegratorHistory& history) = 0;
  /// Repeats a step from `before`, whose history is given, with another length. It makes one attempt, without
  /// error control and, as for a first step, without the treatment of a changed step length.
  [[nodiscard]] virtual StepReport repeat(const State& before, const IntegratorHistory& history,
                                          double step) = 0;
};

}  // namespace nurbeam
