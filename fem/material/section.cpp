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

double BeamProperties::drawn_tension() const {
  const double free = free_strain.of_tension;
  return 0 + axial_point(law, axial_stiffness, 0 - free, free).force;
}

void BeamProperties::set_drawn_tension(double S_0) {
  if (std::holds_alternative<GreenLaw>(law)) {
    free_strain.of_tension = -S_0 / axial_stiffness;
    return;
  }
  constexpr double least = -0.9;  // laws of the engineering strain hold down to there
  const double stretch = stretch_under(law, axial_stiffness, S_0);
  if (stretch < least)
    throw std::invalid_argument("a thrust of " + text_of(-S_0, 4) + " N shortens the beam by " +
                                text_of(-100 * stretch, 4) + " % of its free length; must be at most 90 %");
  const double natural = 1 / (1 + stretch);  // free over drawn length
  free_strain.of_tension = (natural * natural - 1) / 2;
  if (std::holds_alternative<HookeLaw>(law)) axial_stiffness /= natural * natural * natural;
}

double BeamProperties::free_axial_stiffness() const {
  const bool by_tension = std::holds_alternative<HookeLaw>(law);
  const double square = 1 + 2 * (free_strain.constant + (by_tension ? free_strain.of_tension : 0));
  return axial_stiffness * square * std::sqrt(square);
}

}  // namespace nurbeam
