#include "pipelines/model/model_frame.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

constexpr double flat =
    1e-9;  // what is no further off a plane or line, in parts of the model's size, is in it

// Unit vectors along those that are not zero.
std::vector<Eigen::Vector3d> directions(const std::vector<Eigen::Vector3d>& vectors) {
  std::vector<Eigen::Vector3d> found;
  for (const Eigen::Vector3d& v : vectors)
    if (v.norm() > 0) found.push_back(v.stableNormalized());
  return found;
}

Eigen::Vector3d plane_normal(const std::vector<Eigen::Vector3d>& in_plane,
                             const std::vector<Eigen::Vector3d>& moments) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& v : in_plane) spread += v * v.transpose();
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(spread, Eigen::ComputeFullU);
  const Eigen::Vector3d along = svd.matrixU().col(0);
  // Of each by itself: the round-off of a sum of squares hides what is off the line.
  const bool line = std::all_of(in_plane.begin(), in_plane.end(),
                                [&](const Eigen::Vector3d& v) { return v.cross(along).norm() <= flat; });
  Eigen::Vector3d normal = svd.matrixU().col(2);
  if (line) {
    // Everything on one line: any plane through it; the one a moment asks for, else the one nearest to x-y.
    Eigen::Vector3d wanted = moments.empty() ? Eigen::Vector3d::UnitZ() : moments.front();
    if (wanted.cross(along).norm() < 1e-6) wanted = Eigen::Vector3d::UnitY();
    normal = (wanted - wanted.dot(along) * along).normalized();
  }
  // Clean round-off so that a plane of two axes is exactly that plane.
  for (int i = 0; i < 3; ++i)
    if (std::abs(normal[i]) < 1e-12) normal[i] = 0;
  normal.normalize();
  int largest;
  normal.cwiseAbs().maxCoeff(&largest);
  return normal[largest] > 0 ? normal : Eigen::Vector3d(-normal);
}

}  // namespace

Eigen::Vector3d ModelFrame::direction_to_local(const Eigen::Vector3d& world) const {
  Eigen::Vector3d local = rotation * world;
  if (dimension == 2) local.z() = 0;
  return local;
}

Eigen::Vector3d ModelFrame::moment_to_local(const Eigen::Vector3d& world) const {
  Eigen::Vector3d local = rotation * world;
  if (dimension == 2) local.head<2>().setZero();
  return local;
}

RationalCubic ModelFrame::to_local(const RationalCubic& world) const {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector3d p = to_local(world.control_point(i));
    if (dimension == 2) p.z() = 0;
    points.col(i) << world.weight(i) * p, world.weight(i);
  }
  return RationalCubic(points);
}

ModelFrame model_frame(const std::vector<RationalCubic>& segments, const std::vector<Eigen::Vector3d>& forces,
                       const std::vector<Eigen::Vector3d>& moments, bool torsion) {
  const Eigen::Vector3d origin = segments.front().control_point(0);
  double size = 0;
  for (const RationalCubic& cubic : segments)
    for (int i = 0; i < 4; ++i) size = std::max(size, (cubic.control_point(i) - origin).norm());
  std::vector<Eigen::Vector3d> in_plane;
  for (const RationalCubic& cubic : segments)
    for (int i = 0; i < 4; ++i) in_plane.push_back((cubic.control_point(i) - origin) / size);
  const std::vector<Eigen::Vector3d> along_forces = directions(forces), across = directions(moments);
  in_plane.insert(in_plane.end(), along_forces.begin(), along_forces.end());

  const Eigen::Vector3d normal = plane_normal(in_plane, across);
  double off = 0;
  for (const Eigen::Vector3d& v : in_plane) off = std::max(off, std::abs(v.dot(normal)));
  for (const Eigen::Vector3d& v : across) off = std::max(off, v.cross(normal).norm());
  const bool planar = !torsion && off <= flat;
  ModelFrame frame;
  frame.dimension = planar ? 2 : 3;
  frame.origin = origin;
  if (planar) {
    frame.off_plane = off;
    const Eigen::Vector3d ahead =
        std::abs(normal.x()) < 0.9 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitY();
    const Eigen::Vector3d e1 = (ahead - ahead.dot(normal) * normal).normalized();
    frame.rotation.row(0) = e1;
    frame.rotation.row(1) = normal.cross(e1);
    frame.rotation.row(2) = normal;
  }
  return frame;
}

}  // namespace nurbeam
