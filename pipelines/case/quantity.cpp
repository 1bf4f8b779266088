#include "pipelines/case/quantity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Exponents = std::array<int, 4>;  // of metre, kilogram, second, kelvin

/// One unit is multiply / divide SI units: two factors, so that "350 ms" is the number nearest to 0.35.
struct Unit {
  const char* name;
  double multiply, divide;
  Exponents exponents;
};

constexpr double pound = 0.45359237, standard_gravity = 9.80665, pound_force = pound * standard_gravity,
                 inch = 0.0254, pi = std::numbers::pi;

const std::vector<Unit>& units() {
  static const std::vector<Unit> table = {
      {"m", 1, 1, {1, 0, 0}},
      {"km", 1e3, 1, {1, 0, 0}},
      {"dm", 1, 1e1, {1, 0, 0}},
      {"cm", 1, 1e2, {1, 0, 0}},
      {"mm", 1, 1e3, {1, 0, 0}},
      {"um", 1, 1e6, {1, 0, 0}},
      {"nm", 1, 1e9, {1, 0, 0}},
      {"in", 127, 5000, {1, 0, 0}},
      {"inch", 127, 5000, {1, 0, 0}},
      {"ft", 381, 1250, {1, 0, 0}},
      {"yd", 1143, 1250, {1, 0, 0}},
      {"kg", 1, 1, {0, 1, 0}},
      {"g", 1, 1e3, {0, 1, 0}},
      {"mg", 1, 1e6, {0, 1, 0}},
      {"t", 1e3, 1, {0, 1, 0}},
      {"lb", pound, 1, {0, 1, 0}},
      {"slug", 1250 * pound_force, 381, {0, 1, 0}},
      {"s", 1, 1, {0, 0, 1}},
      {"ms", 1, 1e3, {0, 0, 1}},
      {"us", 1, 1e6, {0, 0, 1}},
      {"min", 60, 1, {0, 0, 1}},
      {"h", 3600, 1, {0, 0, 1}},
      {"N", 1, 1, {1, 1, -2}},
      {"mN", 1, 1e3, {1, 1, -2}},
      {"kN", 1e3, 1, {1, 1, -2}},
      {"MN", 1e6, 1, {1, 1, -2}},
      {"daN", 1e1, 1, {1, 1, -2}},
      {"kgf", standard_gravity, 1, {1, 1, -2}},
      {"lbf", pound_force, 1, {1, 1, -2}},
      {"kip", 1e3 * pound_force, 1, {1, 1, -2}},
      {"Nm", 1, 1, {2, 1, -2}},
      {"kNm", 1e3, 1, {2, 1, -2}},
      {"Nmm", 1, 1e3, {2, 1, -2}},
      {"Pa", 1, 1, {-1, 1, -2}},
      {"kPa", 1e3, 1, {-1, 1, -2}},
      {"MPa", 1e6, 1, {-1, 1, -2}},
      {"GPa", 1e9, 1, {-1, 1, -2}},
      {"bar", 1e5, 1, {-1, 1, -2}},
      {"mbar", 1e2, 1, {-1, 1, -2}},
      {"psi", pound_force, inch * inch, {-1, 1, -2}},
      {"ksi", 1e3 * pound_force, inch * inch, {-1, 1, -2}},
      {"K", 1, 1, {0, 0, 0, 1}},
      {"mph", 1397, 3125, {1, 0, -1}},
      {"kn", 463, 900, {1, 0, -1}},
      {"rad", 1, 1, {0, 0, 0}},
      {"mrad", 1, 1e3, {0, 0, 0}},
      {"deg", pi, 180, {0, 0, 0}},
      {"rev", 2 * pi, 1, {0, 0, 0}},
      {"rpm", 2 * pi, 60, {0, 0, -1}},
  };
  return table;
}

struct DimensionInfo {
  const char* name;
  const char* default_unit;
  Exponents exponents;
  const char* examples;
  double multiply = 1, divide = 1;  // to SI units, from its own
};

