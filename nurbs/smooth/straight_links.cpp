#include "nurbs/smooth/straight_links.h"

#include <algorithm>

namespace nurbeam::smooth {

namespace {

/// What a line has to join at one of its ends.
struct LineEnd {
  double weight = 1;
  double slope = 0;  // of the weight, towards the line, per unit of the parameter
  double speed = 1;
  double unit = 0;  // interval of the parameter that is natural there; 0 at an end that nothing joins
};

/// The joint at the last point of the piece.
LineEnd end_of(const Piece& piece) {
  const Eigen::Index p = piece.degree();
  const double rate = double(p) / piece.length;
  return {piece.weight(p), rate * (piece.weight(p) - piece.weight(p - 1)),
          rate * piece.weight(p - 1) / piece.weight(p) * leg(piece, p - 1).norm(), piece.length};
}

Piece reversed(Piece piece) {
  piece.points.rowwise().reverseInPlace();
  return piece;
}

/// A piece at one end of a line: it begins with the joint's weight, slope and speed and ends with level
/// weight and unit speed.
struct Ramp {
  double length;    // of its interval
  double weight;    // of its second and last control point
  double reach[2];  // distances of these from the joint [m]
};

Ramp ramp(const LineEnd& joint, double length) {
  const double weight = joint.weight + 0.5 * length * joint.slope;
  const double second = 0.5 * length * joint.speed * joint.weight / weight;
  return {length, weight, {second, second + 0.5 * length}};
}

/// The ramps at both ends of a line of this length: as long as there is room for, up to a few natural
/// intervals and mild weights. They meet where they can.
std::pair<Ramp, Ramp> ramps(const LineEnd& from, const LineEnd& to, double length) {
  static constexpr double longest = 4;  // natural intervals
  const auto at = [](const LineEnd& joint, double share) {
    const double gain = 0.5 * joint.unit * joint.slope / joint.weight;  // of the weight in a natural interval
    const double most = gain > 0 ? 2 : 0.5;                             // shares of it
    return ramp(joint, share * joint.unit * std::min(longest, most / std::max(std::abs(gain), 1e-9)));
  };
  const auto fits = [&](double share) { return at(from, share).reach[1] + at(to, share).reach[1] <= length; };
  double low = 0, high = 1;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (fits(middle) ? low : high) = middle;
  }
  if (fits(1)) low = 1;
  return {at(from, low), at(to, low)};
}

/// The line from a to b, which joins what is before and after it.
Pieces linked(const Piece& line, const LineEnd& from, const LineEnd& to) {
  const Eigen::Index p = line.degree();
  const Eigen::Vector3d a = line.points.col(0).hnormalized(), b = line.points.col(p).hnormalized();
  const double length = (b - a).norm();
  const auto [first, last] = ramps(from, to, length);
  const auto at = [&](double distance, double weight) {
    return Eigen::Vector4d(weight * (a + distance / length * (b - a)).homogeneous());
  };
  Pieces pieces;
  const auto add = [&](const Eigen::Vector4d& start, const Eigen::Vector4d& middle,
                       const Eigen::Vector4d& end, double interval) {
    Points points(4, 3);
    points << start, middle, end;
    pieces.push_back({elevated(points, p), interval, line.deviation});
  };
  if (first.length > 0)
    add(at(0, from.weight), at(first.reach[0], first.weight), at(first.reach[1], first.weight), first.length);
  const double begin = first.reach[1], end = length - last.reach[1];
  if (end - begin > 1e-9 * length) add(at(begin, 1), at(0.5 * (begin + end), 1), at(end, 1), end - begin);
  if (last.length > 0)
    add(at(end, last.weight), at(length - last.reach[0], last.weight), at(length, to.weight), last.length);
  return pieces;
}

/// The bent pieces with changes that make them C1, of mild weights and about unit speed.
std::optional<Pieces> mild_run(const Pieces& bent) {
  const auto changes = mild_changes(bent, 0, int(bent.size()) - 1);
  if (!changes) return std::nullopt;
  Pieces run = changed(bent, 0, *changes);
  const double speed = std::sqrt(end_of(reversed(run.front())).speed * end_of(run.back()).speed);
  const double weight = std::sqrt(run.front().weight(0) * run.back().weight(run.back().degree()));
  for (Piece& piece : run) {
    piece.length *= speed;
    piece.points /= weight;
  }
  return run;
}

/// The pieces with the weight at the start of each the one at the end of that before.
Pieces of_continuous_weight(Pieces pieces) {
  for (std::size_t j = 1; j < pieces.size(); ++j) {
    const Piece& before = pieces[j - 1];
    pieces[j].points *= before.weight(before.degree()) / pieces[j].weight(0);
  }
  return pieces;
}

/// Neighbours that are all straight, or all bent and share their tangents.
struct Group {
  Pieces pieces;
  bool straight;
};

std::vector<Group> groups_of(const Pieces& pieces, double tolerance) {
  std::vector<Group> groups;
  for (const Piece& piece : pieces) {
    const bool straight = is_straight(piece, tolerance);
    if (groups.empty() || straight || groups.back().straight ||
        !share_tangent(groups.back().pieces.back(), piece, tolerance))
      groups.push_back({{}, straight});
    groups.back().pieces.push_back(piece);
  }
  return groups;
}

/// The line of group i between what stands before and after it.
Pieces linked(const std::vector<Group>& groups, std::size_t i, double tolerance) {
  const Piece& line = groups[i].pieces[0];
  LineEnd from, to;
  if (i > 0 && !groups[i - 1].straight && share_tangent(groups[i - 1].pieces.back(), line, tolerance))
    from = end_of(groups[i - 1].pieces.back());
  if (i + 1 < groups.size() && !groups[i + 1].straight &&
      share_tangent(line, groups[i + 1].pieces[0], tolerance))
    to = end_of(reversed(groups[i + 1].pieces[0]));
  return linked(line, from, to);
}

bool is_level(const Group& group) {
  return std::all_of(
      group.pieces.begin(), group.pieces.end(),
      [](const Piece& piece) { return spread(piece.points.row(3)) < 1e-12; });
}

}  // namespace

