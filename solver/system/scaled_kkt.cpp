#include "solver/system/scaled_kkt.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

ScaledKkt::ScaledKkt(const SecondOrderSystem& system, const State& state, double h)
    : values_(static_cast<Eigen::Index>(system.tangent_pattern().rows().size())),
      matrix(system.tangent_pattern().matrix_of(values_.data())) {
  system.tangent(state, {.mass = 1, .damping = h / 2, .stiffness = h * h / 4}, matrix);
  scale_coordinates(system.coordinate_count());
}

// Divides the rows and columns of coordinates by their largest diagonal entry.
void ScaledKkt::scale_coordinates(int n) {
  const int *rows = matrix.innerIndexPtr(), *starts = matrix.outerIndexPtr();
  const auto first_at_least = [&](int row, int column) {
    return static_cast<int>(std::lower_bound(rows + starts[column], rows + starts[column + 1], row) - rows);
  };
  double largest = 0;
  for (int i = 0; i < n; ++i) largest = std::fmax(largest, matrix.valuePtr()[first_at_least(i, i)]);
  if (!(largest > 0) || !std::isfinite(largest)) return;
  scale = largest;
  for (int i = 0; i < n; ++i)
    Eigen::Map<Eigen::ArrayXd>(matrix.valuePtr() + starts[i], first_at_least(n, i) - starts[i]) /= largest;
}

}  // namespace nurbeam
