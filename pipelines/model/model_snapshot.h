#pragma once
#include "fem/motion/snapshot.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

/// Names in the order of the vectors of a Snapshot.
SnapshotNames snapshot_names(const BuiltModel& built);

/// A snapshot in the model's own coordinates in those of the world.
Snapshot to_world(const ModelFrame& frame, Snapshot local);

}  // namespace nurbeam
