#include "cad_import/ifc/conic_curve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nurbeam {

NurbsCurve conic_curve(const Eigen::Vector2d& radii, double first, double last,
                       const Eigen::Affine3d& place) {
  constexpr double largest = 2 * std::numbers::pi / 3;  // of a piece
  const int pieces = std::max(1, static_cast<int>(std::ceil((last - first) / largest - 1e-12)));
  const double half = (last - first) / (2 * pieces), weight = std::cos(half);
  std::vector<double> knots(3, first);
  Eigen::Matrix4Xd points(4, 2 * pieces + 1);
  for (int i = 0; i <= 2 * pieces; ++i) {
    const double angle = first + i * half, out = i % 2 == 0 ? 1 : 1 / weight;
    const Eigen::Vector3d at(out * radii.x() * std::cos(angle), out * radii.y() * std::sin(angle), 0);
    const double own = i % 2 == 0 ? 1 : weight;
    points.col(i) << own * (place * at), own;
    if (i % 2 == 0 && i > 0 && i < 2 * pieces) knots.insert(knots.end(), 2, angle);
  }
  knots.insert(knots.end(), 3, last);
  return {KnotVector(2, knots), points};
}

}  // namespace nurbeam
