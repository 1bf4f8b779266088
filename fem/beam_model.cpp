#include "fem/beam_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nurbeam {

std::vector<double> fixed_places(const ReferenceCurve& curve, const std::vector<double>& support_places) {
  const double near = 1e-9 * curve.length();
  std::vector<double> places = curve.breaks();
  for (double s : support_places)
    if (std::none_of(places.begin(), places.end(), [&](double x) { return std::abs(x - s) < near; }))
      places.push_back(s);
  std::sort(places.begin(), places.end());
  return places;
}

std::vector<int> spread_elements(const std::vector<double>& places, int count) {
  const int intervals = static_cast<int>(places.size()) - 1;
  if (count < intervals)
    throw std::invalid_argument(
        std::to_string(count) + " elements are fewer than the " + std::to_string(intervals) +
        " intervals between CAD segments and supports; the smallest count is " + std::to_string(intervals));
  std::vector<int> parts(intervals, 1);
  const auto part_length = [&](int i) { return (places[i + 1] - places[i]) / parts[i]; };
  for (int left = count - intervals; left > 0; --left) {
    int longest = 0;
    for (int i = 1; i < intervals; ++i)
      if (part_length(i) > part_length(longest) * (1 + 1e-12)) longest = i;
    ++parts[longest];
  }
  return parts;
}

std::vector<HomeNode> home_nodes(const std::vector<double>& places, const std::vector<int>& parts) {
  std::vector<HomeNode> home;
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (int k = 0; k < parts[i]; ++k)
      home.push_back({places[i] + (places[i + 1] - places[i]) * k / parts[i], k == 0 && i > 0});
  home.push_back({places.back(), false});
  return home;
}

}  // namespace nurbeam
