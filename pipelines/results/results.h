#pragma once
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "cad_import/report/diagnostic.h"
#include "fem/motion/record/snapshot.h"
#include "pipelines/results/history_table.h"

namespace nurbeam {

/// Everything in a results directory, in memory.
struct StoredResults {
  std::string title;
  SnapshotNames names;
  std::vector<Snapshot> frames;
};

/// Writes histories.csv and results.nc (FrameStore) into a directory, frame by frame.
///
/// Until finish() the rows stand in histories.csv.part, complete to the last frame, and the frames in closed
/// chunks results.chunk0001.nc, results.chunk0002.nc, ..., each of them a whole file of the same layout: a
/// run that is killed at any moment leaves no half file under a final name and loses at most the frames since
/// the last close_chunk(). finish() merges the chunks.
class ResultsWriter {
 public:
  /// A chunk is closed with this many elements: it bounds the memory. A frame with as many had better be
  /// written some elements at a time.
  static constexpr std::size_t most_open_elements = 50'000;

  /// Throws std::runtime_error (file and reason) when a file cannot be written.
  ResultsWriter(std::filesystem::path directory, SnapshotNames names, std::string title);
  /// Goes on after the first `frames` frames that an earlier run, finished or killed, has left in the
  /// directory; later ones are dropped. Throws std::runtime_error (file and reason) when there are fewer.
  /// `rows`: those of histories.csv that are kept, where they are not those of the frames alone.
  static ResultsWriter resume(std::filesystem::path directory, SnapshotNames names, std::string title,
                              std::size_t frames, std::optional<RowsBefore> rows = {});
  ResultsWriter(ResultsWriter&&) noexcept;
  ~ResultsWriter();
  /// Throws std::invalid_argument unless the frame has as many probes, bodies and beams as there are names,
  /// and std::runtime_error (file and reason) when it cannot be written.
  void write(Snapshot frame);
  /// Writes a row of histories of a moment between two frames, of contents_between_frames; none where the
  /// last row is of that time.
  void write_between(const Snapshot& moment);
  /// Writes elements of the frame that is written next, which are handed over before it, as FrameStore has
  /// it.
  void write_ahead(std::span<const ElementRecord> elements);
  /// Puts all frames and rows so far on the disk. Throws std::runtime_error (file and reason).
  void close_chunk();
  /// Gives the files their names; nothing may be written after it. Throws std::runtime_error.
  void finish();
  std::size_t frame_count() const;
  /// After finish(): all that was written, where it still is in memory, and once.
  std::optional<StoredResults> all_frames();

 private:
  struct Implementation;
  explicit ResultsWriter(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// The frames of a results directory: those of results.nc, or of the chunks of a run that has not finished.
class StoredFrames {
 public:
  /// Throws std::runtime_error (file and reason) when there are none.
  explicit StoredFrames(const std::filesystem::path& directory);
  StoredFrames(StoredFrames&&) noexcept;
  ~StoredFrames();

  const std::string& title() const;
  const SnapshotNames& names() const;
  const std::vector<double>& times() const { return times_; }
  /// Frames first, first + 1, ..., first + count - 1 < times().size(). Throws std::runtime_error.
  std::vector<Snapshot> read(std::size_t first, std::size_t count) const;
  /// Index of the frame nearest to `time` [s]. Throws std::runtime_error (file, and the range) for a time
  /// outside the stored range.
  std::size_t nearest(double time) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
  std::vector<double> times_;
};

/// Throws std::runtime_error (file and reason).
StoredResults read_results(const std::filesystem::path& directory);

/// A warning of stored frames without a checksum, which are of an earlier version; nothing where they have
/// one.
std::optional<Diagnostic> missing_checksum(const std::filesystem::path& directory);

/// One beam of a stored frame, as read back.
struct StoredBeam {
  std::string name;
  std::vector<ElementRecord> elements;
};

/// The frame stored nearest to `time` and its time [s]. Throws std::runtime_error (file, reason, and for a
/// time outside the stored range the range).
std::pair<double, std::vector<StoredBeam>> read_stored_beams(const std::filesystem::path& directory,
                                                             double time);

}  // namespace nurbeam
