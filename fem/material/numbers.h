#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

#include "solver/algebra/every_processor.h"

/// Arithmetic of formulas that are written once for several kinds of numbers T: a double, doubles side by
/// side (an Eigen array), or the numbers of eight elements (fem/element/lane_arithmetic.h has the functions
/// of these).
namespace nurbeam {

NURBEAM_WITHIN double square_root(double a) { return std::sqrt(a); }
/// The number itself, or 0 where it is negative.
NURBEAM_WITHIN double positive(double a) { return a > 0 ? a : 0; }
/// 1 where the number is 0, else 0.
NURBEAM_WITHIN double is_zero(double a) { return a == 0 ? 1 : 0; }
/// The largest of the numbers side by side.
NURBEAM_WITHIN double largest(double a) { return a; }
/// `f` of each of the numbers side by side.
template <class Function>
double each(double a, const Function& f) {
  return f(a);
}

template <int n>
using SideBySide = Eigen::Array<double, n, 1>;
template <int n>
SideBySide<n> square_root(const SideBySide<n>& a) {
  return a.sqrt();
}
template <int n>
SideBySide<n> positive(const SideBySide<n>& a) {
  return a.max(0.0);
}
template <int n>
SideBySide<n> is_zero(const SideBySide<n>& a) {
  return (a == 0).template cast<double>();
}
template <int n, class Function>
SideBySide<n> each(const SideBySide<n>& a, const Function& f) {
  return a.unaryExpr(f);
}

/// Zero, the number that sums begin with.
template <class T>
NURBEAM_WITHIN T zero() {
  if constexpr (requires { T::Zero(); })
    return T::Zero();
  else
    return T{};
}

/// A pack of numbers that all have this value.
template <class T>
NURBEAM_WITHIN T filled(double number) {
  return zero<T>() + number;
}

template <class T, std::size_t D>
NURBEAM_WITHIN T dot(const std::array<T, D>& a, const std::array<T, D>& b) {
  T sum = a[0] * b[0];
  for (std::size_t d = 1; d < D; ++d) sum += a[d] * b[d];
  return sum;
}

}  // namespace nurbeam
