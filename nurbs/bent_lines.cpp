#include "nurbs/bent_lines.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "nurbs/primitives.h"

namespace nurbeam {

bool BentLines::closed() const { return points.size() > 3 && points.front() == points.back(); }

std::size_t BentLines::corner_count() const { return points.size() - (closed() ? 1 : 2); }

namespace {

constexpr double straight = 1e-4;   // a turn that is none [rad]
constexpr double back = 1e4;        // the tangent of half a turn that goes back
constexpr double round_off = 1e-9;  // part of a line

/// A corner with its arc, of radius r: it takes r tan(turn/2) of either line.
struct Bend {
  Eigen::Vector3d at, in, out;  ///< directions of the lines
  double radius, half_turn;     ///< tangent of half the angle between the lines; 0: they are one line

  double cut() const { return radius * half_turn; }
  Eigen::Vector3d start() const { return at - cut() * in; }
  Eigen::Vector3d end() const { return at + cut() * out; }
};

double length_of(const BentLines& lines, std::size_t line) {
  return (lines.points[line + 1] - lines.points[line]).norm();
}

std::vector<Bend> bends_of(const BentLines& lines) {
  std::vector<Bend> bends;
  for (std::size_t c = 0; c < lines.corner_count(); ++c) {
    const std::size_t i = lines.point_of(c), before = i > 0 ? i - 1 : lines.points.size() - 2;
    const Eigen::Vector3d in = (lines.points[before + 1] - lines.points[before]).normalized(),
                          out = (lines.points[i + 1] - lines.points[i]).normalized();
    const double turn = std::atan2(in.cross(out).norm(), in.dot(out));
    bends.push_back({lines.points[i], in, out, lines.radii[lines.radii.size() == 1 ? 0 : c],
                     turn > straight ? std::tan(turn / 2) : 0});
  }
  return bends;
}

/// The corners at the ends of a line; none at the ends of the whole.
struct EndsOfLine {
  std::optional<std::size_t> start, end;
};
EndsOfLine ends_of(const BentLines& lines, std::size_t line) {
  const std::size_t corners = lines.corner_count();
  EndsOfLine ends;
  if (line > 0) ends.start = line - 1;
  if (line == 0 && lines.closed()) ends.start = corners - 1;
  if (line < corners) ends.end = line;
  return ends;
}

/// The radius for which a line has room at one of its ends.
double room_for(const std::vector<Bend>& bends, double length, std::size_t corner,
                const std::optional<std::size_t>& other, bool alike) {
  const double t = bends[corner].half_turn;
  if (!other) return length / t;
  if (alike) return length / (t + bends[*other].half_turn);
  return std::max(0.0, length - bends[*other].cut()) / t;
}

}  // namespace

std::optional<TightBend> tight_bend(const BentLines& lines) {
  const std::vector<Bend> bends = bends_of(lines);
  const bool alike = lines.radii.size() == 1;
  std::optional<TightBend> tightest;
  const auto look = [&](std::size_t corner, const std::optional<std::size_t>& other, double length) {
    const Bend& bend = bends[corner];
    const double room = room_for(bends, length, corner, other, alike), allowed = room * (1 + round_off);
    if (bend.half_turn == 0 || bend.radius <= allowed) return;
    if (!tightest || room / bend.radius < tightest->largest / tightest->radius)
      tightest = {corner, bend.radius, room, bend.half_turn > back};
  };
  for (std::size_t line = 0; line + 1 < lines.points.size(); ++line) {
    const auto [start, end] = ends_of(lines, line);
    const double length = length_of(lines, line);
    const bool at_end = end && (!start || bends[*end].cut() > bends[*start].cut());
    if (at_end)
      look(*end, start, length);
    else if (start)
      look(*start, end, length);
  }
  return tightest;
}

std::vector<RationalCubic> bent_line_cubics(const BentLines& lines) {
  const std::vector<Bend> bends = bends_of(lines);
  std::vector<RationalCubic> cubics;
  Eigen::Vector3d from = lines.closed() ? bends.back().end() : lines.points.front();
  const auto add_line = [&](const Eigen::Vector3d& to, double whole) {
    if ((to - from).norm() <= round_off * whole) return from;  // the arcs meet there
    cubics.push_back(line_cubic(from, to));
    return to;
  };
  for (std::size_t c = 0; c < bends.size(); ++c) {
    const Bend& bend = bends[c];
    const Eigen::Vector3d start = add_line(bend.start(), length_of(lines, c));
    from = bend.end();
    if (bend.half_turn == 0) continue;
    const Eigen::Vector3d normal = bend.in.cross(bend.out).normalized();
    const Eigen::Vector3d centre = bend.start() + bend.radius * normal.cross(bend.in);
    const std::vector<RationalCubic> arc = arc_cubics(centre, start, bend.end(), normal);
    cubics.insert(cubics.end(), arc.begin(), arc.end());
  }
  if (!lines.closed()) add_line(lines.points.back(), length_of(lines, lines.points.size() - 2));
  return cubics;
}

}  // namespace nurbeam
