#pragma once
#include <condition_variable>
#include <mutex>
#include <vector>

#include "fem/motion/run/simulation_options.h"

namespace nurbeam {

/// The steps of a run under error control, for other runs that follow it, while it goes on in another thread:
/// finer ones take each step in equal parts, the next coarser one two steps between frames at a time.
class LevelSteps {
 public:
  /// `frames`: the output times [s].
  explicit LevelSteps(std::vector<double> frames) : frames_(std::move(frames)) {}

  void add(const StepRecord& step);
  /// No more steps come.
  void end();

  /// The step of a level that is under way at a time; waits for the run where it has not come so far. Behind
  /// its end steps have no end.
  GivenStep at(double time, int level);
  /// Whether two steps between frames make one; waits for the first frames.
  bool has_pairs();

 private:
  struct Step {
    double start, end;  // [s]
  };
  GivenStep part(double time, int parts) const;
  GivenStep whole(double time, const std::vector<Step>& steps) const;
  bool reaches(double time, const std::vector<Step>& steps) const;

  std::vector<double> frames_;
  std::mutex mutex_;  // of all below
  std::condition_variable more_;
  bool ended_ = false;
  std::vector<Step> steps_, pairs_;
  bool half_ = false;  // the last step waits for another half of its pair
};

}  // namespace nurbeam
