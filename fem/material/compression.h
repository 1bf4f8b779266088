#pragma once
#include <cstdint>

#include "fem/material/axial_law.h"

namespace nurbeam {

/// The axial force of a beam under compression.
enum class Compression : std::uint8_t {
  full,    ///< that of its law
  buckles  ///< no more than what buckles it between two nodes of the mesh (buckling_point)
};

/// The compression of an element that gives way as a beam does that buckles between its ends.
struct Buckling {
  static constexpr double load = 40;       ///< times EI/l^2: 4 pi^2, of a beam that is clamped at both ends
  static constexpr double slope = 1e-3;    ///< stiffness beyond the load, over EA
  static constexpr double crushed = -0.3;  ///< strain beyond which a section resists fully again
};

/// The axial law of an element that buckles at the compressive strain `onset`. The law holds down to there.
/// Beyond, the force grows with the slope of Buckling, and EA joins in where the element is crushed.
template <class T>
AxialPoint<T> buckling_point(const AxialLaw& law, double EA, const T& strain, double free, const T& onset) {
  const T below = positive(T(-onset - strain)), deep = positive(T(Buckling::crushed - strain));
  const T is_below = 1. - is_zero(below), is_deep = 1. - is_zero(deep);
  const AxialPoint<T> at = axial_point<T>(law, EA, T(strain + below), free);
  constexpr double slope = Buckling::slope;
  return {at.energy - (at.force - EA * slope / 2 * below) * below + EA / 2 * (deep * deep),
          at.force - EA * slope * below - EA * deep,
          at.stiffness * (1. - is_below) + EA * slope * is_below + EA * is_deep};
}

}  // namespace nurbeam
