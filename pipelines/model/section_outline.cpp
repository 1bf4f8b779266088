#include "pipelines/model/section_outline.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "pipelines/model/is_straight.h"

namespace nurbeam {
namespace {

using Polygon = std::vector<Eigen::Vector2d>;

constexpr int circle_points = 48, cubic_points = 12;

Polygon circle(double radius, bool clockwise) {
  Polygon polygon;
  for (int i = 0; i < circle_points; ++i) {
    const double angle = (clockwise ? -2 : 2) * std::numbers::pi * i / circle_points;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

Polygon polygon_of(const Loop& loop) {
  Polygon polygon;
  for (const RationalCubic& cubic : loop) {
    const int points = is_straight(cubic) ? 1 : cubic_points;
    for (int i = 0; i < points; ++i)
      polygon.emplace_back(cubic.point(static_cast<double>(i) / points).head<2>());
  }
  return polygon;
}

// A rectangle with these second moments over area, turned to their principal axes.
Polygon rectangle(double over_x, double over_y, double product) {
  const double middle = (over_x + over_y) / 2, spread = std::hypot((over_x - over_y) / 2, product);
  const double angle = spread > 0 ? std::atan2(-2 * product, over_x - over_y) / 2 : 0;
  const double half_width = std::sqrt(3 * (middle - spread)), half_height = std::sqrt(3 * (middle + spread));
  Polygon polygon;
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const Eigen::Vector2d p(x * half_width, y * half_height);
    polygon.emplace_back(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
                         std::sin(angle) * p.x() + std::cos(angle) * p.y());
  }
  return polygon;
}

}  // namespace

SectionOutline section_outline(const BeamSection& section) {
  const CaseSection& sizes = section.section;
  if (section.profile) {
    SectionOutline outline;
    for (const Loop& loop : section.profile->loops) outline.push_back(polygon_of(loop));
    return outline;
  }
  if (sizes.radius) {
    if (sizes.bore.value_or(0) > 0) return {circle(*sizes.radius, false), circle(*sizes.bore, true)};
    return {circle(*sizes.radius, false)};
  }
  if (sizes.second_moments)
    return {rectangle((*sizes.second_moments)[0] / sizes.area, (*sizes.second_moments)[1] / sizes.area,
                      sizes.product / sizes.area)};
  return {circle(2 * std::sqrt(sizes.second_moment / sizes.area), false)};
}

}  // namespace nurbeam
