#include "fem/material/force_over_stretch.h"

#include <algorithm>
#include <stdexcept>

#include "nurbs/monotone_cubic.h"
#include "nurbs/number_text.h"

namespace nurbeam {

ForceOverStretch::ForceOverStretch(std::vector<std::pair<double, double>> rows) : rows_(std::move(rows)) {
  if (rows_.size() < 2) throw std::invalid_argument("a law of force over stretch needs two rows at least");
  for (std::size_t i = 1; i < rows_.size(); ++i)
    if (!(rows_[i].first > rows_[i - 1].first && rows_[i].second > rows_[i - 1].second))
      throw std::invalid_argument(
          "in row " + std::to_string(i + 1) +
          " of force over stretch, stretch and force must be greater than in the row before; "
          "they are " +
          text_of(rows_[i].first) + " and " + text_of(rows_[i].second) + " N");
  if (rows_.front().first <= -1)
    throw std::invalid_argument("the first row of force over stretch is at " + text_of(rows_.front().first) +
                                "; a beam is compressed to nothing at -1");
  slopes_ = monotone_slopes(rows_);
  energies_.assign(rows_.size(), 0);
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i) {
    const double h = rows_[i + 1].first - rows_[i].first;
    energies_[i + 1] = energies_[i] + h * (rows_[i].second + rows_[i + 1].second) / 2 +
                       h * h * (slopes_[i] - slopes_[i + 1]) / 12;
  }
  energy_at_zero_ = from_start(0).energy;
}

// Law at e with the energy counted from the first row.
AxialPoint<double> ForceOverStretch::from_start(double e) const {
  const bool before = e <= rows_.front().first;
  if (before || e >= rows_.back().first) {
    const std::size_t i = before ? 0 : rows_.size() - 1;
    const double x = e - rows_[i].first, slope = slopes_[i];
    return {energies_[i] + x * (rows_[i].second + slope * x / 2), rows_[i].second + slope * x, slope};
  }
  const auto next = std::upper_bound(rows_.begin(), rows_.end(), e,
                                     [](double x, const auto& row) { return x < row.first; });
  const auto i = static_cast<std::size_t>(next - rows_.begin()) - 1;
  // F = F_0 + x (m_0 + x (a + x b)) with x = e - e_0.
  const double h = rows_[i + 1].first - rows_[i].first, x = e - rows_[i].first,
               secant = (rows_[i + 1].second - rows_[i].second) / h;
  const double a = (3 * secant - 2 * slopes_[i] - slopes_[i + 1]) / h,
               b = (slopes_[i] + slopes_[i + 1] - 2 * secant) / (h * h);
  return {energies_[i] + x * (rows_[i].second + x * (slopes_[i] / 2 + x * (a / 3 + x * b / 4))),
          rows_[i].second + x * (slopes_[i] + x * (a + x * b)), slopes_[i] + x * (2 * a + 3 * b * x)};
}

AxialPoint<double> ForceOverStretch::at(double e) const {
  AxialPoint<double> point = from_start(e);
  point.energy -= energy_at_zero_;
  return point;
}

}  // namespace nurbeam
