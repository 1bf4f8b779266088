#pragma once
#include <Eigen/Core>
#include <complex>

namespace nurbeam {

/// Coefficients of the Radau IIA method of three stages (Hairer & Wanner, Solving ODEs II, IV.5 and IV.8).
struct RadauMethod {
  static constexpr int stages = 3;
  using Row = Eigen::RowVector3d;

  Eigen::Vector3d c;             ///< times of the stages in units of the step, the last one 1
  Eigen::Matrix3d a, a_squared;  ///< a(i, j): integral of the j-th Lagrange polynomial up to c_i
  /// Eigenvalues of `a`: a real one, and one of a conjugate pair. With them a = sum over all three of to *
  /// gamma * from.
  double gamma = 0;
  std::complex<double> gamma_c;
  Eigen::Vector3d to;
  Eigen::Vector3cd to_c;
  Row from;
  Eigen::RowVector3cd from_c;
  /// Weights of the stages, beside gamma of the start, in a formula of order three less the method.
  Row error;

  RadauMethod();
  /// Weights of values at the stages in their polynomial, x steps after the start.
  Row weights(double x) const;
};

/// The one instance of the method.
const RadauMethod& radau_method();

}  // namespace nurbeam
