#include "pipelines/run/level_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace nurbeam {

namespace {

constexpr double least_left = 0.25;  // of a step: a shorter end is not worth a step of its own

}  // namespace

void LevelSteps::add(const StepRecord& step) {
  const std::lock_guard lock(mutex_);
  const Step taken{step.time - step.size, step.time};
  const auto next = std::lower_bound(frames_.begin(), frames_.end(), taken.end - 1e-9 * step.size);
  const bool is_frame = next != frames_.end() && std::abs(*next - taken.end) <= 1e-9 * step.size;
  steps_.push_back(taken);
  if (half_)
    pairs_.push_back({steps_[steps_.size() - 2].start, taken.end});
  else if (is_frame)
    pairs_.push_back(taken);
  half_ = !half_ && !is_frame;
  more_.notify_all();
}

void LevelSteps::end() {
  const std::lock_guard lock(mutex_);
  if (half_) pairs_.push_back(steps_.back());
  half_ = false;
  ended_ = true;
  more_.notify_all();
}

bool LevelSteps::reaches(double time, const std::vector<Step>& steps) const {
  return !steps.empty() && steps.back().end - time >= least_left * (steps.back().end - steps.back().start);
}

GivenStep LevelSteps::whole(double time, const std::vector<Step>& steps) const {
  auto step = std::upper_bound(steps.begin(), steps.end(), time,
                               [](double t, const Step& each) { return t < each.end; });
  while (step != steps.end() && step->end - time < least_left * (step->end - step->start)) ++step;
  if (step != steps.end()) return {step->end, step->end - step->start};
  constexpr double never = std::numeric_limits<double>::infinity();
  return {never, steps.empty() ? never : steps.back().end - steps.back().start};
}

GivenStep LevelSteps::part(double time, int parts) const {
  GivenStep step = whole(time, steps_);
  const double length = step.length / parts;
  if (!std::isfinite(step.end)) return {time + length, length};
  const double left = std::floor((step.end - time) / length - least_left);
  return {step.end - std::clamp(left, 0.0, parts - 1.0) * length, length};
}

GivenStep LevelSteps::at(double time, int level) {
  std::unique_lock lock(mutex_);
  const std::vector<Step>& steps = level < 0 ? pairs_ : steps_;
  more_.wait(lock, [&] { return ended_ || reaches(time, steps); });
  return level < 0 ? whole(time, pairs_) : part(time, 1 << level);
}

bool LevelSteps::has_pairs() {
  constexpr std::size_t some = 16;
  constexpr double least_ratio = 1.5;
  std::unique_lock lock(mutex_);
  more_.wait(lock, [&] {
    return ended_ || (!steps_.empty() && frames_.size() > some && steps_.back().end > frames_[some]);
  });
  return static_cast<double>(steps_.size()) >= least_ratio * static_cast<double>(pairs_.size());
}

}  // namespace nurbeam
