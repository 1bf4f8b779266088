#pragma once
#include <Eigen/Core>
#include <array>
#include <cmath>

namespace nurbeam {

/// A number and its first derivatives in N variables (forward automatic differentiation): arithmetic on it is
/// exact. T is double, or again a Dual for second derivatives.
template <int N, class T = double>
struct Dual {
  T value{};
  std::array<T, N> d{};

  constexpr Dual() = default;
  constexpr Dual(double constant) : value(constant) {}  // implicit on purpose
  /// Variable `index` at `value`, with the derivative `seed`.
  static constexpr Dual variable(const T& value, int index, const T& seed = T(1)) {
    Dual x;
    x.value = value;
    x.d[index] = seed;
    return x;
  }

  /// The number with value `y` and derivative d = factor x.d.
  static constexpr Dual chained(const T& y, const T& factor, const Dual& x) {
    Dual z;
    z.value = y;
    for (int i = 0; i < N; ++i) z.d[i] = factor * x.d[i];
    return z;
  }

  Dual& operator+=(const Dual& y) { return *this = *this + y; }
  Dual& operator-=(const Dual& y) { return *this = *this - y; }
  Dual& operator*=(const Dual& y) { return *this = *this * y; }
  Dual& operator/=(const Dual& y) { return *this = *this / y; }

  friend Dual operator-(const Dual& x) { return chained(-x.value, T(-1), x); }
  friend Dual operator+(const Dual& x, const Dual& y) {
    Dual z;
    z.value = x.value + y.value;
    for (int i = 0; i < N; ++i) z.d[i] = x.d[i] + y.d[i];
    return z;
  }
  friend Dual operator-(const Dual& x, const Dual& y) {
    Dual z;
    z.value = x.value - y.value;
    for (int i = 0; i < N; ++i) z.d[i] = x.d[i] - y.d[i];
    return z;
  }
  friend Dual operator*(const Dual& x, const Dual& y) {
    Dual z;
    z.value = x.value * y.value;
    for (int i = 0; i < N; ++i) z.d[i] = x.value * y.d[i] + y.value * x.d[i];
    return z;
  }
  friend Dual operator/(const Dual& x, const Dual& y) {
    const T inverse = T(1) / y.value;
    Dual z;
    z.value = x.value * inverse;
    for (int i = 0; i < N; ++i) z.d[i] = (x.d[i] - z.value * y.d[i]) * inverse;
    return z;
  }
  friend Dual operator*(double c, const Dual& x) { return chained(c * x.value, T(c), x); }
  friend Dual operator*(const Dual& x, double c) { return c * x; }
  friend Dual operator/(const Dual& x, double c) { return (1 / c) * x; }

  friend Dual sqrt(const Dual& x) {
    using std::sqrt;
    const T root = sqrt(x.value);
    return chained(root, T(0.5) / root, x);
  }
  friend Dual sin(const Dual& x) {
    using std::cos, std::sin;
    return chained(sin(x.value), cos(x.value), x);
  }
  friend Dual cos(const Dual& x) {
    using std::cos, std::sin;
    return chained(cos(x.value), -sin(x.value), x);
  }
  /// Undefined at x = y = 0.
  friend Dual atan2(const Dual& y, const Dual& x) {
    using std::atan2;
    const T inverse = T(1) / (x.value * x.value + y.value * y.value);
    Dual z;
    z.value = atan2(y.value, x.value);
    for (int i = 0; i < N; ++i) z.d[i] = (x.value * y.d[i] - y.value * x.d[i]) * inverse;
    return z;
  }
};

/// The plain number in a scalar: the value without derivatives.
inline double plain(double x) { return x; }
template <int N, class T>
double plain(const Dual<N, T>& x) {
  return plain(x.value);
}

/// The plain number, under the name that series use.
template <int N, class T>
double value(const Dual<N, T>& x) {
  return plain(x);
}

/// f(x) from f and its first three derivatives at plain(x).
template <int N, class T>
Dual<N, T> compose(const std::array<double, 4>& f, const Dual<N, T>& x) {
  const Dual<N, T> step = x - plain(x);
  return f[0] + step * (f[1] + step * (f[2] / 2 + step * (f[3] / 6)));
}

}  // namespace nurbeam

namespace Eigen {

template <int N, class T>
struct NumTraits<nurbeam::Dual<N, T>> : NumTraits<double> {
  using Real = nurbeam::Dual<N, T>;
  using NonInteger = Real;
  using Nested = Real;
  using Literal = Real;
  enum { IsComplex = 0, IsInteger = 0, IsSigned = 1, RequireInitialization = 1 };
};
template <int N, class T, class Operation>
struct ScalarBinaryOpTraits<nurbeam::Dual<N, T>, double, Operation> {
  using ReturnType = nurbeam::Dual<N, T>;
};
template <int N, class T, class Operation>
struct ScalarBinaryOpTraits<double, nurbeam::Dual<N, T>, Operation> {
  using ReturnType = nurbeam::Dual<N, T>;
};

}  // namespace Eigen
