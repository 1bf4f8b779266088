#include "fem/structure/friction.h"

#include <cmath>
#include <numbers>

namespace nurbeam {

double Friction::stiffness(double mass) const {
  constexpr double omega = 2 * std::numbers::pi * 100;  // circular frequency of a body that sticks [rad/s]
  return stick_stiffness.value_or(mass * omega * omega);
}

double Friction::stick_damping(double mass) const {
  constexpr double ratio = 0.7;
  return 2 * ratio * std::sqrt(stiffness(mass) * mass);
}

}  // namespace nurbeam
