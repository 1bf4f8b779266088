#pragma once
#include <vector>

namespace nurbeam {

/// All count + degree + 1 knots of a clamped curve with equal spans on [0, 1]; count > degree >= 1.
inline std::vector<double> even_clamped_knots(int degree, int count) {
  const int spans = count - degree;
  std::vector<double> knots(degree + 1, 0.0);
  for (int i = 1; i < spans; ++i) knots.push_back(i / static_cast<double>(spans));
  knots.insert(knots.end(), degree + 1, 1.0);
  return knots;
}

}  // namespace nurbeam
