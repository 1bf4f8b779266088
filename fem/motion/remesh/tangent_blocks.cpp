#include "fem/motion/remesh/tangent_blocks.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace nurbeam {

TangentBlocks::TangentBlocks(const BeamSystem& system, const State& state, const TangentWeights& weights,
                             const std::vector<int>& coordinates) {
  const SparsePattern& pattern = system.tangent_pattern();
  const int n = system.coordinate_count(), m = system.constraint_count();
  const int *starts = pattern.column_starts().data(), *rows = pattern.rows().data();
  std::vector<bool> wanted(static_cast<std::size_t>(n + m), false);
  std::fill(wanted.begin() + n, wanted.end(), true);
  std::vector<int> place(static_cast<std::size_t>(n + m), -1);
  std::iota(place.begin() + n, place.end(), 0);
  // Columns of other coordinates are never read, and stay unset.
  const auto values = std::make_unique_for_overwrite<double[]>(pattern.rows().size());
  for (std::size_t k = 0; k < coordinates.size(); ++k) {
    wanted[coordinates[k]] = true;
    place[coordinates[k]] = static_cast<int>(k);
    std::fill(values.get() + starts[coordinates[k]], values.get() + starts[coordinates[k] + 1], 0.0);
  }
  system.tangent_near(state, weights, wanted, values.get());
  const auto size = static_cast<Eigen::Index>(coordinates.size());
  square_.setZero(size, size);
  gradient_.setZero(m, size);
  for (Eigen::Index k = 0; k < size; ++k)
    for (int i = starts[coordinates[k]]; i < starts[coordinates[k] + 1]; ++i)
      if (place[rows[i]] >= 0) (rows[i] < n ? square_ : gradient_)(place[rows[i]], k) = values[i];
}

Eigen::VectorXd residual_of(const BeamSystem& system, const State& state,
                            const std::vector<int>& coordinates) {
  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  std::vector<bool> wanted(static_cast<std::size_t>(dynamics.size() + constraints.size()), false);
  for (const int coordinate : coordinates) wanted[coordinate] = true;
  system.residual_near(state, wanted, dynamics, constraints);
  return dynamics(coordinates);
}

}  // namespace nurbeam
