#pragma once
#include <array>

namespace nurbeam {

/// Power series in the two end positions (a, b) of an element, truncated after total degree 3.
///
/// f(a, b) = sum c_ij da^i db^j, i + j <= 3: the coefficients of shape functions whose element ends move over
/// the material. Sums, products and compositions of such series are again such series, exactly, so every
/// partial derivative that the equations of motion and their tangents need is a coefficient.
class Jet {
 public:
  using Coefficients = std::array<double, 10>;  ///< 1, a, b, aa, ab, bb, aaa, aab, abb, bbb

  constexpr Jet() = default;
  explicit constexpr Jet(const Coefficients& c) : c_(c) {}
  constexpr Jet(double value) { c_[0] = value; }  // a constant is a series: implicit on purpose
  /// The variable a (index 0) or b (index 1) at `value`.
  static constexpr Jet variable(double value, int index) {
    Jet x(value);
    x.c_[1 + index] = 1;
    return x;
  }

  double value() const { return c_[0]; }
  /// First, second and third partial derivatives; indices 0 = a, 1 = b.
  double d(int i) const { return c_[1 + i]; }
  double d(int i, int j) const { return i == j ? 2 * c_[3 + 2 * i] : c_[4]; }
  double d(int i, int j, int k) const {
    constexpr std::array<double, 4> factor{6, 2, 2, 6};
    return factor[i + j + k] * c_[6 + i + j + k];
  }

  Jet& operator+=(const Jet& y) {
    for (int i = 0; i < 10; ++i) c_[i] += y.c_[i];
    return *this;
  }
  Jet& operator-=(const Jet& y) {
    for (int i = 0; i < 10; ++i) c_[i] -= y.c_[i];
    return *this;
  }
  Jet operator-() const {
    Jet z;
    for (int i = 0; i < 10; ++i) z.c_[i] = -c_[i];
    return z;
  }
  friend Jet operator+(Jet x, const Jet& y) { return x += y; }
  friend Jet operator-(Jet x, const Jet& y) { return x -= y; }
  friend Jet operator*(double f, Jet x) {
    for (double& c : x.c_) c *= f;
    return x;
  }
  friend Jet operator*(const Jet& x, const Jet& y) {
    const auto& p = x.c_;
    const auto& q = y.c_;
    Jet z;
    z.c_ = {p[0] * q[0],
            p[0] * q[1] + p[1] * q[0],
            p[0] * q[2] + p[2] * q[0],
            p[0] * q[3] + p[1] * q[1] + p[3] * q[0],
            p[0] * q[4] + p[1] * q[2] + p[2] * q[1] + p[4] * q[0],
            p[0] * q[5] + p[2] * q[2] + p[5] * q[0],
            p[0] * q[6] + p[1] * q[3] + p[3] * q[1] + p[6] * q[0],
            p[0] * q[7] + p[1] * q[4] + p[2] * q[3] + p[3] * q[2] + p[4] * q[1] + p[7] * q[0],
            p[0] * q[8] + p[1] * q[5] + p[2] * q[4] + p[4] * q[2] + p[5] * q[1] + p[8] * q[0],
            p[0] * q[9] + p[2] * q[5] + p[5] * q[2] + p[9] * q[0]};
    return z;
  }
  friend Jet operator/(const Jet& x, const Jet& y);

  /// f(x) from f and its first three derivatives at x.value().
  friend Jet compose(const std::array<double, 4>& f, const Jet& x) {
    Jet delta = x;
    delta.c_[0] = 0;
    return f[0] + delta * (f[1] + delta * (f[2] / 2 + delta * (f[3] / 6)));
  }

 private:
  Coefficients c_{};
};

inline Jet operator/(const Jet& x, const Jet& y) {
  const double r = 1 / y.value();
  return x * compose({r, -r * r, 2 * r * r * r, -6 * r * r * r * r}, y);
}

/// The functions of Jet for a plain number, in an element with fixed ends.
inline double compose(const std::array<double, 4>& f, double) { return f[0]; }
inline double value(double x) { return x; }
inline double value(const Jet& x) { return x.value(); }

}  // namespace nurbeam
