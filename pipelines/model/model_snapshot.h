#pragma once
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/record/snapshot.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

/// Names in the order of the vectors of a Snapshot.
SnapshotNames snapshot_names(const BuiltModel& built);

/// Puts an element that is in the model's own coordinates into those of the world.
void put_into_world(const ModelFrame& frame, ElementRecord& element);
/// A snapshot in the model's own coordinates in those of the world.
Snapshot to_world(const ModelFrame& frame, Snapshot local);

/// How a simulation ended, with directions in the world.
std::string outcome_in_world(const SimulationReport& report, const BuiltModel& built);

}  // namespace nurbeam