DimensionInfo info(Dimension dimension) {
  switch (dimension) {
    case Dimension::number:
      return {"plain number", "", {0, 0, 0}, "none (a plain number)"};
    case Dimension::length:
      return {"length", "m", {1, 0, 0}, "m, mm, cm, km, um, in, ft, yd"};
    case Dimension::area:
      return {"area", "m^2", {2, 0, 0}, "m^2, mm^2, cm^2, in^2"};
    case Dimension::second_moment:
      return {"second moment of area", "m^4", {4, 0, 0}, "m^4, mm^4, cm^4, in^4"};
    case Dimension::mass:
      return {"mass", "kg", {0, 1, 0}, "kg, g, mg, t, lb, slug"};
    case Dimension::density:
      return {"density", "kg/m^3", {-3, 1, 0}, "kg/m^3, g/cm^3, t/m^3, lb/ft^3"};
    case Dimension::time:
      return {"time", "s", {0, 0, 1}, "s, ms, us, min, h"};
    case Dimension::speed:
      return {"speed", "m/s", {1, 0, -1}, "m/s, mm/s, km/h, ft/s, mph, kn"};
    case Dimension::acceleration:
      return {"acceleration", "m/s^2", {1, 0, -2}, "m/s^2, mm/s^2, ft/s^2"};
    case Dimension::force:
      return {"force", "N", {1, 1, -2}, "N, kN, mN, MN, daN, kgf, lbf, kip"};
    case Dimension::moment:
      return {"moment", "N m", {2, 1, -2}, "N m, N mm, kN m, kgf m, lbf in, lbf ft, Nm, Nmm, kNm"};
    case Dimension::force_per_length:
      return {"force per length", "N/m", {0, 1, -2}, "N/m, kN/m, N/mm, kgf/m, lbf/ft, kip/ft"};
    case Dimension::pressure:
      return {"modulus", "Pa", {-1, 1, -2}, "Pa, kPa, MPa, GPa, N/mm^2, kgf/cm^2, bar, mbar, psi, ksi"};
    case Dimension::temperature:
      return {"difference of temperature", "K", {0, 0, 0, 1}, "K"};
    case Dimension::thermal_expansion:
      return {"coefficient of thermal expansion", "1/K", {0, 0, 0, -1}, "1/K, m/m/K, mm/m/K, um/m/K"};
    case Dimension::angular_speed:
      return {"angular velocity", "rad/s", {0, 0, -1}, "rad/s, deg/s, rev/s, rpm"};
    case Dimension::inertia:
      return {"moment of inertia", "kg m^2", {2, 1, 0}, "kg m^2, kg mm^2, g cm^2, lb in^2"};
    case Dimension::torque_per_length:
      return {"torque per length", "N m/m", {1, 1, -2}, "N m/m, N mm/mm, kN m/m, lbf in/in"};
    case Dimension::rate:
      return {"rate", "1/s", {0, 0, -1}, "1/s, 1/ms, 1/min, rad/s"};
    case Dimension::stiffness:
      return {"stiffness", "N/m", {0, 1, -2}, "N/m, kN/m, N/mm, MN/m, lbf/in"};
    case Dimension::damping:
      return {"damping", "N s/m", {0, 1, -1}, "N s/m, kN s/m, N s/mm, lbf s/in"};
    case Dimension::rotational_stiffness:
      return {
          "rotational stiffness", "N m/rad", {2, 1, -2}, "N m/rad, kN m/rad, N mm/rad, N m/deg, lbf in/rad"};
    case Dimension::rotational_damping:
      return {
          "rotational damping", "N m s/rad", {2, 1, -1}, "N m s/rad, N mm s/rad, N m s/deg, lbf in s/rad"};
    case Dimension::drag:
      return {"force over speed squared", "N s^2/m^2", {-1, 1, 0}, "N s^2/m^2, kN s^2/m^2, kg/m"};
    case Dimension::angle:
      return {"angle", "degrees", {0, 0, 0}, "deg, rad, mrad, rev", pi, 180};
    case Dimension::part:
      return {"part", "parts of 1", {0, 0, 0}, "%"};
  }
  return {};
}

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// The text with powers as ^n, products as spaces, micro as u, ° as deg, and without the 1 of 1/s.
std::string plain(std::string_view unit) {
  unit.remove_prefix(std::min(unit.find_first_not_of(' '), unit.size()));
  if (unit.starts_with("1/")) unit.remove_prefix(1);
  std::string text(unit);
  for (const auto& [from, to] : {std::pair{"²", "^2"},
                                 {"³", "^3"},
                                 {"⁴", "^4"},
                                 {"·", " "},
                                 {"*", " "},
                                 {"µ", "u"},
                                 {"μ", "u"},
                                 {"°", "deg"}})
    replace_all(text, from, to);
  return text;
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

struct UnitProduct {
  double multiply = 1, divide = 1;
  Exponents exponents{};
  std::string error;
};

const Unit* find_unit(std::string_view name) {
  for (const Unit& unit : units())
    if (name == unit.name) return &unit;
  return nullptr;
}

bool has_word(std::string_view text, std::string_view word) {
  for (auto at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
    const auto end = at + word.size();
    if ((at == 0 || !is_letter(text[at - 1])) && (end == text.size() || !is_letter(text[end]))) return true;
  }
  return false;
}

/// Those in the examples of a dimension. First those as long as `unknown`: a letter is mistaken for another
/// before one is left out.
std::vector<std::string> unit_names(std::string_view examples, std::string_view unknown) {
  std::vector<std::string> names;
  for (const Unit& unit : units())
    if (has_word(examples, unit.name)) names.emplace_back(unit.name);
  std::stable_partition(names.begin(), names.end(),
                        [&](const std::string& name) { return name.size() == unknown.size(); });
  return names;
}

/// Reads the power that follows a unit's name and moves `rest` behind it; 1 if there is none, 0 if it is not
/// one.
int take_power(std::string_view& rest) {
  const bool caret = rest.starts_with('^');
  if (caret) rest.remove_prefix(1);
  int power = caret ? 0 : 1;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), power);
  rest.remove_prefix(end - rest.data());
  return power;
}

