#pragma once
#include <chrono>
#include <iosfwd>
#include <string>

namespace nurbeam {

/// Tells how far a run has come: percent, simulated time, time to go, and simulated seconds per second of
/// wall time. On a terminal one line that is rewritten, at most ten times a second; elsewhere a line at every
/// tenth of the way.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Style { quiet, terminal, lines };

  /// The style that suits stderr.
  static Style style_of_stderr(bool quiet);

  Progress(std::ostream& stream, Style style, double start_time, double end_time,
           Clock::time_point now = Clock::now());
  /// Tells that the run has reached simulated time `time` [s].
  void update(double time, Clock::time_point now = Clock::now());
  /// Ends the line on a terminal, so that other messages start on their own.
  void finish();

 private:
  std::string line(double time, Clock::time_point now) const;

  std::ostream& stream_;
  Style style_;
  double start_time_, end_time_;  // [s], simulated
  Clock::time_point start_, last_;
  int next_tenth_ = 1;
  bool line_open_ = false;
};

}  // namespace nurbeam
