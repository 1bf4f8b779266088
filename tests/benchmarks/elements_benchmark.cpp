// What does one element cost, and one pass over a mesh?
#include <benchmark/benchmark.h>

#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "pipelines/bench/bent_element.h"
#include "pipelines/verification/verify_examples.h"

namespace nurbeam {
namespace {

template <int D>
void element(benchmark::State& timing, Ends ends, bool tangent) {
  const ReferenceCurve curve({line_cubic({0, 0, 0}, {1, 0, 0})}, D);
  const BeamProperties properties = verification::round_bar(0.01, 7200, 20e6);
  const BeamElement<D> element(curve, properties, {.segment = 0}, 0, 0.1, ends);
  const ElementState<D> x = bent_element<ElementLayout<D>, ElementState<D>>(0.1);
  const auto load = BeamElement<D>::Vector::Constant(1).eval();
  for (auto _ : timing)
    if (tangent)
      benchmark::DoNotOptimize(element.tangent(x, load, {.mass = 1, .damping = 1, .stiffness = 1}));
    else
      benchmark::DoNotOptimize(element.force(x, load));
}

void in_plane(benchmark::State& timing, Ends ends, bool tangent) { element<2>(timing, ends, tangent); }
BENCHMARK_CAPTURE(in_plane, fixed_force, Ends::fixed, false);
BENCHMARK_CAPTURE(in_plane, fixed_tangent, Ends::fixed, true);
BENCHMARK_CAPTURE(in_plane, moving_force, Ends::moving, false);
BENCHMARK_CAPTURE(in_plane, moving_tangent, Ends::moving, true);

void in_space(benchmark::State& timing, Ends ends, bool tangent) { element<3>(timing, ends, tangent); }
BENCHMARK_CAPTURE(in_space, fixed_force, Ends::fixed, false);
BENCHMARK_CAPTURE(in_space, fixed_tangent, Ends::fixed, true);
BENCHMARK_CAPTURE(in_space, moving_force, Ends::moving, false);
BENCHMARK_CAPTURE(in_space, moving_tangent, Ends::moving, true);

void residual_pass(benchmark::State& timing) {
  const BeamSystem system(verification::falling_beam(static_cast<int>(timing.range(0))));
  const State state = drawn_state(system);
  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  for (auto _ : timing) {
    system.residual(state, dynamics, constraints);
    benchmark::DoNotOptimize(dynamics.data());
  }
  timing.SetComplexityN(timing.range(0));
}
BENCHMARK(residual_pass)->RangeMultiplier(10)->Range(10, 10000)->Complexity();

void tangent_pass(benchmark::State& timing) {
  const BeamSystem system(verification::falling_beam(static_cast<int>(timing.range(0))));
  const State state = drawn_state(system);
  Eigen::SparseMatrix<double> kkt = system.tangent_pattern().matrix();
  for (auto _ : timing) {
    system.tangent(state, {.mass = 1, .damping = 1, .stiffness = 1}, kkt);
    benchmark::DoNotOptimize(kkt.valuePtr());
  }
  timing.SetComplexityN(timing.range(0));
}
BENCHMARK(tangent_pass)->RangeMultiplier(10)->Range(10, 10000)->Complexity();

}  // namespace
}  // namespace nurbeam
