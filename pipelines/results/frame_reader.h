#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "pipelines/results/frame_layout.h"

namespace nurbeam {

/// What a FrameStore has written.
class FrameReader {
 public:
  /// Throws std::runtime_error (file and reason), DamagedError where the file's checksum is not its own.
  explicit FrameReader(const std::filesystem::path& file);

  const std::string& title() const { return title_; }
  const SnapshotNames& names() const { return names_; }
  const std::vector<double>& times() const { return times_; }
  StoredRows rows() const;
  /// Frames first, first + 1, ..., first + count - 1. Throws std::runtime_error (file and reason).
  std::vector<Snapshot> read(std::size_t first, std::size_t count) const;

 private:
  void check_counts(const std::filesystem::path& file) const;
  void read_scalars(std::size_t first, std::vector<Snapshot>& frames) const;
  void read_points(std::size_t first, std::vector<Snapshot>& frames) const;
  void read_forces(std::size_t first, std::vector<Snapshot>& frames) const;
  void read_turns(std::size_t first, std::vector<Snapshot>& frames) const;
  void read_elements(std::size_t first, std::vector<Snapshot>& frames) const;
  void read_nodes(std::size_t first, std::vector<Snapshot>& frames) const;
  void read_steps(std::size_t first, std::vector<Snapshot>& frames) const;

  NetcdfFile file_;
  std::string title_;
  SnapshotNames names_;
  std::vector<double> times_;
  std::vector<int> element_counts_, node_counts_, step_counts_;  // (time, beam), (time, beam), (time)
};

}  // namespace nurbeam
