#include "fem/motion/sag.h"

#include <algorithm>
#include <limits>

#include "nurbs/golden_section.h"

namespace nurbeam {

double sag(const std::vector<ElementRecord>& elements, const Eigen::Vector3d& gravity) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<RationalCubic> cubics;
  for (const ElementRecord& element : elements) cubics.emplace_back(element.control_points);
  const Eigen::Vector3d a = cubics.front().point(0), chord = cubics.back().point(1) - a;
  if (gravity.norm() == 0) return none;
  const Eigen::Vector3d down = gravity.normalized(), across = chord - chord.dot(down) * down;
  if (across.norm() <= 1e-9 * std::max(chord.norm(), 1e-300)) return none;
  const auto depth = [&](const RationalCubic& cubic, double u) {
    const Eigen::Vector3d d = cubic.point(u) - a;
    return d.dot(down) - d.dot(across) / across.squaredNorm() * chord.dot(down);
  };
  std::size_t lowest = 0;
  for (std::size_t i = 1; i < cubics.size(); ++i)
    if (depth(cubics[i], 0.5) > depth(cubics[lowest], 0.5)) lowest = i;
  double most = 0;
  for (std::size_t i = lowest > 0 ? lowest - 1 : 0; i < std::min(lowest + 2, cubics.size()); ++i) {
    const double u = minimum_place([&](double v) { return -depth(cubics[i], v); }, 0, 1, 30);
    most = std::max(most, depth(cubics[i], u));
  }
  return most;
}

}  // namespace nurbeam
