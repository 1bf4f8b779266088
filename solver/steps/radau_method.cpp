#include "solver/steps/radau_method.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <cmath>

namespace nurbeam {

namespace {

/// The weights w with sum_j w_j c_j^k = moments_k for k = 0, 1, 2.
RadauMethod::Row quadrature(const Eigen::Vector3d& c, const RadauMethod::Row& moments) {
  Eigen::Matrix3d powers;
  powers << Eigen::Vector3d::Ones(), c, c.cwiseAbs2();
  return powers.transpose().partialPivLu().solve(moments.transpose()).transpose();
}

}  // namespace

RadauMethod::RadauMethod() {
  const double root = std::sqrt(6.0);
  c = {(4 - root) / 10, (4 + root) / 10, 1};
  for (int i = 0; i < stages; ++i)
    a.row(i) = quadrature(c, {c[i], std::pow(c[i], 2) / 2, std::pow(c[i], 3) / 3});
  a_squared = a * a;
  const Eigen::EigenSolver<Eigen::Matrix3d> eigen(a);
  const Eigen::Matrix3cd vectors = eigen.eigenvectors(), inverse = vectors.inverse();
  for (int k = 0; k < stages; ++k) {
    const std::complex<double> value = eigen.eigenvalues()[k];
    if (value.imag() > 0) {
      gamma_c = value;
      to_c = vectors.col(k);
      from_c = inverse.row(k);
    } else if (value.imag() == 0) {
      gamma = value.real();
      to = vectors.col(k).real();
      from = inverse.row(k).real();
    }
  }
  error = quadrature(c, {1 - gamma, 1.0 / 2, 1.0 / 3}) - a.row(stages - 1);
}

RadauMethod::Row RadauMethod::weights(double x) const { return quadrature(c, {1, x, x * x}); }

const RadauMethod& radau_method() {
  static const RadauMethod method;
  return method;
}

}  // namespace nurbeam