bool is_straight(const Piece& piece, double tolerance) {
  const Eigen::Index p = piece.degree();
  const Eigen::Vector3d start = piece.points.col(0).hnormalized();
  const Eigen::Vector3d chord = piece.points.col(p).hnormalized() - start;
  if (!(chord.norm() > tolerance)) return false;
  const Eigen::Vector3d along = chord.normalized();
  for (Eigen::Index i = 0; i < p; ++i) {
    const Eigen::Vector3d offset = piece.points.col(i).hnormalized() - start;
    if ((offset - along.dot(offset) * along).norm() > tolerance || !(along.dot(leg(piece, i)) > 0))
      return false;
  }
  return true;
}

std::optional<Pieces> with_straight_links(const Pieces& pieces, double tolerance) {
  std::vector<Group> groups = groups_of(pieces, tolerance);
  const auto is_line = [](const Group& group) { return group.straight; };
  if (pieces[0].degree() < 2 || std::none_of(groups.begin(), groups.end(), is_line) ||
      std::all_of(groups.begin(), groups.end(), is_level))
    return std::nullopt;
  for (Group& group : groups)
    if (!group.straight) {
      std::optional<Pieces> run = mild_run(group.pieces);
      if (!run) return std::nullopt;
      group.pieces = std::move(*run);
    }
  Pieces result;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const Pieces own = groups[i].straight ? linked(groups, i, tolerance) : groups[i].pieces;
    result.insert(result.end(), own.begin(), own.end());
  }
  return of_continuous_weight(std::move(result));
}

}  // namespace nurbeam::smooth
