#include "tests/support/ida/ida_integrator.h"

#include <ida/ida.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "solver/algebra/sundials_border.h"
#include "solver/system/arguments.h"
#include "tests/support/ida/stabilised_equations.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
/// Part of the local error that Newton's iteration may leave. With IDA's 0.33 this remainder passes for an
/// error of the formula in the estimates, and twice the steps are taken.
constexpr double newton_fraction = 0.01;

constexpr const char* ida = "IDA";

using Outcome = StabilisedEquations::Outcome;

}  // namespace

struct IdaIntegrator::Implementation {
  struct IdaMemory;
  struct DeleteMemory {
    void operator()(IdaMemory* memory) const {
      void* pointer = memory;
      IDAFree(&pointer);
    }
  };

  Implementation(const Ida& options, const SecondOrderSystem& owner, State start)
      : settings(options),
        system(&owner),
        state(std::move(start)),
        trial(state),
        equations(owner, state, options.time_scale) {
    const sunindextype size = equations.size();
    context.reset(sundials::new_context());
    y.reset(sundials::owned(N_VNew_Serial(size, context.get())));
    derivative.reset(sundials::owned(N_VNew_Serial(size, context.get())));
    rows.reset(sundials::owned(N_VNew_Serial(size, context.get())));
    matrix.reset(
        sundials::owned(SUNSparseMatrix(size, size, equations.entry_count(), CSC_MAT, context.get())));
    linear_solver.reset(sundials::owned(SUNLinSol_KLU(y.get(), matrix.get(), context.get())));
    memory.reset(static_cast<IdaMemory*>(sundials::owned(IDACreate(context.get()))));
    void* ida = memory.get();
    IDASetErrHandlerFn(ida, sundials::ignore_message, nullptr);
    equations.write(state, map(y), map(derivative));
    sundials::check(IDAInit(ida, residual, state.t, y.get(), derivative.get()));
    sundials::check(IDASetUserData(ida, this));
    sundials::check(IDAWFtolerances(ida, error_weights));
    sundials::check(IDASetLinearSolver(ida, linear_solver.get(), matrix.get()));
    sundials::check(IDASetJacFn(ida, jacobian));
    sundials::check(IDASetNonlinConvCoef(ida, newton_fraction));
    sundials::check(IDASetMaxOrd(ida, settings.max_order));
    map(rows).setZero();
    map(rows).head(equations.differential_count()).setOnes();
    sundials::check(IDASetId(ida, rows.get()));
    sundials::check(IDASetSuppressAlg(ida, SUNTRUE));
  }

  static Eigen::Map<Vector> map(const sundials::Owner<_generic_N_Vector>& vector) {
    return sundials::map(vector.get());
  }

  bool evaluate(double t, N_Vector unknowns, N_Vector rates, N_Vector result) {
    const Outcome outcome =
        equations.residual(t, sundials::map(unknowns), sundials::map(rates), sundials::map(result));
    if (outcome == Outcome::inadmissible) met_inadmissible = true;
    return outcome == Outcome::finite;
  }

  static int residual(double t, N_Vector unknowns, N_Vector rates, N_Vector result, void* data) {
    Implementation& self = *static_cast<Implementation*>(data);
    return self.guard.run([&] { return self.evaluate(t, unknowns, rates, result); });
  }

  static int jacobian(double t, double cj, N_Vector unknowns, N_Vector rates, N_Vector, SUNMatrix result,
                      void* data, N_Vector, N_Vector, N_Vector) {
    Implementation& self = *static_cast<Implementation*>(data);
    return self.guard.run([&] {
      return self.equations.jacobian(t, cj, sundials::map(unknowns), sundials::map(rates), result);
    });
  }

  /// Sets the error weights. An error of l or m is harmless if it moves w or x, over the step, by less than
  /// the tolerance.
  static int error_weights(N_Vector unknowns, N_Vector result, void* data) {
    constexpr double first_step = 1e-9;  // relative to the time scale, before there is a step
    const Implementation& self = *static_cast<Implementation*>(data);
    const auto y = sundials::map(unknowns);
    auto weights = sundials::map(result);
    const double tolerance = self.settings.tolerance;
    weights = (tolerance * (y.array().abs() + 1)).inverse();
    double h = 0;
    IDAGetCurrentStep(self.memory.get(), &h);
    const double relative = std::max(std::abs(h) / self.settings.time_scale, first_step);
    weights.tail(y.size() - self.equations.differential_count()) *= std::min(1.0, relative);
    return 0;
  }

  StepReport advance(double step) {
    StepReport report{.status = StepStatus::inadmissible, .next_step = step};
    const double end = state.t + step;
    if (!(step > 0) || !std::isfinite(end) || !(end - state.t > shortest_step * std::abs(end))) return report;
    const bool restart = std::exchange(must_restart, true);
    if (restart && !equations.regular(state)) {
      report.status = StepStatus::singular_matrix;
      return report;
    }
    if (restart) start();
    const Counts before = counts();
    report.status = integrate(end);
    const Counts after = counts();
    report.newton_iterations = static_cast<int>(after.newton_iterations - before.newton_iterations);
    report.rejected = static_cast<int>(after.rejected - before.rejected);
    if (report.status != StepStatus::converged) return report;
    report.step = step;
    report.local_error = local_error();
    report.residual_norm = map(rows).lpNorm<Eigen::Infinity>();
    std::swap(state, trial);
    must_restart = false;
    return report;
  }

