#pragma once
#include <cmath>

namespace nurbeam::testing {

/// x + x' eps with eps^2 = 0 over any scalar, itself a Dual if need be: derivatives by arithmetic, as a
/// witness.
template <class T>
struct Dual {
  T x{};
  T d{};
  Dual() = default;
  Dual(double value) : x(value), d(0.0) {}
  Dual(T value, T derivative) : x(value), d(derivative) {}
  friend Dual operator+(const Dual& a, const Dual& b) { return {a.x + b.x, a.d + b.d}; }
  friend Dual operator-(const Dual& a, const Dual& b) { return {a.x - b.x, a.d - b.d}; }
  friend Dual operator-(const Dual& a) { return {T(0.0) - a.x, T(0.0) - a.d}; }
  friend Dual operator*(const Dual& a, const Dual& b) { return {a.x * b.x, a.x * b.d + a.d * b.x}; }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const T q = a.x / b.x;
    return {q, (a.d - q * b.d) / b.x};
  }
  friend Dual sqrt(const Dual& a) {
    using std::sqrt;
    const T r = sqrt(a.x);
    return {r, a.d / (T(2.0) * r)};
  }
};

inline double real(double x) { return x; }
template <class T>
double real(const Dual<T>& x) {
  return real(x.x);
}

/// The number y of an outer level, constant on the new innermost level.
template <class T>
Dual<T> lifted(const T& y) {
  return {y, T(0.0)};
}

}  // namespace nurbeam::testing
