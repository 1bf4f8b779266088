#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace nurbeam {

/// Integral of f over [a, b] by the Gauss-Legendre rule of 10 points: exact for polynomials up to degree 19.
template <typename Function>
double gauss(const Function& f, double a, double b) {
  constexpr std::pair<double, double> abscissae_and_weights[] = {
      {0.14887433898163121088, 0.29552422471475287017},
      {0.43339539412924719080, 0.26926671930999635509},
      {0.67940956829902440623, 0.21908636251598204400},
      {0.86506336668898451073, 0.14945134915058059315},
      {0.97390652851717172008, 0.06667134430868813759}};
  const double middle = 0.5 * (a + b);
  const double half = 0.5 * (b - a);
  double sum = 0;
  for (const auto& [x, weight] : abscissae_and_weights)
    sum += weight * (f(middle - half * x) + f(middle + half * x));
  return half * sum;
}

/// The same by the rule of 5 points: exact up to degree 9.
template <typename Function>
double gauss_of_5(const Function& f, double a, double b) {
  const double middle = 0.5 * (a + b), half = 0.5 * (b - a);
  const double x = 0.53846931010568309104 * half, y = 0.90617984593866399280 * half;
  return half *
         (0.56888888888888888889 * f(middle) + 0.47862867049936646804 * (f(middle - x) + f(middle + x)) +
          0.23692688505618908751 * (f(middle - y) + f(middle + y)));
}

/// An interval cut into panels on each of which the rule of `gauss` integrates a function to round-off.
struct Panels {
  std::vector<double> breaks;     ///< increasing, from the start of the interval to its end
  std::vector<double> integrals;  ///< cumulative integral at each break, 0 first
};

/// The panels of f on [a, b]: halved until the halves agree with the whole to `tolerance` of the larger of
/// `scale` and their sum, then both halves are kept. A panel shorter than 2^-40 of the interval is kept as it
/// is (f with a kink or a jump), and so is one on which f is no number, and all behind the first 10,000 (f
/// that is round-off, of a damaged file).
template <typename Function>
Panels panels_of(const Function& f, double a, double b, double scale, double tolerance) {
  constexpr std::size_t most_panels = 10'000;
  Panels panels{{a}, {0}};
  const auto append = [&panels](double end, double integral) {
    panels.breaks.push_back(end);
    panels.integrals.push_back(panels.integrals.back() + integral);
  };
  const auto divide = [&](const auto& self, double left, double right, double whole) -> void {
    const double middle = 0.5 * (left + right);
    const double first = gauss(f, left, middle);
    const double second = gauss(f, middle, right);
    const double allowed = tolerance * std::max(scale, first + second);
    if (!(std::abs(first + second - whole) > allowed) || right - left <= std::ldexp(b - a, -40) ||
        panels.breaks.size() > most_panels) {
      append(middle, first);
      append(right, second);
    } else {
      self(self, left, middle, first);
      self(self, middle, right, second);
    }
  };
  divide(divide, a, b, gauss(f, a, b));
  return panels;
}

/// The panels of a non-negative f on [a, b], to 1e-13 of its integral.
template <typename Function>
Panels panels_of(const Function& f, double a, double b) {
  return panels_of(f, a, b, gauss(f, a, b), 1e-13);
}

}  // namespace nurbeam
