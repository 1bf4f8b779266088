#include "cad_import/ifc/fillets.h"

#include <Eigen/Geometry>
#include <cmath>
#include <stdexcept>

#include "cad_import/ifc/conic_curve.h"

namespace nurbeam {
namespace {

NurbsCurve line(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  Eigen::Matrix3Xd ends(3, 2);
  ends << from, to;
  return make_nurbs_curve(KnotVector(1, {0, 0, 1, 1}), ends, Eigen::VectorXd::Ones(2));
}

/// From a place on, in a direction that turns by an angle about a normal.
NurbsCurve arc(const Eigen::Vector3d& start, const Eigen::Vector3d& along, const Eigen::Vector3d& normal,
               double radius, double angle) {
  const Eigen::Vector3d to_centre = normal.cross(along);
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.linear() << -to_centre, along, normal;
  place.translation() = start + radius * to_centre;
  return conic_curve(Eigen::Vector2d::Constant(radius), 0, angle, place);
}

}  // namespace

std::vector<NurbsCurve> with_fillets(const NurbsCurve& polyline, double radius) {
  const Eigen::Matrix3Xd points = polyline.control_points().colwise().hnormalized();
  std::vector<NurbsCurve> curves;
  Eigen::Vector3d from = points.col(0);
  const auto add_line = [&](const Eigen::Vector3d& to, const Eigen::Vector3d& along) {
    const double left = (to - from).dot(along);
    if (left < -1e-9 * radius) throw std::runtime_error("there is no room for its fillet radius at a corner");
    if (left > 1e-9 * radius) curves.push_back(line(from, to));
  };
  for (Eigen::Index i = 1; i < points.cols(); ++i) {
    const Eigen::Vector3d in = (points.col(i) - points.col(i - 1)).normalized();
    if (i + 1 == points.cols()) {
      add_line(points.col(i), in);
      break;
    }
    const Eigen::Vector3d out = (points.col(i + 1) - points.col(i)).normalized(), normal = in.cross(out);
    const double angle = std::atan2(normal.norm(), in.dot(out));
    if (!(angle > 1e-9)) continue;
    const double cut = radius * std::tan(angle / 2);
    const Eigen::Vector3d begin = points.col(i) - cut * in;
    add_line(begin, in);
    curves.push_back(arc(begin, in, normal.normalized(), radius, angle));
    from = points.col(i) + cut * out;
  }
  return curves;
}

}  // namespace nurbeam
