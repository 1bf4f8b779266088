#pragma once
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"
#include "pipelines/model/model_snapshot.h"
#include "pipelines/results/paraview.h"
#include "pipelines/results/restart_file.h"
#include "pipelines/results/results.h"
#include "pipelines/results/run_extremes.h"
#include "pipelines/run/cad_output.h"
#include "pipelines/run/contact_records.h"
#include "pipelines/run/run_checks.h"

namespace nurbeam {

/// All that a run writes frame by frame: stored frames, CAD files, ParaView files, restart points.
class RunOutputs {
 public:
  /// With `from`, goes on after the frames that lie before that restart point. This and the others throw
  /// std::runtime_error (file and reason).
  RunOutputs(const CaseFile& case_file, const BuiltModel& built, const std::filesystem::path& directory,
             std::string inputs, const Checkpoint* from);

  /// Whether elements are to be handed over before their frame (write_ahead): where a frame of them is large
  /// and nothing asks for all at once.
  bool takes_elements_ahead() const;
  /// Writes elements of a beam, in the model's own coordinates, of the frame at that time, which is written
  /// next.
  void write_ahead(double time, int beam, std::vector<ElementRecord>& local);
  /// Shows each frame that is written, in world coordinates.
  void show_frames_to(std::function<void(const Snapshot&)> look) { shown_to_ = std::move(look); }
  /// Writes one frame, in the model's own coordinates.
  void write(Snapshot local);
  /// Writes a row of histories of a moment between two frames, of contents_between_frames, in the model's own
  /// coordinates. Of the time of a frame there is its own row.
  void write_between(Snapshot local);
  /// Looks at a moment between two frames, in the model's own coordinates: its extremes count.
  void look_between(Snapshot local);
  /// Writes a frame that shows a shape, in the model's own coordinates: no extreme counts.
  void write_shape(Snapshot local);
  /// Writes frames as a ParaView series NAME.pvd.
  void write_series(const std::string& name, const std::vector<Snapshot>& local);
  /// Whether the last restart point is old enough for another.
  bool checkpoint_due() const;
  /// Puts all frames so far, and the point, on the disk: at once where it is due, else, at the end of a run,
  /// with finish().
  void write(Checkpoint point);
  void finish();
  std::size_t frame_count() const { return results_.frame_count(); }
  /// After finish(): the frames of results.nc, where they still are in memory, and once.
  std::optional<StoredResults> all_frames() { return results_.all_frames(); }
  /// What could not be written into a CAD file; the run goes on.
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }
  const FrameChecks& checks() const { return checks_; }
  std::vector<CollectorOutcome> collectors() const { return contacts_.outcomes(); }
  const std::vector<RunExtreme>& extremes() const { return extremes_.list(); }
  /// Wall time spent here [s].
  double seconds() const { return seconds_; }

 private:
  using Clock = std::chrono::steady_clock;
  template <class Work>
  void timed(Work work);
  void look_at(const Snapshot& frame);
  void put(Checkpoint point);

  const CaseFile& case_;
  const BuiltModel& built_;
  std::filesystem::path directory_;
  std::string inputs_, model_;
  ResultsWriter results_;
  CadOutput cad_;
  std::optional<ParaviewSeries> paraview_;
  Clock::time_point next_restart_;        // before which no restart point is due
  std::optional<Checkpoint> last_point_;  // for finish()
  double seconds_ = 0;
  std::vector<Diagnostic> diagnostics_;
  SnapshotNames names_;
  FrameChecks checks_;
  RunExtremes extremes_;
  ContactRecords contacts_;
  std::function<void(const Snapshot&)> shown_to_;
};

}  // namespace nurbeam
