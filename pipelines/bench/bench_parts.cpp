#include "pipelines/bench/bench_parts.h"

#include <malloc.h>

#include <limits>
#include <optional>

#include "fem/motion/run/simulation.h"
#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "pipelines/bench/bench_table.h"
#include "pipelines/bench/bent_element.h"
#include "pipelines/bench/stopwatch.h"
#include "pipelines/verification/verify_examples.h"
#include "solver/algebra/kkt_solver.h"
#include "solver/algebra/side_by_side.h"
#include "solver/steps/generalized_alpha.h"

namespace nurbeam {

namespace {

constexpr TangentWeights all_parts{.mass = 1, .damping = 1, .stiffness = 1};

// Force and tangent [us] with fixed and with moving ends.
template <class Cost>
std::vector<std::string> element_row(const std::string& name, const Cost& cost) {
  const auto [fixed_force, fixed_tangent] = cost(Ends::fixed);
  const auto [moving_force, moving_tangent] = cost(Ends::moving);
  std::vector<std::string> row{name};
  for (const double seconds : {fixed_force, fixed_tangent, moving_force, moving_tangent})
    row.push_back(few_digits(1e6 * seconds));
  row.push_back(few_digits((moving_force + moving_tangent) / (fixed_force + fixed_tangent), 2));
  return row;
}

template <int D>
std::pair<double, double> axis_cost(Ends ends, double damping) {
  const ReferenceCurve curve({line_cubic({0, 0, 0}, {1, 0, 0})}, D);
  BeamProperties properties = verification::round_bar(0.01, 7200, 20e6);
  properties.damping = damping;
  const BeamElement<D> element(curve, properties, Chart{0, {}}, 0, 0.1, ends);
  const auto x = bent_element<ElementLayout<D>, ElementState<D>>(0.1);
  const auto load = BeamElement<D>::Vector::Constant(1).eval();
  volatile double keep = 0;
  return {seconds_of([&] { keep = element.force(x, load)[0]; }),
          seconds_of([&] { keep = element.tangent(x, load, all_parts)(0, 0); })};
}

/// A body that meets an element in every ten steps of 0.1 ms or less.
constexpr double steps_per_element = 10;

double step_for(int elements) { return 1e-3 / std::max(10, elements); }

BeamModel beam_with_slider(int elements) {
  BeamModel model = verification::falling_beam(elements);
  model.riders[0].s = 0.5 + 0.25 / elements;
  model.riders[0].speed = 1.0 / elements / (steps_per_element * step_for(elements));
  return model;
}

double allocated() {
  const auto heap = mallinfo2();
  return static_cast<double>(heap.uordblks + heap.hblkhd);
}

double cost_of_event(const BeamModel& model, double step) {
  SimulationOptions options;
  options.step = step;
  options.end_time = 4 * steps_per_element * step;
  const SimulationReport report = simulate(model, {}, options, {});
  if (report.events.empty()) return std::numeric_limits<double>::quiet_NaN();
  return report.length_control_seconds / static_cast<double>(report.events.size());
}

SystemCost cost_of_system(int elements) {
  const BeamModel model = beam_with_slider(elements);
  const double step = step_for(elements);
  SystemCost cost{};
  cost.elements = elements;
  std::optional<ThreadLimit> alone(1);
  const double before = allocated();
  const BeamSystem system(model);
  State state = drawn_state(system);
  start_moving(system, state);
  GeneralizedAlphaIntegrator integrator({}, system, state);
  [[maybe_unused]] const StepReport first = integrator.advance(step);
  cost.memory = allocated() - before;

  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  cost.residual = seconds_of([&] { system.residual(state, dynamics, constraints); });
  Eigen::SparseMatrix<double> kkt = system.tangent_pattern().matrix();
  const TangentWeights weights{.mass = 1, .damping = step / 2, .stiffness = step * step / 4};
  cost.tangent = seconds_of([&] { system.tangent(state, weights, kkt); });
  KktSolver solver;
  bool regular = solver.factorise(kkt, system.moving_unknowns());
  cost.factorisation =
      seconds_of([&] { regular = solver.factorise(kkt, system.moving_unknowns()) && regular; });
  Eigen::VectorXd x, rhs = Eigen::VectorXd::Ones(kkt.rows());
  cost.solution =
      regular ? seconds_of([&] { solver.solve(rhs, x); }) : std::numeric_limits<double>::quiet_NaN();
  const State start = integrator.state();
  const IntegratorHistory history = integrator.history();
  int taken = 0;
  const auto advance = [&] {
    if (++taken % 5 == 0) integrator.restore(start, history);
    [[maybe_unused]] const StepReport report = integrator.advance(step);
  };
  cost.step = seconds_of(advance);
  cost.event = cost_of_event(model, step);
  const double by_one = seconds_of<clock_seconds>(advance);
  alone.reset();
  cost.speed_up = by_one / seconds_of<clock_seconds>(advance);
  return cost;
}

}  // namespace

void bench_elements(std::ostream& out) {
  std::vector<std::vector<std::string>> rows{
      {"", "force", "tangent", "moving: force", "tangent", "moving / fixed"}};
  rows.push_back(element_row(
      "in the plane", [](Ends ends) { return axis_cost<2>(ends, 0); }));
  rows.push_back(element_row(
      "in the plane, damped", [](Ends ends) { return axis_cost<2>(ends, 1e-4); }));
  rows.push_back(element_row(
      "in space", [](Ends ends) { return axis_cost<3>(ends, 0); }));
  rows.push_back(element_row("in space, damped", [](Ends ends) { return axis_cost<3>(ends, 1e-4); }));
  print_table(out, "One element by itself [us]", rows);
}

std::vector<SystemCost> bench_systems(int largest, std::ostream& out) {
  std::vector<SystemCost> costs;
  std::vector<std::vector<std::string>> rows{{"elements", "residual", "tangent", "factorisation", "solution",
                                              "step", "change of the mesh [us]", "memory [kB]",
                                              "quicker on all cores"}};
  for (int elements = 10; elements <= largest; elements *= 10) {
    const SystemCost& cost = costs.emplace_back(cost_of_system(elements));
    std::vector<std::string> row{std::to_string(elements)};
    for (const double seconds : {cost.residual, cost.tangent, cost.factorisation, cost.solution, cost.step})
      row.push_back(few_digits(1e6 * seconds / elements));
    row.push_back(few_digits(1e6 * cost.event));
    row.push_back(few_digits(cost.memory / elements / 1000));
    row.push_back(few_digits(cost.speed_up));
    rows.push_back(row);
  }
  print_table(out, "A beam in the plane with a sliding body, per element [us]", rows);
  return costs;
}

}  // namespace nurbeam
