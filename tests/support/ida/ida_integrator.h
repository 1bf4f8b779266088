#pragma once
#include <memory>

#include "solver/steps/integrator.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Settings of SUNDIALS' IDA: backward differentiation of variable order and step.
struct Ida {
  double tolerance = 1e-8;  ///< local error per step over |q| + coordinate_scale(), and accordingly for v
  double time_scale = 1;    ///< v is measured against coordinate_scale() / time_scale [s]
  int max_order = 5;        ///< 1 to 5; above 2 the steps must follow undamped vibrations
  int max_steps = 100000;   ///< limit of IDA's steps in one call of advance
};

/// Advances one state by IDA's variable-order BDF, on the stabilised index-2 form (Gear, Gupta & Leimkuhler
/// 1985)
///
///   q' = v + S^2 G'mu,   M(q) v' + G'lambda = f(q, v, t),   g(q, t) = 0,   G v + g_t = 0,
///
/// so that neither constraint drifts. S = diag(coordinate_scale()) makes the correction of q, which is of the
/// size of the tolerance, independent of the units. lambda and mu are left out of the error test; they carry
/// the error of one step of v and q divided by the step. a is v' of the same formula: M a + G'lambda = f
/// holds to `residual_norm`, G a + curvature = 0 to the tolerance divided by the step.
///
/// Newton's matrix leaves out d(G'mu)/dq; d(G v + g_t)/dq is the difference of G along the motion.
///
/// advance(step) ends at t + step and keeps IDA's history, also over many short steps; no step of IDA's is
/// longer than system.step_limit. After a status other than `converged` or an exception the next call starts
/// anew from the unchanged state, at order one.
class IdaIntegrator final : public Integrator {
 public:
  /// `start` must be consistent (a and lambda too). `system` must outlive the integrator. Throws
  /// std::invalid_argument for settings out of range and for a start of the wrong size.
  IdaIntegrator(Ida settings, const SecondOrderSystem& system, State start);
  ~IdaIntegrator() override;
  IdaIntegrator(IdaIntegrator&&) noexcept;
  IdaIntegrator& operator=(IdaIntegrator&&) noexcept;

  const State& state() const override;
  [[nodiscard]] StepReport advance(double step) override;
  State take_before() override;
  void restore(State state, const IntegratorHistory& history) override;
  [[nodiscard]] StepReport repeat(const State& before, const IntegratorHistory& history,
                                  double step) override;
  /// Steps of IDA since its last start.
  long internal_steps() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace nurbeam
