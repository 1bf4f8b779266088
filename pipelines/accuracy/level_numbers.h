#pragma once
#include <optional>
#include <string>
#include <vector>

#include "fem/motion/record/simulation_report.h"
#include "pipelines/results/history_columns.h"
#include "pipelines/results/run_extremes.h"

namespace nurbeam {

/// What one run of a case has come to, in numbers. Level k has 2^k as many elements as the case, and in
/// motion steps of a 2^k-th of the length; 0 is the case itself.
struct LevelNumbers {
  int level = 0;
  long elements = 0, steps = 0;
  std::optional<double> step;  ///< where it is fixed [s]
  double seconds = 0;          ///< wall time
  bool done = false;
  double end = 0;                  ///< time that it has reached [s]
  std::vector<double> times = {};  ///< of the frames [s]
  std::vector<std::vector<double>>
      rows;  ///< per frame its histories (history_columns); NaN where there is none
  std::vector<RunExtreme> extremes = {};
  std::vector<RunEvent> events = {};  ///< those of bodies
  std::vector<double> modes = {};     ///< frequencies [Hz], or factors of loads
};

/// Takes the numbers of a run while it goes on.
class LevelRecorder {
 public:
  explicit LevelRecorder(const SnapshotNames& names) : names_(names), columns_(history_columns(names)) {}

  /// A frame in world coordinates.
  void look_at(const Snapshot& frame);
  /// A moment between two frames, of which the extremes count.
  void look_between(const Snapshot& moment) { extremes_.look_at(moment, names_); }
  /// The numbers so far, with what the report has.
  LevelNumbers numbers(const SimulationReport& report) const;

 private:
  SnapshotNames names_;
  std::vector<HistoryColumn> columns_;
  RunExtremes extremes_;
  LevelNumbers numbers_;
};

}  // namespace nurbeam