/// `examples`: units that could be meant.
UnitProduct parse_units(const std::string& text, std::string_view examples) {
  UnitProduct product;
  std::string_view rest = text;
  int sign = 1;
  while (!rest.empty()) {
    if (rest.front() == ' ') {
      rest.remove_prefix(1);
      continue;
    }
    if (rest.front() == '/' && sign == 1) {
      sign = -1;
      rest.remove_prefix(1);
      continue;
    }
    std::size_t letters = 0;
    while (letters < rest.size() && is_letter(rest[letters])) ++letters;
    const std::string_view name = rest.substr(0, letters);
    const Unit* unit = find_unit(name);
    if (!unit) {
      product.error = name.empty() ? "cannot read the unit from " + in_quotes(rest) + " on"
                                   : "unknown unit " + in_quotes(name) +
                                         nearest_question(name, unit_names(examples, name));
      return product;
    }
    rest.remove_prefix(letters);
    const int power = sign * take_power(rest);
    if (power == 0) {
      product.error = "the power after the unit " + in_quotes(name) + " must be an integer other than 0";
      return product;
    }
    product.multiply *= std::pow(power > 0 ? unit->multiply : unit->divide, std::abs(power));
    product.divide *= std::pow(power > 0 ? unit->divide : unit->multiply, std::abs(power));
    for (std::size_t i = 0; i < product.exponents.size(); ++i)
      product.exponents[i] += power * unit->exponents[i];
    sign = 1;
  }
  if (sign == -1) product.error = "a unit is missing after \"/\"";
  return product;
}

