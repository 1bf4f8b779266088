#include "cad_import/report/length_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

const std::array<NamedUnit, 9> known{{{"m", 1},
                                      {"mm", 1e-3},
                                      {"cm", 1e-2},
                                      {"inch", 0.0254},
                                      {"ft", 0.3048},
                                      {"um", 1e-6},
                                      {"km", 1e3},
                                      {"mile", 1609.344},
                                      {"mil", 2.54e-5}}};

}  // namespace

LengthUnit parse_length_unit(const std::string& text) {
  if (text == "m") return LengthUnit::metre;
  if (text == "mm") return LengthUnit::millimetre;
  if (text == "inch" || text == "in") return LengthUnit::inch;
  throw std::invalid_argument("'" + text + "' is no length unit for export; known are m, mm, inch (in)");
}

std::string name_of(LengthUnit unit) { return named_unit(metres_of(unit)).name; }

double metres_of(LengthUnit unit) {
  switch (unit) {
    case LengthUnit::metre:
      return 1;
    case LengthUnit::millimetre:
      return metres_per_millimetre;
    case LengthUnit::inch:
      return 0.0254;
  }
  throw std::invalid_argument("unknown length unit");
}

std::optional<NamedUnit> unit_of_name(const std::string& name) {
  const auto at = std::find_if(known.begin(), known.end(), [&](const NamedUnit& unit) {
    return unit.name == name || (unit.name == "inch" && name == "in");
  });
  return at == known.end() ? std::nullopt : std::optional(*at);
}

std::string known_unit_names() {
  std::string names;
  for (const NamedUnit& unit : known) names += (names.empty() ? "" : ", ") + unit.name;
  return names;
}

bool is_same_unit(double in_metres, double other) {
  return std::abs(in_metres - other) <= 1e-6 * std::abs(other);
}

NamedUnit named_unit(double in_metres) {
  for (const NamedUnit& unit : known)
    if (is_same_unit(in_metres, unit.in_metres)) return unit;
  return {text_of(in_metres) + " m", in_metres};
}

}  // namespace nurbeam
