// What does a step cost, with its factorisations; and a whole run with its splits and merges?
#include <benchmark/benchmark.h>

#include <numbers>

#include "fem/motion/run/simulation.h"
#include "fem/system/initial_state.h"
#include "pipelines/verification/verify_examples.h"
#include "solver/algebra/kkt_solver.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {
namespace {

void factorisation(benchmark::State& timing) {
  const BeamSystem system(verification::falling_beam(static_cast<int>(timing.range(0))));
  const State state = drawn_state(system);
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {.mass = 1, .stiffness = 1e-8});
  KktSolver solver;
  for (auto _ : timing) benchmark::DoNotOptimize(solver.factorise(kkt));
  timing.SetComplexityN(timing.range(0));
}
BENCHMARK(factorisation)->RangeMultiplier(10)->Range(10, 10000)->Complexity();

/// Example 1 of Ding & Ouyang 2022 over its first 50 ms: 500 steps, with the mesh's changes.
void falling_beam(benchmark::State& timing) {
  const BeamModel model = verification::falling_beam(static_cast<int>(timing.range(0)));
  SimulationOptions options;
  options.end_time = 0.05;
  options.step = 1e-4;
  for (auto _ : timing) {
    const SimulationReport report = simulate(model, {}, options, {});
    if (report.status != SimulationStatus::done) timing.SkipWithError("the run did not end");
    timing.counters["steps"] = static_cast<double>(report.steps);
  }
}
BENCHMARK(falling_beam)->Arg(10)->Arg(100)->Unit(benchmark::kMillisecond);

enum class Rod { without_torsion, with_torsion };

/// A round rod in space, clamped at its start, that falls; with `damping` [s], and a body that slides on it.
BeamModel rod_in_space(Rod rod, double damping, bool slider) {
  const Material rubber{.youngs_modulus = 20e6, .density = 7200, .damping = damping};
  BeamProperties properties(Section::round(0.01), rubber);
  if (rod == Rod::with_torsion) {
    const double EI = properties.bending_stiffness, spin = rubber.density * std::numbers::pi * 1e-8 / 2;
    properties.sections = SectionStiffness{EI, EI, 0, EI / 1.3, spin};
  }
  ModelBuilder builder(3, {0, -9.81, 1});
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {1, 0, 0})}, 3), properties, {40});
  builder.clamp(0, 0);
  if (slider) builder.slide(builder.add_body("body", 0.8), 0, 0.1);
  return builder.build();
}

/// What a step costs in space, with torsion and without; of moving elements there are two at most.
void step_in_space(benchmark::State& timing, Rod rod, double damping, bool slider) {
  const BeamSystem system(rod_in_space(rod, damping, slider));
  State start = drawn_state(system);
  if (make_accelerations_consistent(system, start) != ConsistencyStatus::done)
    timing.SkipWithError("no accelerations");
  GeneralizedAlphaIntegrator integrator({}, system, start);
  const IntegratorHistory history = integrator.history();
  double iterations = 0;
  for (auto _ : timing) {
    if (integrator.state().t > 0.02) integrator.restore(start, history);
    const StepReport report = integrator.advance(2e-4);
    if (report.status != StepStatus::converged) timing.SkipWithError("a step failed");
    iterations += report.newton_iterations;
  }
  timing.counters["iterations"] = benchmark::Counter(iterations, benchmark::Counter::kAvgIterations);
}
BENCHMARK_CAPTURE(step_in_space, plain, Rod::without_torsion, 0, false);
BENCHMARK_CAPTURE(step_in_space, torsion, Rod::with_torsion, 0, false);
BENCHMARK_CAPTURE(step_in_space, damped_plain, Rod::without_torsion, 1e-4, false);
BENCHMARK_CAPTURE(step_in_space, damped_torsion, Rod::with_torsion, 1e-4, false);
BENCHMARK_CAPTURE(step_in_space, sliding_plain, Rod::without_torsion, 0, true);
BENCHMARK_CAPTURE(step_in_space, sliding_torsion, Rod::with_torsion, 0, true);
BENCHMARK_CAPTURE(step_in_space, damped_sliding_plain, Rod::without_torsion, 1e-4, true);
BENCHMARK_CAPTURE(step_in_space, damped_sliding_torsion, Rod::with_torsion, 1e-4, true);

void hanging_cable(benchmark::State& timing) {
  const BeamModel model = verification::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                                 verification::round_bar(0.001, 7200, 20e6),
                                                 static_cast<int>(timing.range(0)), {{0, false}, {1, false}});
  const BeamSystem system(model);
  for (auto _ : timing) {
    State state = drawn_state(system);
    const StaticReport report = find_static_equilibrium({}, system, state);
    if (report.status != StaticStatus::converged) timing.SkipWithError("no equilibrium");
    timing.counters["iterations"] = static_cast<double>(report.newton_iterations);
  }
}
BENCHMARK(hanging_cable)->Arg(20)->Arg(100)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace nurbeam
