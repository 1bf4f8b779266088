#include "pipelines/section/profile_polygon.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace nurbeam {
namespace {

/// The largest angle between the chord of a cubic and a leg of its control polygon.
double largest_turn(const RationalCubic& cubic) {
  const Eigen::Vector2d chord = (cubic.control_point(3) - cubic.control_point(0)).head<2>();
  double turn = 0;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d leg = (cubic.control_point(i + 1) - cubic.control_point(i)).head<2>();
    if (leg.norm() > 1e-12 * chord.norm())
      turn = std::max(turn, std::abs(std::atan2(cross(chord, leg), chord.dot(leg))));
  }
  return turn;
}

void cut(const Loop& loop, BoundaryPiece piece, double angle, int depth, ProfilePolygon& polygon) {
  const RationalCubic cubic = loop[piece.segment].piece(piece.u0, piece.u1);
  constexpr int deepest = 20;
  if (largest_turn(cubic) <= angle || depth == deepest) {
    polygon.corners.emplace_back(cubic.control_point(0).head<2>());
    polygon.pieces.push_back(piece);
    return;
  }
  const double middle = 0.5 * (piece.u0 + piece.u1);
  cut(loop, {piece.loop, piece.segment, piece.u0, middle}, angle, depth + 1, polygon);
  cut(loop, {piece.loop, piece.segment, middle, piece.u1}, angle, depth + 1, polygon);
}

struct Edge {
  int polygon, index;
  Eigen::Vector2d a, b;
};

/// Where two edges that do not follow each other meet.
std::optional<Eigen::Vector2d> meeting(const Edge& e, const Edge& f) {
  const Eigen::Vector2d d = e.b - e.a, g = f.b - f.a, offset = f.a - e.a;
  const double det = cross(d, g);
  if (std::abs(det) <= 1e-14 * d.norm() * g.norm()) {
    if (std::abs(cross(d, offset)) > 1e-12 * d.norm() * std::max(d.norm(), offset.norm())) return {};
    const double s0 = offset.dot(d) / d.squaredNorm(), s1 = (f.b - e.a).dot(d) / d.squaredNorm();
    if (std::max(s0, s1) < 0 || std::min(s0, s1) > 1) return {};
    return e.a + std::clamp(std::min(s0, s1), 0.0, 1.0) * d;
  }
  const double s = cross(offset, g) / det, t = cross(offset, d) / det;
  if (s < 0 || s > 1 || t < 0 || t > 1) return {};
  return e.a + s * d;
}

}  // namespace

double ProfilePolygon::area() const {
  double sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]) / 2;
  return sum;
}

bool ProfilePolygon::contains(const Eigen::Vector2d& point) const {
  double turned = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d a = corners[i] - point, b = corners[(i + 1) % corners.size()] - point;
    turned += std::atan2(cross(a, b), a.dot(b));
  }
  return std::abs(turned) > std::numbers::pi;
}

double middle_of(const Loop& loop, const BoundaryPiece& piece) {
  const RationalCubic& cubic = loop[piece.segment];
  const Eigen::Vector3d start = cubic.point(piece.u0), end = cubic.point(piece.u1), chord = end - start;
  double low = piece.u0, high = piece.u1;
  for (int i = 0; i < 60; ++i) {
    const double u = 0.5 * (low + high);
    ((cubic.point(u) - 0.5 * (start + end)).dot(chord) < 0 ? low : high) = u;
  }
  return 0.5 * (low + high);
}

std::vector<ProfilePolygon> profile_polygons(const std::vector<Loop>& loops, double angle) {
  std::vector<ProfilePolygon> polygons(loops.size());
  for (std::size_t k = 0; k < loops.size(); ++k)
    for (std::size_t j = 0; j < loops[k].size(); ++j)
      cut(loops[k], {static_cast<int>(k), static_cast<int>(j), 0, 1}, angle, 0, polygons[k]);
  return polygons;
}

std::optional<Eigen::Vector2d> crossing(const std::vector<ProfilePolygon>& polygons) {
  std::vector<Edge> edges;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    const std::vector<Eigen::Vector2d>& corners = polygons[k].corners;
    for (std::size_t i = 0; i < corners.size(); ++i)
      edges.push_back(
          {static_cast<int>(k), static_cast<int>(i), corners[i], corners[(i + 1) % corners.size()]});
  }
  const auto left = [](const Edge& e) { return std::min(e.a.x(), e.b.x()); };
  std::sort(edges.begin(), edges.end(), [&](const Edge& e, const Edge& f) { return left(e) < left(f); });
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const Edge& e = edges[i];
    for (std::size_t j = i + 1; j < edges.size() && left(edges[j]) <= std::max(e.a.x(), e.b.x()); ++j) {
      const Edge& f = edges[j];
      if (std::min(e.a.y(), e.b.y()) > std::max(f.a.y(), f.b.y()) ||
          std::max(e.a.y(), e.b.y()) < std::min(f.a.y(), f.b.y()))
        continue;
      const int count = static_cast<int>(polygons[e.polygon].corners.size());
      const bool neighbours =
          e.polygon == f.polygon && ((e.index + 1) % count == f.index || (f.index + 1) % count == e.index);
      if (neighbours) continue;
      if (const auto point = meeting(e, f)) return point;
    }
  }
  return {};
}

std::vector<ProfilePolygon> polygons_without_crossing(const std::vector<Loop>& loops) {
  constexpr double coarsest = std::numbers::pi / 12, finest = coarsest / 128;
  for (double angle = coarsest; angle >= finest; angle /= 2) {
    std::vector<ProfilePolygon> polygons = profile_polygons(loops, angle);
    if (!crossing(polygons)) return polygons;
  }
  return {};
}

}  // namespace nurbeam