  /// Puts IDA at the state, without history.
  void start() {
    equations.write(state, map(y), map(derivative));
    trial = state;
    sundials::check(IDAReInit(memory.get(), state.t, y.get(), derivative.get()));
    // A failed factorisation must not be refactorised.
    sundials::check(SUNLinSol_KLUReInit(linear_solver.get(), matrix.get(), SUNSparseMatrix_NNZ(matrix.get()),
                                        SUNKLU_REINIT_PARTIAL));
  }

  /// Steps to `end`; the state there is in `trial`, its residual in `rows`.
  StepStatus integrate(double end) {
    double t = state.t;
    trial = state;
    for (int i = 0; i < settings.max_steps; ++i) {
      const double limit = system->step_limit(trial);
      if (!(limit > shortest_step * std::abs(t))) return StepStatus::inadmissible;
      const double stop = next_stop(t, end, limit);
      if (IDASetStopTime(memory.get(), stop) != IDA_SUCCESS) return StepStatus::not_converged;
      met_inadmissible = false;
      const int flag = IDASolve(memory.get(), stop, &t, y.get(), derivative.get(), IDA_ONE_STEP);
      guard.rethrow();
      if (flag == IDA_MEM_FAIL) throw std::bad_alloc();
      if (flag < 0) return failure();
      if (t >= end) t = end;
      equations.read(t, map(y), map(derivative), trial);
      if (!system->admissible(trial)) return StepStatus::inadmissible;
      if (t < end) continue;
      return evaluate(t, y.get(), derivative.get(), rows.get()) ? StepStatus::converged : failure();
    }
    return StepStatus::not_converged;
  }

  /// Time by which IDA's next step must end. A stop is set only where it is needed, as each disturbs the
  /// choice of the order: when the step is longer than the limit, and when less than a step would remain
  /// after it; the step is then halved.
  double next_stop(double t, double end, double limit) const {
    double h = 0;  // remains zero before the first step
    IDAGetCurrentStep(memory.get(), &h);
    const double rest = end - t;
    const double reached = 64 * epsilon * (std::abs(t) + h);  // IDA cannot resolve a shorter time
    if (!(h > 0 && h <= limit)) {
      const double pieces = std::ceil(rest / limit);
      return pieces <= 1 ? end : t + rest / pieces;
    }
    return rest > h + reached && rest < 2 * h ? t + rest / 2 : end;
  }

  StepStatus failure() {
    if (met_inadmissible) return StepStatus::inadmissible;
    return equations.regular(trial) ? StepStatus::not_converged : StepStatus::singular_matrix;
  }

  struct Counts {
    long newton_iterations = 0;
    long rejected = 0;
  };
  Counts counts() const {
    long iterations = 0;
    long error_failures = 0;
    long solver_failures = 0;
    IDAGetNumNonlinSolvIters(memory.get(), &iterations);
    IDAGetNumErrTestFails(memory.get(), &error_failures);
    IDAGetNumStepSolveFails(memory.get(), &solver_failures);
    return {iterations, error_failures + solver_failures};
  }

  /// Local error of the last step: the largest estimate over q and v in units of the tolerance's own scale.
  double local_error() {
    const sundials::Owner<_generic_N_Vector> estimate(sundials::owned(N_VClone(y.get())));
    sundials::check(IDAGetEstLocalErrors(memory.get(), estimate.get()));
    const auto scale = map(y).cwiseAbs().array() + 1;
    return (map(estimate).array() / scale).head(equations.differential_count()).abs().maxCoeff();
  }

  Ida settings;
  const SecondOrderSystem* system;
  State state;
  State trial;
  StabilisedEquations equations;
  bool must_restart = true;
  bool met_inadmissible = false;  ///< in the present step
  sundials::Guard guard;
  sundials::Owner<_SUNContext> context;
  sundials::Owner<_generic_N_Vector> y;
  sundials::Owner<_generic_N_Vector> derivative;
  sundials::Owner<_generic_N_Vector> rows;
  sundials::Owner<_generic_SUNMatrix> matrix;
  sundials::Owner<_generic_SUNLinearSolver> linear_solver;
  std::unique_ptr<IdaMemory, DeleteMemory> memory;
};

IdaIntegrator::IdaIntegrator(Ida settings, const SecondOrderSystem& system, State start) {
  require(settings.tolerance > 0, ida, "tolerance ", settings.tolerance, " is not positive");
  require(settings.time_scale > 0 && std::isfinite(settings.time_scale), ida, "time_scale ",
          settings.time_scale, " is not positive and finite");
  require(settings.max_order >= 1 && settings.max_order <= 5, ida, "max_order ", settings.max_order,
          " is not in [1, 5]");
  require(settings.max_steps > 0, ida, "max_steps ", settings.max_steps, " is not positive");
  require_sizes(ida, start, system);
  implementation_ = std::make_unique<Implementation>(settings, system, std::move(start));
}

IdaIntegrator::~IdaIntegrator() = default;
IdaIntegrator::IdaIntegrator(IdaIntegrator&&) noexcept = default;
IdaIntegrator& IdaIntegrator::operator=(IdaIntegrator&&) noexcept = default;

void IdaIntegrator::restore(State state, const IntegratorHistory&) {
  *this = IdaIntegrator(implementation_->settings, *implementation_->system, std::move(state));
}

StepReport IdaIntegrator::repeat(const State& before, const IntegratorHistory& history, double step) {
  restore(before, history);
  return advance(step);
}

const State& IdaIntegrator::state() const { return implementation_->state; }

StepReport IdaIntegrator::advance(double step) { return implementation_->advance(step); }

State IdaIntegrator::take_before() { return std::move(implementation_->trial); }

long IdaIntegrator::internal_steps() const {
  long steps = 0;
  IDAGetNumSteps(implementation_->memory.get(), &steps);
  return steps;
}

}  // namespace nurbeam
