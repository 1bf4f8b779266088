#include "solver/steps/explicit_integrator.h"

#include <arkode/arkode_erkstep.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/sundials_border.h"
#include "solver/system/arguments.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;
using VectorRef = Eigen::Ref<Vector>;
using ConstVectorRef = Eigen::Ref<const Vector>;

constexpr const char* runge_kutta = "explicit Runge-Kutta";

/// d/dt of y = (q / s, T v / s), with the coordinate scale s and the time scale T.
class FirstOrderEquations {
 public:
  FirstOrderEquations(const SecondOrderSystem& system, const State& start, double time_scale)
      : system_(system),
        n_(system.coordinate_count()),
        T_(time_scale),
        s_(system.coordinate_scale()),
        state_(start),
        mass_(system.tangent_pattern().matrix()),
        force_(n_),
        constraints_(system.constraint_count()),
        right_side_(n_ + system.constraint_count()) {}

  int size() const { return 2 * n_; }
  /// The status of the last evaluation.
  StepStatus outcome() const { return outcome_; }
  /// The state of the last evaluation, with its acceleration.
  const State& state() const { return state_; }

  /// Sets the memory of forces for the following steps.
  void remember(const Vector& memory) {
    if (memory != state_.memory) outcome_ = StepStatus::not_converged;
    state_.memory = memory;
  }
  void write(const State& state, VectorRef y) const {
    y.head(n_) = state.q.cwiseQuotient(s_);
    y.tail(n_) = T_ * state.v.cwiseQuotient(s_);
  }

  [[nodiscard]] bool evaluate(double t, const ConstVectorRef& y) {
    const bool known = outcome_ == StepStatus::converged && t == state_.t && y == last_;
    if (known) return true;
    outcome_ = StepStatus::not_converged;
    if (!y.allFinite()) return false;
    last_ = y;
    state_.t = t;
    state_.q = s_.cwiseProduct(y.head(n_));
    state_.v = s_.cwiseProduct(y.tail(n_)) / T_;
    outcome_ = accelerate();
    return outcome_ == StepStatus::converged;
  }

  void derivative(VectorRef rate) const {
    rate.head(n_) = state_.v.cwiseQuotient(s_);
    rate.tail(n_) = T_ * state_.a.cwiseQuotient(s_);
  }

 private:
  StepStatus accelerate() {
    if (!system_.admissible(state_)) return StepStatus::inadmissible;
    state_.a.setZero(n_);
    state_.lambda.setZero(constraints_.size());
    system_.residual(state_, force_, constraints_);
    right_side_ << -force_, -system_.constraint_curvature(state_);
    if (!right_side_.allFinite()) return StepStatus::not_converged;
    system_.tangent(state_, {.mass = 1}, mass_);
    if (!mass_.coeffs().allFinite()) return StepStatus::not_converged;
    if (!solver_.factorise(mass_)) return StepStatus::singular_matrix;
    const Vector solution = solver_.solve(right_side_);
    state_.a = solution.head(n_);
    state_.lambda = solution.tail(constraints_.size());
    return solution.allFinite() ? StepStatus::converged : StepStatus::not_converged;
  }

  const SecondOrderSystem& system_;
  int n_;
  double T_;
  Vector s_;
  State state_;
  Vector last_;
  StepStatus outcome_ = StepStatus::not_converged;
  Eigen::SparseMatrix<double> mass_;
  KktSolver solver_;
  Vector force_;
  Vector constraints_;
  Vector right_side_;
};

}  // namespace

struct ExplicitIntegrator::Implementation {
  struct ArkodeMemory;
  struct DeleteMemory {
    void operator()(ArkodeMemory* memory) const {
      void* pointer = memory;
      ERKStepFree(&pointer);
    }
  };

  Implementation(const ExplicitRungeKutta& options, const SecondOrderSystem& owner, State start)
      : settings(options),
        system(&owner),
        state(std::move(start)),
        equations(owner, state, options.time_scale) {
    context.reset(sundials::new_context());
    y.reset(sundials::owned(N_VNew_Serial(equations.size(), context.get())));
    equations.write(state, sundials::map(y.get()));
    memory.reset(static_cast<ArkodeMemory*>(
        sundials::owned(ERKStepCreate(derivative, state.t, y.get(), context.get()))));
    void* arkode = memory.get();
    ERKStepSetErrHandlerFn(arkode, sundials::ignore_message, nullptr);
    sundials::check(ERKStepSetUserData(arkode, this));
    if (settings.tolerance > 0) {
      sundials::check(ERKStepSetTableNum(arkode, ARKODE_DORMAND_PRINCE_7_4_5));
      sundials::check(ERKStepSStolerances(arkode, settings.tolerance, settings.tolerance));
    } else {
      set_classical_table();
    }
  }

