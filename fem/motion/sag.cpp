#include "fem/motion/sag.h"

#include <algorithm>
#include <limits>

#include "nurbs/golden_section.h"

namespace nurbeam {

double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto cubic_of = [](const ElementRecord& element) { return RationalCubic(element.control_points); };
  const Eigen::Vector3d a = cubic_of(elements.front()).point(0),
                        chord = cubic_of(elements.back()).point(1) - a;
  if (gravity.norm() == 0) return none;
  const Eigen::Vector3d down = gravity.normalized(), across = chord - chord.dot(down) * down;
  if (across.norm() <= 1e-9 * std::max(chord.norm(), 1e-300)) return none;
  const auto depth = [&](const RationalCubic& cubic, double u) {
    const Eigen::Vector3d d = cubic.point(u) - a;
    return d.dot(down) - d.dot(across) / across.squaredNorm() * chord.dot(down);
  };
  std::size_t lowest = 0;
  double deepest = depth(cubic_of(elements[0]), 0.5);
  for (std::size_t i = 1; i < elements.size(); ++i)
    if (const double here = depth(cubic_of(elements[i]), 0.5); here > deepest) {
      deepest = here;
      lowest = i;
    }
  double most = 0;
  for (std::size_t i = lowest > 0 ? lowest - 1 : 0; i < std::min(lowest + 2, elements.size()); ++i) {
    const RationalCubic cubic = cubic_of(elements[i]);
    const double u = minimum_place([&](double v) { return -depth(cubic, v); }, 0, 1, 30);
    most = std::max(most, depth(cubic, u));
  }
  return most;
}

}  // namespace nurbeam
