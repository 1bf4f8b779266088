#pragma once
#include <string>

namespace nurbeam {

enum class LengthUnit { metre, millimetre, inch };
/// "m", "mm", "inch" ("in"). Throws std::invalid_argument listing these for anything else.
LengthUnit parse_length_unit(const std::string& text);

}  // namespace nurbeam
