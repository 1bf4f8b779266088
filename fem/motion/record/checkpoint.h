#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "fem/mesh/mesh_plan.h"
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "solver/steps/integrator.h"

namespace nurbeam {

/// A load whose value differs from that in the case.
struct ChangedLoad {
  int number = 0;  ///< among the loads of the case
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
};

/// A checkpoint between two steps: all that a run needs to go on as if it had not been interrupted, in the
/// model's own coordinates.
struct Checkpoint {
  std::string inputs;         ///< digest of the case and its files: the checkpoint belongs to these alone
  std::size_t snapshots = 0;  ///< number of snapshots taken before the checkpoint
  std::string model;          ///< digest of the model's definition: the run goes on in no other model
  std::vector<ChangedLoad> changed_loads;  ///< loads changed since the run began
  MeshPlan plan;
  State state;
  IntegratorHistory history;
  double next_step = 0;                                ///< step length that error control would take [s]
  double last_step = 0;                                ///< [s]
  double transient = 0;                                ///< Run::transient [s]
  bool restarted = false;                              ///< restarted by an event, with no step since
  double dissipated = 0, input = 0, start_energy = 0;  ///< [J]
  std::vector<double> connector_lengths;  ///< free lengths of connectors, as the run has found them [m]
  long iterations_in_snapshots = 0;
  std::vector<StepRecord> steps;  ///< since the last snapshot
  SimulationReport report;        ///< so far
  std::vector<double> peaks;      ///< of the watch between snapshots (PeakWatch::numbers)
  std::vector<double> extremes;   ///< of the run: value, s, time and layer of each
  /// Warnings about files written before the checkpoint, so that each is told once: file and warning.
  std::vector<std::string> said_of_files;
};

}  // namespace nurbeam
