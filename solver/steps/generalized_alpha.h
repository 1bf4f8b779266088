#pragma once
#include <utility>

#include "solver/algebra/kkt_solver.h"
#include "solver/steps/integrator.h"
#include "solver/system/second_order_system.h"

namespace nurbeam {

/// Settings of the index-3 generalized-alpha method (Arnold & Bruels 2007).
struct GeneralizedAlpha {
  double rho_infinity = 0.8;        ///< spectral radius at infinite frequency, [0,1]
  double newton_tolerance = 1e-10;  ///< on the scaled correction and residual, relative
  int max_iterations = 12;
  int max_halvings = 12;  ///< halvings of a failed step, before giving up
  double tolerance = 0;   ///< relative local error per step; 0: fixed steps
  bool settles = true;    ///< project v and alg onto the constraints after each step; StepTangent and
                          ///< StepAdjoint know only steps that do not
};

/// Advances one state by the index-3 generalized-alpha method; keeps the method's own acceleration variable
/// and the factorised matrix between steps. The matrix is renewed where a correction is not at least ten
/// times smaller than the one before (for the second one, two times). It is also renewed where the step's
/// length changes, and after fifty steps. The system's moving part of the matrix is renewed in every step.
///
///   q' = q + h v + h^2 ((1/2 - beta) alg + beta alg'),   v' = v + h ((1 - gamma) alg + gamma alg'),
///   (1 - alpha_m) alg' + alpha_m alg = (1 - alpha_f) a' + alpha_f a,
///   M a' + G'lambda' = f(q', v', t'), g(q', t') = 0,
///
/// as Arnold & Bruels (2007), with their optimal parameters. It differs in two ways. Scaling: the dynamic
/// rows are multiplied by beta h^2 / (mass scale) and lambda by the inverse, so the iteration matrix tends to
/// [(1 - alpha_m)/(1 - alpha_f) M / (mass scale), G'; G, 0] as h -> 0. Step changes: alg stands for a at t +
/// (alpha_m - alpha_f) h, so a new step h_new moves it by (alpha_m - alpha_f)(h_new - h) d3q/dt3, the
/// derivative taken from alg over the last step. A step more than four times the last one starts afresh with
/// alg = a.
///
/// Settling: at index 3 what is left of v and alg along the gradients of the constraints alternates from step
/// to step and dies out by rho_infinity a step. Where the gradients turn by a good part of 1 - rho_infinity
/// in a step, it feeds on the motion and grows without bound. So where G v + g_t has turned by more than a
/// smooth motion lets it, v and alg are projected after the step onto
///
///   G v + g_t = e h^2 G j,   G alg + curvature = (alpha_m - alpha_f) h G j,
///
/// in the norm of the iteration matrix, a back substitution each; j = d3q/dt3, and e is the method's own
/// error of position. Forces that depend on v are balanced again. With zero in place of
/// the right-hand sides each step would begin like a first one, and lambda would be of first order. Where G
/// is constant, nothing grows.
///
/// Order two in q and v for any steps; in lambda for equal steps, once the start (alg = a) is forgotten like
/// rho_infinity^k. A change of step disturbs lambda and a by O(h_new - h), which is forgotten at the same
/// rate. Where that matters, make_accelerations_consistent on a copy of the state gives both to second order
/// from q and v.
///
/// In an exact position constraint lambda carries the round-off of q divided by h^2: a caller that must land
/// on a time should divide the rest evenly rather than take one tiny step.
class GeneralizedAlphaIntegrator final : public Integrator {
 public:
  struct Parameters {
    double alpha_m;
    double alpha_f;
    double beta;
    double gamma;
    double position_error;  ///< error in q of one step, in units of h^3 d3q/dt3
  };
  static Parameters parameters(double rho_infinity);
  static constexpr double largest_rescaling = 4;  ///< ratio of steps beyond which the method starts afresh

  /// `start` must be consistent (a and lambda too); the method's own acceleration variable is set to a.
  /// `system` must outlive the integrator. Throws std::invalid_argument for settings out of range and for a
  /// start of the wrong size.
  GeneralizedAlphaIntegrator(GeneralizedAlpha settings, const SecondOrderSystem& system, State start);
  /// An integrator with the scale of masses of another one.
  GeneralizedAlphaIntegrator(GeneralizedAlpha settings, const SecondOrderSystem& system, State start,
                             double mass_scale);

