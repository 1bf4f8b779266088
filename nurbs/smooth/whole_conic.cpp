#include "nurbs/smooth/whole_conic.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "nurbs/smooth/rejoin.h"

namespace nurbeam::smooth {

namespace {

using std::numbers::pi;

/// centre + cos(angle) a + sin(angle) b.
struct Ellipse {
  Eigen::Vector3d centre, a, b;

  Eigen::Vector3d offset(double angle) const { return std::cos(angle) * a + std::sin(angle) * b; }
  /// Of a point of it, from that before on.
  double angle_of(const Eigen::Vector3d& point, double before) const {
    const Eigen::Matrix<double, 3, 2> axes = (Eigen::Matrix<double, 3, 2>() << a, b).finished();
    const Eigen::Vector2d at = (axes.transpose() * axes).inverse() * axes.transpose() * (point - centre);
    const double angle = std::atan2(at.y(), at.x());
    return angle + 2 * pi * std::ceil((before - angle) / (2 * pi));
  }
};

/// A quadratic with equal weights at its ends as a part of an ellipse.
struct Arc {
  Eigen::Vector3d centre, from_start, to_end;  // derivatives by the angle at its ends
};

/// Nothing where it is no part of one.
std::optional<Arc> arc_with(const Points& conic) {
  const double cosine = conic(3, 1) / conic(3, 0);
  if (!(cosine > 0 && cosine < 1 - 1e-9)) return std::nullopt;
  const Eigen::Vector3d start = conic.col(0).hnormalized(), corner = conic.col(1).hnormalized(),
                        end = conic.col(2).hnormalized(), middle = 0.5 * (start + end);
  const double cotangent = cosine / std::sqrt(1 - cosine * cosine);
  return Arc{middle - cotangent * cotangent * (corner - middle), cotangent * (corner - start),
             cotangent * (end - corner)};
}

/// The mean of what the pieces say.
std::optional<Ellipse> ellipse_of(const Pieces& pieces) {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Arc> arcs;
  for (const Piece& piece : pieces) {
    const std::optional<Arc> arc = arc_with(balanced(piece.points));
    if (!arc) return std::nullopt;
    arcs.push_back(*arc);
    centre += arc->centre / static_cast<double>(pieces.size());
  }
  const Eigen::Vector3d start = pieces.front().points.col(0).hnormalized();
  return Ellipse{centre, start - centre, 0.5 * (arcs.front().from_start + arcs.back().to_end)};
}

Points arc_of(const Ellipse& ellipse, double from, double to) {
  const double cosine = std::cos(0.5 * (to - from));
  Points arc(4, 3);
  arc << ellipse.centre + ellipse.offset(from), cosine * ellipse.centre + ellipse.offset(0.5 * (from + to)),
      ellipse.centre + ellipse.offset(to), 1, cosine, 1;
  return arc;
}

/// How far the pieces lie from the ellipse at most; never where they do not go around it once.
double deviation_from(const Ellipse& ellipse, const Pieces& pieces) {
  double angle = 0, deviation = 0;
  for (const Piece& piece : pieces) {
    const bool is_last = &piece == &pieces.back();
    const double end = is_last ? 2 * pi : ellipse.angle_of(piece.points.col(2).hnormalized(), angle);
    if (!(end > angle && end - angle < pi)) return never;
    deviation = std::max(
        deviation, piece.deviation + distance_bound(balanced(piece.points), arc_of(ellipse, angle, end)));
    angle = end;
  }
  return deviation;
}

}  // namespace

std::optional<SmoothNurbs> whole_conic(const Pieces& pieces, double start, double length, double tolerance) {
  const std::optional<Ellipse> ellipse = ellipse_of(pieces);
  if (!ellipse) return std::nullopt;
  const double deviation = deviation_from(*ellipse, pieces);
  if (!(deviation <= tolerance)) return std::nullopt;
  Eigen::Vector4d h0, h1, h2;
  h0 << ellipse->centre + ellipse->a, 1;
  h1 << ellipse->b, 0;
  h2 << ellipse->centre - ellipse->a, 1;
  Eigen::Matrix4Xd points(4, 6);
  points << 3 * h0, h0 / 3 + 2 * h1, h2 + 2 * h1 / 3, h2 - 2 * h1 / 3, h0 / 3 - 2 * h1, 3 * h0;
  const double middle = start + 0.5 * length, end = start + length;
  return SmoothNurbs{
      NurbsCurve(KnotVector(3, {start, start, start, start, middle, middle, end, end, end, end}), points),
      deviation};
}

}  // namespace nurbeam::smooth
