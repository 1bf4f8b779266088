#include "fem/element/twist_inertia.h"

#include "fem/element/cross_matrix.h"

namespace nurbeam::twist {

namespace {

// The coordinates (r_s, angle) of an end.
Eigen::Vector4d node_part(const Reduced<double>& x, int end) {
  const int i = slope_of(end);
  return {x[i], x[i + 1], x[i + 2], x[angle_of(end)]};
}

// NodeSpin with its derivatives: c = -(m x r_s)/d, d = |r_s|^2 + |r_s| r_s . m.
struct VaryingSpin {
  double rate, second;
  Eigen::Vector3d c, turn;
  Eigen::Vector3d rate_rs, second_rs,
      second_v;  // derivatives by r_s and r_s'; by the angles' rates they are 1, and by r_s'' they are c
  Eigen::Matrix3d c_rs, turn_rs, turn_v;

  VaryingSpin(const Eigen::Matrix3d& chart, const Eigen::Vector4d& q, const Eigen::Vector4d& velocity,
              const Eigen::Vector4d& acceleration) {
    const Eigen::Vector3d m = chart.col(2), rs = q.head<3>(), v = velocity.head<3>(),
                          a = acceleration.head<3>();
    const double square = rs.squaredNorm(), n = std::sqrt(square), cubed = square * n, along = rs.dot(m);
    const Eigen::Vector3d t = rs / n;
    const double d = square + n * along;
    const Eigen::Vector3d d_rs = 2 * rs + along * t + n * m;
    const double d_v = d_rs.dot(v);
    const Eigen::Vector3d d_rs_v = 2 * v + t.dot(v) * m + along / n * (v - t.dot(v) * t) + m.dot(v) * t;
    c = rs.cross(m) / d;
    c_rs = -(cross_matrix(m) + c * d_rs.transpose()) / d;
    const double c_v = c.dot(v);
    rate = velocity[3] + c_v;
    rate_rs = c_rs.transpose() * v;
    second = acceleration[3] + c.dot(a) - c_v * d_v / d;
    second_rs = c_rs.transpose() * a - (d_v * rate_rs + c_v * d_rs_v - c_v * d_v / d * d_rs) / d;
    second_v = c_rs * v + rate_rs;
    turn = v.cross(rs) / cubed;
    turn_rs = cross_matrix(v) / cubed - 3 / square * turn * rs.transpose();
    turn_v = -cross_matrix(rs) / cubed;
  }
};

}  // namespace

Eigen::Matrix<double, reduced, reduced> spin_tangent(const std::array<Eigen::Matrix3d, 2>& charts,
                                                     const Eigen::Matrix3d& mass, const Reduced<double>& q,
                                                     const Reduced<double>& v, const Reduced<double>& a,
                                                     const TangentWeights& w) {
  using Rows = Eigen::Matrix<double, 3, reduced>;
  const std::array<VaryingSpin, 2> nodes{
      VaryingSpin(charts[0], node_part(q, 0), node_part(v, 0), node_part(a, 0)),
      VaryingSpin(charts[1], node_part(q, 1), node_part(v, 1), node_part(a, 1))};
  Rows spins_x = Rows::Zero(), second_x = Rows::Zero();
  for (const int end : {0, 1}) {
    const VaryingSpin& node = nodes[end];
    const int i = slope_of(end), k = angle_of(end);
    spins_x.block<1, 3>(end, i) = (w.stiffness * node.rate_rs + w.damping * node.c).transpose();
    spins_x(end, k) = w.damping;
    second_x.block<1, 3>(end, i) =
        (w.stiffness * node.second_rs + w.damping * node.second_v + w.mass * node.c).transpose();
    second_x(end, k) = w.mass;
  }
  spins_x(2, bubble) = w.damping;
  second_x(2, bubble) = w.mass;
  const Eigen::Vector3d p = mass * Eigen::Vector3d(nodes[0].rate, nodes[1].rate, v[bubble]);
  const Eigen::Vector3d p_rate = mass * Eigen::Vector3d(nodes[0].second, nodes[1].second, a[bubble]);
  const Rows p_x = mass * spins_x, p_rate_x = mass * second_x;
  Eigen::Matrix<double, reduced, reduced> K = Eigen::Matrix<double, reduced, reduced>::Zero();
  for (const int end : {0, 1}) {
    const VaryingSpin& node = nodes[end];
    const int i = slope_of(end);
    K.middleRows<3>(i) = node.c * p_rate_x.row(end) + node.turn * p_x.row(end);
    K.block<3, 3>(i, i) +=
        w.stiffness * (p_rate[end] * node.c_rs + p[end] * node.turn_rs) + w.damping * p[end] * node.turn_v;
    K.row(angle_of(end)) = p_rate_x.row(end);
  }
  K.row(bubble) = p_rate_x.row(2);
  return K;
}

}  // namespace nurbeam::twist
