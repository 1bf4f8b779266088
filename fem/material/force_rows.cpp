#include "fem/material/force_rows.h"

#include <algorithm>
#include <stdexcept>

#include "nurbs/monotone_cubic.h"
#include "nurbs/number_text.h"

namespace nurbeam {

ForceRows::ForceRows(std::vector<std::pair<double, double>> rows) : rows_(std::move(rows)) {
  if (rows_.size() < 2) throw std::invalid_argument("needs two rows at least");
  for (std::size_t i = 1; i < rows_.size(); ++i)
    if (!(rows_[i].first > rows_[i - 1].first && rows_[i].second > rows_[i - 1].second))
      throw std::invalid_argument("row " + std::to_string(i + 1) + " has a stretch of " +
                                  text_of(rows_[i].first) + " and a force of " + text_of(rows_[i].second) +
                                  " N; both must be greater than in the row before");
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
ForceRows::Point ForceRows::from_start(double e) const {
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

ForceRows::Point ForceRows::at(double e) const {
  Point point = from_start(e);
  point.energy -= energy_at_zero_;
  return point;
}

double ForceRows::stretch(double force) const {
  const bool before = force <= rows_.front().second;
  if (before || force >= rows_.back().second) {
    const std::size_t i = before ? 0 : rows_.size() - 1;
    return rows_[i].first + (force - rows_[i].second) / slopes_[i];
  }
  double low = rows_.front().first, high = rows_.back().first;
  for (double middle = (low + high) / 2; middle > low && middle < high; middle = (low + high) / 2)
    (at(middle).force < force ? low : high) = middle;
  return high;
}

}  // namespace nurbeam
