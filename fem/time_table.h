#pragma once
#include <algorithm>
#include <utility>
#include <vector>

namespace nurbeam {

/// Values over time: (t [s], value), t increasing; linear between, constant outside.
using TimeTable = std::vector<std::pair<double, double>>;

/// Value and slope of a table at time t; an empty table is 1 everywhere.
inline std::pair<double, double> value_and_slope(const TimeTable& table, double t) {
  if (table.empty()) return {1, 0};
  if (t < table.front().first) return {table.front().second, 0};
  if (t >= table.back().first) return {table.back().second, 0};
  const auto next = std::upper_bound(table.begin(), table.end(), t,
                                     [](double x, const auto& row) { return x < row.first; });
  const auto& [t0, y0] = *(next - 1);
  const auto& [t1, y1] = *next;
  const double slope = (y1 - y0) / (t1 - t0);
  return {y0 + slope * (t - t0), slope};
}

}  // namespace nurbeam
