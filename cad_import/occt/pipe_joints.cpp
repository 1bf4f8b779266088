#include "cad_import/occt/pipe_joints.h"

#include <Geom_Circle.hxx>
#include <Geom_Line.hxx>
#include <algorithm>
#include <array>
#include <cmath>
#include <gp_Vec.hxx>
#include <limits>
#include <optional>
#include <utility>

#include "cad_import/report/length_unit.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

/// A part of a centre line, continued beyond its ends.
struct Reach {
  const Wall* wall;
  double first, last;
};

bool goes_on(const Wall& wall) {
  return wall.centre->IsKind(STANDARD_TYPE(Geom_Line)) || wall.centre->IsKind(STANDARD_TYPE(Geom_Circle));
}

/// Two places on two centre lines.
struct Meeting {
  double here, there;
  double distance;
};

/// Where they come nearest to each other.
Meeting nearest(const Reach& a, const Reach& b) {
  constexpr int samples = 24, steps = 30;
  const auto at = [](const Reach& reach, int i) {
    return reach.first + (reach.last - reach.first) * i / samples;
  };
  Meeting best{0, 0, std::numeric_limits<double>::infinity()};
  for (int i = 0; i <= samples; ++i)
    for (int k = 0; k <= samples; ++k) {
      const double s = at(a, i), t = at(b, k);
      const double distance = a.wall->centre->Value(s).Distance(b.wall->centre->Value(t));
      if (distance < best.distance) best = {s, t, distance};
    }
  for (int i = 0; i < steps; ++i) {  // Gauss-Newton
    gp_Pnt p, q;
    gp_Vec u, v;
    a.wall->centre->D1(best.here, p, u);
    b.wall->centre->D1(best.there, q, v);
    const gp_Vec gap(p, q);
    const double uu = u.Dot(u), vv = v.Dot(v), uv = u.Dot(v), determinant = uu * vv - uv * uv;
    if (determinant <= 1e-6 * uu * vv) return {0, 0, std::numeric_limits<double>::infinity()};  // parallel
    best.here += (gap.Dot(u) * vv - gap.Dot(v) * uv) / determinant;
    best.there += (gap.Dot(u) * uv - gap.Dot(v) * uu) / determinant;
    best.here = std::clamp(best.here, a.first, a.last);
    best.there = std::clamp(best.there, b.first, b.last);
  }
  best.distance = a.wall->centre->Value(best.here).Distance(b.wall->centre->Value(best.there));
  return best;
}

/// Whether a good part of the outline lies on the wall of a pipe.
bool touches(const PipeEnd& end, const Wall& wall) {
  constexpr double near = 0.05;  // of the radius
  const auto on_it = std::count_if(end.outline.begin(), end.outline.end(), [&](const gp_Pnt& point) {
    const double distance = point.Distance(wall.centre->Value(parameter_on(wall, point)));
    return std::abs(distance - wall.radius) <= near * wall.radius;
  });
  return 4 * on_it >= static_cast<std::ptrdiff_t>(end.outline.size());
}

class Joints {
 public:
  explicit Joints(const std::vector<PipePiece>& pieces) : pieces_(pieces), breaks_(pieces.size()) {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      for (int end = 0; end < 2; ++end) breaks_[i].push_back(place_of(i, end));
    for (const auto& [piece, place] : branches_) divide(piece, place);
  }

  JoinedWalls joined() const {
    std::vector<Wall> walls;
    for (std::size_t i = 0; i < pieces_.size(); ++i)
      for (std::size_t k = 0; k + 1 < breaks_[i].size(); ++k) {
        Wall wall = pieces_[i].wall;
        wall.first = breaks_[i][k];
        wall.last = breaks_[i][k + 1];
        if (wall.last > wall.first) walls.push_back(std::move(wall));
      }
    constexpr std::size_t most_remarks = 5;
    std::vector<std::string> remarks(remarks_.begin(),
                                     remarks_.begin() + std::min(remarks_.size(), most_remarks));
    if (remarks_.size() > most_remarks)
      remarks.push_back(std::to_string(remarks_.size() - most_remarks) + " more ends of pipes are cut so");
    return {std::move(walls), std::move(remarks)};
  }

