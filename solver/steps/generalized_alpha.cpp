#include "solver/steps/generalized_alpha.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/algebra/convergence.h"
#include "solver/algebra/finite.h"
#include "solver/algebra/side_by_side.h"
#include "solver/system/arguments.h"
#include "solver/system/balance_reference.h"
#include "solver/system/mass_scale.h"

namespace nurbeam {

namespace {

constexpr double largest_growth = 2;  ///< largest growth of the step under error control
/// Contraction of the first two corrections, which is due to Newton's method more than to the matrix.
constexpr double first_contraction = 0.5;
/// Corrections in excess of those that the first step with a matrix took, after which the matrix is renewed:
/// renewal costs about as many.
constexpr int worth_a_matrix = 12;
constexpr double longest_use = 50;  ///< longest use of a matrix, in steps
constexpr double same_step = 1e-6;  ///< relative difference of steps that a matrix does not notice
constexpr double safety = 0.9;

constexpr const char* generalized_alpha_method = "generalized-alpha";

void check(const GeneralizedAlpha& settings) {
  require(settings.rho_infinity >= 0 && settings.rho_infinity <= 1, generalized_alpha_method, "rho_infinity ",
          settings.rho_infinity, " is not in [0, 1]");
  require(settings.newton_tolerance > 0, generalized_alpha_method, "newton_tolerance ",
          settings.newton_tolerance, " is not positive");
  require(settings.max_iterations > 0, generalized_alpha_method, "max_iterations ", settings.max_iterations,
          " is not positive");
  require(settings.max_halvings >= 0, generalized_alpha_method, "max_halvings ", settings.max_halvings,
          " is negative");
  require(settings.tolerance >= 0, generalized_alpha_method, "tolerance ", settings.tolerance,
          " is negative");
}

/// Number of unknowns worked on at once, so that data of an iteration stay in the cache and long vectors are
/// shared between threads.
constexpr long piece = 4096;

/// The part of a vector from entry `first` to before `end`.
template <class Vector>
auto part(Vector& vector, long first, long end) {
  return vector.segment(first, end - first);
}

/// The maximum magnitude of some numbers, 0 of none; not a number if one of them is not finite.
template <class Numbers>
double largest(const Numbers& numbers) {
  if (!all_finite(numbers)) return std::numeric_limits<double>::quiet_NaN();
  return numbers.size() > 0 ? numbers.template lpNorm<Eigen::Infinity>() : 0;
}

}  // namespace

GeneralizedAlphaIntegrator::Parameters GeneralizedAlphaIntegrator::parameters(double rho_infinity) {
  const double alpha_m = (2 * rho_infinity - 1) / (rho_infinity + 1);
  const double alpha_f = rho_infinity / (rho_infinity + 1);
  const double gamma = 0.5 + alpha_f - alpha_m;
  const double beta = 0.25 * (gamma + 0.5) * (gamma + 0.5);
  // alg stands for a at t + (alpha_m - alpha_f) h: with it and the exact q and v, the formula for q' is wrong
  // by position_error h^3 d3q/dt3.
  const double position_error = 1.0 / 6 - 0.5 * (alpha_m - alpha_f) - beta;
  return {alpha_m, alpha_f, beta, gamma, position_error};
}

GeneralizedAlphaIntegrator::GeneralizedAlphaIntegrator(GeneralizedAlpha settings,
                                                       const SecondOrderSystem& system, State start)
    : GeneralizedAlphaIntegrator(settings, system, std::move(start), 1) {
  mass_scale_ = nurbeam::mass_scale(system, state_, matrix());
  // The first step allocates kkt_ again; code before it may need as much memory.
  kkt_.resize(0);
}

GeneralizedAlphaIntegrator::GeneralizedAlphaIntegrator(GeneralizedAlpha settings,
                                                       const SecondOrderSystem& system, State start,
                                                       double mass_scale)
    : settings_(settings), system_(&system), state_(std::move(start)), mass_scale_(mass_scale) {
  check(settings_);
  const int n = system.coordinate_count();
  const int m = system.constraint_count();
  require_sizes(generalized_alpha_method, state_, system);
  parameters_ = parameters(settings_.rho_infinity);
  algorithmic_acceleration_ = state_.a;
  jerk_ = Eigen::VectorXd::Zero(n);
  inverse_scale_ = system.coordinate_scale().cwiseInverse();
  trial_ = state_;
  trial_algorithmic_ = state_.a;
  residual_.resize(n + m);
  reference_.resize(n + m);
  settles_ = settings_.settles && !system.has_constant_constraints();
  for (Eigen::VectorXd* each : {&speeds_, &last_speeds_, &earlier_, &later_, &smooth_speeds_, &open_})
    each->setZero(m);
  if (settles_) system.turning_speeds(state_, last_speeds_);
}

IntegratorHistory GeneralizedAlphaIntegrator::history() const {
  IntegratorHistory history{
      {last_step_, last_error_, mass_scale_, 1.0 * first_corrections_, 1.0 * more_corrections_},
      {},
      linearisation_};
  history.vectors.reserve(2);
  history.vectors.push_back(algorithmic_acceleration_);
  history.vectors.push_back(jerk_);
  return history;
}

void GeneralizedAlphaIntegrator::restore(State state, const IntegratorHistory& history) {
  require_sizes(generalized_alpha_method, state, *system_);
  require(history.numbers.size() == 5 && history.vectors.size() == 2, generalized_alpha_method,
          "the history is not one of this method");
  for (const Eigen::VectorXd& vector : history.vectors)
    require_size(generalized_alpha_method, "the history", vector.size(), system_->coordinate_count());
  if (history.linearisation) require_sizes(generalized_alpha_method, history.linearisation->state, *system_);
  linearisation_ = history.linearisation;
  state_ = std::move(state);
  algorithmic_acceleration_ = history.vectors[0];
  jerk_ = history.vectors[1];
  last_step_ = history.numbers[0];
  last_error_ = history.numbers[1];
  mass_scale_ = history.numbers[2];
  first_corrections_ = static_cast<int>(history.numbers[3]);
  more_corrections_ = static_cast<int>(history.numbers[4]);
  if (settles_) system_->turning_speeds(state_, last_speeds_);
}

void GeneralizedAlphaIntegrator::jump_to(State state, const Eigen::VectorXd& jump) {
  require_sizes(generalized_alpha_method, state, *system_);
  require_size(generalized_alpha_method, "the jump", jump.size(), system_->coordinate_count());
  state_ = std::move(state);
  algorithmic_acceleration_ += jump;
  if (settles_) system_->turning_speeds(state_, last_speeds_);
}

StepReport GeneralizedAlphaIntegrator::repeat(const State& before, const IntegratorHistory& history,
                                              double step) {
  restore(before, history);
  last_step_ = last_error_ = 0;
  linearisation_ = nullptr;
  jerk_.setZero();
  mass_scale_ = nurbeam::mass_scale(*system_, state_, matrix());
  return advance_within(step, 0, 0);
}

StepReport GeneralizedAlphaIntegrator::advance(double step) {
  return advance_within(step, settings_.max_halvings, settings_.tolerance);
}

StepReport GeneralizedAlphaIntegrator::advance_within(double step, int max_halvings, double tolerance) {
  StepReport report{.status = StepStatus::inadmissible, .next_step = step};
  const double limit = system_->step_limit(state_);
  if (!(step > 0) || !(limit > 0)) return report;
  double h = std::min(step, limit);
  for (int i = 0; i <= max_halvings && std::isfinite(h) && state_.t + h > state_.t; ++i) {
    report.status = attempt(h, report);
    double shorter = 0.5;
    if (report.status == StepStatus::converged) {
      if (settles_) settle(h);
      report.local_error = local_error(h);
      if (tolerance == 0 || report.local_error <= tolerance) {
        report.step = h;
        if (tolerance > 0) report.next_step = next_step(h, tolerance, report);
        last_error_ = report.local_error;
        accept(h);
        return report;
      }
      report.status = StepStatus::inaccurate;
      shorter = std::max(0.2, safety * std::cbrt(tolerance / report.local_error));
    }
    ++report.rejected;
    h *= shorter;
  }
  return report;
}

StepStatus GeneralizedAlphaIntegrator::attempt(double step, StepReport& report) {
  if (!predict(step)) return StepStatus::not_converged;
  if (!system_->admissible(trial_)) return StepStatus::inadmissible;
  if (!has_matrix_for(step)) linearisation_ = nullptr;
  const bool has_served = linearisation_ != nullptr;
  Convergence convergence;
  for (int i = 0; i < settings_.max_iterations; ++i) {
    evaluate_residual();
    ++report.newton_iterations;
    const bool is_kept = linearisation_ && linearise_again() && (i > 0 || renew_moving_part());
    if (!is_kept && !linearise(trial_point(step), trial_))
      return all_finite(residual_) ? StepStatus::singular_matrix : StepStatus::not_converged;
    report.residual_norm = scale_residual(step);
    if (!std::isfinite(report.residual_norm)) return StepStatus::not_converged;
    const double correction = find_correction();
    if (!std::isfinite(correction)) return StepStatus::not_converged;
    // A matrix from elsewhere is renewed if its correction leads away.
    if (is_kept && correction > std::max(convergence.last_correction(), settings_.newton_tolerance)) {
      linearisation_ = nullptr;
      continue;
    }
    correct(step);
    if (!system_->admissible(trial_)) return StepStatus::inadmissible;
    const bool done = convergence.reached(report.residual_norm, correction, settings_.newton_tolerance);
    // A correction below the tolerance may be round-off, which nothing contracts.
    const bool stale = correction > settings_.newton_tolerance &&
                       !convergence.contracts(i == 1 ? first_contraction : Convergence::good_contraction);
    if (stale) linearisation_ = nullptr;
    if (!done) continue;
    if (!has_served || stale)
      first_corrections_ = i, more_corrections_ = 0;
    else if ((more_corrections_ += std::max(0, i - first_corrections_)) > worth_a_matrix)
      linearisation_ = nullptr;
    return StepStatus::converged;
  }
  return StepStatus::not_converged;
}

void GeneralizedAlphaIntegrator::rest() {
  factorised_ = nullptr;
  solver_ = {};
  kkt_ = {};
}

bool GeneralizedAlphaIntegrator::has_matrix_for(double step) const {
  return linearisation_ && std::abs(linearisation_->step / step - 1) <= same_step &&
         std::abs(trial_.t - linearisation_->state.t) <= longest_use * step;
}

Eigen::Map<Eigen::SparseMatrix<double>> GeneralizedAlphaIntegrator::matrix() {
  const SparsePattern& pattern = system_->tangent_pattern();
  kkt_.resize(static_cast<Eigen::Index>(pattern.rows().size()));
  return pattern.matrix_of(kkt_.data());
}

Eigen::Map<const Eigen::SparseMatrix<double>> GeneralizedAlphaIntegrator::iteration_matrix() const {
  const SparsePattern& pattern = system_->tangent_pattern();
  return {pattern.size(),        pattern.size(), kkt_.size(), pattern.column_starts().data(),
          pattern.rows().data(), kkt_.data()};
}

/// Takes and factorises the matrix at a place. `still`: a copy of its state, used as work space and restored.
/// False where the matrix is singular.
bool GeneralizedAlphaIntegrator::linearise(std::shared_ptr<const Linearisation> at, State& still) {
  linearisation_ = std::move(at);
  factorised_ = nullptr;
  const TangentWeights weights = weights_of(linearisation_->step);
  system_->tangent(linearisation_->state, weights, matrix());
  if (!solver_.factorise(matrix(), system_->moving_unknowns())) {
    linearisation_ = nullptr;
    return false;
  }
  system_->moving_tangent(linearisation_->state, weights, moving_part_);
  const double step = linearisation_->step;
  measure_balance(*system_, linearisation_->state, kkt_.data(),
                  {parameters_.beta * step * step, mass_scale_, settings_.newton_tolerance}, inverse_scale_,
                  still, reference_);
  factorised_ = linearisation_;
  return true;
}

/// Factorises the matrix of linearisation_ again, if another one was factorised since.
bool GeneralizedAlphaIntegrator::linearise_again() {
  if (factorised_ == linearisation_) return true;
  State still = linearisation_->state;
  return linearise(linearisation_, still);
}

/// The trial state as the place of a new matrix.
std::shared_ptr<const Linearisation> GeneralizedAlphaIntegrator::trial_point(double step) {
  linearisation_ = factorised_ = nullptr;
  if (spare_.use_count() != 1) spare_ = std::make_shared<Linearisation>();
  spare_->state = trial_;
  spare_->step = step;
  return spare_;
}

/// Renews the moving part of the matrix at the trial state. False where the matrix is then singular.
bool GeneralizedAlphaIntegrator::renew_moving_part() {
  if (moving_part_.size() == 0) return true;
  system_->moving_tangent(trial_, weights_of(linearisation_->step), moved_part_);
  moved_part_ -= moving_part_;
  return solver_.renew(moved_part_);
}

TangentWeights GeneralizedAlphaIntegrator::weights_of(double step) const {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  return {.mass = (1 - alpha_m) / (1 - alpha_f) / mass_scale_,
          .damping = gamma * step / mass_scale_,
          .stiffness = beta * step * step / mass_scale_};
}

/// Calls use(alg) with this part of the method's acceleration variable, moved to the step of the attempt.
template <class Use>
auto GeneralizedAlphaIntegrator::with_start(long first, long end, const Use& use) const {
  if (starts_anew_) return use(part(state_.a, first, end));
  return use(part(algorithmic_acceleration_, first, end) + of_jerk_ * part(jerk_, first, end));
}

/// Sets the trial state, with the true acceleration and multipliers of the last state; returns whether it is
/// finite.
bool GeneralizedAlphaIntegrator::predict(double step) {
  const double alpha_m = parameters_.alpha_m, beta = parameters_.beta, gamma = parameters_.gamma;
  const double h = step;
  starts_anew_ = last_step_ > 0 && step > largest_rescaling * last_step_;
  of_jerk_ = last_step_ > 0 ? (alpha_m - parameters_.alpha_f) * (h - last_step_) : 0;
  for (Eigen::VectorXd* vector : {&trial_.q, &trial_.v, &trial_.a}) vector->resize(state_.q.size());
  const double not_finite = largest_of_pieces(state_.q.size(), piece, [&](long first, long end) {
    const auto of = [&](auto& vector) { return part(vector, first, end); };
    auto after = of(trial_algorithmic_);
    with_start(first, end, [&](const auto& alg) {
      after = (of(state_.a) - alpha_m * alg) / (1 - alpha_m);
      of(trial_.q) = of(state_.q) + h * of(state_.v) + h * h * ((0.5 - beta) * alg + beta * after);
      of(trial_.v) = of(state_.v) + h * ((1 - gamma) * alg + gamma * after);
    });
    of(trial_.a) = of(state_.a);
    const bool is_finite = all_finite(of(trial_.q)) && all_finite(of(trial_.v)) && all_finite(of(trial_.a));
    return is_finite ? 0.0 : 1.0;
  });
  trial_.t = state_.t + h;
  trial_.lambda = state_.lambda;
  trial_.memory = state_.memory;
  return not_finite == 0 && all_finite(trial_.lambda);
}

/// Evaluates the residual of the trial state.
void GeneralizedAlphaIntegrator::evaluate_residual() {
  const Eigen::Index n = trial_.q.size();
  system_->residual(trial_, residual_.head(n), residual_.tail(trial_.lambda.size()));
}

/// Scales the residual as the matrix is scaled. Returns the largest entry over its reference, not a number if
/// one is not finite.
double GeneralizedAlphaIntegrator::scale_residual(double step) {
  const double factor = parameters_.beta * step * step / mass_scale_;
  const Eigen::Index n = trial_.q.size();
  const double of_forces = largest_of_pieces(n, piece, [&](long first, long end) {
    auto rows = part(residual_, first, end);
    rows *= factor;
    return largest(rows.cwiseProduct(part(reference_, first, end)));
  });
  const Eigen::Index m = trial_.lambda.size();
  const double of_constraints = largest(residual_.tail(m).cwiseProduct(reference_.tail(m)));
  return of_constraints > of_forces || std::isnan(of_constraints) ? of_constraints : of_forces;
}

/// Solves for the correction that closes the residual. Returns the largest correction of q over the
/// coordinate scale, not a number if one is not finite.
double GeneralizedAlphaIntegrator::find_correction() {
  Eigen::VectorXd& correction = residual_;
  solver_.solve(residual_, correction);
  if (!all_finite(correction.tail(trial_.lambda.size()))) return std::numeric_limits<double>::quiet_NaN();
  return largest_of_pieces(trial_.q.size(), piece, [&](long first, long end) {
    return largest(part(correction, first, end).cwiseProduct(part(inverse_scale_, first, end)));
  });
}

/// Corrects the trial state: q directly, and v, a and alg by the method's formulas.
void GeneralizedAlphaIntegrator::correct(double step) {
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  const double of_velocity = gamma / (beta * step), of_algorithmic = 1 / (beta * step * step);
  const double of_acceleration = (1 - alpha_m) / (1 - alpha_f) * of_algorithmic;
  const Eigen::VectorXd& correction = residual_;
  by_pieces(trial_.q.size(), piece, [&](long first, long end) {
    const auto of = [&](auto& vector) { return part(vector, first, end); };
    const auto less = of(correction);
    of(trial_.q) -= less;
    of(trial_.v) -= of_velocity * less;
    of(trial_.a) -= of_acceleration * less;
    of(trial_algorithmic_) -= of_algorithmic * less;
  });
  trial_.lambda -= mass_scale_ * of_algorithmic * correction.tail(trial_.lambda.size());
}

/// The h^3 d3q/dt3 term of the method's own error in q over the coordinate scale, with the derivative taken
/// from alg.
double GeneralizedAlphaIntegrator::local_error(double step) const {
  const double greatest = largest_of_pieces(state_.q.size(), piece, [&](long first, long end) {
    return with_start(first, end, [&](const auto& start) {
      const auto moved = part(trial_algorithmic_, first, end) - start;
      return largest(moved.cwiseProduct(part(inverse_scale_, first, end)));
    });
  });
  return std::abs(parameters_.position_error) * step * step * greatest;
}

/// A proportional-integral controller for a local error of third degree; no growth right after a rejection.
double GeneralizedAlphaIntegrator::next_step(double step, double tolerance, const StepReport& report) const {
  const double smallest = 1e-12 * tolerance;
  const double relative = std::max(report.local_error, smallest) / tolerance;
  const double last = std::max(last_error_, smallest) / tolerance;
  const double integral = last_error_ > 0 ? std::pow(last, 0.4 / 3) : 1;
  const double growth = safety * std::pow(relative, -0.7 / 3) * integral;
  return step * std::clamp(growth, 0.2, report.rejected > 0 ? 1.0 : largest_growth);
}

/// Whether the velocities of the trial state along the gradients of constraints have turned since the last
/// step as those of a smooth motion do not.
bool GeneralizedAlphaIntegrator::alternates() const {
  constexpr double smooth = 0.1, round_off = 1e-12;
  const auto now = speeds_.array(), last = last_speeds_.array();
  const double noise = round_off * trial_.v.lpNorm<Eigen::Infinity>();
  return ((now - last).abs() > (smooth * (now.abs() + last.abs())).max(noise)).any();
}

/// Projects v and alg of the trial state onto those of a smooth motion, in the norm of the step's matrix.
void GeneralizedAlphaIntegrator::settle(double step) {
  system_->turning_speeds(trial_, speeds_);
  if (!alternates()) return;
  const auto& [alpha_m, alpha_f, beta, gamma, error] = parameters_;
  const double little = step / 64, per_jerk = error * step * step;
  beside_.load = trial_.load;
  beside_.lambda = trial_.lambda;
  const auto find_speeds = [&](double time, Eigen::VectorXd& speeds) {  // on the way with constant a
    beside_.t = trial_.t + time;
    beside_.q = trial_.q + time * (trial_.v + (time / 2) * trial_.a);
    beside_.v = trial_.v + time * trial_.a;
    system_->turning_speeds(beside_, speeds);
  };
  find_speeds(-little, earlier_);
  find_speeds(little, later_);
  // e h^2 G j, within the present speeds where a constraint turns or is driven with a kink.
  smooth_speeds_ = (per_jerk / (little * little)) * (2 * speeds_ - earlier_ - later_);
  smooth_speeds_ = smooth_speeds_.cwiseMin(speeds_.cwiseAbs().cwiseMax(last_speeds_.cwiseAbs()))
                       .cwiseMax(-speeds_.cwiseAbs().cwiseMax(last_speeds_.cwiseAbs()));
  // Speeds change with v in proportion: alg - a takes the place of v for a second.
  beside_.t = trial_.t;
  beside_.q = trial_.q;
  beside_.v = trial_.v + trial_algorithmic_ - trial_.a;
  system_->turning_speeds(beside_, open_);
  open_ += (later_ - earlier_) / (2 * little) - speeds_;
  open_ -= ((alpha_m - alpha_f) * step / per_jerk) * smooth_speeds_;
  project_open(trial_algorithmic_);
  open_ = speeds_ - smooth_speeds_;
  project_open(trial_.v);
  balance_again(step);
  system_->turning_speeds(trial_, speeds_);
}

/// Balances forces at velocities that have been moved, as dampers feel it.
void GeneralizedAlphaIntegrator::balance_again(double step) {
  constexpr int most_iterations = 3;
  for (int i = 0; i < most_iterations; ++i) {
    evaluate_residual();
    if (!(scale_residual(step) > settings_.newton_tolerance) || !std::isfinite(find_correction())) return;
    correct(step);
  }
}

/// Takes open_ (m) off G times `motion`.
void GeneralizedAlphaIntegrator::project_open(Eigen::VectorXd& motion) {
  Eigen::VectorXd& correction = residual_;
  correction.head(motion.size()).setZero();
  correction.tail(open_.size()) = open_;
  solver_.solve(residual_, correction);
  motion -= correction.head(motion.size());
}

void GeneralizedAlphaIntegrator::accept(double step) {
  by_pieces(state_.q.size(), piece, [&](long first, long end) {
    with_start(first, end, [&](const auto& start) {
      part(jerk_, first, end) = (part(trial_algorithmic_, first, end) - start) / step;
    });
  });
  std::swap(state_, trial_);
  std::swap(algorithmic_acceleration_, trial_algorithmic_);
  last_step_ = step;
  std::swap(speeds_, last_speeds_);
  state_.memory = system_->committed(state_);
}

}  // namespace nurbeam
