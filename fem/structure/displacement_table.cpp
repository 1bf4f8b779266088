#include "fem/structure/displacement_table.h"

#include <algorithm>
#include <stdexcept>

#include "nurbs/monotone_cubic.h"
#include "nurbs/number_text.h"

namespace nurbeam {

DisplacementTable::DisplacementTable(std::vector<Row> rows)
    : rows_(std::move(rows)), slopes_(rows_.size(), Eigen::Vector3d::Zero()) {
  if (rows_.empty()) throw std::invalid_argument("a table of displacements has at least one row");
  for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
    if (!(rows_[i].first < rows_[i + 1].first))
      throw std::invalid_argument("the times of a displacement must increase; " +
                                  text_of(rows_[i + 1].first) + " s follows " + text_of(rows_[i].first) +
                                  " s");
  for (int d = 0; d < 3; ++d) {
    std::vector<std::pair<double, double>> component;
    for (const auto& [t, displacement] : rows_) component.emplace_back(t, displacement[d]);
    const std::vector<double> slopes = monotone_slopes(component);
    for (std::size_t i = 1; i + 1 < slopes.size(); ++i) slopes_[i][d] = slopes[i];
  }
}

DisplacementTable::Motion DisplacementTable::at(double t) const {
  if (law_) return law_(t);
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const auto next =
      std::upper_bound(rows_.begin(), rows_.end(), t, [](double x, const Row& row) { return x < row.first; });
  if (next == rows_.begin()) return {rows_.front().second, none, none};
  if (next == rows_.end()) return {rows_.back().second, none, none};
  const auto i = static_cast<std::size_t>(next - rows_.begin()) - 1;
  const double l = rows_[i + 1].first - rows_[i].first, x = (t - rows_[i].first) / l;
  const Eigen::Vector3d rise = rows_[i + 1].second - rows_[i].second, a = l * slopes_[i],
                        b = l * slopes_[i + 1];
  // Cubic Hermite: y_0 + a x + c2 x^2 + c3 x^3.
  const Eigen::Vector3d c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  return {rows_[i].second + x * (a + x * (c2 + x * c3)), (a + x * (2 * c2 + x * 3 * c3)) / l,
          (2 * c2 + 6 * x * c3) / (l * l)};
}

}  // namespace nurbeam
