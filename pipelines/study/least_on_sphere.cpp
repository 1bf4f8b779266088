#include "pipelines/study/least_on_sphere.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

namespace {

constexpr double aligned = 1e-6, nearly_aligned = 1e-3;  // [rad]

/// From a place of a sphere towards another one, as unit vectors.
struct GreatCircle {
  Eigen::VectorXd from, across;
  double angle = 0;

  GreatCircle(Eigen::VectorXd begin, const Eigen::VectorXd& end) : from(std::move(begin)) {
    across = end - end.dot(from) * from;
    angle = std::atan2(across.norm(), end.dot(from));
    if (across.norm() < 1e-12) across = from.unitOrthogonal();  // all ways from a pole are as long
    across.normalize();
  }
  Eigen::VectorXd at(double turned) const { return std::cos(turned) * from + std::sin(turned) * across; }
};

struct Step {
  Eigen::VectorXd u;
  double value = 0, part = 1;
};

// So much of the way along a circle that f decreases enough; nothing where no part of it does.
std::optional<Step> shortened_step(const SphereFunction& f, double radius, const GreatCircle& circle,
                                   double value, double descent, double part) {
  constexpr double enough = 1e-4, shortest = 1e-10;
  while (part * circle.angle > shortest) {
    const Eigen::VectorXd u = radius * circle.at(part * circle.angle);
    const std::optional<double> found = f.value(u);
    const double expected = descent * part * circle.angle;
    if (found && *found <= value - enough * expected) return Step{u, *found, part};
    // Least of the parabola through both values and the slope.
    const double curved = found ? *found - value + expected : expected;
    part *= std::clamp(curved > 0 ? expected / (2 * curved) : 0.5, 0.1, 0.5);
  }
  return {};
}

}  // namespace

std::optional<SpherePlace> least_on_sphere(const SphereFunction& f, double radius,
                                           const Eigen::VectorXd& start) {
  Eigen::VectorXd direction = start;
  if (!(start.norm() > 0)) {
    const auto slope = f.gradient(start);
    if (!slope) return {};
    direction = slope->norm() > 0 ? Eigen::VectorXd(-*slope) : Eigen::VectorXd::Unit(start.size(), 0);
  }
  if (radius == 0) return SpherePlace{Eigen::VectorXd::Zero(start.size())};
  SpherePlace place{radius * direction.normalized()};
  std::optional<double> value = f.value(place.u);
  if (!value) return {};
  constexpr int most_turns = 100;
  double part = 1;
  for (int i = 0; i < most_turns; ++i) {
    const auto slope = f.gradient(place.u);
    if (!slope) return {};
    if (!(slope->norm() > 0)) return place;  // it is the same everywhere
    const GreatCircle circle(place.u / radius, -slope->normalized());
    place.angle = circle.angle;
    if (circle.angle <= aligned) return place;
    const double descent = radius * -slope->dot(circle.across);
    const auto step = shortened_step(f, radius, circle, *value, std::max(descent, 0.0), part);
    if (!step) break;
    place.u = step->u;
    value = step->value;
    part = std::min(1.0, 1.5 * step->part);
  }
  return place.angle <= nearly_aligned ? std::optional(place) : std::nullopt;
}

}  // namespace nurbeam
