#include "nurbs/arc_length.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

#include "nurbs/bernstein.h"
#include "nurbs/golden_section.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// Index of the panel that holds the value; the first or the last for a value outside.
std::size_t panel_holding(const std::vector<double>& bounds, double value) {
  const auto after = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, value);
  return static_cast<std::size_t>(after - bounds.begin()) - 1;
}

/// Panels on which 5 points integrate to round-off, and a polynomial of degree 7 is the inverse.
Panels finer(const Panels& panels, const Speed& speed) {
  constexpr int parts = 16;
  Panels fine{{panels.breaks[0]}, {0}};
  for (std::size_t k = 0; k + 1 < panels.breaks.size(); ++k) {
    const double a = panels.breaks[k], b = panels.breaks[k + 1];
    double part = 0;
    for (int i = 1; i < parts; ++i) {
      const double u = a + (b - a) * i / parts;
      part += gauss_of_5(speed, fine.breaks.back(), u);
      fine.integrals.push_back(panels.integrals[k] + part);
      fine.breaks.push_back(u);
    }
    fine.breaks.push_back(b);
    fine.integrals.push_back(panels.integrals[k + 1]);
  }
  return fine;
}

/// Where the speed is least, looked for around the slowest break.
double slowest_place(const Speed& speed, const Panels& panels, const std::vector<double>& break_speeds) {
  const std::size_t last = break_speeds.size() - 1;
  const std::size_t i = std::min_element(break_speeds.begin(), break_speeds.end()) - break_speeds.begin();
  const double at_break = panels.breaks[i];
  const double between =
      minimum_place(speed, panels.breaks[i > 0 ? i - 1 : 0], panels.breaks[std::min(i + 1, last)], 80);
  return speed(between) < speed(at_break) ? between : at_break;
}

/// Whether the speed is the same everywhere, to the last bits of the control points.
bool is_uniform(const RationalCubic& cubic, const Eigen::Matrix<double, 3, 5>& hodograph) {
  const Eigen::RowVector4d weights = cubic.points().row(3);
  const Eigen::Vector3d mean = hodograph.rowwise().mean();
  return (weights.array() == weights[0]).all() &&
         (hodograph.colwise() - mean).cwiseAbs().maxCoeff() <=
             1e-15 * cubic.points().topRows<3>().cwiseAbs().maxCoeff() * weights[0];
}

/// Throws where the speed vanishes.
void refuse_stops(const RationalCubic& cubic, const Speed& speed, const Panels& panels,
                  const std::vector<double>& break_speeds) {
  const double length = panels.integrals.back();
  // Panels crowd where the speed nearly vanishes: it is small at some break then.
  constexpr double far_from_vanishing = 1e-2;
  if (*std::min_element(break_speeds.begin(), break_speeds.end()) > far_from_vanishing * length) return;
  const double u = slowest_place(speed, panels, break_speeds);
  if (speed(u) > 1e-10 * length) return;
  std::ostringstream message;
  message.precision(17);
  message << "the speed |r'(u)| is " << speed(u) << " m at u = " << u << " of a cubic " << length
          << " m long, at " << text_of(cubic.point(u)) << "; it must be above 1e-10 of the length";
  throw std::invalid_argument(message.str());
}

}  // namespace

Speed::Speed(const RationalCubic& cubic)
    : hodograph_(cubic.hodograph()),
      weights_(cubic.points().row(3)),
      uniform_(is_uniform(cubic, hodograph_)) {}

double Speed::operator()(double u) const {
  const double v = 1 - u;
  const double uu = u * u, uv = u * v, vv = v * v;
  const double weight =
      weights_(0) * vv * v + 3 * uv * (weights_(1) * v + weights_(2) * u) + weights_(3) * uu * u;
  const Eigen::Vector3d numerator = vv * vv * hodograph_.col(0) + 4 * uv * vv * hodograph_.col(1) +
                                    6 * uv * uv * hodograph_.col(2) + 4 * uv * uu * hodograph_.col(3) +
                                    uu * uu * hodograph_.col(4);
  return numerator.norm() / (weight * weight);
}

std::array<double, 3> Speed::derivatives(double u) const {
  const double v = 1 - u;
  const Eigen::Vector4d cubic = cubic_bernstein(u);
  const Eigen::Vector3d square(v * v, 2 * u * v, u * u);
  const Eigen::Matrix<double, 3, 4> steps = hodograph_.rightCols<4>() - hodograph_.leftCols<4>();
  const Eigen::Vector3d N = hodograph_ * quartic_bernstein(u), N_u = 4 * steps * cubic,
                        N_uu = 12 * (steps.rightCols<3>() - steps.leftCols<3>()) * square;
  const Eigen::RowVector3d rises = weights_.tail<3>() - weights_.head<3>();
  const double W = weights_ * cubic, W_u = 3 * rises * square,
               W_uu = 6 * (rises.tail<2>() - rises.head<2>()) * Eigen::Vector2d(v, u);
  const double n = N.norm(), n_u = N.dot(N_u) / n, n_uu = (N_u.dot(N_u) + N.dot(N_uu) - n_u * n_u) / n;
  const double g = 1 / (W * W), g_u = -2 * W_u * g / W, g_uu = (6 * W_u * W_u / W - 2 * W_uu) * g / W;
  return {n * g, n_u * g + n * g_u, n_uu * g + 2 * n_u * g_u + n * g_uu};
}

