#include "cad_import/occt/prism_section.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "nurbs/gauss_panels.h"
#include "nurbs/primitives.h"

namespace nurbeam {
namespace {

using EdgeIndex = std::size_t;  // a corner of a section is an edge
/// The other end of a side, by the face that it lies in and one end.
using Sides = std::map<std::pair<int, EdgeIndex>, EdgeIndex>;

Eigen::Vector3d in_space(const Eigen::Vector2d& place) { return {place.x(), place.y(), 0}; }

/// In a plane every second stretch between corners is material; a piece of a cylinder has two.
Sides sides_at(const PrismEdges& prism, double at) {
  std::map<int, std::vector<EdgeIndex>> corners_of;
  for (EdgeIndex i = 0; i < prism.edges.size(); ++i)
    if (prism.edges[i].low < at && at < prism.edges[i].high)
      for (const int face : prism.edges[i].faces) corners_of[face].push_back(i);
  Sides sides;
  for (auto& [face, corners] : corners_of) {
    const PrismSide& side = prism.sides.at(face);
    if (corners.size() % 2 != 0 || (side.radius > 0 && corners.size() != 2)) continue;
    std::sort(corners.begin(), corners.end(), [&](EdgeIndex a, EdgeIndex b) {
      return side.along.dot(prism.edges[a].place) < side.along.dot(prism.edges[b].place);
    });
    for (std::size_t i = 0; i < corners.size(); i += 2) {
      sides[{face, corners[i]}] = corners[i + 1];
      sides[{face, corners[i + 1]}] = corners[i];
    }
  }
  return sides;
}

std::vector<RationalCubic> cubics_of(const PrismSide& side, const Eigen::Vector2d& from,
                                     const Eigen::Vector2d& to, const Eigen::Vector2d& origin) {
  const Eigen::Vector3d start = in_space(from - origin), end = in_space(to - origin);
  if (side.radius == 0) return {line_cubic(start, end)};
  const Eigen::Vector3d middle = in_space(side.middle - origin);
  return arc_cubics(in_space(side.centre - origin), start, end, (middle - start).cross(end - middle));
}

/// Integral of f, homogeneous of this degree, over what the cubic sweeps about the origin (Green), by ten
/// points, which are exact for lines and to round-off for quarters of a turn.
template <class F>
double swept(const RationalCubic& cubic, int degree, const F& f) {
  const auto rate = [&](double u) {
    const Eigen::Matrix<double, 3, 6> d = cubic.derivatives(u);
    return f(d(0, 0), d(1, 0)) * (d(0, 0) * d(1, 1) - d(1, 0) * d(0, 1));
  };
  return gauss(rate, 0, 1) / (degree + 2);
}

/// With a positive area.
AreaMoments moments_inside(const std::vector<RationalCubic>& outline) {
  AreaMoments sum;
  for (const RationalCubic& cubic : outline) {
    const double mixed = swept(cubic, 2, [](double x, double y) { return x * y; });
    AreaMoments part;
    part.area = swept(
        cubic, 0, [](double, double) { return 1.0; });
    part.first << swept(
        cubic, 1, [](double x, double) { return x; }),
        swept(
            cubic, 1, [](double, double y) { return y; });
    part.second << swept(cubic, 2, [](double x, double) { return x * x; }), mixed, mixed,
        swept(cubic, 2, [](double, double y) { return y * y; });
    sum += part;
  }
  return sum.area < 0 ? AreaMoments{-sum.area, -sum.first, -sum.second} : sum;
}

/// From a corner around to it again; nothing where a side is missing.
std::optional<PrismLoop> loop_from(EdgeIndex start, const PrismEdges& prism, const Sides& sides,
                                   const Eigen::Vector2d& origin) {
  PrismLoop loop;
  std::vector<RationalCubic> outline;
  EdgeIndex here = start;
  int face = prism.edges[start].faces[0];
  do {
    const auto next = sides.find({face, here});
    if (next == sides.end() || loop.edges.size() > prism.edges.size()) return std::nullopt;
    const PrismEdge &from = prism.edges[here], &to = prism.edges[next->second];
    loop.edges.push_back(here);
    loop.corners.push_back(from.place);
    for (RationalCubic& cubic : cubics_of(prism.sides.at(face), from.place, to.place, origin))
      outline.push_back(std::move(cubic));
    here = next->second;
    face = to.faces[0] == face ? to.faces[1] : to.faces[0];
  } while (here != start);
  loop.moments = moments_inside(outline);
  return loop;
}

}  // namespace

bool PrismLoop::surrounds(const Eigen::Vector2d& place) const {
  bool inside = false;
  for (std::size_t i = 0, k = corners.size() - 1; i < corners.size(); k = i++) {
    const Eigen::Vector2d &a = corners[i], &b = corners[k];
    if ((a.y() > place.y()) != (b.y() > place.y()) &&
        place.x() < a.x() + (b.x() - a.x()) * (place.y() - a.y()) / (b.y() - a.y()))
      inside = !inside;
  }
  return inside;
}

std::vector<PrismLoop> prism_section(const PrismEdges& prism, double at, const Eigen::Vector2d& origin) {
  const Sides sides = sides_at(prism, at);
  std::vector<PrismLoop> loops;
  std::set<EdgeIndex> used;
  for (const auto& [key, other] : sides)
    if (used.insert(key.second).second)
      if (std::optional<PrismLoop> loop = loop_from(key.second, prism, sides, origin)) {
        used.insert(loop->edges.begin(), loop->edges.end());
        loops.push_back(std::move(*loop));
      }
  return loops;
}

}  // namespace nurbeam
