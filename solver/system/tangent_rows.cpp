#include "solver/system/tangent_rows.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace nurbeam {

TangentRows::TangentRows(const SecondOrderSystem& system, const State& state, const TangentWeights& weights,
                         std::vector<int> of_rows)
    : rows_(std::move(of_rows)) {
  const SparsePattern& pattern = system.tangent_pattern();
  const int *starts = pattern.column_starts().data(), *rows = pattern.rows().data();
  const auto size = static_cast<std::size_t>(pattern.size());
  std::vector<bool> near(size, false), coupled(size, false);
  std::vector<int> place(size, -1);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const int unknown = rows_[i];
    near[unknown] = true;
    place[unknown] = static_cast<int>(i);
    for (int k = starts[unknown]; k < starts[unknown + 1]; ++k) coupled[rows[k]] = true;
  }
  // Columns of other unknowns are never read, and stay unset.
  const auto values = std::make_unique_for_overwrite<double[]>(pattern.rows().size());
  for (int column = 0; column < static_cast<int>(size); ++column)
    if (coupled[column]) {
      columns_.push_back(column);
      std::fill(values.get() + starts[column], values.get() + starts[column + 1], 0.0);
    }
  system.tangent_near(state, weights, near, values.get());
  entries_.setZero(static_cast<Eigen::Index>(rows_.size()), static_cast<Eigen::Index>(columns_.size()));
  for (std::size_t c = 0; c < columns_.size(); ++c)
    for (int k = starts[columns_[c]]; k < starts[columns_[c] + 1]; ++k)
      if (place[rows[k]] >= 0) entries_(place[rows[k]], static_cast<Eigen::Index>(c)) = values[k];
}

Eigen::MatrixXd TangentRows::entries(const std::vector<int>& columns) const {
  Eigen::MatrixXd found = Eigen::MatrixXd::Zero(entries_.rows(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const auto place = std::lower_bound(columns_.begin(), columns_.end(), columns[k]);
    if (place != columns_.end() && *place == columns[k])
      found.col(static_cast<Eigen::Index>(k)) = entries_.col(place - columns_.begin());
  }
  return found;
}

}  // namespace nurbeam
