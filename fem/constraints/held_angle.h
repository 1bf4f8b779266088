#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

namespace nurbeam {

/// The angle between two slopes, held as it is drawn: of two beams at a rigid joint, or of one beam before
/// and after a corner. The constraint is g(a, b) = 0 for the slopes a = r_s and b = r_s.
///
/// In the plane g = cos(theta0) a x b - sin(theta0) a . b = |a| |b| sin(theta - theta0), bilinear and regular
/// for every angle. In space g = a . b - cos(theta0) |a| |b|: beams without torsion may turn about each
/// other. The gradient in space vanishes where the slopes are parallel; no joint or corner has parallel
/// slopes.
template <int D>
class HeldAngle {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  /// Value, gradient with respect to (a, b), and second derivatives.
  struct Terms {
    double value;
    Eigen::Matrix<double, 2 * D, 1> gradient;
    Eigen::Matrix<double, 2 * D, 2 * D> hessian;
  };

  /// The angle between two unit tangents of the drawing.
  HeldAngle(const Vector& a, const Vector& b) : cosine_(a.dot(b)) {
    if constexpr (D == 2) sine_ = a.x() * b.y() - a.y() * b.x();
  }

  /// The angle between two tangents of drawings, 3 each.
  static HeldAngle drawn(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return {a.head<D>().normalized(), b.head<D>().normalized()};
  }

  /// g for any scalar, as a witness of the derivatives.
  template <class T>
  T value(const std::array<T, D>& a, const std::array<T, D>& b) const {
    using std::sqrt;
    T ab = 0.0, aa = 0.0, bb = 0.0;
    for (int i = 0; i < D; ++i) {
      ab = ab + a[i] * b[i];
      aa = aa + a[i] * a[i];
      bb = bb + b[i] * b[i];
    }
    if constexpr (D == 2) return T(cosine_) * (a[0] * b[1] - a[1] * b[0]) - T(sine_) * ab;
    return ab - T(cosine_) * sqrt(aa * bb);
  }

  /// Precondition in space: a, b not zero.
  Terms terms(const Vector& a, const Vector& b) const {
    Terms t;
    if constexpr (D == 2) {
      Eigen::Matrix2d M;
      M << -sine_, cosine_, -cosine_, -sine_;
      t.value = a.dot(M * b);
      t.gradient << M * b, M.transpose() * a;
      t.hessian << Eigen::Matrix2d::Zero(), M, M.transpose(), Eigen::Matrix2d::Zero();
    } else {
      const double A = a.norm(), B = b.norm();
      const Vector e = a / A, f = b / B;
      const auto across = [](const Vector& v) {
        return Eigen::Matrix3d(Eigen::Matrix3d::Identity() - v * v.transpose());
      };
      t.value = a.dot(b) - cosine_ * A * B;
      t.gradient << b - cosine_ * B * e, a - cosine_ * A * f;
      const Eigen::Matrix3d mixed = Eigen::Matrix3d::Identity() - cosine_ * e * f.transpose();
      t.hessian << -cosine_ * B / A * across(e), mixed, mixed.transpose(), -cosine_ * A / B * across(f);
    }
    return t;
  }

 private:
  double cosine_, sine_ = 0;
};

}  // namespace nurbeam
