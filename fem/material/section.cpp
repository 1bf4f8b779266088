#include "fem/material/section.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

Section Section::round(double radius, double bore) {
  if (!(bore >= 0 && bore < radius))
    throw std::invalid_argument("a round section needs 0 <= bore < radius, got a bore of " + text_of(bore) +
                                " m and a radius of " + text_of(radius) + " m");
  const double area = std::numbers::pi * radius * radius - std::numbers::pi * bore * bore;
  const double second_moment = (area * radius * radius + area * bore * bore) / 4;
  return {area, second_moment, 2 * second_moment, radius, bore, radius};
}

std::optional<double> Section::fibre_stress(double axial_force, double bending_moment) const {
  if (!extreme_fibre || !(area > 0) || !(second_moment > 0)) return std::nullopt;
  const double bending = std::abs(bending_moment) * *extreme_fibre / second_moment;
  return axial_force / area + std::copysign(bending, axial_force);
}

}  // namespace nurbeam