  void set_classical_table() {
    std::array<double, 4> c{0, 0.5, 0.5, 1};
    std::array<double, 16> A{0, 0, 0, 0, 0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, 1, 0};
    std::array<double, 4> b{1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    const ARKodeButcherTable table =
        sundials::owned(ARKodeButcherTable_Create(4, 4, 0, c.data(), A.data(), b.data(), nullptr));
    const int flag = ERKStepSetTable(memory.get(), table);
    ARKodeButcherTable_Free(table);
    sundials::check(flag);
  }

  static int derivative(double t, N_Vector unknowns, N_Vector rate, void* data) {
    Implementation& self = *static_cast<Implementation*>(data);
    return self.guard.run([&] {
      if (!self.equations.evaluate(t, sundials::map(unknowns))) return false;
      self.equations.derivative(sundials::map(rate));
      return true;
    });
  }

  StepReport advance(double step) {
    StepReport report{.status = StepStatus::inadmissible, .next_step = step};
    const double end = state.t + step;
    if (!(step > 0) || !std::isfinite(end)) return report;
    trial = state;
    // If a table ends with c = 1, as the classical one, ARKODE 5.4 uses its last stage for the first stage of
    // the next step, though it belongs to other q and v. That costs an order; a restart discards the stage.
    if (std::exchange(must_restart, true) || is_fixed()) restart(trial);
    int failures = 0;  // in a row
    for (int i = 0; i < settings.max_steps; ++i) {
      const double rest = end - trial.t;
      const double longest = std::ldexp(std::min(system->step_limit(trial), rest), -failures);
      if (!(longest > shortest_step * std::abs(end))) {
        if (failures == 0) report.status = StepStatus::inadmissible;
        return report;
      }
      report.status = attempt(longest < rest ? trial.t + longest : end);
      if (report.status != StepStatus::converged) {
        ++report.rejected;
        if (++failures > settings.max_halvings) return report;
        restart(trial);
        continue;
      }
      failures = 0;
      if (trial.t >= end || is_fixed()) {
        report.step = trial.t - state.t;
        if (!is_fixed()) report.local_error = local_error();
        std::swap(state, trial);
        state.memory = system->committed(state);
        must_restart = state.memory != trial.memory;
        return report;
      }
    }
    report.status = StepStatus::not_converged;
    return report;
  }

  bool is_fixed() const { return settings.tolerance == 0; }

  void restart(const State& from) {
    equations.remember(from.memory);
    equations.write(from, sundials::map(y.get()));
    sundials::check(ERKStepReset(memory.get(), from.t, y.get()));
  }

  /// One step of ARKODE from the trial state to `stop` or, under error control, to an earlier time; moves the
  /// trial state.
  StepStatus attempt(double stop) {
    if (is_fixed())
      sundials::check(ERKStepSetFixedStep(memory.get(), stop - trial.t));
    else
      sundials::check(ERKStepSetStopTime(memory.get(), stop));
    double t = trial.t;
    const int flag = ERKStepEvolve(memory.get(), stop, y.get(), &t, ARK_ONE_STEP);
    guard.rethrow();
    if (flag == ARK_MEM_FAIL) throw std::bad_alloc();
    const bool evaluated = equations.outcome() == StepStatus::converged;
    if (flag < 0) return evaluated ? StepStatus::not_converged : equations.outcome();
    if (is_fixed()) t = stop;
    if (!equations.evaluate(t, sundials::map(y.get()))) return equations.outcome();
    trial = equations.state();
    return StepStatus::converged;
  }

  /// Local error of the last step: the largest estimate in units of the tolerance's own scale.
  double local_error() {
    const sundials::Owner<_generic_N_Vector> estimate(sundials::owned(N_VClone(y.get())));
    sundials::check(ERKStepGetEstLocalErrors(memory.get(), estimate.get()));
    const auto scale = sundials::map(y.get()).cwiseAbs().array() + 1;
    return (sundials::map(estimate.get()).array() / scale).abs().maxCoeff();
  }

  ExplicitRungeKutta settings;
  const SecondOrderSystem* system;
  State state;
  State trial;  ///< after a step: the state before it, until it is taken out
  FirstOrderEquations equations;
  bool must_restart = true;
  sundials::Guard guard;
  sundials::Owner<_SUNContext> context;
  sundials::Owner<_generic_N_Vector> y;
  std::unique_ptr<ArkodeMemory, DeleteMemory> memory;
};

ExplicitIntegrator::ExplicitIntegrator(ExplicitRungeKutta settings, const SecondOrderSystem& system,
                                       State start) {
  require(settings.tolerance >= 0, runge_kutta, "tolerance ", settings.tolerance, " is negative");
  require(settings.time_scale > 0 && std::isfinite(settings.time_scale), runge_kutta, "time_scale ",
          settings.time_scale, " is not positive and finite");
  require(settings.max_halvings >= 0, runge_kutta, "max_halvings ", settings.max_halvings, " is negative");
  require(settings.max_steps > 0, runge_kutta, "max_steps ", settings.max_steps, " is not positive");
  require_size(runge_kutta, "q", start.q.size(), system.coordinate_count());
  require_size(runge_kutta, "v", start.v.size(), system.coordinate_count());
  require_size(runge_kutta, "lambda", start.lambda.size(), system.constraint_count());
  implementation_ = std::make_unique<Implementation>(settings, system, std::move(start));
}

ExplicitIntegrator::~ExplicitIntegrator() = default;
ExplicitIntegrator::ExplicitIntegrator(ExplicitIntegrator&&) noexcept = default;
ExplicitIntegrator& ExplicitIntegrator::operator=(ExplicitIntegrator&&) noexcept = default;

void ExplicitIntegrator::restore(State state, const IntegratorHistory&) {
  *this = ExplicitIntegrator(implementation_->settings, *implementation_->system, std::move(state));
}

StepReport ExplicitIntegrator::repeat(const State& before, const IntegratorHistory& history, double step) {
  restore(before, history);
  return advance(step);
}

const State& ExplicitIntegrator::state() const { return implementation_->state; }

StepReport ExplicitIntegrator::advance(double step) { return implementation_->advance(step); }

State ExplicitIntegrator::take_before() { return std::move(implementation_->trial); }

}  // namespace nurbeam
