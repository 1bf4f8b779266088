#include "pipelines/run/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <ostream>
#include <vector>

#include "pipelines/diagnostics/terminal_width.h"

namespace nurbeam {

namespace {

/// "42 s", "3 min 05 s", "2 h 10 min".
std::string duration(double seconds) {
  const long s = std::lround(seconds);
  char text[48];
  if (s < 60)
    std::snprintf(text, sizeof text, "%ld s", s);
  else if (s < 3600)
    std::snprintf(text, sizeof text, "%ld min %02ld s", s / 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld h %02ld min", s / 3600, s % 3600 / 60);
  return text;
}

template <class... Values>
std::string formatted(const char* format, Values... values) {
  char text[120];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

// As many of the parts as a line of that width has room for. A terminal breaks a line that fills it.
std::string fitting(const std::vector<std::string>& parts, std::size_t width) {
  std::string line = parts.front().substr(0, width - 1);
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (line.size() + 2 + parts[i].size() < width) line += "  " + parts[i];
  return line;
}

}  // namespace

Progress::Style Progress::style_of_stderr(bool quiet) {
  if (quiet) return Style::quiet;
  return isatty(STDERR_FILENO) ? Style::terminal : Style::lines;
}

std::size_t Progress::width_of_stderr() {
  constexpr std::size_t usual = 80;
  return terminal_width(STDERR_FILENO).value_or(usual);
}

Progress::Progress(std::ostream& stream, Style style, double start_time, double end_time,
                   Clock::time_point now, std::size_t width)
    : stream_(stream),
      style_(style),
      start_time_(start_time),
      end_time_(end_time),
      start_(now),
      last_(now),
      width_(width),
      next_tenth_(static_cast<int>(10 * start_time / end_time + 1e-9) + 1) {}

std::string Progress::line(const StepRecord& step, Clock::time_point now) const {
  const double wall = std::chrono::duration<double>(now - start_).count();
  const double simulated = step.time - start_time_;
  std::vector<std::string> parts{
      formatted("%3.0f %%  t = %.4g of %.4g s", 100 * step.time / end_time_, step.time, end_time_)};
  if (simulated > 0 && wall > 0) {
    parts.push_back(duration(wall * (end_time_ - step.time) / simulated) + " to go");
    parts.push_back(formatted("%.3g simulated s/s", simulated / wall));
  }
  parts.push_back(formatted("step %.3g s, %d Newton", step.size, step.newton_iterations));
  return style_ == Style::terminal ? fitting(parts, width_) : fitting(parts, std::string::npos);
}

void Progress::update(const StepRecord& step, Clock::time_point now) {
  if (style_ == Style::terminal) {
    if (step.time < end_time_ && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    stream_ << '\r' << line(step, now) << "\x1b[K" << std::flush;  // erases what is left of a longer line
    line_open_ = true;
  } else if (style_ == Style::lines) {
    const int tenths = static_cast<int>(10 * step.time / end_time_ + 1e-9);
    if (tenths >= next_tenth_) {
      stream_ << line(step, now) << std::endl;
      next_tenth_ = tenths + 1;
    }
  }
}

void Progress::finish() {
  if (line_open_) {
    stream_ << std::endl;
    line_open_ = false;
  }
}

}  // namespace nurbeam
