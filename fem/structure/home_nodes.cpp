#include "fem/structure/home_nodes.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "fem/element/subdivision.h"
#include "nurbs/number_text.h"

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

std::vector<HomeNode> guide_nodes(const ReferenceCurve& curve) {
  std::vector<HomeNode> nodes;
  for (const double s : curve.breaks()) nodes.push_back({.s = s, .permanent = true});
  return nodes;
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

std::vector<HomeNode> home_nodes(const std::vector<double>& places, const std::vector<int>& parts,
                                 double grading) {
  const auto length = [&](std::size_t i) { return places[i + 1] - places[i]; };
  std::size_t tightest = 0;
  for (std::size_t i = 1; i < parts.size(); ++i)
    if (grading_limit(length(i), parts[i]) < grading_limit(length(tightest), parts[tightest])) tightest = i;
  try {
    graded_places(length(tightest), parts[tightest], grading);
  } catch (const std::invalid_argument& refusal) {
    throw std::invalid_argument("between s = " + text_of(places[tightest]) +
                                " m and s = " + text_of(places[tightest + 1]) + " m: " + refusal.what());
  }
  std::vector<HomeNode> home;
  home.reserve(std::accumulate(parts.begin(), parts.end(), std::size_t{1}));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    home.push_back({.s = places[i], .permanent = i > 0});
    for (const double x : graded_places(length(i), parts[i], grading)) home.push_back({.s = places[i] + x});
  }
  home.push_back({.s = places.back()});
  return home;
}

}  // namespace nurbeam
