#include "pipelines/verification/verify_run.h"

#include <stdexcept>

#include "pipelines/diagnostics/simulation_text.h"
#include "pipelines/verification/noted.h"

namespace nurbeam::verification {

RunRecord run_model(const BeamModel& model, const std::vector<double>& times, double step,
                    const decltype(SimulationOptions::integrator)& integrator,
                    const std::vector<ProbePlace>& probes) {
  RunRecord record;
  SimulationOptions options;
  options.end_time = times.back();
  options.step = step;
  options.output_times = times;
  options.integrator = integrator;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) { record.frames.push_back(frame); };
  record.report = simulate(noted(model, options), probes, at_problem_level(options), observer);
  if (record.report.status != SimulationStatus::done)
    throw std::runtime_error(outcome_text(record.report, model));
  keep_numbers(record.frames, record.report);
  return record;
}

RunRecord run_model(const BeamModel& model, const std::vector<double>& times, double step,
                    double rho_infinity, const std::vector<ProbePlace>& probes) {
  return run_model(model, times, step, GeneralizedAlpha{.rho_infinity = rho_infinity}, probes);
}

std::vector<double> even_times(double end, long count) {
  std::vector<double> times;
  for (long i = 0; i <= count; ++i)
    times.push_back(end * static_cast<double>(i) / static_cast<double>(count));
  return times;
}

}  // namespace nurbeam::verification
