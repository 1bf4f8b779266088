#pragma once
#include <string>
#include <vector>

#include "fem/mesh/mesh.h"
#include "fem/motion/frame.h"
#include "fem/motion/simulation_report.h"
#include "solver/generalized_alpha.h"

namespace nurbeam {

/// A moment between two steps of a run, with all that the run needs to go on from there as if it had not been
/// interrupted, in the model's own coordinates.
struct RestartPoint {
  std::string inputs;      ///< digest of the case and its files: a restart point belongs to them
  std::size_t frames = 0;  ///< stored before it
  MeshPlan plan;
  State state;
  GeneralizedAlphaIntegrator::History history;  ///< empty for the other integrators, which start afresh
  double next_step = 0;                         ///< what error control would take [s]
  double last_step = 0;                         ///< [s]
  double dissipated = 0, start_energy = 0;      ///< [J]
  long iterations_in_frames = 0;
  std::vector<StepRecord> steps;  ///< since the last frame
  SimulationReport report;        ///< so far
};

}  // namespace nurbeam
