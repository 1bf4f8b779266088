#pragma once
#include <Eigen/Core>
#include <vector>

#include "nurbs/rational_cubic.h"

namespace nurbeam {

/// The model's own frame: local = rotation * (world - origin), with the origin on the model, so that a model
/// far from the world's origin loses no digits. For a planar model (dimension 2) the plane is local z = 0.
struct ModelFrame {
  int dimension = 3;
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double off_plane = 0;       ///< of a planar model the most that has been left out, in parts of its size
  double gravity_energy = 0;  ///< of the whole mass at the origin, which the local potential leaves out [J]

  Eigen::Vector3d to_local(const Eigen::Vector3d& world) const { return rotation * (world - origin); }
  Eigen::Vector3d to_world(const Eigen::Vector3d& local) const {
    return rotation.transpose() * local + origin;
  }
  Eigen::Vector3d direction_to_world(const Eigen::Vector3d& local) const {
    return rotation.transpose() * local;
  }
  /// Of a force or an acceleration; in a planar model its part in the plane.
  Eigen::Vector3d direction_to_local(const Eigen::Vector3d& world) const;
  /// In a planar model its part normal to the plane.
  Eigen::Vector3d moment_to_local(const Eigen::Vector3d& world) const;
  /// A curve; in a planar model its projection on the plane.
  RationalCubic to_local(const RationalCubic& world) const;
};

/// The frame of a model with these axes, of at least one segment with an extent: its origin is the start of
/// the first. The model is planar when axes and `forces` (their directions; zeros count for nothing) lie in
/// one plane and `moments` are normal to it. The local z axis is the plane's normal with its largest
/// component positive; where many planes hold everything, of a line, the one that the first moment is normal
/// to, or else the one nearest to the world's x-y plane. With `torsion` it is in space whatever they are.
/// gravity_energy stays 0.
ModelFrame model_frame(const std::vector<RationalCubic>& segments, const std::vector<Eigen::Vector3d>& forces,
                       const std::vector<Eigen::Vector3d>& moments, bool torsion = false);

}  // namespace nurbeam
