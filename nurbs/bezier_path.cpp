#include "nurbs/bezier_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

#include "nurbs/arc_length.h"
#include "nurbs/closest_point.h"
#include "nurbs/curve_vertices.h"

namespace nurbeam {
namespace {

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The direction in which the cubic starts: to the first control point that is not the start point itself.
Eigen::Vector3d start_direction(const RationalCubic& cubic) {
  Eigen::Matrix3d legs;
  for (int i = 0; i < 3; ++i) legs.col(i) = cubic.control_point(i + 1) - cubic.control_point(0);
  const Eigen::RowVector3d lengths = legs.colwise().norm();
  int i = 0;
  while (i < 2 && lengths(i) <= 1e-12 * lengths.maxCoeff()) ++i;
  return legs.col(i);
}

Eigen::Vector3d end_direction(const RationalCubic& cubic) { return -start_direction(cubic.reversed()); }

bool is_rational(const RationalCubic& cubic) {
  const Eigen::RowVector4d weights = cubic.points().row(3);
  return weights.maxCoeff() - weights.minCoeff() > 1e-14 * weights.maxCoeff();
}

/// Sum of the angles between the tangents at 33 evenly spread places [rad].
double turning(const RationalCubic& cubic) {
  constexpr int count = 32;
  const Eigen::Matrix<double, 3, 5> hodograph = cubic.hodograph();
  Eigen::Vector3d before = start_direction(cubic);
  double sum = 0;
  for (int i = 1; i <= count; ++i) {
    const double u = double(i) / count, v = 1 - u;
    Eigen::Matrix<double, 5, 1> bernstein;
    bernstein << v * v * v * v, 4 * u * v * v * v, 6 * u * u * v * v, 4 * u * u * u * v, u * u * u * u;
    const Eigen::Vector3d tangent = i < count ? hodograph * bernstein : end_direction(cubic);
    sum += angle_between(before, tangent);
    before = tangent;
  }
  return sum;
}

/// Appends the cubic, whose source lives on [a, b]; a rational one that turns by more than 90 degrees in
/// halves. A cusp turns however short its piece is, so no more than `halvings` are made.
void append(BezierPath& path, const RationalCubic& cubic, double a, double b, int halvings = 10) {
  constexpr double right_angle = 1.5707963267948966 + 1e-9;
  if (halvings > 0 && is_rational(cubic) && turning(cubic) > right_angle) {
    const auto [first, second] = cubic.split(0.5);
    const double middle = 0.5 * (a + b);
    append(path, first, a, middle, halvings - 1);
    append(path, second, middle, b, halvings - 1);
  } else {
    path.segments.push_back(cubic);
    path.breaks.push_back(b);
  }
}

/// Homogeneous Bezier points of degree 1, 2 or 3, written with degree 3.
Eigen::Matrix4d elevated(const Eigen::Matrix4Xd& bezier) {
  Eigen::Matrix4d points;
  if (bezier.cols() == 2)
    points << bezier.col(0), (2 * bezier.col(0) + bezier.col(1)) / 3, (bezier.col(0) + 2 * bezier.col(1)) / 3,
        bezier.col(1);
  else if (bezier.cols() == 3)
    points << bezier.col(0), (bezier.col(0) + 2 * bezier.col(1)) / 3, (2 * bezier.col(1) + bezier.col(2)) / 3,
        bezier.col(2);
  else
    points = bezier;
  return points;
}

/// The cubic with the homogeneous end values and end derivatives of a Bezier curve of degree p >= 3.
Eigen::Matrix4d hermite_cubic(const Eigen::Matrix4Xd& bezier) {
  const Eigen::Index p = bezier.cols() - 1;
  const double third = double(p) / 3;
  Eigen::Matrix4d points;
  points << bezier.col(0), bezier.col(0) + third * (bezier.col(1) - bezier.col(0)),
      bezier.col(p) - third * (bezier.col(p) - bezier.col(p - 1)), bezier.col(p);
  return points;
}

/// The left and right part of a homogeneous Bezier curve of any degree, cut at u (de Casteljau).
std::pair<Eigen::Matrix4Xd, Eigen::Matrix4Xd> split(Eigen::Matrix4Xd right, double u) {
  Eigen::Matrix4Xd left = right;
  for (Eigen::Index r = 1; r < right.cols(); ++r) {
    for (Eigen::Index j = 0; j + r < right.cols(); ++j)
      right.col(j) = (1 - u) * right.col(j) + u * right.col(j + 1);
    left.col(r) = right.col(0);
  }
  return {left, right};
}

/// Appends Hermite cubics for the Bezier curve, whose source lives on [a, b], halved until each is within the
/// tolerance [m].
void approximate(BezierPath& path, const Eigen::Matrix4Xd& bezier, double a, double b, double tolerance) {
  const Eigen::Matrix4d points = hermite_cubic(bezier);
  if (points.row(3).minCoeff() > 0) {
    const BezierPath cubic{{RationalCubic(points)}, {0, 1}, 0};
    const auto source = [&bezier](double u) -> Eigen::Vector3d {
      return split(bezier, u).second.col(0).hnormalized();
    };
    // The middle is where Hermite interpolation errs most: it turns most hopeless cubics down at once.
    double deviation = closest_point(cubic, source(0.5)).distance;
    if (deviation <= tolerance) deviation = largest_distance(source, cubic);
    if (deviation <= tolerance) {
      path.deviation = std::max(path.deviation, deviation);
      append(path, cubic.segments.front(), a, b);
      return;
    }
  }
  const auto [first, second] = split(bezier, 0.5);
  const double middle = 0.5 * (a + b);
  approximate(path, first, a, middle, tolerance);
  approximate(path, second, middle, b, tolerance);
}

/// The cubic with its end moved to `point`; its end direction stays.
RationalCubic with_end_at(const RationalCubic& cubic, const Eigen::Vector3d& point) {
  const Eigen::Vector3d shift = point - cubic.control_point(3);
  Eigen::Matrix4d points = cubic.points();
  points.col(2).head<3>() += cubic.weight(2) * shift;
  points.col(3).head<3>() = cubic.weight(3) * point;
  return RationalCubic(points);
}

/// Moves the end of `before` and the start of `after` to the point midway; returns how far each moved [m].
/// A gap of the size of the coordinates' round-off is left.
double close_gap(RationalCubic& before, RationalCubic& after) {
  const Eigen::Vector3d end = before.control_point(3);
  const Eigen::Vector3d start = after.control_point(0);
  const double gap = (start - end).norm();
  if (gap <= 1e-15 * end.norm()) return 0;
  const Eigen::Vector3d middle = 0.5 * (start + end);
  before = with_end_at(before, middle);
  after = with_end_at(after.reversed(), middle).reversed();
  return 0.5 * gap;
}

/// For each end of a curve (2 i: start of curve i, 2 i + 1: its end) the one other end that meets it, or -1
/// where none or more than one does.
std::vector<int> meeting_ends(const std::vector<NurbsCurve>& curves, double tolerance) {
  std::vector<int> partner(2 * curves.size(), -1);
  for (const CurveVertex& vertex : vertices_of(curves, tolerance)) {
    if (vertex.ends.size() != 2) continue;
    partner[vertex.ends[0]] = vertex.ends[1];
    partner[vertex.ends[1]] = vertex.ends[0];
  }
  return partner;
}

void reverse(Chain& chain) {
  std::reverse(chain.curves.begin(), chain.curves.end());
  std::reverse(chain.reversed.begin(), chain.reversed.end());
  chain.reversed.flip();
}

/// Lengthens the chain at its end as far as the curves go on; closed when that leads back to its first curve.
void follow(Chain& chain, const std::vector<int>& partner) {
  while (!chain.closed) {
    const int end = 2 * chain.curves.back() + (chain.reversed.back() ? 0 : 1);
    const int next = partner[end];
    if (next < 0) return;
    if (next / 2 == chain.curves.front()) {
      chain.closed = true;
    } else {
      chain.curves.push_back(next / 2);
      chain.reversed.push_back(next % 2 == 1);
    }
  }
}

void require_one_break_more_than_segments(const BezierPath& path) {
  if (!path.segments.empty() && path.breaks.size() == path.segments.size() + 1) return;
  std::ostringstream message;
  message << "a path has " << path.segments.size() << " segments and " << path.breaks.size()
          << " breaks; it must have at least one segment and one break more than segments";
  throw std::invalid_argument(message.str());
}

}  // namespace

BezierPath BezierPath::from_nurbs(const NurbsCurve& curve, double tolerance) {
  const bool exact = curve.degree() <= 3;
  if (!exact && !(tolerance > 0)) {
    std::ostringstream message;
    message << "the tolerance is " << tolerance << " m; a curve of degree " << curve.degree()
            << " needs one above 0";
    throw std::invalid_argument(message.str());
  }
  const double round_off = 1e-14 * curve.control_points().colwise().hnormalized().cwiseAbs().maxCoeff();
  const std::vector<double> source_breaks = curve.knots().breaks();
  BezierPath path{{}, {source_breaks.front()}, 0};
  for (std::size_t i = 0; i + 1 < source_breaks.size(); ++i) {
    const double a = source_breaks[i], b = source_breaks[i + 1];
    const Eigen::Matrix4Xd bezier = curve.bezier_points(curve.knots().find_span(a));
    if (exact)
      append(path, RationalCubic(elevated(bezier)), a, b);
    else
      approximate(path, bezier, a, b, std::max(tolerance, round_off));
  }
  return path;
}

NurbsCurve BezierPath::to_nurbs() const {
  require_one_break_more_than_segments(*this);
  Eigen::Matrix4Xd points(4, 3 * segments.size() + 1);
  std::vector<double> knots{breaks.front()};
  double sigma = 1;
  for (std::size_t j = 0; j < segments.size(); ++j) {
    if (j > 0) sigma *= segments[j - 1].weight(3) / segments[j].weight(0);
    points.middleCols(3 * j, 3) = sigma * segments[j].points().leftCols<3>();
    points.rightCols<1>() = sigma * segments[j].points().col(3);
    knots.insert(knots.end(), 3, breaks[j]);
  }
  knots.insert(knots.end(), 4, breaks.back());
  return {KnotVector(3, std::move(knots)), std::move(points)};
}

double BezierPath::length() const {
  double sum = 0;
  for (const RationalCubic& segment : segments) sum += nurbeam::length(segment);
  return sum;
}

std::vector<Corner> BezierPath::corners(double angle) const {
  std::vector<Corner> corners;
  for (std::size_t j = 0; j + 1 < segments.size(); ++j) {
    const double turn = angle_between(end_direction(segments[j]), start_direction(segments[j + 1]));
    if (turn > angle) corners.push_back({static_cast<int>(j), segments[j].control_point(3), turn});
  }
  return corners;
}

std::vector<Chain> find_chains(const std::vector<NurbsCurve>& curves, double tolerance) {
  const std::vector<int> partner = meeting_ends(curves, tolerance);
  std::vector<bool> used(curves.size(), false);
  std::vector<Chain> chains;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (used[i]) continue;
    Chain chain{{static_cast<int>(i)}, {false}, false};
    follow(chain, partner);
    if (!chain.closed) {
      reverse(chain);
      follow(chain, partner);
      reverse(chain);
      if (chain.reversed.front() && chain.reversed.back()) reverse(chain);
    }
    for (const int curve : chain.curves) used[curve] = true;
    chains.push_back(std::move(chain));
  }
  return chains;
}

BezierPath join(const std::vector<NurbsCurve>& curves, const Chain& chain, double tolerance) {
  BezierPath joined;
  double largest_shift = 0;
  for (std::size_t i = 0; i < chain.curves.size(); ++i) {
    const NurbsCurve& curve = curves.at(chain.curves[i]);
    const BezierPath next = BezierPath::from_nurbs(chain.reversed[i] ? curve.reversed() : curve, tolerance);
    if (i == 0) joined.breaks = {next.breaks.front()};
    const std::size_t joint = joined.segments.size();
    const double offset = joined.breaks.back() - next.breaks.front();
    joined.segments.insert(joined.segments.end(), next.segments.begin(), next.segments.end());
    for (std::size_t j = 1; j < next.breaks.size(); ++j) joined.breaks.push_back(offset + next.breaks[j]);
    joined.deviation = std::max(joined.deviation, next.deviation);
    if (i > 0)
      largest_shift = std::max(largest_shift, close_gap(joined.segments[joint - 1], joined.segments[joint]));
  }
  if (chain.closed)
    largest_shift = std::max(largest_shift, close_gap(joined.segments.back(), joined.segments.front()));
  joined.deviation += largest_shift;
  return joined;
}

}  // namespace nurbeam
