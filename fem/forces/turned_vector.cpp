#include "fem/forces/turned_vector.h"

#include <Eigen/Geometry>

namespace nurbeam {

TurnedVector turned_with_tangent(const Eigen::Vector3d& p, const Eigen::Vector3d& drawn_tangent,
                                 const Eigen::Vector3d& rs) {
  const double norm = rs.norm();
  const Eigen::Vector3d t = rs / norm, &t0 = drawn_tangent;
  const Eigen::Matrix3d dt = (Eigen::Matrix3d::Identity() - t * t.transpose()) / norm;
  const bool planar = rs.z() == 0 && t0.z() == 0;
  if (planar) {
    // R(theta) p with cos = t0.t, sin = t0 x t: linear in t, regular for every angle.
    const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
    const Eigen::Vector3d flat(p.x(), p.y(), 0), across = z.cross(flat);
    const Eigen::Vector3d z_t0 = z.cross(t0);
    Eigen::Vector3d value = t0.dot(t) * flat + z_t0.dot(t) * across;
    const Eigen::Matrix3d by_t = flat * t0.transpose() + across * z_t0.transpose();
    value.z() = p.z();
    return {value, by_t * dt};
  }
  // Rodrigues with w = t0 x t, |w| = sin: R p = p + w x p + w x (w x p)/(1 + cos).
  const double c = 1 + t0.dot(t);
  const Eigen::Vector3d w = t0.cross(t), wp = w.cross(p), wwp = w.cross(wp);
  Eigen::Matrix3d by_t;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d d = Eigen::Vector3d::Unit(i), dw = t0.cross(d);
    by_t.col(i) = dw.cross(p) + (dw.cross(wp) + w.cross(dw.cross(p))) / c - wwp * (t0.dot(d) / (c * c));
  }
  return {p + wp + wwp / c, by_t * dt};
}

}  // namespace nurbeam
