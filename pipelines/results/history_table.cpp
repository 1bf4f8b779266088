#include "pipelines/results/history_table.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace nurbeam {

HistoryTable::HistoryTable(const std::filesystem::path& file, const SnapshotNames& names)
    : file_(file), stream_(file), columns_(history_columns(names)) {
  row_ = "time [s]";
  for (const HistoryColumn& column : columns_) row_ += "," + column.heading();
  write_row();
}

void HistoryTable::write(const Snapshot& frame) {
  add_number(frame.time);
  for (const HistoryColumn& column : columns_) {
    row_ += ',';
    if (const double value = column.value(frame); !std::isnan(value)) add_number(value);
  }
  write_row();
}

void HistoryTable::close() {
  stream_.close();
  check_stream();
}

// Appends a number with the 17 digits that give it back exactly, with a decimal point in every locale. What
// has decayed below the smallest normal number is 0: common readers take it for an overflow.
void HistoryTable::add_number(double value) {
  if (std::abs(value) < std::numeric_limits<double>::min()) value = 0;
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 17).ptr;
  row_.append(digits, end);
}

void HistoryTable::write_row() {
  stream_ << row_ << '\n' << std::flush;
  row_.clear();
  check_stream();
}

void HistoryTable::check_stream() const {
  if (!stream_) throw std::runtime_error(file_.string() + ": cannot be written: " + std::strerror(errno));
}

}  // namespace nurbeam
