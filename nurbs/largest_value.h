#pragma once
#include <algorithm>
#include <array>

#include "nurbs/golden_section.h"

namespace nurbeam {

/// Largest value of a distance f on [0, 1]: 33 samples, and golden section around those above their
/// neighbours. Where the samples and what lies beside them are round-off, there is nothing to look for.
template <typename Function>
double largest_value(const Function& f, double round_off) {
  constexpr int count = 32;
  constexpr double ratio = 0.6180339887498949;  // where a golden section begins: on no grid
  std::array<double, count + 1> samples;
  for (int i = 0; i <= count; ++i) samples[i] = f(double(i) / count);
  double largest = *std::max_element(samples.begin(), samples.end());
  for (int i = 0; i <= count; ++i) {
    const int before = std::max(i - 1, 0), after = std::min(i + 1, count);
    if (samples[i] < samples[before] || samples[i] < samples[after]) continue;
    const double a = double(before) / count, b = double(after) / count;
    if (samples[i] <= round_off && std::max(f(b - ratio * (b - a)), f(a + ratio * (b - a))) <= round_off)
      continue;
    const double u = minimum_place([&f](double v) { return -f(v); }, a, b, 30);
    largest = std::max(largest, f(u));
  }
  return largest;
}

}  // namespace nurbeam
