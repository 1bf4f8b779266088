#include "solver/steps/radau_integrator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "solver/algebra/convergence.h"
#include "solver/algebra/finite.h"
#include "solver/steps/radau_method.h"
#include "solver/steps/stage_equations.h"
#include "solver/system/arguments.h"

namespace nurbeam {

namespace {

constexpr const char* radau = "Radau";
constexpr int stages = RadauMethod::stages;

void check(const Radau& settings) {
  require(settings.newton_tolerance > 0, radau, "newton_tolerance ", settings.newton_tolerance,
          " is not positive");
  require(settings.max_iterations > 0, radau, "max_iterations ", settings.max_iterations, " is not positive");
  require(settings.max_halvings >= 0, radau, "max_halvings ", settings.max_halvings, " is negative");
  require(settings.tolerance >= 0, radau, "tolerance ", settings.tolerance, " is negative");
}

/// Accelerations and multipliers of the stages of a step, and their polynomials beyond it.
struct KnownStages {
  double start = 0, step = 0;  ///< [s]; step 0: nothing is known
  std::array<Eigen::VectorXd, stages> a, lambda;

  bool reach(double t) const {
    constexpr double farthest = 5;  // part of the steps
    return step > 0 && std::abs(t - start) <= farthest * step;
  }
  void write(double t, State& to) const {
    const RadauMethod::Row weights = radau_method().weights((t - start) / step);
    to.a = weights[0] * a[0] + weights[1] * a[1] + weights[2] * a[2];
    to.lambda = weights[0] * lambda[0] + weights[1] * lambda[1] + weights[2] * lambda[2];
  }
};

}  // namespace

struct RadauIntegrator::Implementation {
  Implementation(const Radau& options, const SecondOrderSystem& owner, State start)
      : settings(options), system(&owner), state(std::move(start)), before(state), equations(owner, state) {
    at.fill(state);
    residuals.fill(Eigen::VectorXd(owner.coordinate_count() + owner.constraint_count()));
  }

  StepReport advance(double step, int max_halvings, double tolerance) {
    // Part of the step limit, as stages follow a motion farther than a single place does.
    constexpr double of_limit = 1.5;
    StepReport report{.status = StepStatus::inadmissible, .next_step = step};
    const double limit = of_limit * system->step_limit(state);
    if (!(step > 0) || !(limit > 0)) return report;
    double h = std::min(step, limit);
    for (int i = 0; i <= max_halvings && std::isfinite(h) && state.t + h > state.t; ++i) {
      report.status = attempt(h, report);
      double shorter = 0.5;
      if (report.status == StepStatus::converged) {
        keep_stages(h);
        report.local_error = local_error(h);
        const double ratio = tolerance == 0 ? 1 : change(report.local_error / tolerance);
        if (tolerance == 0 || report.local_error <= tolerance) {
          report.step = h;
          if (tolerance > 0) report.next_step = h * (report.rejected > 0 ? std::min(ratio, 1.0) : ratio);
          accept();
          return report;
        }
        report.status = StepStatus::inaccurate;
        // After an event fast oscillations fall more slowly than by the method's order.
        shorter = report.rejected > 0 ? std::min(ratio, shorter) : ratio;
      }
      ++report.rejected;
      h *= shorter;
    }
    return report;
  }

  /// Change of the step for a local error in units of the tolerance.
  static double change(double error) {
    constexpr double safety = 0.9, smallest = 0.2, largest = 4;
    return std::clamp(safety * std::pow(error, -0.25), smallest, largest);
  }

  StepStatus attempt(double h, StepReport& report) {
    if (!predict(h)) return StepStatus::not_converged;
    if (!all_admissible()) return StepStatus::inadmissible;
    if (!equations.linearise(at[1], h, settings.newton_tolerance)) return StepStatus::singular_matrix;
    Convergence convergence;
    for (int i = 0; i < settings.max_iterations; ++i) {
      ++report.newton_iterations;
      for (int k = 0; k < stages; ++k)
        system->residual(at[k], residuals[k].head(state.q.size()), residuals[k].tail(state.lambda.size()));
      report.residual_norm = equations.scale(residuals);
      if (!std::isfinite(report.residual_norm)) return StepStatus::not_converged;
      const double correction = equations.solve(residuals, corrections);
      if (!std::isfinite(correction)) return StepStatus::not_converged;
      correct();
      if (!all_admissible()) return StepStatus::inadmissible;
      if (convergence.reached(report.residual_norm, correction, settings.newton_tolerance))
        return StepStatus::converged;
    }
    return StepStatus::not_converged;
  }