  const State& state() const override { return state_; }
  /// The divisor of the dynamic rows (mass_scale.h).
  double mass_scale() const { return mass_scale_; }
  /// The method's own acceleration variable and jerk (n each), last step, last error and mass scale, and the
  /// state at which its matrix was taken.
  IntegratorHistory history() const override;
  void restore(State state, const IntegratorHistory& history) override;
  /// Goes on from `state`, whose v and a have jumped, a by `jump` (n). The method's own acceleration jumps
  /// with a, so that coordinates without a jump go on as if there were none.
  void jump_to(State state, const Eigen::VectorXd& jump);
  [[nodiscard]] StepReport repeat(const State& before, const IntegratorHistory& history,
                                  double step) override;
  /// (n+m) x (n+m) the scaled matrix of the last Newton iteration, whichever step it was taken in.
  /// Precondition: there was one.
  Eigen::Map<const Eigen::SparseMatrix<double>> iteration_matrix() const;

  /// One step of at most `step` seconds (shortened by system.step_limit, by retries and by error control).
  [[nodiscard]] StepReport advance(double step) override;
  State take_before() override { return std::move(trial_); }
  void rest() override;

 private:
  StepReport advance_within(double step, int max_halvings, double tolerance);
  StepStatus attempt(double step, StepReport& report);
  bool predict(double step);
  bool has_matrix_for(double step) const;
  Eigen::Map<Eigen::SparseMatrix<double>> matrix();
  TangentWeights weights_of(double step) const;
  bool linearise(std::shared_ptr<const Linearisation> at, State& still);
  bool linearise_again();
  std::shared_ptr<const Linearisation> trial_point(double step);
  bool renew_moving_part();
  void evaluate_residual();
  double scale_residual(double step);
  template <class Use>
  auto with_start(long first, long end, const Use& use) const;
  double find_correction();
  void correct(double step);
  double local_error(double step) const;
  double next_step(double step, double tolerance, const StepReport& report) const;
  bool alternates() const;
  void settle(double step);
  void project_open(Eigen::VectorXd& motion);
  void balance_again(double step);
  void accept(double step);

  GeneralizedAlpha settings_;
  Parameters parameters_;
  const SecondOrderSystem* system_;
  State state_;
  Eigen::VectorXd algorithmic_acceleration_;
  Eigen::VectorXd jerk_;  ///< d3q/dt3 over the last step
  double last_step_ = 0;
  double last_error_ = 0;
  double mass_scale_ = 1;
  int first_corrections_ = 0;  ///< number in the step that took the matrix
  int more_corrections_ = 0;   ///< number beyond that, in the steps that kept the matrix
  std::shared_ptr<const Linearisation> linearisation_;  ///< of the matrix that the next iteration uses
  std::shared_ptr<const Linearisation> factorised_;     ///< of the matrix in kkt_, solver_ and reference_
  std::shared_ptr<Linearisation> spare_;                ///< reused when nobody else holds it
  KktSolver solver_;
  Eigen::VectorXd kkt_;          ///< values of the system's pattern; empty before a step and after a rest
  Eigen::MatrixXd moving_part_;  ///< moving part as it is in kkt_

  // The attempt under way.
  State trial_;               ///< after a step: the state before it, until that is taken
  bool settles_ = false;      ///< whether G turns, so that steps settle
  bool starts_anew_ = false;  ///< from the true acceleration, not the method's own variable
  double of_jerk_ = 0;  ///< factor of jerk_ that moves algorithmic_acceleration_ to the step of the attempt
  Eigen::VectorXd trial_algorithmic_;
  Eigen::VectorXd residual_;  ///< (n+m) scaled; once solved for, the correction that answers it
  Eigen::VectorXd
      reference_;  ///< (n+m) inverse of the reference of the scaled residual, at the place of factorised_
  Eigen::VectorXd inverse_scale_;         ///< (n) of the coordinates
  Eigen::VectorXd speeds_, last_speeds_;  ///< (m) G v + g_t of the trial state and of the last one
  Eigen::VectorXd earlier_, later_, smooth_speeds_, open_;  ///< (m) work space of settle()
  State beside_;                ///< work space: a state near the trial state, without a and memory
  Eigen::MatrixXd moved_part_;  ///< present moving part less the one in kkt_
};

}  // namespace nurbeam
