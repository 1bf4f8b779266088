#pragma once
#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

namespace nurbeam {

/// Accelerations that act on all mass besides even gravity: in a frame that turns, near a body that attracts.
///
/// With d = r - about, the acceleration of what is at r and moves at v in the frame is
///   -2 w x v - w x (w x d) - |w|^2 (d - 3 x x.d) - mu (r - centre)/|r - centre|^3,
/// the third part where a direction `radial` = x is given (a frame on a circular orbit, Hill's equations),
/// the fourth where a `centre` is.
struct MassField {
  Eigen::Vector3d rate = Eigen::Vector3d::Zero();    ///< w of the frame [rad/s]
  Eigen::Vector3d about = Eigen::Vector3d::Zero();   ///< a point of the axis of its rotation [m]
  std::optional<Eigen::Vector3d> radial = {};        ///< unit vector away from what is orbited
  double attraction = 0;                             ///< mu [m^3/s^2]
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the body that attracts [m]

  /// Of what rests in the frame [m/s^2].
  Eigen::Vector3d at_rest(const Eigen::Vector3d& r) const {
    const Eigen::Vector3d d = r - about;
    Eigen::Vector3d a = -rate.cross(rate.cross(d));
    if (radial) a -= rate.squaredNorm() * (d - 3 * *radial * radial->dot(d));
    if (attraction != 0) a -= attraction / std::pow((r - centre).norm(), 3) * (r - centre);
    return a;
  }
  /// Its derivative by r [1/s^2].
  Eigen::Matrix3d gradient(const Eigen::Vector3d& r) const {
    const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
    Eigen::Matrix3d K = rate.squaredNorm() * one - rate * rate.transpose();
    if (radial) K -= rate.squaredNorm() * (one - 3 * *radial * radial->transpose());
    if (attraction != 0) {
      const Eigen::Vector3d d = r - centre;
      const double square = d.squaredNorm();
      K -= attraction / std::pow(square, 1.5) * (one - 3 / square * d * d.transpose());
    }
    return K;
  }
  /// The part of the acceleration that goes with the velocity is this matrix times it [1/s].
  Eigen::Matrix3d by_velocity() const {
    Eigen::Matrix3d W;
    W << 0, -rate.z(), rate.y(), rate.z(), 0, -rate.x(), -rate.y(), rate.x(), 0;
    return -2 * W;
  }
  /// The potential per mass of what rests, of which at_rest() is the negative gradient [J/kg].
  double potential(const Eigen::Vector3d& r) const {
    const Eigen::Vector3d d = r - about;
    double sum = -rate.cross(d).squaredNorm() / 2;
    if (radial) sum += rate.squaredNorm() / 2 * (d.squaredNorm() - 3 * std::pow(radial->dot(d), 2));
    if (attraction != 0) sum -= attraction / (r - centre).norm();
    return sum;
  }
};

}  // namespace nurbeam
