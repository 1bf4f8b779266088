#include "pipelines/results/swept_section.h"

#include <Eigen/Geometry>
#include <cmath>

#include "nurbs/interpolated_cubic.h"
#include "nurbs/number_text.h"
#include "nurbs/rational_cubic.h"

namespace nurbeam {
namespace {

// The sections along a beam, at increasing parameters: chords summed up.
struct Stations {
  std::vector<double> parameters;
  std::vector<Eigen::Vector3d> centres, d1, d2;

  explicit Stations(const BeamRecord& beam) {
    for (const ElementRecord& e : beam.elements)
      for (int i = &e == beam.elements.data() ? 0 : 1; i < 4; ++i) {
        const Eigen::Vector3d centre = RationalCubic(e.control_points).point(i / 3.0);
        parameters.push_back(centres.empty() ? 0 : parameters.back() + (centre - centres.back()).norm());
        centres.push_back(centre);
        d1.emplace_back(e.d1.col(i));
        d2.emplace_back(e.d2.col(i));
      }
  }

  NurbsCurve line(const Eigen::Vector2d& place) const {
    Eigen::Matrix3Xd points(3, centres.size());
    for (std::size_t i = 0; i < centres.size(); ++i)
      points.col(static_cast<int>(i)) = centres[i] + place.x() * d1[i] + place.y() * d2[i];
    return interpolated_cubic(parameters, points);
  }
};

Eigen::Vector2d flat(const Eigen::Vector3d& p) { return p.head<2>(); }

// A direction in which the cubic begins, or ends.
Eigen::Vector2d direction(const RationalCubic& cubic, bool at_end) {
  return flat(cubic.derivatives(at_end ? 1 : 0).col(1)).normalized();
}

}  // namespace

std::optional<std::string> sweeping_obstacle(const BeamRecord& beam) {
  constexpr double smooth = 1e-2;  // [rad]; small angles of a drawing are smoothed
  for (std::size_t i = 0; i < beam.elements.size(); ++i) {
    const ElementRecord& e = beam.elements[i];
    if (e.d1.hasNaN()) return "it has no torsion, so that its sections have no orientation";
    if (i == 0) continue;
    const ElementRecord& before = beam.elements[i - 1];
    if ((e.d1.col(0) - before.d1.col(3)).norm() > smooth || (e.d2.col(0) - before.d2.col(3)).norm() > smooth)
      return "it has a corner at s = " + text_of(e.s_start) + " m";
  }
  const Eigen::Vector4d first = beam.elements.front().control_points.col(0),
                        last = beam.elements.back().control_points.col(3);
  if ((first.hnormalized() - last.hnormalized()).norm() < 1e-9 * beam.length) return "it is a ring";
  return {};
}

NurbsCurve section_line(const BeamRecord& beam, const Eigen::Vector2d& place) {
  return Stations(beam).line(place);
}

SweptProfile swept_section(const BeamRecord& beam, const std::vector<Loop>& profile, double area,
                           const std::string& name, const std::string& part) {
  const Stations stations(beam);
  SweptProfile swept{name, part, {}, area * beam.length};
  for (const Loop& loop : profile) {
    std::vector<SweptCubic>& cubics = swept.loops.emplace_back();
    for (const RationalCubic& cubic : loop) {
      const auto rail = [&](int k) { return stations.line(flat(cubic.control_point(k))); };
      cubics.push_back({{rail(0), rail(1), rail(2), rail(3)},
                        {cubic.weight(0), cubic.weight(1), cubic.weight(2), cubic.weight(3)}});
    }
  }
  return swept;
}

std::vector<Eigen::Vector2d> marked_places(const std::vector<Loop>& profile) {
  constexpr double sharp = 0.17;  // [rad]
  std::vector<Eigen::Vector2d> corners, farthest(4, Eigen::Vector2d::Zero());
  constexpr std::pair<double, double> axes[] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  for (const Loop& loop : profile)
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Eigen::Vector2d a = direction(loop[j], true), b = direction(loop[(j + 1) % loop.size()], false);
      if (std::abs(std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b))) > sharp)
        corners.push_back(flat(loop[j].control_point(3)));
      constexpr int parts = 32;
      for (int i = 0; i < parts; ++i)
        for (int k = 0; k < 4; ++k) {
          const Eigen::Vector2d p = flat(loop[j].point(static_cast<double>(i) / parts)),
                                axis(axes[k].first, axes[k].second);
          if (p.dot(axis) > farthest[k].dot(axis)) farthest[k] = p;
        }
    }
  return corners.empty() ? farthest : corners;
}

}  // namespace nurbeam
