#pragma once
#include <vector>

#include "fem/motion/run/simulation.h"

namespace nurbeam::verification {

/// What a run did and the frames asked for.
struct RunRecord {
  SimulationReport report;
  std::vector<Snapshot> frames;

  const Eigen::Vector3d& body(std::size_t i) const { return frames.at(i).bodies.at(0).point.position; }
  double place(std::size_t i) const { return frames.at(i).bodies.at(0).s.value(); }
  const Eigen::Vector3d& probe(std::size_t i) const { return frames.at(i).probes.at(0).position; }
};

/// Runs a model with fixed steps [s] and keeps the frames at the given times [s]. Throws std::runtime_error
/// (the run's message) when the run ends early.
RunRecord run_model(const BeamModel& model, const std::vector<double>& times, double step,
                    const decltype(SimulationOptions::integrator)& integrator,
                    const std::vector<ProbePlace>& probes = {});
/// By generalized-alpha.
RunRecord run_model(const BeamModel& model, const std::vector<double>& times, double step,
                    double rho_infinity = 0.9, const std::vector<ProbePlace>& probes = {});

/// Times from 0 to `end` in equal steps, both included.
std::vector<double> even_times(double end, long count);

}  // namespace nurbeam::verification
