#pragma once
#include "fem/element/twist_kinematics.h"
#include "solver/system/second_order_system.h"

/// The inertia of the spin of sections about their tangents.
namespace nurbeam::twist {

/// The spin w = theta' + c . r_s' of the node at an end, and its rate; turn = (dt/dt x t)/|r_s|. For a
/// momentum p of the spin the forces are p' on the angle and c p' + p turn on the slope.
template <class T>
struct NodeSpin {
  Vector3<T> c, turn;
  T spin, rate;

  template <class Vector>
  NodeSpin(const Eigen::Matrix3d& chart, int end, const Vector& q, const Vector& v, const Vector& a) {
    using std::sqrt;
    const int i = slope_of(end), k = angle_of(end);
    const Vector3<T> rs = q.template segment<3>(i), rs_rate = v.template segment<3>(i),
                     rs_second = a.template segment<3>(i);
    const Vector3<Dual<1, T>> moving_c = spin_row<Dual<1, T>>(chart, moving<T, 3>(rs, rs_rate));
    Vector3<T> c_rate;
    for (int d = 0; d < 3; ++d) {
      c[d] = moving_c[d].value;
      c_rate[d] = moving_c[d].d[0];
    }
    spin = v[k] + c.dot(rs_rate);
    rate = a[k] + c.dot(rs_second) + c_rate.dot(rs_rate);
    const T square = rs.dot(rs);
    turn = rs_rate.cross(rs) / (square * sqrt(square));
  }

  template <class Vector>
  void add_force(int end, const T& p, const T& p_rate, Vector& force) const {
    force.template segment<3>(slope_of(end)) += c * p_rate + turn * p;
    force[angle_of(end)] += p_rate;
  }
};

/// The tangent of the inertia with fixed ends; `mass`: for the spins of both ends and the bubble's rate.
Eigen::Matrix<double, reduced, reduced> spin_tangent(const std::array<Eigen::Matrix3d, 2>& charts,
                                                     const Eigen::Matrix3d& mass, const Reduced<double>& q,
                                                     const Reduced<double>& v, const Reduced<double>& a,
                                                     const TangentWeights& w);

}  // namespace nurbeam::twist
