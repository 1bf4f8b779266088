#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "pipelines/simulation.h"

namespace nurbeam::testing {

struct RunRecord {
  SimulationReport report;
  std::vector<Frame> frames;

  const Eigen::Vector3d& body(std::size_t i) const { return frames.at(i).bodies.at(0).point.position; }
  double place(std::size_t i) const { return frames.at(i).bodies.at(0).s.value(); }
  const Eigen::Vector3d& probe(std::size_t i) const { return frames.at(i).probes.at(0).position; }
};

/// Runs a model with fixed steps and keeps the frames at the given times; a run that ends early fails the
/// test.
inline RunRecord run_model(const BeamModel& model, const std::vector<double>& times, double step,
                           const decltype(SimulationOptions::integrator)& integrator,
                           const std::vector<ProbePlace>& probes = {}) {
  RunRecord record;
  SimulationOptions options;
  options.end_time = times.back();
  options.step = step;
  options.output_times = times;
  options.integrator = integrator;
  SimulationObserver observer;
  observer.frame = [&](const Frame& frame) { record.frames.push_back(frame); };
  observer.progress = [](double) {};
  observer.interrupted = [] { return false; };
  record.report = simulate(model, probes, options, observer);
  EXPECT_EQ(record.report.status, SimulationStatus::done) << record.report.message;
  return record;
}

/// By generalized-alpha.
inline RunRecord run_model(const BeamModel& model, const std::vector<double>& times, double step,
                           double rho_infinity = 0.9, const std::vector<ProbePlace>& probes = {}) {
  return run_model(model, times, step, GeneralizedAlpha{.rho_infinity = rho_infinity}, probes);
}

/// Times from 0 to `end` in equal steps.
inline std::vector<double> even_times(double end, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(end * i / count);
  return times;
}

}  // namespace nurbeam::testing
