#pragma once
#include <cmath>
#include <optional>

#include "pipelines/case/parts/output.h"

namespace nurbeam {

/// When histories have rows besides those of frames: at every step, or at the first step at or after every
/// multiple of an interval. No step is shortened for them.
class HistoryRows {
 public:
  explicit HistoryRows(const CaseOutput& output)
      : every_(output.histories_every), each_step_(output.histories_at_steps) {}

  bool any() const { return each_step_ || every_; }
  /// Whether a step from one time to another [s] has a row at its end. Before the first step both are equal.
  bool due(double before, double now) const {
    if (each_step_) return true;
    return every_ &&
           (now == before ? number(now) * *every_ >= now * (1 - near) : number(now) > number(before));
  }

 private:
  static constexpr double near = 1e-9;
  double number(double time) const { return std::floor(time / *every_ * (1 + near) + near); }

  std::optional<double> every_;
  bool each_step_;
};

}  // namespace nurbeam
