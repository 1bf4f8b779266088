#pragma once
#include <string>

namespace nurbeam {

/// A unit as people write it for numbers of some size.
struct ReadableUnit {
  std::string name;
  double factor;  ///< in SI units
};
ReadableUnit readable_unit(double value, const std::string& unit);

/// A value in SI as people read it, with four digits: 0.0016577 m is "1.658 mm", 137e6 Pa "137 MPa". Units:
/// m, N, N m, Pa, J, m/s, rad; others stay as they are.
std::string readable(double value, const std::string& unit);

}  // namespace nurbeam