double length(const RationalCubic& cubic) { return panels_of(Speed(cubic), 0, 1).integrals.back(); }

ArcLengthMap::ArcLengthMap(const RationalCubic& cubic)
    : speed_(cubic),
      panels_(speed_.uniform() ? panels_of(speed_, 0, 1) : finer(panels_of(speed_, 0, 1), speed_)) {
  std::vector<double> break_speeds;
  for (const double u : panels_.breaks) break_speeds.push_back(speed_(u));
  refuse_stops(cubic, speed_, panels_, break_speeds);
  if (speed_.uniform()) return;
  for (std::size_t k = 0; k + 1 < panels_.breaks.size(); ++k) inverses_.push_back(inverse_on(k));
}

double ArcLengthMap::arc_length(double u) const {
  const std::size_t k = panel_holding(panels_.breaks, u);
  const double a = panels_.breaks[k], b = panels_.breaks[k + 1];
  return panels_.integrals[k] + (a <= u && u <= b ? gauss_of_5(speed_, a, u) : gauss(speed_, a, u));
}

double ArcLengthMap::Inverse::operator()(double t) const {
  double sum = 0;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = t * (sum + coefficients[i]);
  return sum;
}

ArcLengthMap::Inverse ArcLengthMap::inverse_on(std::size_t k) const {
  const double a = panels_.breaks[k], b = panels_.breaks[k + 1];
  const double panel_length = panels_.integrals[k + 1] - panels_.integrals[k];
  // Derivatives of u by t: those of the inverse of s(u).
  const auto slopes = [&](double u) {
    const auto [v, v_u, v_uu] = speed_.derivatives(u);
    const double first = panel_length / v, ratio = first * v_u / v;
    return Eigen::Vector3d(first, -ratio * first, (3 * ratio * ratio - first * first * v_uu / v) * first);
  };
  const Eigen::Vector3d at_a = slopes(a), at_b = slopes(b);
  // What the derivatives at the start leave of the value and the derivatives at the end.
  const double c1 = at_a[0], c2 = at_a[1] / 2, c3 = at_a[2] / 6, left = b - a - c1 - c2 - c3,
               left_1 = at_b[0] - c1 - 2 * c2 - 3 * c3, left_2 = at_b[1] - 2 * c2 - 6 * c3,
               left_3 = at_b[2] - 6 * c3;
  Inverse inverse{{c1, c2, c3, 35 * left - 15 * left_1 + 2.5 * left_2 - left_3 / 6,
                   -84 * left + 39 * left_1 - 7 * left_2 + left_3 / 2,
                   70 * left - 34 * left_1 + 6.5 * left_2 - left_3 / 2,
                   -20 * left + 10 * left_1 - 2 * left_2 + left_3 / 6},
                  false};
  // The middle is where such a polynomial is furthest off.
  const double middle = a + inverse(0.5);
  inverse.exact = a < middle && middle < b &&
                  std::abs(gauss_of_5(speed_, a, middle) - panel_length / 2) <= 1e-16 * length();
  return inverse;
}

double ArcLengthMap::by_newton(std::size_t k, double from_start) const {
  const double a = panels_.breaks[k], b = panels_.breaks[k + 1];
  const double panel_length = panels_.integrals[k + 1] - panels_.integrals[k];
  const double t = from_start / panel_length;
  const bool inside = 0 <= t && t <= 1;
  double low = a, high = b;
  double u = inside  ? std::clamp(a + inverses_[k](t), a, b)
             : t < 0 ? a + from_start / speed_(a)
                     : b + (from_start - panel_length) / speed_(b);
  for (int i = 0; i < 60; ++i) {
    const double excess = (inside ? gauss_of_5(speed_, a, u) : gauss(speed_, a, u)) - from_start;
    (excess > 0 ? high : low) = u;
    double next = u - excess / speed_(u);
    if (inside && (next < low || next > high)) next = 0.5 * (low + high);
    const double step = std::abs(next - u);
    u = next;
    if (step <= 1e-7 * (b - a)) break;
  }
  return u;
}

double ArcLengthMap::parameter(double s) const {
  if (speed_.uniform()) return s / length();
  const std::size_t k = panel_holding(panels_.integrals, s);
  const double from_start = s - panels_.integrals[k];
  const double t = from_start / (panels_.integrals[k + 1] - panels_.integrals[k]);
  if (!(inverses_[k].exact && 0 <= t && t <= 1)) return by_newton(k, from_start);
  return std::min(panels_.breaks[k] + inverses_[k](t), panels_.breaks[k + 1]);
}

}  // namespace nurbeam
