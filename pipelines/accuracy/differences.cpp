#include "pipelines/accuracy/differences.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

constexpr double window = 0.05;  // of the run

double difference(const HistoryQuantity& of, const std::vector<double>& one,
                  const std::vector<double>& other) {
  double largest = 0;
  for (const std::size_t i : of.columns) {
    const double d = of.has_larger_sign ? std::abs(one[i]) - std::abs(other[i]) : one[i] - other[i];
    if (std::isfinite(d)) largest = std::max(largest, std::abs(d));
  }
  return largest;
}

}  // namespace

Differences::Differences(const std::vector<HistoryQuantity>& quantities, const LevelNumbers& one,
                         const LevelNumbers& other) {
  std::vector<double> largest(quantities.size(), 0);
  const double end = std::max({one.end, other.end, 1e-300});
  beyond_ = window * end;
  for (std::size_t i = 0, j = 0; i < one.times.size() && j < other.times.size();) {
    if (std::abs(one.times[i] - other.times[j]) > 1e-9 * end) {
      one.times[i] < other.times[j] ? ++i : ++j;
      continue;
    }
    for (std::size_t q = 0; q < quantities.size(); ++q)
      largest[q] = std::max(largest[q], difference(quantities[q], one.rows[i], other.rows[j]));
    times_.push_back(one.times[i]);
    largest_.push_back(largest);
    ++i, ++j;
  }
  if (largest_.empty()) {
    times_.push_back(0);
    largest_.push_back(largest);
  }
}

double Differences::until(std::size_t quantity, double time) const {
  const auto after = std::upper_bound(times_.begin(), times_.end(), time + beyond_);
  const auto i = after == times_.begin() ? 0 : after - times_.begin() - 1;
  return largest_[static_cast<std::size_t>(i)][quantity];
}

}  // namespace nurbeam
