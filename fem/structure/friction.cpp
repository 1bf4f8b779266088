#include "fem/structure/friction.h"

#include <cmath>
#include <numbers>

namespace nurbeam {

double Friction::stiffness_on_guide(double mass) {
  constexpr double omega = 2 * std::numbers::pi * 100;  // circular frequency of a body that sticks [rad/s]
  return mass * omega * omega;
}

double Friction::stick_damping(double stiffness, double mass) {
  constexpr double ratio = 0.7;
  return 2 * ratio * std::sqrt(stiffness * mass);
}

}  // namespace nurbeam
