#pragma once
#include <chrono>
#include <cstddef>
#include <iosfwd>
#include <string>

#include "fem/motion/record/snapshot.h"

namespace nurbeam {

/// Tells how far a run has come: percent, simulated time, time to go, simulated seconds per second of wall
/// time, and the last step with its Newton iterations. On a terminal one line that is rewritten, at most ten
/// times a second; elsewhere a line at every tenth of the way.
class Progress {
 public:
  using Clock = std::chrono::steady_clock;
  enum class Style { quiet, terminal, lines };

  /// The style that suits stderr.
  static Style style_of_stderr(bool quiet);
  /// The columns of the terminal that stderr is; 80 where it does not say.
  static std::size_t width_of_stderr();

  /// `width`: columns that a line on a terminal may take.
  Progress(std::ostream& stream, Style style, double start_time, double end_time,
           Clock::time_point now = Clock::now(), std::size_t width = width_of_stderr());
  /// Starts the clock anew: what came before, as a search for rest, says nothing of the time to go.
  void begin_motion(Clock::time_point now = Clock::now()) { start_ = now; }
  /// Tells that the run has taken a step.
  void update(const StepRecord& step, Clock::time_point now = Clock::now());
  /// Ends the line on a terminal, so that other messages start on their own.
  void finish();

 private:
  std::string line(const StepRecord& step, Clock::time_point now) const;

  std::ostream& stream_;
  Style style_;
  double start_time_, end_time_;  // [s], simulated
  Clock::time_point start_, last_;
  std::size_t width_;
  int next_tenth_;
  bool line_open_ = false;
};

}  // namespace nurbeam
