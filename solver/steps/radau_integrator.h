#pragma once
#include <memory>

#include "solver/steps/integrator.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Settings of the Radau IIA method of three stages.
struct Radau {
  double newton_tolerance = 1e-10;  ///< on the scaled correction and residual, relative
  int max_iterations = 15;
  int max_halvings = 12;  ///< halvings of a failed step, before giving up
  double tolerance = 0;   ///< relative local error per step, by an embedded formula; 0: fixed steps
};

/// Advances one state by the Radau IIA method of three stages (Hairer & Wanner, Solving ODEs II, IV.8) on the
/// equations of index three: at stage i, at t + c_i h,
///
///   q_i = q + h sum_j a_ij v_j,   v_i = v + h sum_j a_ij alpha_j,
///   M(q_i) alpha_i + G'lambda_i = f(q_i, v_i, t_i),   g(q_i, t_i) = 0.
///
/// The last stage is the end of the step. The order is five in q, three in v, two in a and lambda where the
/// system is smooth (Hairer, Lubich & Roche 1989); motions quicker than the step die out in it. Earlier steps
/// only give a first guess. Each step takes its matrices anew, in its middle.
///
/// The local error is that of the embedded formula of order three in q, filtered (StageEquations::filtered).
/// In v the formula has no error where accelerations begin as those of the stages do.
class RadauIntegrator final : public Integrator {
 public:
  /// `start` must be consistent (a and lambda too). `system` must outlive the integrator. Throws
  /// std::invalid_argument for settings out of range and for a start of the wrong size.
  RadauIntegrator(Radau settings, const SecondOrderSystem& system, State start);
  ~RadauIntegrator() override;
  RadauIntegrator(RadauIntegrator&&) noexcept;
  RadauIntegrator& operator=(RadauIntegrator&&) noexcept;

  const State& state() const override;
  /// One step of at most `step` seconds (shortened by system.step_limit, by retries and by error control).
  [[nodiscard]] StepReport advance(double step) override;
  State take_before() override;
  /// The stages before the last one, with the memory that forces would have there.
  std::span<const State> within() const override;
  /// Start and length of the last attempted step, the mass scale, and a and lambda of its stages.
  IntegratorHistory history() const override;
  void restore(State state, const IntegratorHistory& history) override;
  [[nodiscard]] StepReport repeat(const State& before, const IntegratorHistory& history,
                                  double step) override;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nurbeam
