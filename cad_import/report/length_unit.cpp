#include "cad_import/report/length_unit.h"

#include <cmath>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

LengthUnit parse_length_unit(const std::string& text) {
  if (text == "m") return LengthUnit::metre;
  if (text == "mm") return LengthUnit::millimetre;
  if (text == "inch" || text == "in") return LengthUnit::inch;
  throw std::invalid_argument("'" + text + "' is no length unit for export; known are m, mm, inch (in)");
}

bool is_same_unit(double in_metres, double other) {
  return std::abs(in_metres - other) <= 1e-6 * std::abs(other);
}

NamedUnit named_unit(double in_metres) {
  const NamedUnit known[] = {{"m", 1},     {"mm", 1e-3}, {"cm", 1e-2},       {"inch", 0.0254}, {"ft", 0.3048},
                             {"um", 1e-6}, {"km", 1e3},  {"mile", 1609.344}, {"mil", 2.54e-5}};
  for (const NamedUnit& unit : known)
    if (is_same_unit(in_metres, unit.in_metres)) return unit;
  return {text_of(in_metres) + " m", in_metres};
}

}  // namespace nurbeam
