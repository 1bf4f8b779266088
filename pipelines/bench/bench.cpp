#include "pipelines/bench/bench.h"

#include <array>
#include <chrono>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <vector>

#include "cad_import/import_curves.h"
#include "fem/motion/run/simulation.h"
#include "pipelines/bench/bench_parts.h"
#include "pipelines/bench/bench_table.h"
#include "pipelines/bench/stopwatch.h"
#include "pipelines/papers/plot.h"
#include "pipelines/verification/verify_examples.h"

namespace nurbeam {

namespace {

// Table 1 of Ding & Ouyang 2022: motion and length control of ALE-RANCF, motion of ALE-ANCF [s].
struct PaperTime {
  int elements;
  double motion, length_control, ancf;
};
constexpr std::array<PaperTime, 5> paper_times{{{5, 59.9, 16.1, 34.6},
                                                {10, 97.1, 69.1, 58.3},
                                                {20, 169.2, 157.0, 103.1},
                                                {30, 292.4, 238.3, 192.4},
                                                {40, 478.0, 378.2, 325.0}}};

constexpr double end_time = 0.55;

struct BenchRun {
  SimulationReport report;
  double seconds = 0;
  Eigen::Vector3d end = Eigen::Vector3d::Zero();  // of the body
};

BenchRun run_example(int elements, double step, WeightRule weights, bool as_point = false) {
  BeamModel model = verification::falling_beam(elements);
  model.beams[0].weights = weights;
  model.riders[0].as_point = as_point;
  SimulationOptions options;
  options.step = step;
  options.end_time = end_time;
  options.output_times = {end_time};
  BenchRun run;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& last) { run.end = last.bodies[0].point.position; };
  const double start = processor_seconds();
  run.report = simulate(model, {}, options, observer);
  run.seconds = processor_seconds() - start;
  if (run.report.status != SimulationStatus::done) throw std::runtime_error("a run of Example 1 has failed");
  return run;
}

void bench_runs(std::ostream& out) {
  constexpr double step = 1e-4;
  const BenchRun reference = run_example(160, step / 4, WeightRule::material);
  std::vector<std::vector<std::string>> rows{{"elements", "steps", "iterations", "changes of the mesh",
                                              "time [s]", "of it changes", "us/step", "error [mm]",
                                              "as point [s]", "error [mm]", "ALE-ANCF [s]", "RANCF / ANCF",
                                              "paper [s]", "changes", "RANCF / ANCF"}};
  for (const PaperTime& paper : paper_times) {
    const BenchRun run = run_example(paper.elements, step, WeightRule::material),
                   point = run_example(paper.elements, step, WeightRule::material, true),
                   ancf = run_example(paper.elements, step, WeightRule::ones);
    const auto error = [&](const BenchRun& of) { return few_digits(1e3 * (of.end - reference.end).norm()); };
    const auto per_step = [](const BenchRun& of) {
      return of.seconds / static_cast<double>(of.report.steps);
    };
    rows.push_back({std::to_string(paper.elements), std::to_string(run.report.steps),
                    std::to_string(run.report.newton_iterations), std::to_string(run.report.events.size()),
                    few_digits(run.seconds), few_digits(run.report.length_control_seconds),
                    few_digits(1e6 * per_step(run)), error(run), few_digits(point.seconds), error(point),
                    few_digits(ancf.seconds), few_digits(per_step(run) / per_step(ancf)),
                    few_digits(paper.motion, 4), few_digits(paper.length_control, 4),
                    few_digits(paper.motion / paper.ancf)});
  }
  print_table(
      out,
      "Example 1 of Ding & Ouyang 2022 to 0.55 s, steps of 0.1 ms; error: of the body's place at the end "
      "against 160 elements and a quarter of the step",
      rows);
}

void bench_import(const std::filesystem::path& file, std::ostream& out) {
  const auto start = std::chrono::steady_clock::now();
  const ImportReport report = import_curves(file);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  for (const Diagnostic& diagnostic : report.diagnostics)
    if (diagnostic.severity == Severity::error) throw std::invalid_argument(diagnostic.message);
  out << "Reading " << file.string() << ": " << report.curves.size() << " curves in "
      << few_digits(taken.count()) << " s (by the clock)\n\n";
}

void draw(const std::vector<SystemCost>& costs, std::ostream& out) {
  Plot plot;
  plot.title = "Cost by number of elements";
  plot.x_label = "elements";
  plot.y_label = "time per element [us]";
  plot.log_x = plot.log_y = true;
  const auto add = [&](const std::string& label, double SystemCost::*part) {
    PlotLine line;
    line.label = label;
    line.style = PlotLine::Style::line_and_marks;
    for (const SystemCost& cost : costs) {
      line.x.push_back(cost.elements);
      line.y.push_back(1e6 * cost.*part / cost.elements);
    }
    plot.lines.push_back(line);
  };
  add("step", &SystemCost::step);
  add("tangent", &SystemCost::tangent);
  add("factorisation", &SystemCost::factorisation);
  add("solution", &SystemCost::solution);
  add("residual", &SystemCost::residual);
  out << svg(plot);
}

}  // namespace

void bench(const BenchOptions& options, std::ostream& out) {
  std::ofstream plot;
  if (options.plot) plot.open(*options.plot);
  const auto need_plot = [&] {
    if (!plot) throw std::runtime_error(options.plot->string() + ": cannot be written");
  };
  need_plot();
  if (options.cad) bench_import(*options.cad, out);
  bench_elements(out);
  const std::vector<SystemCost> costs = bench_systems(options.largest, out);
  bench_runs(out);
  if (!options.plot) return;
  draw(costs, plot);
  plot.close();
  need_plot();
}

}  // namespace nurbeam
