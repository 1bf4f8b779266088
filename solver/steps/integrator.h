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
  inaccurate  ///< as error control finds it
};

struct StepReport {
  StepStatus status = StepStatus::converged;
  double step = 0;            ///< the step taken [s] (may be shorter than asked)
  double next_step = 0;       ///< what error control would take next [s]; the asked step without it
  int newton_iterations = 0;  ///< over all attempts; of explicit methods 0
  int rejected = 0;           ///< attempts thrown away
  double residual_norm = 0;   ///< scaled as the method's tolerance is, last attempt; of explicit methods 0
  double local_error = 0;     ///< estimated, relative; 0 where the method makes no estimate
};

/// Where and for which step an implicit method has taken its matrix.
struct Linearisation {
  State state;
  double step = 0;  ///< [s]
};

/// What a method keeps between steps besides the state; only the same method can read it.
struct IntegratorHistory {
  std::vector<double> numbers;
  std::vector<Eigen::VectorXd> vectors;
  std::shared_ptr<const Linearisation>
      linearisation;  ///< of the matrix that the next step begins with, if any
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
  /// The state before the last step, which has converged: it is moved out, to be asked for once.
  virtual State take_before() = 0;
  /// States within the last step, in order of time, where the method has found some: valid until the next.
  virtual std::span<const State> within() const { return {}; }
  /// Gives room back that the next step makes anew, as that of a matrix and its factors.
  virtual void rest() {}

  /// Empty for methods that start afresh from any state.
  virtual IntegratorHistory history() const { return {}; }
  /// Goes on from `state` as the integrator would that had this history. Throws std::invalid_argument for a
  /// state or a history of another system or method.
  virtual void restore(State state, const IntegratorHistory& history) = 0;
  /// Repeats a step from `before`, which had that history, with another length: one attempt, without error
  /// control, and as a first step, without what a change of the step length would ask for.
  [[nodiscard]] virtual StepReport repeat(const State& before, const IntegratorHistory& history,
                                          double step) = 0;
};

}  // namespace nurbeam
