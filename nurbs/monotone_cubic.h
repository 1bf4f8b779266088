#pragma once
#include <cstddef>
#include <utility>
#include <vector>

namespace nurbeam {

/// Slopes at the rows (x, y), x increasing, of the C1 cubic that is monotone where the rows are (Fritsch &
/// Butland, SIAM J. Sci. Stat. Comput. 5, 1984); at the ends those of the chords.
inline std::vector<double> monotone_slopes(const std::vector<std::pair<double, double>>& rows) {
  std::vector<double> slopes(rows.size(), 0);
  if (rows.size() < 2) return slopes;
  const auto length = [&](std::size_t i) { return rows[i + 1].first - rows[i].first; };
  const auto secant = [&](std::size_t i) { return (rows[i + 1].second - rows[i].second) / length(i); };
  slopes.front() = secant(0);
  slopes.back() = secant(rows.size() - 2);
  for (std::size_t i = 1; i + 1 < rows.size(); ++i) {
    const double a = secant(i - 1), b = secant(i);
    const double weight = (1 + length(i) / (length(i - 1) + length(i))) / 3;
    if (a * b > 0) slopes[i] = a * b / (weight * b + (1 - weight) * a);
  }
  return slopes;
}

}  // namespace nurbeam
