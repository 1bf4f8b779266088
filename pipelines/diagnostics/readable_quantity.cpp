#include "pipelines/diagnostics/readable_quantity.h"

#include <cmath>
#include <string_view>
#include <vector>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

struct Prefix {
  const char* name;
  double factor;
};

// The prefixes that are in use for a unit, from the smallest on.
std::vector<Prefix> prefixes_of(std::string_view unit) {
  if (unit == "m") return {{"um", 1e-6}, {"mm", 1e-3}, {"m", 1}};
  if (unit == "N") return {{"mN", 1e-3}, {"N", 1}, {"kN", 1e3}, {"MN", 1e6}};
  if (unit == "N m") return {{"mN m", 1e-3}, {"N m", 1}, {"kN m", 1e3}, {"MN m", 1e6}};
  if (unit == "Pa") return {{"Pa", 1}, {"kPa", 1e3}, {"MPa", 1e6}, {"GPa", 1e9}};
  if (unit == "J") return {{"mJ", 1e-3}, {"J", 1}, {"kJ", 1e3}, {"MJ", 1e6}};
  return {};
}

}  // namespace

ReadableUnit readable_unit(double value, const std::string& unit) {
  const std::vector<Prefix> prefixes = prefixes_of(unit);
  if (value == 0 || prefixes.empty()) return {unit, 1};
  const Prefix* best = &prefixes.front();
  for (const Prefix& each : prefixes)
    if (std::abs(value) >= each.factor * (1 - 0.5e-4)) best = &each;
  return {best->name, best->factor};
}

std::string readable(double value, const std::string& unit) {
  constexpr int digits = 4;
  const ReadableUnit shown = readable_unit(value, unit);
  return text_of(value / shown.factor, digits) + " " + shown.name;
}

}  // namespace nurbeam
