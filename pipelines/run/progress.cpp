#include "pipelines/run/progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <ostream>

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

}  // namespace

Progress::Style Progress::style_of_stderr(bool quiet) {
  if (quiet) return Style::quiet;
  return isatty(STDERR_FILENO) ? Style::terminal : Style::lines;
}

Progress::Progress(std::ostream& stream, Style style, double start_time, double end_time,
                   Clock::time_point now)
    : stream_(stream),
      style_(style),
      start_time_(start_time),
      end_time_(end_time),
      start_(now),
      last_(now),
      next_tenth_(static_cast<int>(10 * start_time / end_time + 1e-9) + 1) {}

std::string Progress::line(const StepRecord& step, Clock::time_point now) const {
  const double wall = std::chrono::duration<double>(now - start_).count();
  const double simulated = step.time - start_time_;
  char text[200];
  int length = std::snprintf(text, sizeof text, "%3.0f %%  t = %.4g of %.4g s", 100 * step.time / end_time_,
                             step.time, end_time_);
  if (simulated > 0 && wall > 0)
    length += std::snprintf(text + length, sizeof text - length, "  %s to go  %.3g simulated s/s",
                            duration(wall * (end_time_ - step.time) / simulated).c_str(), simulated / wall);
  std::snprintf(text + length, sizeof text - length, "  step %.3g s, %d Newton", step.size,
                step.newton_iterations);
  return text;
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
