#include "cad_import/ifc/turning.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace nurbeam {
namespace {

using std::numbers::pi;

double rate_of_powers(const std::vector<double>& factors, double u) {
  double sum = 0;
  for (std::size_t i = factors.size(); i-- > 1;) sum = sum * u + static_cast<double>(i) * factors[i];
  return sum;
}

/// By differences of its angle; NaN where that is no number.
double sharpest_of(const std::function<double(double)>& angle, double length) {
  constexpr int count = 64;
  double largest = 0, before = angle(0);
  for (int i = 1; i <= count; ++i) {
    const double here = angle(length * i / count), curvature = std::abs(here - before) * count / length;
    if (!(curvature <= largest)) largest = curvature;
    before = here;
  }
  return largest;
}

Turning turning_by(std::function<double(double)> angle, double length) {
  const double sharpest = length == 0 ? 0 : sharpest_of(angle, std::abs(length));
  return {std::move(angle), sharpest};
}

double speed_of(const PolynomialCurve& curve, double u) {
  return std::hypot(rate_of_powers(curve.x, u), rate_of_powers(curve.y, u));
}

/// By Gauss' rule of five points.
double length_of_piece(const PolynomialCurve& curve, double first, double last) {
  constexpr std::array<double, 3> nodes{0, 0.5384693101056831, 0.9061798459386640};
  constexpr std::array<double, 3> weights{0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
  const double middle = first + (last - first) / 2, half = (last - first) / 2;
  double sum = weights[0] * speed_of(curve, middle);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    for (const double side : {1.0, -1.0})
      sum += weights[i] * speed_of(curve, middle + side * nodes[i] * half);
  return sum * half;
}

double length_between(const PolynomialCurve& curve, double first, double last) {
  constexpr int pieces = 16;
  const double step = (last - first) / pieces;
  double sum = 0;
  for (int i = 0; i < pieces; ++i) sum += length_of_piece(curve, first + i * step, first + (i + 1) * step);
  return sum;
}

/// The parameter at a distance s from another, by Newton's rule from a guess; `length(u)`: from there to u.
template <class Length>
double parameter_at(const PolynomialCurve& curve, double s, double from, double guess, const Length& length) {
  constexpr int most_steps = 50;
  constexpr double near = 1e-13;
  double u = guess;
  for (int i = 0; i < most_steps; ++i) {
    const double speed = speed_of(curve, u), missing = s - length(u);
    if (!(speed > 0 && std::isfinite(missing))) throw std::runtime_error("a polynomial of it stands still");
    u += missing / speed;
    if (std::abs(missing) <= near * (std::abs(s) + speed * std::abs(from))) return u;
  }
  throw std::runtime_error("a polynomial of it has no place at a distance of its length");
}

/// Parameters of a polynomial by the length from the first of them, which many places are asked for.
class ParametersByLength {
 public:
  ParametersByLength(const PolynomialCurve& curve, double from, double length) : curve_(curve) {
    const double end = curve.parameter(from, length);
    for (int i = 0; i <= pieces; ++i) {
      parameters_.push_back(from + (end - from) * i / pieces);
      lengths_.push_back(
          i == 0 ? 0 : lengths_[i - 1] + length_of_piece(curve, parameters_[i - 1], parameters_[i]));
    }
  }

  double at(double s) const {
    std::size_t i = 0;
    while (i + 1 < pieces && std::abs(lengths_[i + 1]) < std::abs(s)) ++i;
    const double missing = s - lengths_[i], step = lengths_[i + 1] - lengths_[i];
    const double first = parameters_[i], width = parameters_[i + 1] - first;
    return parameter_at(curve_, missing, first, first + width * missing / step,
                        [&](double u) { return length_of_piece(curve_, first, u); });
  }

 private:
  static constexpr int pieces = 64;

  PolynomialCurve curve_;
  std::vector<double> parameters_, lengths_;
};

}  // namespace

Turning even_turning(double curvature) {
  return {[curvature](double s) { return curvature * s; }, std::abs(curvature), curvature};
}

double Spiral::angle(double s) const {
  double sum = 0;
  for (std::size_t i = powers.size(); i-- > 0;) sum = sum * s + powers[i] / static_cast<double>(i + 1);
  return sum * s + cosine * period / pi * std::sin(pi * s / period) +
         sine * period / (2 * pi) * (1 - std::cos(2 * pi * s / period));
}

Turning turning_of(const Spiral& spiral, double from, double length) {
  const double sense = length < 0 ? -1 : 1, begin = spiral.angle(from);
  return turning_by([=](double s) { return spiral.angle(from + sense * s) - begin; }, length);
}

double PolynomialCurve::heading(double u) const {
  return std::atan2(rate_of_powers(y, u), rate_of_powers(x, u));
}

double PolynomialCurve::parameter(double from, double s) const {
  return parameter_at(
      *this, s, from, from, [&](double u) { return length_between(*this, from, u); });
}

Turning turning_of(const PolynomialCurve& curve, double from, double length) {
  if (length == 0) return even_turning(0);
  const double sense = length < 0 ? -1 : 1, begin = curve.heading(from);
  return turning_by(
      [=, parameters = ParametersByLength(curve, from, length)](double s) {
        return std::remainder(curve.heading(parameters.at(sense * s)) - begin, 2 * pi);
      },
      length);
}

}  // namespace nurbeam
