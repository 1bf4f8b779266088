#include "pipelines/results/history_table.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "nurbs/number_text.h"
#include "pipelines/results/file_error.h"

namespace nurbeam {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// The number at the start of a text; NaN where there is none.
double number_in(std::string_view text) {
  double value = no_number;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

// Calls visit(field) for what stands between the commas of a line.
template <class Visit>
void for_each_field(std::string_view line, Visit visit) {
  for (;;) {
    const std::size_t comma = line.find(',');
    visit(line.substr(0, comma));
    if (comma == std::string_view::npos) return;
    line.remove_prefix(comma + 1);
  }
}

}  // namespace

HistoryTable::HistoryTable(const std::filesystem::path& file, const SnapshotNames& names)
    : file_(file),
      stream_(file),
      columns_(history_columns(names)),
      header_("time [s]"),
      last_time_(no_number) {
  for (const HistoryColumn& column : columns_) header_ += "," + column.heading();
  row_ = header_;
  write_row();
}

void HistoryTable::write(const Snapshot& frame) {
  add_number(frame.time);
  for (const HistoryColumn& column : columns_) {
    row_ += ',';
    if (const double value = column.value(frame); !std::isnan(value)) add_number(value);
  }
  write_row();
  last_time_ = frame.time;
}

void HistoryTable::write_between(const Snapshot& moment) {
  add_number(moment.time);
  for (const HistoryColumn& column : columns_) {
    row_ += ',';
    if (!is_known_between_frames(column)) continue;
    if (const double value = column.value(moment); !std::isnan(value)) add_number(value);
  }
  write_row();
  last_time_ = moment.time;
}

void HistoryTable::take_over(const std::filesystem::path& former, const RowsBefore& rows) {
  std::ifstream lines(former);
  std::string line;
  if (!std::getline(lines, line) || line != header_)
    fail(former, "has no rows that this run could go on from; run without --resume");
  while (std::getline(lines, line) && !lines.eof()) {
    const double time = number_in(line);
    if (time > rows.time || (time == rows.time && (!rows.at_it || last_time_ == time))) break;
    stream_ << line << '\n';
    last_time_ = time;
  }
  if (rows.at_it && last_time_ != rows.time)
    fail(former,
         "ends before the restart point, which is at " + text_of(rows.time) + " s; run without --resume");
  stream_ << std::flush;
  check_stream();
}

void HistoryTable::put_on_disk() {
  const int descriptor = open(file_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return check_stream();
  fsync(descriptor);
  ::close(descriptor);
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

StoredHistories read_histories(const std::filesystem::path& file) {
  std::ifstream lines(file);
  std::string line;
  if (!std::getline(lines, line)) fail(file, "cannot be read");
  StoredHistories histories;
  for_each_field(line, [&](std::string_view field) { histories.headings.emplace_back(field); });
  histories.headings.erase(histories.headings.begin());
  while (std::getline(lines, line)) {
    std::size_t fields = 0;
    for_each_field(line, [&](std::string_view field) {
      (fields++ == 0 ? histories.times : histories.values).push_back(number_in(field));
    });
    if (fields != histories.headings.size() + 1)
      fail(file, "is damaged: row " + std::to_string(histories.times.size()) + " has " +
                     std::to_string(fields) + " values, expected " +
                     std::to_string(histories.headings.size() + 1));
  }
  return histories;
}

}  // namespace nurbeam
