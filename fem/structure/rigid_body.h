#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>

namespace nurbeam {

/// What makes a body a rigid one, which turns: without it the body is a point mass. Its own axes are those of
/// the model as it is drawn.
struct RigidBody {
  Eigen::Matrix3d inertia;  ///< about the centre of mass, along its own axes [kg m^2]
  /// From the drawing to the start, and the spin at the start along the axes of the model [rad/s].
  Eigen::Quaterniond attitude = Eigen::Quaterniond::Identity();
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotor = Eigen::Vector3d::Zero();  ///< angular momentum of a part that spins in it [N m s]
  /// Columns: axes along which accelerations are told, along its own axes.
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
};

/// A place of a rigid body, which is a body without mass itself.
struct BodyPoint {
  int body;             ///< the rigid body
  Eigen::Vector3d arm;  ///< from its centre of mass, along its own axes [m]
};

}  // namespace nurbeam
