#pragma once
#include <optional>
#include <string>

namespace nurbeam {

enum class LengthUnit { metre, millimetre, inch };
/// "m", "mm", "inch" ("in"). Throws std::invalid_argument listing these for anything else.
LengthUnit parse_length_unit(const std::string& text);

/// "m", "mm" or "inch".
std::string name_of(LengthUnit unit);
double metres_of(LengthUnit unit);

/// OpenCASCADE computes in millimetres, nurbeam in metres.
constexpr double metres_per_millimetre = 1e-3, millimetres_per_metre = 1e3;

/// A length unit as files declare it.
struct NamedUnit {
  std::string name;
  double in_metres;
};
/// The unit of that size, to 1e-6 of it, or one named by its size: "0.0123 m".
NamedUnit named_unit(double in_metres);
/// That of a name: those of named_unit(), and "in".
std::optional<NamedUnit> unit_of_name(const std::string& name);
/// "m, mm, cm, ...", for messages.
std::string known_unit_names();
/// To 1e-6 of the second.
bool is_same_unit(double in_metres, double other);

}  // namespace nurbeam
