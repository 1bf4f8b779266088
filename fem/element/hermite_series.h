#pragma once
#include <array>

namespace nurbeam {

/// Power series in the two end positions, truncated after total degree N; coefficients by degree: 1, a, b,
/// aa, ab, bb, ... Like Jet, but with a degree as low as its use allows.
template <int N>
struct EndSeries {
  static constexpr int size = (N + 1) * (N + 2) / 2;
  std::array<double, size> c{};

  static constexpr int index(int i, int j) { return (i + j) * (i + j + 1) / 2 + j; }
};

template <int N>
EndSeries<N> operator+(EndSeries<N> x, const EndSeries<N>& y) {
  for (int i = 0; i < EndSeries<N>::size; ++i) x.c[i] += y.c[i];
  return x;
}
template <int N>
EndSeries<N> operator*(double f, EndSeries<N> x) {
  for (double& c : x.c) c *= f;
  return x;
}
template <int N>
EndSeries<N> operator-(const EndSeries<N>& x, const EndSeries<N>& y) {
  return x + -1.0 * y;
}
template <int N>
EndSeries<N> operator*(const EndSeries<N>& x, const EndSeries<N>& y) {
  static_assert(N <= 3);
  const auto& p = x.c;
  const auto& q = y.c;
  EndSeries<N> z;
  z.c[0] = p[0] * q[0];
  if constexpr (N > 0) {
    z.c[1] = p[0] * q[1] + p[1] * q[0];
    z.c[2] = p[0] * q[2] + p[2] * q[0];
  }
  if constexpr (N > 1) {
    z.c[3] = p[0] * q[3] + p[1] * q[1] + p[3] * q[0];
    z.c[4] = p[0] * q[4] + p[1] * q[2] + p[2] * q[1] + p[4] * q[0];
    z.c[5] = p[0] * q[5] + p[2] * q[2] + p[5] * q[0];
  }
  if constexpr (N > 2) {
    z.c[6] = p[0] * q[6] + p[1] * q[3] + p[3] * q[1] + p[6] * q[0];
    z.c[7] = p[0] * q[7] + p[1] * q[4] + p[2] * q[3] + p[3] * q[2] + p[4] * q[1] + p[7] * q[0];
    z.c[8] = p[0] * q[8] + p[1] * q[5] + p[2] * q[4] + p[4] * q[2] + p[5] * q[1] + p[8] * q[0];
    z.c[9] = p[0] * q[9] + p[2] * q[5] + p[5] * q[2] + p[9] * q[0];
  }
  return z;
}

template <int M, int N>
EndSeries<M> truncated(const EndSeries<N>& x) {
  EndSeries<M> y;
  for (int i = 0; i < EndSeries<M>::size; ++i) y.c[i] = x.c[i];
  return y;
}

/// The derivative by variable 0 or 1.
template <int N>
EndSeries<N - 1> derivative(const EndSeries<N>& x, int variable) {
  EndSeries<N - 1> y;
  for (int d = 0; d < N; ++d)
    for (int j = 0; j <= d; ++j)
      y.c[EndSeries<N>::index(d - j, j)] = variable == 0
                                               ? (d - j + 1) * x.c[EndSeries<N>::index(d - j + 1, j)]
                                               : (j + 1) * x.c[EndSeries<N>::index(d - j, j + 1)];
  return y;
}

/// The series of a function of one variable, from its value and derivatives.
template <int N>
EndSeries<N> of_variable(int variable, const std::array<double, 4>& f) {
  EndSeries<N> y;
  constexpr std::array<double, 4> factorial{1, 1, 2, 6};
  for (int d = 0; d <= N; ++d)
    y.c[variable == 0 ? EndSeries<N>::index(d, 0) : EndSeries<N>::index(0, d)] = f[d] / factorial[d];
  return y;
}

/// A cubic of u by its values and slopes at both ends of the element, as functions of the end positions.
template <int N>
struct Hermite {
  EndSeries<N> P, Q, R, T;
};

/// Series of 1 / l, and of du/ds at the ends.
struct MovingEnds {
  EndSeries<2> inverse_length, rate_a, rate_b;
};

/// The derivative of a Hermite cubic in s_A at fixed u, again a cubic: P_a - Q u_A', Q_a - H''(u_A) u_A',
/// R_a, T_a.
template <int N>
Hermite<N - 1> by_start(const Hermite<N>& h, const MovingEnds& ends) {
  constexpr int M = N - 1;
  const EndSeries<M> i = truncated<M>(ends.inverse_length), rate = truncated<M>(ends.rate_a),
                     Q = truncated<M>(h.Q);
  const EndSeries<M> second = i * (6.0 * i * (truncated<M>(h.R) - truncated<M>(h.P)) - 4.0 * Q -
                                   2.0 * truncated<M>(h.T));  // H''(u_A)
  return {derivative(h.P, 0) - Q * rate, derivative(h.Q, 0) - second * rate, derivative(h.R, 0),
          derivative(h.T, 0)};
}

/// The derivative of a Hermite cubic in s_B at fixed u.
template <int N>
Hermite<N - 1> by_end(const Hermite<N>& h, const MovingEnds& ends) {
  constexpr int M = N - 1;
  const EndSeries<M> i = truncated<M>(ends.inverse_length), rate = truncated<M>(ends.rate_b),
                     T = truncated<M>(h.T);
  const EndSeries<M> second = i * (6.0 * i * (truncated<M>(h.P) - truncated<M>(h.R)) +
                                   2.0 * truncated<M>(h.Q) + 4.0 * T);  // H''(u_B)
  return {derivative(h.P, 1), derivative(h.Q, 1), derivative(h.R, 1) - T * rate,
          derivative(h.T, 1) - second * rate};
}

}  // namespace nurbeam
