#include "cad_import/iges/hyperbola.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <IGESGeom_ConicArc.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_GTrsf.hxx>
#include <gp_Pnt2d.hxx>
#include <gp_XYZ.hxx>
#include <stdexcept>

namespace nurbeam {
namespace {

/// x^T M x = 0 of homogeneous points (x, y, 1), in units of `size`.
Eigen::Matrix3d matrix_of(const IGESGeom_ConicArc& entity, double size) {
  double a = 0, b = 0, c = 0, d = 0, e = 0, f = 0;
  entity.Equation(a, b, c, d, e, f);
  a *= size * size;
  b *= size * size / 2;
  c *= size * size;
  d *= size / 2;
  e *= size / 2;
  Eigen::Matrix3d m;
  m << a, b, d, b, c, e, d, e, f;
  return m / m.cwiseAbs().maxCoeff();
}

}  // namespace

NurbsCurve hyperbola_arc(const IGESGeom_ConicArc& entity, double unit) {
  const gp_Pnt2d first = entity.StartPoint(), last = entity.EndPoint();
  const double size =
      std::max({std::abs(first.X()), std::abs(first.Y()), std::abs(last.X()), std::abs(last.Y())});
  if (!(size > 0 && std::isfinite(size))) throw std::runtime_error("its ends are no two points");
  const Eigen::Vector3d start(first.X() / size, first.Y() / size, 1),
      end(last.X() / size, last.Y() / size, 1);
  const Eigen::Matrix3d m = matrix_of(entity, size);
  constexpr double digits = 1e-4;  // of the ends, as files round them
  const auto is_on = [&](const Eigen::Vector3d& x) {
    return std::abs(x.dot(m * x)) <= digits * x.norm() * (m * x).norm();
  };
  // The tangents meet in the pole of the chord; the weight there puts the arc on the conic.
  const Eigen::Vector3d pole = m.fullPivLu().solve(start.cross(end));
  const Eigen::Vector3d meeting = pole / pole.z();
  const double weight_squared = -start.dot(m * end) / (2 * meeting.dot(m * meeting));
  if (!is_on(start) || !is_on(end) || !meeting.allFinite() || !(weight_squared > 0))
    throw std::runtime_error("its ends are not on one branch of the hyperbola");
  const double weight = std::sqrt(weight_squared);

  Eigen::Matrix4Xd points(4, 3);
  const std::array<Eigen::Vector3d, 3> plane{start, meeting, end};
  for (int i = 0; i < 3; ++i) {
    gp_XYZ place(size * plane[i].x(), size * plane[i].y(), entity.ZPlane());
    entity.CompoundLocation().Transforms(place);
    const double w = i == 1 ? weight : 1;
    points.col(i) << w * unit * Eigen::Vector3d(place.X(), place.Y(), place.Z()), w;
  }
  return {KnotVector(2, {0, 0, 0, 1, 1, 1}), std::move(points)};
}

}  // namespace nurbeam
