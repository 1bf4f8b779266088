#include "cad_import/report/leniency.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nurbeam {

namespace {

constexpr double part_of_size = 0.01, last_digits = 1e-6;

}  // namespace

bool Leniency::repairs(double off, double size) const {
  constexpr double most_of_resolution = 0.1;
  return off <= std::max(part_of_size * size, std::min(resolution, most_of_resolution * size));
}

bool Leniency::is_told(double off, double size) { return off > last_digits * size; }

double repair_knots(std::vector<double>& knots, int degree) {
  const auto order = static_cast<std::size_t>(degree) + 1;
  if (degree < 0 || knots.size() < 2 * order) return 0;
  const std::vector<double> before = knots;
  const double range = *std::max_element(knots.begin(), knots.end()) - knots.front();
  for (std::size_t i = 1; i < order; ++i) {
    double &first = knots[i], &last = knots[knots.size() - 1 - i];
    if (std::abs(first - knots.front()) <= last_digits * range) first = knots.front();
    if (std::abs(knots.back() - last) <= last_digits * range) last = knots.back();
  }
  for (std::size_t i = 1; i < knots.size(); ++i)
    if (knots[i] < knots[i - 1] && knots[i - 1] - knots[i] <= part_of_size * range) knots[i] = knots[i - 1];
  double change = 0;
  for (std::size_t i = 0; i < knots.size(); ++i) change = std::max(change, std::abs(knots[i] - before[i]));
  return change > 0 ? change / range : 0;
}

}  // namespace nurbeam
