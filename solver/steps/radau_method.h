#pragma once
#include <Eigen/Core>
#include <complex>

namespace nurbeam {

/// Coefficients of the Radau IIA method of three stages (Hairer & Wanner, Solving ODEs II, IV.5 and IV.8).
struct RadauMethod {
  static constexpr int stages = 3;
  using Row = Eigen::RowVector3d;

  Eigen::Vector3d c;             ///< times of the stages in steps, the last 1
  Eigen::Matrix3d a, a_squared;  ///< a(i, j): integral of the j-th Lagrange polynomial up to c_i
  /// Eigenvalues of `a`: a real one, and one of two that are conjugate; with them a = sum over all three of
  /// to * gamma * from.
  double gamma = 0;
  std::complex<double> gamma_c;
  Eigen::Vector3d to;
  Eigen::Vector3cd to_c;
  Row from;
  Eigen::RowVector3cd from_c;
  /// Of the stages, beside gamma of the start: a formula of order three less the method.
  Row error;

  RadauMethod();
  /// Weights of values at the stages in their polynomial, x steps after the start.
  Row weights(double x) const;
};

/// The only one there is.
const RadauMethod& radau_method();

}  // namespace nurbeam
