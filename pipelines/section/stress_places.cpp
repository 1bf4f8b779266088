#include "pipelines/section/stress_places.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "nurbs/bezier_path.h"

namespace nurbeam {
namespace {

constexpr int parts = 32;       // of a segment, which turns by 90 degrees at most
constexpr double sharp = 0.17;  // the turn at a corner from which on it is one [rad]

Eigen::Vector2d flat(const Eigen::Vector3d& p) { return p.head<2>(); }

Eigen::Vector2d direction(const RationalCubic& cubic, bool at_end) {
  // A control point may lie on the end.
  const int end = at_end ? 3 : 0, inward = at_end ? -1 : 1;
  for (int i = end + inward; i >= 0 && i <= 3; i += inward) {
    const Eigen::Vector2d d = flat(cubic.control_point(i) - cubic.control_point(end)) * inward;
    if (d.norm() > 0) return d.normalized();
  }
  return Eigen::Vector2d::UnitX();
}

// From the end of segment j to the next one: positive where the corner stands out, as material is on the
// left.
double turn_after(const Loop& loop, std::size_t j) {
  const Eigen::Vector2d a = direction(loop[j], true), b = direction(loop[(j + 1) % loop.size()], false);
  return std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
}

// Shear by the parameter of one segment: linear between places, constant outside.
class ShearAlong {
 public:
  explicit ShearAlong(std::vector<std::pair<double, double>> places) : places_(std::move(places)) {
    std::sort(places_.begin(), places_.end());
  }
  double at(double u) const {
    if (places_.empty()) return std::numeric_limits<double>::quiet_NaN();
    const auto after = std::lower_bound(places_.begin(), places_.end(), std::pair{u, 0.0});
    if (after == places_.begin()) return places_.front().second;
    if (after == places_.end()) return places_.back().second;
    const auto before = std::prev(after);
    const double part = (u - before->first) / (after->first - before->first);
    return before->second + part * (after->second - before->second);
  }

 private:
  std::vector<std::pair<double, double>> places_;
};

std::vector<Eigen::Vector2d> reentrant_corners(const std::vector<Loop>& loops) {
  std::vector<Eigen::Vector2d> corners;
  for (const Loop& loop : loops)
    for (std::size_t j = 0; j < loop.size(); ++j)
      if (turn_after(loop, j) < -sharp) corners.push_back(flat(loop[j].control_point(3)));
  return corners;
}

}  // namespace

std::vector<StressPlace> stress_places(const SectionProfile& profile, const TorsionReport& torsion) {
  const std::vector<Eigen::Vector2d> corners = reentrant_corners(profile.loops);
  double perimeter = 0;
  for (const Loop& loop : profile.loops) perimeter += total_length(loop);
  const double too_near = profile.area / perimeter;
  const auto counts = [&](const Eigen::Vector2d& place) {
    return std::all_of(corners.begin(), corners.end(),
                       [&](const Eigen::Vector2d& corner) { return (corner - place).norm() >= too_near; });
  };
  std::vector<StressPlace> places;
  for (int l = 0; l < static_cast<int>(profile.loops.size()); ++l) {
    const Loop& loop = profile.loops[l];
    for (std::size_t j = 0; j < loop.size(); ++j) {
      std::vector<std::pair<double, double>> known;
      for (const TorsionReport::AtBoundary& at : torsion.boundary)
        if (at.loop == l && at.segment == static_cast<int>(j) && counts(flat(loop[j].point(at.u))))
          known.emplace_back(at.u, at.shear / torsion.value);
      const std::size_t before = (j + loop.size() - 1) % loop.size();
      if (!known.empty() && turn_after(loop, before) > sharp) known.emplace_back(0, 0);
      if (!known.empty() && turn_after(loop, j) > sharp) known.emplace_back(1, 0);
      const ShearAlong shear(std::move(known));
      for (int i = 0; i <= parts; ++i) {
        const double u = static_cast<double>(i) / parts;
        places.push_back({flat(loop[j].point(u)), shear.at(u)});
      }
    }
  }
  return places;
}

}  // namespace nurbeam
