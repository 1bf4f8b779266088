#pragma once
#include <string>
#include <vector>

#include "pipelines/model/build_model.h"
#include "pipelines/results/contact_statistics.h"
#include "pipelines/results/history_columns.h"
#include "pipelines/results/history_table.h"

namespace nurbeam {

/// The contact forces of a run's collectors, row by row of its histories.
class ContactRecords {
 public:
  explicit ContactRecords(const BuiltModel& built);

  /// A frame, or a moment of contents_between_frames, in the world's coordinates.
  void look_at(const Snapshot& moment);
  /// The rows of the run that this one goes on from.
  void take_over(const StoredHistories& rows);
  std::vector<CollectorOutcome> outcomes() const;

 private:
  struct Lifted {
    Eigen::Vector3d first = Eigen::Vector3d::Zero();
    Uplift found;
    std::vector<std::size_t> columns;  ///< of ux, uy, uz
  };
  struct Of {
    Collector collector;
    std::vector<std::size_t> place;  ///< columns of x, y, z of the head
    std::size_t force;               ///< column
    std::vector<ContactSample> series;
    std::vector<Lifted> uplift;
  };
  template <class Value>
  void add(double time, Value value);

  std::vector<HistoryColumn> columns_;
  std::vector<Of> of_;
};

/// Warnings of windows through which a collector has not come, or which begin or end too near to the start or
/// the end of the run for the filters.
std::vector<Diagnostic> contact_warnings(const std::filesystem::path& file,
                                         const std::vector<CollectorOutcome>& outcomes);

}  // namespace nurbeam
