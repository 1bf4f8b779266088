#include "fem/material/bending_layer.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

// Of the length of the free beam over the drawn one.
double free_stretch(const BeamProperties& beam) { return std::sqrt(1 + 2 * beam.free_strain.constant); }

// EI about an axis of the section, per length of the free beam.
double stiffness_about(const BeamProperties& beam, const Eigen::Vector2d& n) {
  if (!beam.sections) return beam.bending_stiffness * free_stretch(beam);
  const SectionStiffness& own = *beam.sections;
  return (own.bending_1 * n[0] * n[0] + own.bending_2 * n[1] * n[1] + 2 * own.bending_product * n[0] * n[1]) *
         free_stretch(beam);
}

double greatest_stiffness(const BeamProperties& beam) {
  if (!beam.sections) return beam.bending_stiffness * free_stretch(beam);
  const SectionStiffness& own = *beam.sections;
  return ((own.bending_1 + own.bending_2) / 2 +
          std::hypot((own.bending_1 - own.bending_2) / 2, own.bending_product)) *
         free_stretch(beam);
}

}  // namespace

double bending_reach(const BeamProperties& beam, double tension) {
  return std::sqrt(greatest_stiffness(beam) / tension);
}

bool is_string(const BeamProperties& beam, double length, double axial_force) {
  constexpr double part = 1.0 / 16;
  return axial_force > 0 && greatest_stiffness(beam) < part * part * length * length * axial_force;
}

double elastic_moment(const BeamProperties& beam, double bend) { return beam.bending_stiffness * bend; }

BendingLayer kink_layer(const BeamProperties& beam, double angle, double tension_before,
                        double tension_behind, const Eigen::Vector2d& across) {
  const double EI = stiffness_about(beam, across), T_1 = tension_before, T_2 = tension_behind,
               mean = std::sqrt(T_1 * T_2);
  // sqrt(T_1) sin(a_1/2) = sqrt(T_2) sin(a_2/2), as the moment is one, and a_1 + a_2 = angle.
  return {std::sqrt(EI / std::min(T_1, T_2)), 2 * std::sqrt(EI) * mean * std::sin(angle / 2) /
                                                  std::sqrt(T_1 + T_2 + 2 * mean * std::cos(angle / 2))};
}

BendingLayer clamp_layer(const BeamProperties& beam, double angle, double tension,
                         const Eigen::Vector2d& across) {
  const double EI = stiffness_about(beam, across);
  return {std::sqrt(EI / tension), 2 * std::sqrt(EI * tension) * std::sin(angle / 2)};
}

}  // namespace nurbeam
