#pragma once
#include <memory>

#include "solver/steps/integrator.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Settings of the explicit Runge-Kutta methods of SUNDIALS' ARKODE.
struct ExplicitRungeKutta {
  double tolerance =
      0;  ///< local error per step over |q| + coordinate_scale(), and accordingly for v; 0: fixed step
  double time_scale = 1;   ///< v is measured against coordinate_scale() / time_scale [s]
  int max_halvings = 12;   ///< halvings of a failed step, before giving up
  int max_steps = 100000;  ///< limit of ARKODE's steps in one call of advance, with error control
};

/// Advances one state by an explicit Runge-Kutta method on q' = v, M(q) v' + G'lambda = f(q, v, t), G v' +
/// curvature = 0, with the matrix factorised at every stage. Constraints that are linear in q, such as
/// supports, hold to round-off; others drift at the order of the method.
///
/// Without a tolerance: the classical method of four stages and order four, one step of at most `step`
/// seconds per call (shortened by system.step_limit and by retries). With a tolerance: the pair of Dormand &
/// Prince (1980) of orders five and four; advance(step) ends at t + step, with as many steps of its own as
/// the tolerance and system.step_limit require.
class ExplicitIntegrator final : public Integrator {
 public:
  /// `system` must outlive the integrator. Throws std::invalid_argument for settings out of range, for a
  /// start of the wrong size. start.a and start.lambda are not used; q and v must be consistent.
  ExplicitIntegrator(ExplicitRungeKutta settings, const SecondOrderSystem& system, State start);
  ~ExplicitIntegrator() override;
  ExplicitIntegrator(ExplicitIntegrator&&) noexcept;
  ExplicitIntegrator& operator=(ExplicitIntegrator&&) noexcept;

  const State& state() const override;
  [[nodiscard]] StepReport advance(double step) override;
  State take_before() override;
  void restore(State state, const IntegratorHistory& history) override;
  [[nodiscard]] StepReport repeat(const State& before, const IntegratorHistory& history,
                                  double step) override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nurbeam
