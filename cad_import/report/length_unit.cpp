#include "cad_import/report/length_unit.h"

#include <stdexcept>

namespace nurbeam {

LengthUnit parse_length_unit(const std::string& text) {
  if (text == "m") return LengthUnit::metre;
  if (text == "mm") return LengthUnit::millimetre;
  if (text == "inch" || text == "in") return LengthUnit::inch;
  throw std::invalid_argument("'" + text + "' is no length unit for export; known are m, mm, inch (in)");
}

}  // namespace nurbeam