  /// Predicts the stages. Accelerations and multipliers continue the known stages, else they stay as they
  /// are; positions and velocities follow by the method's formulas. Returns whether all is finite.
  bool predict(double h) {
    const RadauMethod& method = radau_method();
    for (int i = 0; i < stages; ++i) {
      at[i] = state;
      at[i].t = state.t + method.c[i] * h;
      if (known.reach(at[i].t)) known.write(at[i].t, at[i]);
    }
    bool is_finite = true;
    for (int i = 0; i < stages; ++i) {
      State& stage = at[i];
      stage.q += method.c[i] * h * state.v;
      for (int j = 0; j < stages; ++j) {
        stage.q += h * h * method.a_squared(i, j) * at[j].a;
        stage.v += h * method.a(i, j) * at[j].a;
      }
      is_finite = is_finite && all_finite(stage.q) && all_finite(stage.v) && all_finite(stage.lambda);
    }
    return is_finite;
  }

  void correct() {
    for (int i = 0; i < stages; ++i) {
      at[i].q += corrections[i].q;
      at[i].v += corrections[i].v;
      at[i].a += corrections[i].a;
      at[i].lambda += corrections[i].lambda;
    }
  }

  bool all_admissible() const {
    return std::all_of(
        at.begin(), at.end(), [&](const State& stage) { return system->admissible(stage); });
  }

  double local_error(double h) const {
    const RadauMethod& method = radau_method();
    Eigen::VectorXd of_q = method.gamma * state.v;
    for (int i = 0; i < stages; ++i) of_q += method.error[i] * at[i].v;
    return equations.filtered(h * of_q);
  }

  void keep_stages(double h) {
    known.start = state.t;
    known.step = h;
    for (int i = 0; i < stages; ++i) {
      known.a[i] = at[i].a;
      known.lambda[i] = at[i].lambda;
    }
  }

  void accept() {
    std::swap(before, state);
    for (State& stage : at) stage.memory = system->committed(stage);
    state = at[stages - 1];
  }

  Radau settings;
  const SecondOrderSystem* system;
  State state;
  State before;  ///< state before the last step, until it is taken out
  KnownStages known;

  // The attempt under way.
  StageEquations equations;
  std::array<State, stages> at;
  StageEquations::Residuals residuals;
  std::array<StageCorrection, stages> corrections;
};

RadauIntegrator::RadauIntegrator(Radau settings, const SecondOrderSystem& system, State start) {
  check(settings);
  require_sizes(radau, start, system);
  implementation_ = std::make_unique<Implementation>(settings, system, std::move(start));
}

RadauIntegrator::~RadauIntegrator() = default;
RadauIntegrator::RadauIntegrator(RadauIntegrator&&) noexcept = default;
RadauIntegrator& RadauIntegrator::operator=(RadauIntegrator&&) noexcept = default;

const State& RadauIntegrator::state() const { return implementation_->state; }

StepReport RadauIntegrator::advance(double step) {
  const Radau& settings = implementation_->settings;
  return implementation_->advance(step, settings.max_halvings, settings.tolerance);
}

State RadauIntegrator::take_before() { return std::move(implementation_->before); }

std::span<const State> RadauIntegrator::within() const {
  const auto& at = implementation_->at;
  const bool of_last_step = at[stages - 1].t == implementation_->state.t;
  return {at.data(), of_last_step ? stages - 1 : 0u};
}

IntegratorHistory RadauIntegrator::history() const {
  const KnownStages& known = implementation_->known;
  IntegratorHistory history{{known.start, known.step, implementation_->equations.mass_scale()}, {}, nullptr};
  if (known.step > 0)
    for (const auto* of : {&known.a, &known.lambda})
      history.vectors.insert(history.vectors.end(), of->begin(), of->end());
  return history;
}

void RadauIntegrator::restore(State state, const IntegratorHistory& history) {
  require_sizes(radau, state, *implementation_->system);
  require(history.numbers.size() == 3, radau, "the history is not one of this method");
  KnownStages known{.start = history.numbers[0], .step = history.numbers[1], .a = {}, .lambda = {}};
  require(history.vectors.size() == (known.step > 0 ? 2 * stages : 0), radau,
          "the history is not one of this method");
  for (std::size_t k = 0; k < history.vectors.size(); ++k) {
    const bool of_a = k < stages;
    const Eigen::VectorXd& vector = history.vectors[k];
    require_size(radau, "the history", vector.size(), of_a ? state.a.size() : state.lambda.size());
    (of_a ? known.a[k] : known.lambda[k - stages]) = vector;
  }
  implementation_->state = std::move(state);
  implementation_->known = std::move(known);
  implementation_->equations.scale_masses_by(history.numbers[2]);
}

StepReport RadauIntegrator::repeat(const State& before, const IntegratorHistory& history, double step) {
  // The stages of the step that is repeated are a better guess.
  KnownStages repeated = std::move(implementation_->known);
  restore(before, history);
  if (repeated.step > 0 && repeated.start == before.t) implementation_->known = std::move(repeated);
  return implementation_->advance(step, 0, 0);
}

}  // namespace nurbeam
