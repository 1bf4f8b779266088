// What does a step cost, with its factorisations; and a whole run with its splits and merges?
#include <benchmark/benchmark.h>

#include "fem/motion/simulation.h"
#include "fem/system/initial_state.h"
#include "pipelines/verification/verify_examples.h"
#include "solver/consistent.h"
#include "solver/generalized_alpha.h"
#include "solver/kkt_solver.h"
#include "solver/static_equilibrium.h"

namespace nurbeam {
namespace {

void factorisation(benchmark::State& timing) {
  const BeamSystem system(verification::falling_beam(static_cast<int>(timing.range(0))));
  const State state = drawn_state(system);
  Eigen::SparseMatrix<double> kkt = system.tangent_pattern();
  system.tangent(state, {.mass = 1, .stiffness = 1e-8}, kkt);
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
