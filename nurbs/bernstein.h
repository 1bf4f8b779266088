#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>

namespace nurbeam {

/// The four cubic Bernstein polynomials at u.
template <typename Scalar>
Eigen::Vector4<Scalar> cubic_bernstein(const Scalar& u) {
  const Scalar v = 1 - u;
  return {v * v * v, 3 * u * v * v, 3 * u * u * v, u * u * u};
}

/// The five quartic Bernstein polynomials at u.
template <typename Scalar>
Eigen::Vector<Scalar, 5> quartic_bernstein(const Scalar& u) {
  const Scalar v = 1 - u;
  return {v * v * v * v, 4 * u * v * v * v, 6 * u * u * v * v, 4 * u * u * u * v, u * u * u * u};
}

/// Polar form (blossom) of the Bezier curve with these points (columns), of any degree, at as many arguments
/// as its degree: symmetric, affine in each, f(u, ..., u) = value at u (de Casteljau, one argument a round).
template <typename Points, typename Arguments>
auto blossom(Points points, const Arguments& arguments) {
  for (Eigen::Index r = 1; r < points.cols(); ++r) {
    const auto a = arguments[static_cast<std::size_t>(r - 1)];
    for (Eigen::Index j = 0; j + r < points.cols(); ++j)
      points.col(j) = (1 - a) * points.col(j) + a * points.col(j + 1);
  }
  return points.col(0).eval();
}

}  // namespace nurbeam