/// Parts of a hundred, the one unit of parts.
UnitProduct parse_percent(const std::string& text) {
  UnitProduct product{.multiply = 1, .divide = 100};
  const std::string unit = text.substr(0, text.find_last_not_of(' ') + 1);
  if (unit != "%") product.error = "unknown unit " + in_quotes(unit);
  return product;
}

/// Whether a unit is one of temperatures that do not begin at their absolute zero.
bool is_scale_of_temperature(const std::string& unit) {
  for (const char* scale : {"C", "degC", "F", "degF", "Celsius", "Fahrenheit"})
    if (unit == scale) return true;
  return false;
}

/// Not divided where that would only round: 15 degrees are 15 degrees.
double scaled(double number, double multiply, double divide) {
  return multiply == divide ? number : number * multiply / divide;
}

}  // namespace

std::string dimension_name(Dimension dimension) { return info(dimension).name; }
std::string default_unit(Dimension dimension) { return info(dimension).default_unit; }
std::string unit_examples(Dimension dimension) { return info(dimension).examples; }

std::optional<double> in_si_units(std::string_view unit) {
  for (const char* const as_it_is : {"1", "-", "J", "W", "Hz"})
    if (unit == as_it_is) return 1;
  const UnitProduct product = parse_units(plain(unit), "");
  return product.error.empty() ? std::optional(product.multiply / product.divide) : std::nullopt;
}

ParsedQuantity parse_quantity(std::string_view text, Dimension dimension) {
  const auto failed = [&](const std::string& reason) {
    return ParsedQuantity{{}, in_quotes(text) + ": " + reason};
  };
  const DimensionInfo wanted = info(dimension);
  const bool is_plain = dimension == Dimension::number;
  const std::string expected =
      is_plain ? "a plain number"
               : dimension_name(dimension) + " (valid units: " + unit_examples(dimension) + ")";

  std::string_view rest = text;
  rest.remove_prefix(std::min(rest.find_first_not_of(" +"), rest.size()));
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error != std::errc{} || !std::isfinite(number))
    return failed("does not begin with a finite number; expected " +
                  std::string(is_plain ? "" : "a number and a unit of ") + expected);
  rest.remove_prefix(end - rest.data());
  if (rest.size() > 1 && rest[0] == ',' && rest[1] >= '0' && rest[1] <= '9') {
    std::string with_point(text);
    with_point[text.size() - rest.size()] = '.';
    return failed("has a decimal comma; did you mean " + in_quotes(with_point) + "?");
  }
  const bool has_unit = rest.find_first_not_of(' ') != std::string_view::npos;
  if (is_plain && has_unit) return failed("has a unit; expected a plain number");
  const UnitProduct product = dimension == Dimension::part && has_unit
                                  ? parse_percent(plain(rest))
                                  : parse_units(plain(rest), unit_examples(dimension));
  if (dimension == Dimension::temperature && is_scale_of_temperature(plain(rest)))
    return failed(
        "is a temperature; expected the difference from the one at which the beam is free of stress, in K: "
        "\"20 K\" of a beam that was made at 20 degrees and is at 40");
  if (!product.error.empty())
    return failed(product.error + (product.error.ends_with('?') ? " Expected " : "; expected ") + expected);
  if (!has_unit && !is_plain) {
    return failed("has no unit; expected " + expected + "; a number without quotes is in " +
                  default_unit(dimension));
  }
  if (product.exponents != wanted.exponents)
    return failed((is_plain ? "has a unit; expected " : "the unit does not measure ") + expected);
  const double value = scaled(number, product.multiply * wanted.divide, product.divide * wanted.multiply);
  if (!std::isfinite(value) || (value == 0 && number != 0)) {
    return failed(std::string("is too ") + (value == 0 ? "small" : "large") + " for a number in " +
                  default_unit(dimension));
  }
  return {value, {}};
}

}  // namespace nurbeam
