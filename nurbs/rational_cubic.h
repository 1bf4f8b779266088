#pragma once
#include <Eigen/Core>
#include <array>
#include <utility>

namespace nurbeam {

/// Four homogeneous control points on u in [0,1]: the common tongue of CAD and FEM.
///
/// Column i of `points` is (w_i P_i, w_i), P_i in metres, w_i > 0. r(u) = sum B_i(u) w_i P_i / W(u),
/// W(u) = sum B_i(u) w_i (Ding & Ouyang Eqs. 1-3 with n = 3).
class RationalCubic {
 public:
  /// Throws std::invalid_argument unless all values are finite and all weights positive.
  explicit RationalCubic(const Eigen::Matrix4d& points);

  const Eigen::Matrix4d& points() const { return points_; }
  /// Weight i.
  double weight(int i) const { return points_(3, i); }
  /// Plain control point P_i [m].
  Eigen::Vector3d control_point(int i) const;
  /// r(u), 3 [m]. u outside [0,1] extrapolates as long as W(u) > 0.
  Eigen::Vector3d point(double u) const;
  /// d^k r/du^k for k = 0..5 (columns), 3 x 6.
  Eigen::Matrix<double, 3, 6> derivatives(double u) const;
  /// What charts need, in one go.
  struct WeightedDerivatives {
    std::array<Eigen::Vector3d, 4> r;  ///< d^k r/du^k for k = 1..4
    std::array<double, 4> weight;      ///< d^k W/du^k for k = 0..3
  };
  WeightedDerivatives weighted_derivatives(double u) const;
  /// Bernstein coefficients of W(u)^2 r'(u), a quartic: 3 x 5. Made of differences of control points, so they
  /// keep their digits far from the origin (Floater 1992, "Derivatives of rational Bezier curves").
  Eigen::Matrix<double, 3, 5> hodograph() const;
  /// The two halves at u in (0,1) (de Casteljau in homogeneous coordinates), each again on [0,1].
  std::pair<RationalCubic, RationalCubic> split(double u) const;
  /// The piece on [u0, u1], 0 <= u0 < u1 <= 1, again on [0,1].
  RationalCubic piece(double u0, double u1) const;
  RationalCubic reversed() const;

 private:
  Eigen::Matrix4d points_;
};

}  // namespace nurbeam
