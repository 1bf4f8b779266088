#include <Eigen/Dense>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/route/route_file.h"

namespace nurbeam {

namespace {

struct Area {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< its length is the area [m^2]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< [m]
};

// Five Gauss points on [0, 1]: exact for polynomials of degree 9.
constexpr double gauss_places[] = {0.046910077030668, 0.230765344947158, 0.5, 0.769234655052842,
                                   0.953089922969332};
constexpr double gauss_weights[] = {0.118463442528095, 0.239314335249683, 0.284444444444444,
                                    0.239314335249683, 0.118463442528095};

// Calls take(r - origin, dr/du, weight) at the points of a quadrature over the whole curve.
template <class Take>
void for_each_point(const NurbsCurve& curve, const Eigen::Vector3d& origin, Take take) {
  constexpr int pieces = 64;  // of each span: rational pieces converge with the tenth power
  const std::vector<double> breaks = curve.knots().breaks();
  for (std::size_t span = 0; span + 1 < breaks.size(); ++span) {
    const double width = (breaks[span + 1] - breaks[span]) / pieces;
    for (int piece = 0; piece < pieces; ++piece)
      for (int g = 0; g < 5; ++g) {
        const Eigen::Matrix3Xd d = curve.derivatives(breaks[span] + width * (piece + gauss_places[g]), 1);
        take(Eigen::Vector3d(d.col(0) - origin), Eigen::Vector3d(d.col(1)), width * gauss_weights[g]);
      }
  }
}

// By Stokes: the normal is half the integral of r x dr, and the centre a third of that of r (r x dr).n over
// twice the area.
Area area_inside(const NurbsCurve& curve) {
  const Eigen::Vector3d origin = curve.point(curve.knots().start());
  Area area;
  for_each_point(curve, origin, [&](const Eigen::Vector3d& r, const Eigen::Vector3d& slope, double weight) {
    area.normal += 0.5 * weight * r.cross(slope);
  });
  const Eigen::Vector3d n = area.normal.normalized();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  for_each_point(curve, origin, [&](const Eigen::Vector3d& r, const Eigen::Vector3d& slope, double weight) {
    moment += weight * r * r.cross(slope).dot(n) / 3;
  });
  area.centre = origin + moment / area.normal.norm();
  return area;
}

RouteEnd centre_of(const NurbsCurve& curve) {
  constexpr double relative = 1e-6;
  const double size = length(curve);
  if (!is_closed(curve, relative * size))
    throw std::invalid_argument(
        "is not closed, and only a closed curve has a centre; take its \"start\" or its \"end\"");
  const Area area = area_inside(curve);
  if (!(area.normal.norm() > relative * size * size))
    throw std::invalid_argument("has no area inside; take a curve that goes round a face");
  const Eigen::Vector3d n = area.normal.normalized();
  double off = 0;
  for_each_point(curve, area.centre, [&](const Eigen::Vector3d& r, const Eigen::Vector3d&, double) {
    off = std::max(off, std::abs(r.dot(n)));
  });
  if (off > relative * size)
    throw std::invalid_argument("does not lie in a plane: it is " + text_of(off, 3) +
                                " m off; take a curve that goes round a plane face");
  return {area.centre, n};
}

}  // namespace

RouteEnd end_at(const NurbsCurve& curve, const std::string& place) {
  if (place == "centre") return centre_of(curve);
  const bool at_start = place == "start";
  const double u = at_start ? curve.knots().start() : curve.knots().end();
  const Eigen::Matrix3Xd d = curve.derivatives(u, 1);
  return {d.col(0), at_start ? -d.col(1).normalized() : d.col(1).normalized()};
}

}  // namespace nurbeam
