#include "fem/beam_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nurbeam {

namespace {

// Largest-remainder rule: at least one element for each interval, the rest where elements are longest.
std::vector<int> spread(const std::vector<double>& lengths, int count) {
  std::vector<int> parts(lengths.size(), 1);
  for (int left = count - static_cast<int>(lengths.size()); left > 0; --left) {
    std::size_t longest = 0;
    for (std::size_t i = 1; i < lengths.size(); ++i)
      if (lengths[i] / parts[i] > lengths[longest] / parts[longest] * (1 + 1e-12)) longest = i;
    ++parts[longest];
  }
  return parts;
}

}  // namespace

std::vector<HomeNode> divide_evenly(const ReferenceCurve& curve, const std::vector<double>& support_places,
                                    int count) {
  const double near = 1e-9 * curve.length();
  std::vector<double> fixed = curve.breaks();
  for (double s : support_places)
    if (std::none_of(fixed.begin(), fixed.end(), [&](double x) { return std::abs(x - s) < near; }))
      fixed.push_back(s);
  std::sort(fixed.begin(), fixed.end());

  const int intervals = static_cast<int>(fixed.size()) - 1;
  if (count < intervals)
    throw std::invalid_argument(
        std::to_string(count) + " elements are fewer than the " + std::to_string(intervals) +
        " intervals between CAD segments and supports; the smallest count is " + std::to_string(intervals));
  std::vector<double> lengths;
  for (int i = 0; i < intervals; ++i) lengths.push_back(fixed[i + 1] - fixed[i]);
  const std::vector<int> parts = spread(lengths, count);

  std::vector<HomeNode> home;
  for (int i = 0; i < intervals; ++i)
    for (int k = 0; k < parts[i]; ++k)
      home.push_back({fixed[i] + lengths[i] * k / parts[i], k == 0 && i > 0});
  home.push_back({curve.length(), false});
  return home;
}

}  // namespace nurbeam
