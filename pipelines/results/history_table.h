#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "pipelines/results/history_columns.h"

namespace nurbeam {

/// Rows of histories before a restart point: those before its time and, where one is due at it, the first of
/// that time. A run that was interrupted there has written one of its last frame behind it.
struct RowsBefore {
  double time;  ///< [s]
  bool at_it;   ///< whether a row is due at that time
};

/// The table histories.csv: a header that names each column with its unit, then one row per frame, and rows
/// between frames, in which what needs all elements is empty. Every row reaches the file before it is
/// returned from write().
class HistoryTable {
 public:
  /// Begins the table in `file`, which is overwritten. This and the others throw std::runtime_error (file and
  /// reason).
  HistoryTable(const std::filesystem::path& file, const SnapshotNames& names);
  void write(const Snapshot& frame);
  /// A row of contents_between_frames.
  void write_between(const Snapshot& moment);
  /// Takes over rows of a former table of the same columns.
  void take_over(const std::filesystem::path& former, const RowsBefore& rows);
  /// Time of the last row [s]; NaN without one.
  double last_time() const { return last_time_; }
  /// Puts all rows so far on the disk.
  void put_on_disk();
  void close();

 private:
  void add_number(double value);
  void write_row();
  void check_stream() const;

  std::filesystem::path file_;
  std::ofstream stream_;
  std::vector<HistoryColumn> columns_;
  std::string header_, row_;
  double last_time_;
};

/// All rows of a histories.csv that a run has left: times and values, NaN where there is none.
struct StoredHistories {
  std::vector<std::string> headings;  ///< all but that of the time
  std::vector<double> times;          ///< [s]
  std::vector<double> values;         ///< (times, headings), row by row
};
/// Throws std::runtime_error (file and reason).
StoredHistories read_histories(const std::filesystem::path& file);

}  // namespace nurbeam