 private:
  /// From the middle of the piece to well beyond its end; the whole of one that others end on.
  static double slack(const PipePiece& a, const PipePiece& b) { return 4 * (a.wall.radius + b.wall.radius); }

  Reach reach_of_end(const PipePiece& piece, int end, const PipePiece& other) const {
    const double middle = (piece.ends[0].middle + piece.ends[1].middle) / 2;
    const double more = goes_on(piece.wall) ? slack(piece, other) / speed_of(piece.wall) : 0;
    return end == 0 ? Reach{&piece.wall, piece.ends[0].low - more, middle}
                    : Reach{&piece.wall, middle, piece.ends[1].high + more};
  }

  Reach reach_of_whole(const PipePiece& piece, const PipePiece& other) const {
    const double more = goes_on(piece.wall) ? slack(piece, other) / speed_of(piece.wall) : 0;
    return {&piece.wall, piece.ends[0].low - (piece.ends[0].is_square() ? 0 : more),
            piece.ends[1].high + (piece.ends[1].is_square() ? 0 : more)};
  }

  /// Where the centre line ends there.
  double place_of(std::size_t i, int at) {
    const PipePiece& piece = pieces_[i];
    const PipeEnd& end = piece.ends[static_cast<std::size_t>(at)];
    if (end.is_square()) return end.middle;
    if (end.cut) return *end.cut;
    constexpr double meets_within = 1e-3;  // of the smaller radius
    std::optional<std::size_t> found;
    Meeting best{};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      const PipePiece& other = pieces_[k];
      if (k == i || other.wall.is_bore != piece.wall.is_bore || !touches(end, other.wall)) continue;
      const Meeting meeting = nearest(reach_of_end(piece, at, other), reach_of_whole(other, piece));
      const double off = std::max({end.low - meeting.here, meeting.here - end.high, 0.0});
      if (meeting.distance > meets_within * std::min(piece.wall.radius, other.wall.radius) || off >= least)
        continue;
      least = off;
      best = meeting;
      found = k;
    }
    if (!found) {
      tell_of_middle(piece, end);
      return end.middle;
    }
    branches_.emplace_back(*found, best.there);
    return best.here;
  }

  void tell_of_middle(const PipePiece& piece, const PipeEnd& end) {
    const Wall& wall = piece.wall;
    const gp_Pnt place = wall.centre->Value(end.middle);
    const double off = (end.high - end.low) / 2 * speed_of(wall) / millimetres_per_metre;
    remarks_.push_back("face " + std::to_string(wall.face) + ": the pipe of radius " +
                       text_of(wall.radius / millimetres_per_metre) +
                       " m is cut neither by a plane nor on the centre line of another pipe at " +
                       text_of(Eigen::Vector3d(place.X(), place.Y(), place.Z()) / millimetres_per_metre) +
                       "; its centre line ends midway of the cut, up to " + text_of(off, 3) +
                       " m from where it may be meant to end");
  }

  /// Unless the place is one of its ends.
  void divide(std::size_t piece, double place) {
    std::vector<double>& breaks = breaks_[piece];
    const Wall& wall = pieces_[piece].wall;
    const double together = 1e-3 * wall.radius / speed_of(wall);
    if (place <= breaks.front() || place >= breaks.back()) return;
    if (std::any_of(breaks.begin(), breaks.end(),
                    [&](double at) { return std::abs(at - place) <= together; }))
      return;
    breaks.insert(std::upper_bound(breaks.begin(), breaks.end(), place), place);
  }

  const std::vector<PipePiece>& pieces_;
  std::vector<std::vector<double>> breaks_;  // of each piece, ascending
  std::vector<std::pair<std::size_t, double>> branches_;
  std::vector<std::string> remarks_;
};

}  // namespace

JoinedWalls joined_walls(const std::vector<PipePiece>& pieces) { return Joints(pieces).joined(); }

}  // namespace nurbeam
