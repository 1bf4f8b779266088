#pragma once
#include <utility>

namespace nurbeam {

/// Where f, with one minimum in [a, b], is least: golden section, `steps` times (each leaves 0.618 of the
/// interval).
template <typename Function>
double minimum_place(const Function& f, double a, double b, int steps) {
  constexpr double ratio = 0.6180339887498949;
  double left = b - ratio * (b - a), right = a + ratio * (b - a);
  double f_left = f(left), f_right = f(right);
  for (int i = 0; i < steps; ++i) {
    if (f_left < f_right) {
      b = std::exchange(right, left);
      f_right = f_left;
      left = b - ratio * (b - a);
      f_left = f(left);
    } else {
      a = std::exchange(left, right);
      f_left = f_right;
      right = a + ratio * (b - a);
      f_right = f(right);
    }
  }
  return f_left < f_right ? left : right;
}

}  // namespace nurbeam
