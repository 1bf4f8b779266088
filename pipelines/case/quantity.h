#pragma once
#include <optional>
#include <string>
#include <string_view>

namespace nurbeam {

/// What a number of the case file measures.
enum class Dimension {
  number,
  length,
  area,
  second_moment,
  mass,
  density,
  time,
  speed,
  acceleration,
  force,
  moment,
  force_per_length,
  pressure,
  temperature,
  thermal_expansion,
  angular_speed,
  inertia,
  torque_per_length,
  rate,
  stiffness,
  damping,
  rotational_stiffness,
  rotational_damping,
  drag,
  angle,
  part
};

/// "length", "force per length", ...
std::string dimension_name(Dimension dimension);
/// That of a number without one, the SI unit but of angles: "m", "N/m", "degrees", ...; "" for a plain
/// number.
std::string default_unit(Dimension dimension);
/// Units a user may write, as a list: "m, mm, cm, km, in, ft".
std::string unit_examples(Dimension dimension);

/// A quantity in its default unit, or why the text is not one.
struct ParsedQuantity {
  std::optional<double> value;
  std::string error;  ///< empty when there is a value
};

/// Reads "5 mm", "7200 kg/m^3", "2 N m", "20 km/h", "1 %": a number and a product of units with integer
/// powers (m2, m^2 and m² are the same), whose dimension must be the expected one.
ParsedQuantity parse_quantity(std::string_view text, Dimension dimension);

/// What 1 of this unit ("mm", "N m", "deg") is in SI units; nothing for one that is not known.
std::optional<double> in_si_units(std::string_view unit);

}  // namespace nurbeam
