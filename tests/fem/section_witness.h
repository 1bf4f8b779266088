#pragma once
#include <Eigen/Geometry>

/// Sections by quaternions and rotation vectors: shares no code with those of beams, and is their witness.
namespace nurbeam::testing {

/// A drawn section (columns d1, d2, t) carried to the direction of `slope` by the smallest rotation and then
/// turned about it by an angle [rad].
inline Eigen::Matrix3d turned_section(const Eigen::Matrix3d& drawn, const Eigen::Vector3d& slope,
                                      double angle) {
  const Eigen::Vector3d t = slope.normalized();
  return Eigen::AngleAxisd(angle, t).toRotationMatrix() *
         Eigen::Quaterniond::FromTwoVectors(drawn.col(2), t).toRotationMatrix() * drawn;
}

/// Axis times angle of a rotation [rad].
inline Eigen::Vector3d rotation_vector(const Eigen::Matrix3d& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  return turn.angle() * turn.axis();
}

/// The angle of a section in the chart of another one: of the turn that is left after the smallest rotation.
inline double angle_of(const Eigen::Matrix3d& section, const Eigen::Matrix3d& drawn) {
  const Eigen::Matrix3d carried = turned_section(drawn, section.col(2), 0);
  return rotation_vector(section * carried.transpose()).dot(section.col(2));
}

}  // namespace nurbeam::testing
