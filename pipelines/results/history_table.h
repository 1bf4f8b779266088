#pragma once
#include <filesystem>
#include <fstream>
#include <string>

#include "pipelines/results/history_columns.h"

namespace nurbeam {

/// The table histories.csv: a header that names each column with its unit, then one row per frame. Every row
/// reaches the file before write() returns.
class HistoryTable {
 public:
  /// Begins the table in `file`, which is overwritten. This and the others throw std::runtime_error (file and
  /// reason).
  HistoryTable(const std::filesystem::path& file, const SnapshotNames& names);
  void write(const Snapshot& frame);
  void close();

 private:
  void add_number(double value);
  void write_row();
  void check_stream() const;

  std::filesystem::path file_;
  std::ofstream stream_;
  std::vector<HistoryColumn> columns_;
  std::string row_;
};

}  // namespace nurbeam
