#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/mesh/mesh_plan.h"
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "solver/steps/integrator.h"

namespace nurbeam {

/// A load that has another value than the case has it.
struct ChangedLoad {
  int number = 0;  ///< among the loads of the case
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

/// A moment between two steps of a run, with all that the run needs to go on from there as if it had not been
/// interrupted, in the model's own coordinates.
struct Checkpoint {
  std::string inputs;                      ///< digest of the case and its files: a checkpoint belongs to them
  std::size_t snapshots = 0;               ///< taken before it
  std::string model;                       ///< digest of what makes the model: it goes on in no other
  std::vector<ChangedLoad> changed_loads;  ///< since the run began
  MeshPlan plan;
  State state;
  IntegratorHistory history;
  double next_step = 0;                                ///< what error control would take [s]
  double last_step = 0;                                ///< [s]
  double transient = 0;                                ///< of Run [s]
  bool restarted = false;                              ///< by an event, and no step since
  double dissipated = 0, input = 0, start_energy = 0;  ///< [J]
  std::vector<double> connector_lengths;               ///< free ones, as the run has found them [m]
  long iterations_in_snapshots = 0;
  std::vector<StepRecord> steps;  ///< since the last snapshot
  SimulationReport report;        ///< so far
  /// What was said of files written before it, which is said once: of each the file and the warning.
  std::vector<std::string> said_of_files;
};

}  // namespace nurbeam
