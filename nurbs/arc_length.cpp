#include "nurbs/arc_length.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

#include "nurbs/golden_section.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// Index of the panel that holds the value; the first or the last for a value outside.
std::size_t panel_holding(const std::vector<double>& bounds, double value) {
  const auto after = std::upper_bound(bounds.begin() + 1, bounds.end() - 1, value);
  return static_cast<std::size_t>(after - bounds.begin()) - 1;
}

/// Panels on which 5 points integrate to round-off, and a cubic guesses the inverse to 1e-7.
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

double length(const RationalCubic& cubic) { return panels_of(Speed(cubic), 0, 1).integrals.back(); }

ArcLengthMap::ArcLengthMap(const RationalCubic& cubic)
    : speed_(cubic),
      panels_(speed_.uniform() ? panels_of(speed_, 0, 1) : finer(panels_of(speed_, 0, 1), speed_)) {
  for (const double u : panels_.breaks) break_speeds_.push_back(speed_(u));
  // Panels crowd where the speed nearly vanishes: it is small at some break then.
  constexpr double far_from_vanishing = 1e-2;
  if (*std::min_element(break_speeds_.begin(), break_speeds_.end()) > far_from_vanishing * length()) return;
  const double u = slowest_place(speed_, panels_, break_speeds_);
  if (speed_(u) > 1e-10 * length()) return;
  std::ostringstream message;
  message.precision(17);
  message << "the speed |r'(u)| is " << speed_(u) << " m at u = " << u << " of a cubic " << length()
          << " m long, at " << text_of(cubic.point(u)) << "; it must be above 1e-10 of the length";
  throw std::invalid_argument(message.str());
}

double ArcLengthMap::arc_length(double u) const {
  const std::size_t k = panel_holding(panels_.breaks, u);
  const double a = panels_.breaks[k], b = panels_.breaks[k + 1];
  return panels_.integrals[k] + (a <= u && u <= b ? gauss_of_5(speed_, a, u) : gauss(speed_, a, u));
}

double ArcLengthMap::parameter(double s) const {
  if (speed_.uniform()) return s / length();
  const std::size_t k = panel_holding(panels_.integrals, s);
  const double a = panels_.breaks[k], b = panels_.breaks[k + 1];
  const double panel_length = panels_.integrals[k + 1] - panels_.integrals[k];
  const double from_a = s - panels_.integrals[k];
  if (from_a == 0) return a;

  // First guess: the cubic u(s) with the right ends and slopes 1 / speed there.
  const double t = from_a / panel_length;
  const double slope_a = panel_length / break_speeds_[k], slope_b = panel_length / break_speeds_[k + 1];
  const double guess = a + t * t * (3 - 2 * t) * (b - a) + t * (1 - t) * ((1 - t) * slope_a - t * slope_b);

  const bool inside = 0 <= t && t <= 1;
  double low = a, high = b;
  double u =
      inside ? std::clamp(guess, a, b)
             : (t < 0 ? a + from_a / break_speeds_[k] : b + (from_a - panel_length) / break_speeds_[k + 1]);
  double excess = (inside ? gauss_of_5(speed_, a, u) : gauss(speed_, a, u)) - from_a;
  for (int i = 0; i < 60; ++i) {
    (excess > 0 ? high : low) = u;
    double next = u - excess / speed_(u);
    if (inside && (next < low || next > high)) next = 0.5 * (low + high);
    const double step = std::abs(next - u);
    if (step <= 1e-7 * (b - a)) return next;
    // Where the step is short, three points integrate it to round-off.
    excess = step <= 1e-1 * (b - a) ? excess + gauss_of_3(speed_, u, next) : gauss(speed_, a, next) - from_a;
    u = next;
  }
  return u;
}

}  // namespace nurbeam
