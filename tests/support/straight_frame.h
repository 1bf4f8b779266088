#pragma once
#include <Eigen/Dense>
#include <algorithm>
#include <vector>

namespace nurbeam::testing {

/// A linear frame in space of straight elements with 12 degrees of freedom (Przemieniecki, Theory of Matrix
/// Structural Analysis, 5.6), of round or tubular sections: shares no code with the beams it is a witness of.
struct StraightFrame {
  double EA, EI, GJ;
  std::vector<Eigen::Vector3d> nodes;  ///< [m], each joined to the next

  /// Displacements and rotations of the nodes under a force per length [N/m], both ends clamped.
  Eigen::VectorXd solve(const Eigen::Vector3d& force_per_length) const {
    const int n = static_cast<int>(nodes.size());
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6 * n, 6 * n);
    Eigen::VectorXd F = Eigen::VectorXd::Zero(6 * n);
    for (int i = 0; i + 1 < n; ++i) {
      K.block<12, 12>(6 * i, 6 * i) += stiffness(nodes[i], nodes[i + 1]);
      F.segment<12>(6 * i) += load(nodes[i], nodes[i + 1], force_per_length);
    }
    const int inner = 6 * (n - 2);
    Eigen::VectorXd u = Eigen::VectorXd::Zero(6 * n);
    u.segment(6, inner) = K.block(6, 6, inner, inner).ldlt().solve(F.segment(6, inner));
    return u;
  }

  /// Force and moment that the first node's clamp gives.
  Eigen::Matrix<double, 6, 1> start_reaction(const Eigen::Vector3d& force_per_length) const {
    const Eigen::VectorXd u = solve(force_per_length);
    return (stiffness(nodes[0], nodes[1]) * u.head<12>() - load(nodes[0], nodes[1], force_per_length))
        .head<6>();
  }

  /// The largest displacement of a node.
  double sag(const Eigen::Vector3d& force_per_length) const {
    const Eigen::VectorXd u = solve(force_per_length);
    double largest = 0;
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i)
      largest = std::max(largest, u.segment<3>(6 * i).norm());
    return largest;
  }

 private:
  using Matrix12 = Eigen::Matrix<double, 12, 12>;

  // Rows: the element's own axes, x along it.
  static Matrix12 to_own_axes(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    Eigen::Matrix3d R;
    R.row(0) = (b - a).normalized();
    R.row(1) = R.row(0).unitOrthogonal();
    R.row(2) = R.row(0).cross(R.row(1));
    Matrix12 T = Matrix12::Zero();
    for (int i = 0; i < 4; ++i) T.block<3, 3>(3 * i, 3 * i) = R;
    return T;
  }

  Matrix12 stiffness(const Eigen::Vector3d& a, const Eigen::Vector3d& b) const {
    const double L = (b - a).norm();
    Matrix12 k = Matrix12::Zero();
    const auto spring = [&](int i, int j, double value) {
      k(i, i) += value;
      k(j, j) += value;
      k(i, j) -= value;
      k(j, i) -= value;
    };
    spring(0, 6, EA / L);
    spring(3, 9, GJ / L);
    // Bending: displacement v and rotation of both ends; about z with v = y, about y with v = z and the
    // rotation reversed.
    const double c[4][4] = {{12, 6 * L, -12, 6 * L},
                            {6 * L, 4 * L * L, -6 * L, 2 * L * L},
                            {-12, -6 * L, 12, -6 * L},
                            {6 * L, 2 * L * L, -6 * L, 4 * L * L}};
    const int about_z[] = {1, 5, 7, 11}, about_y[] = {2, 4, 8, 10};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const double value = EI / (L * L * L) * c[i][j];
        const double sign = i % 2 == j % 2 ? 1 : -1;
        k(about_z[i], about_z[j]) += value;
        k(about_y[i], about_y[j]) += sign * value;
      }
    const Matrix12 T = to_own_axes(a, b);
    return T.transpose() * k * T;
  }

  // Half the force at each end, and the moments of a clamped span.
  static Eigen::Matrix<double, 12, 1> load(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                           const Eigen::Vector3d& force_per_length) {
    const Eigen::Vector3d chord = b - a;
    Eigen::Matrix<double, 12, 1> F;
    const Eigen::Vector3d half = force_per_length * chord.norm() / 2,
                          moment = chord.cross(force_per_length) * chord.norm() / 12;
    F << half, moment, half, -moment;
    return F;
  }
};

}  // namespace nurbeam::testing
