#include "pipelines/diagnostics/reading_progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <ostream>
#include <string>

#include "cad_import/import_curves.h"

namespace nurbeam {

namespace {

std::string with_unit(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, value < 10 ? "%.1f %s" : "%.0f %s", value, unit);
  return text;
}

std::string size_text(std::uintmax_t bytes) {
  constexpr double mebibyte = 1 << 20;
  const double value = static_cast<double>(bytes) / mebibyte;
  return value < 1024 ? with_unit(value, "MiB") : with_unit(value / 1024, "GiB");
}

// Tells of one file.
class ReadingProgress {
 public:
  ReadingProgress(const std::filesystem::path& file, std::ostream& err)
      : err_(err), on_terminal_(isatty(STDERR_FILENO) != 0) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    name_ = file.string() + (error ? "" : " (" + size_text(size) + ")");
  }

  void update(const ChildState& state) {
    if (state.seconds < next_) return;
    next_ = state.seconds + (on_terminal_ ? 0.5 : 10);
    const std::string share =
        state.share > 0 ? std::to_string(static_cast<int>(100 * state.share)) + " %, " : "";
    err_ << (on_terminal_ ? "\r" : "") << "reading " << name_ << ": " << share
         << with_unit(state.seconds, "s") << ", " << size_text(state.memory) << (on_terminal_ ? "   " : "\n")
         << std::flush;
    told_ = true;
  }

  void finish(double seconds, std::size_t memory) {
    constexpr double long_time = 5;  // [s]
    if (told_ && on_terminal_) err_ << '\r' << std::string(name_.size() + 40, ' ') << '\r';
    if (seconds > long_time)
      err_ << "note: " << name_ << ": read in " << with_unit(seconds, "s") << " with up to "
           << size_text(memory) << '\n';
  }

 private:
  std::ostream& err_;
  bool on_terminal_, told_ = false;
  std::string name_;
  double next_ = 2;  // [s]
};

}  // namespace

ImportReport read_with_progress(const std::filesystem::path& file, std::ostream& err) {
  ReadingProgress progress(file, err);
  const auto start = std::chrono::steady_clock::now();
  ImportReport report =
      import_curves(file, {.watch = [&](const ChildState& state) { progress.update(state); }});
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  progress.finish(taken.count(), report.peak_memory);
  return report;
}

}  // namespace nurbeam
