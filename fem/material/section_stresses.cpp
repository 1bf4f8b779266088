#include "fem/material/section_stresses.h"

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace nurbeam {

SectionStresses::SectionStresses(double area, const Eigen::Vector2d& second_moments, double product,
                                 std::vector<StressPlace> places)
    : area_(area), places_(std::move(places)) {
  if (places_.empty()) throw std::invalid_argument("stresses of a section need places of it, got none");
  Eigen::Matrix2d moments;
  moments << second_moments[0], -product, -product, second_moments[1];
  moments_inverse_ = moments.inverse();
}

SectionStresses::SectionStresses(double area, double second_moment, StressPlace on_circle)
    : area_(area),
      moments_inverse_(Eigen::Matrix2d::Identity() / second_moment),
      round_(true),
      places_{on_circle} {}

SectionStresses SectionStresses::round(double area, double second_moment, double torsion_constant,
                                       double radius) {
  return {area, second_moment, StressPlace{{0, radius}, radius / torsion_constant}};
}

// The strain of a fibre at (x, y) is eps + k1 y - k2 x, with M = E [I_x, -I_xy; -I_xy, I_y] k.
SectionStresses::Largest SectionStresses::largest(const SectionLoads& loads) const {
  const double mean = loads.axial_force / area_;
  const Eigen::Vector2d M(loads.moment_1, loads.moment_2), k = moments_inverse_ * M;
  Largest largest{0, 0};
  for (const StressPlace& at : places_) {
    const double bending =
        round_ ? std::copysign(k.norm() * at.place.norm(), mean) : k[0] * at.place.y() - k[1] * at.place.x();
    const double normal = mean + bending, shear = loads.torque * at.shear_per_torque;
    if (std::abs(normal) > std::abs(largest.normal)) largest.normal = normal;
    const double von_mises = std::sqrt(normal * normal + 3 * shear * shear);
    if (!(von_mises <= largest.von_mises)) largest.von_mises = von_mises;
  }
  return largest;
}

}  // namespace nurbeam
