#include "pipelines/verification/verify_oracles.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "nurbs/golden_section.h"

namespace nurbeam::verification {

double root(const std::function<double(double)>& f, double lo, double hi) {
  double f_lo = f(lo), f_hi = f(hi);
  for (int i = 0; i < 200 && hi - lo > 1e-15 * (std::abs(lo) + std::abs(hi)); ++i) {
    const double x = (lo * f_hi - hi * f_lo) / (f_hi - f_lo), f_x = f(x);
    if (f_x == 0 || x <= lo || x >= hi) return x;
    if (f_x < 0)
      lo = x, f_lo = f_x, f_hi /= 2;
    else
      hi = x, f_hi = f_x, f_lo /= 2;
  }
  return (lo + hi) / 2;
}

Tip roll_up_tip(double m) { return {std::sin(m) / m, (1 - std::cos(m)) / m}; }

Tip elastica_tip(double q) {
  const auto phi = [](double p) { return std::asin(1 / (p * std::numbers::sqrt2)); };
  const double p =
      root([&](double x) { return std::comp_ellint_1(x) - std::ellint_1(x, phi(x)) - std::sqrt(q); },
           1 / std::numbers::sqrt2, 1 - 1e-12);
  const double drop = 1 - 2 * (std::comp_ellint_2(p) - std::ellint_2(p, phi(p))) / std::sqrt(q);
  return {std::sqrt(2 * (2 * p * p - 1) / q), -drop};
}

Tip stretching_elastica_tip(double EA, double q, double kappa_0) {
  constexpr int steps = 4000;
  const StringLaw law{.EA = EA, .w = 0};
  const auto rate = [&](const Eigen::Vector4d& y) {  // theta, M, x, y
    const double lambda = law.stretch(-q * std::sin(y[0]));
    return Eigen::Vector4d(kappa_0 + y[1], lambda * q * std::cos(y[0]), lambda * std::cos(y[0]),
                           lambda * std::sin(y[0]));
  };
  const auto end = [&](double root_moment) {
    Eigen::Vector4d y(0, root_moment, 0, 0);
    constexpr double h = 1.0 / steps;
    for (int i = 0; i < steps; ++i) {
      const Eigen::Vector4d k1 = rate(y), k2 = rate(y + h / 2 * k1), k3 = rate(y + h / 2 * k2);
      y += h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(y + h * k3));
    }
    return y;
  };
  const Eigen::Vector4d y = end(root([&](double M) { return end(M)[1]; }, -1.2 * q, 0));
  return {y[2], y[3]};
}

double StringLaw::stretch(double T) const {
  double lambda = 1;
  for (int i = 0; i < 20; ++i)
    lambda -= (EA * lambda * (lambda * lambda - 1) / 2 - T) / (EA * (3 * lambda * lambda - 1) / 2);
  return lambda;
}

StringShape StringLaw::shape(double H, double V, double length) const {
  constexpr int panels = 100;
  const double gauss = std::sqrt(0.6);
  StringShape sum;
  for (int i = 0; i < panels; ++i)
    for (const auto& [point, weight] : {std::pair{-gauss, 5.0 / 18}, {0.0, 8.0 / 18}, {gauss, 5.0 / 18}}) {
      const double ds = weight * length / panels, s = (i + (1 + point) / 2) * length / panels;
      const double T = std::hypot(H, V + w * s), lambda = stretch(T);
      const double strain = (lambda * lambda - 1) / 2;
      sum.x += H / T * lambda * ds;
      sum.y += (V + w * s) / T * lambda * ds;
      sum.axial_energy += EA * strain * strain / 2 * ds;
    }
  return sum;
}

Hanging hang(const StringLaw& law, double length, double span, double rise) {
  const double weight = law.w * length;
  const auto lowest_force = [&](double H) {
    return root([&](double V) { return law.shape(H, V, length).y - rise; }, -10 * weight, 10 * weight);
  };
  const double H = root([&](double x) { return law.shape(x, lowest_force(x), length).x - span; }, 1e-3, 1e5);
  return {H, lowest_force(H)};
}

double inextensible_pull(double S, double X, double d, double w) {
  // sinh(X/2a) falls with a.
  return w * root([&](double a) { return std::sqrt(S * S - d * d) - 2 * a * std::sinh(X / (2 * a)); }, X / 50,
                  50 * X);
}

double midspan_ratio(double alpha, double tau) {
  using std::numbers::pi;
  double sum = 0;
  for (int n = 1; n < 100; n += 2) {
    const double sign = n % 4 == 1 ? 1 : -1;
    // [sin(n pi tau) - (alpha/n) sin(n^2 pi tau/alpha)] / (1 - (alpha/n)^2), and its limit where n = alpha
    const double term = n == alpha
                            ? (std::sin(n * pi * tau) - n * pi * tau * std::cos(n * pi * tau)) / 2
                            : (std::sin(n * pi * tau) - alpha / n * std::sin(n * n * pi * tau / alpha)) /
                                  (1 - alpha * alpha / (n * n));
    sum += sign / std::pow(n, 4) * term;
  }
  return 96 / std::pow(pi, 4) * sum;
}

double largest_midspan_ratio(double alpha) {
  constexpr int samples = 1000;
  int best = 0;
  for (int i = 0; i <= samples; ++i)
    if (midspan_ratio(alpha, double(i) / samples) > midspan_ratio(alpha, double(best) / samples)) best = i;
  const auto negative = [&](double tau) { return -midspan_ratio(alpha, tau); };
  const double tau = minimum_place(negative, std::max(0.0, (best - 1.0) / samples),
                                   std::min(1.0, (best + 1.0) / samples), 40);
  return std::max(midspan_ratio(alpha, tau), midspan_ratio(alpha, 1));
}

}  // namespace nurbeam::verification
