#pragma once
#include <cstddef>
#include <vector>

#include "pipelines/accuracy/level_numbers.h"
#include "pipelines/accuracy/quantities.h"

namespace nurbeam {

/// How far two runs of a case are apart: of each quantity the largest difference of a component, from the
/// start to a time and a twentieth of the run beyond it. What happens in time changes sign, so that the
/// difference of one moment is small by chance.
class Differences {
 public:
  Differences(const std::vector<HistoryQuantity>& quantities, const LevelNumbers& one,
              const LevelNumbers& other);

  double until(std::size_t quantity, double time) const;
  /// Over the whole of both runs.
  double whole(std::size_t quantity) const { return largest_.back()[quantity]; }

 private:
  std::vector<double> times_;                 // of the frames that both have
  std::vector<std::vector<double>> largest_;  // per frame, up to there, of each quantity
  double beyond_ = 0;                         // [s]
};

}  // namespace nurbeam
