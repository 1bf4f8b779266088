#pragma once
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "pipelines/results/mode_table.h"

namespace nurbeam::python {

/// The snapshots of a run in world coordinates, in memory, with what the run came to.
struct Recording {
  std::string title;
  SnapshotNames names;
  std::deque<Snapshot> frames;  ///< which stay where they are when more come
  std::optional<ModeTable> modes;
  /// Rows of histories, where they are not those of the frames: times, and the values of all columns row by
  /// row.
  std::vector<double> row_times, row_values;
};

/// One of them; it keeps the recording.
struct Frame {
  std::shared_ptr<const Recording> of;
  const Snapshot* snapshot;
};

}  // namespace nurbeam::python
