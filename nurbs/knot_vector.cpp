#include "nurbs/knot_vector.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace nurbeam {
namespace {

template <typename... Parts>
void require(bool holds, const Parts&... message) {
  if (holds) return;
  std::ostringstream text;
  text.precision(17);
  (text << ... << message);
  throw std::invalid_argument(text.str());
}

void require_finite_and_sorted(const std::vector<double>& knots) {
  for (std::size_t i = 0; i < knots.size(); ++i) {
    require(std::isfinite(knots[i]), "knot ", i, " is ", knots[i], "; knots must be finite");
    if (i > 0)
      require(knots[i - 1] <= knots[i], "knot ", i, " is ", knots[i], " after ", knots[i - 1],
              "; knots must not decrease");
  }
}

// So that derivatives by the parameter are numbers.
void require_apart(const std::vector<double>& breaks) {
  constexpr double least = 1e-60;
  for (std::size_t i = 1; i < breaks.size(); ++i)
    require(breaks[i] - breaks[i - 1] >= least, "knots ", breaks[i - 1], " and ", breaks[i], " are ",
            breaks[i] - breaks[i - 1], " apart; knots must be equal, or at least 1e-60 apart");
}

}  // namespace

KnotVector::KnotVector(int degree, std::vector<double> knots) : degree_(degree), knots_(std::move(knots)) {
  require(degree >= 1, "degree is ", degree, "; it must be at least 1");
  require(knots_.size() / 2 >= static_cast<std::size_t>(degree) + 1, "there are ", knots_.size(),
          " knots; degree ", degree, " needs at least ", 2 * (static_cast<std::size_t>(degree) + 1));
  require_finite_and_sorted(knots_);
  require(start() < end(), "the curve would live on [", start(), ", ", end(),
          "]; its start must lie before its end");
  require_apart(breaks());
  for (const double u : breaks()) {
    const int most = u == start() || u == end() ? degree + 1 : degree;
    require(multiplicity(u) <= most, "knot ", u, " stands ", multiplicity(u), " times; at most ", most,
            " are allowed there");
  }
}

int KnotVector::find_span(double u) const {
  const auto begin = knots_.begin();
  const auto first_after = u < end() ? std::upper_bound(begin, knots_.end(), std::max(u, start()))
                                     : std::lower_bound(begin, knots_.end(), end());
  return static_cast<int>(first_after - begin) - 1;
}

int KnotVector::multiplicity(double u) const {
  const auto [first, last] = std::equal_range(knots_.begin(), knots_.end(), u);
  return static_cast<int>(last - first);
}

std::vector<double> KnotVector::breaks() const {
  std::vector<double> different(knots_.begin() + degree_, knots_.begin() + control_point_count() + 1);
  different.erase(std::unique(different.begin(), different.end()), different.end());
  return different;
}

}  // namespace nurbeam
