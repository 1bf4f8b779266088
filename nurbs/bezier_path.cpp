#include "nurbs/bezier_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "nurbs/arc_length.h"
#include "nurbs/bezier.h"
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

// ------------------------------------------------------------------------------- degrees above three

constexpr double never = std::numeric_limits<double>::infinity();

/// A curve as Bezier pieces on the intervals between its breaks.
struct Source {
  std::vector<double> breaks;
  std::vector<BezierPoints> pieces;

  /// The piece that begins at u or holds it.
  std::size_t piece_at(double u) const {
    const auto after = std::upper_bound(breaks.begin() + 1, breaks.end() - 1, u);
    return after - breaks.begin() - 1;
  }
  /// The part of piece j on [a, b], which lies within it.
  BezierPoints part_of(std::size_t j, double a, double b) const {
    const double from = breaks[j], length = breaks[j + 1] - from;
    if (a == from && b == breaks[j + 1]) return pieces[j];
    return part(pieces[j], (a - from) / length, b == breaks[j + 1] ? 1 : (b - from) / length);
  }
};

/// The cubic with the homogeneous end values and end derivatives of the source on [a, b], and a proven bound
/// on its distance from it [m].
struct Approximation {
  Eigen::Matrix4d points;
  double deviation;
};

Approximation hermite(const Source& source, double a, double b) {
  constexpr int halvings = 3;
  const std::size_t first = source.piece_at(a);
  std::size_t last = first;
  while (source.breaks[last + 1] < b) ++last;
  std::vector<BezierPoints> parts;
  std::vector<double> shares{0};  // where the parts end in [a, b], as shares of it
  for (std::size_t j = first; j <= last; ++j) {
    const double end = std::min(b, source.breaks[j + 1]);
    parts.push_back(source.part_of(j, std::max(a, source.breaks[j]), end));
    shares.push_back(j == last ? 1 : (end - a) / (b - a));
  }
  const Eigen::Index p = parts[0].cols() - 1;
  const BezierPoints &front = parts.front(), &back = parts.back();
  const double third = double(p) / 3;
  Approximation cubic;
  cubic.points << front.col(0), front.col(0) + third / shares[1] * (front.col(1) - front.col(0)),
      back.col(p) - third / (1 - shares[shares.size() - 2]) * (back.col(p) - back.col(p - 1)), back.col(p);
  cubic.deviation = cubic.points.row(3).minCoeff() > 0 ? 0 : never;
  for (std::size_t j = 0; j < parts.size() && cubic.deviation < never; ++j) {
    const BezierPoints ours = elevated(part(cubic.points, shares[j], shares[j + 1]), p);
    cubic.deviation = std::max(cubic.deviation, distance_bound(parts[j], ours, halvings));
  }
  return cubic;
}

/// The end of the longest interval from a, no farther than `end`, on which one cubic is within the tolerance.
double longest_interval(const Source& source, double a, double end, double tolerance) {
  constexpr int steps = 30;
  if (hermite(source, a, end).deviation <= tolerance) return end;
  double good = 0, bad = 1;  // shares of [a, end]
  for (int i = 0; i < steps && (good == 0 || bad - good > 1e-3 * good); ++i) {
    const double middle = good == 0 ? 0.5 * bad : 0.5 * (good + bad);
    (hermite(source, a, a + middle * (end - a)).deviation <= tolerance ? good : bad) = middle;
  }
  return a + (good > 0 ? good : bad) * (end - a);
}

/// The breaks of the cubics from `start` to `end`, each as long as the tolerance [m] allows; as soon as there
/// are more than `most` of them the rest is left out.
std::vector<double> greedy_breaks(const Source& source, double start, double end, double tolerance,
                                  std::size_t most) {
  std::vector<double> breaks{start};
  while (breaks.back() < end && breaks.size() <= most + 1)
    breaks.push_back(longest_interval(source, breaks.back(), end, tolerance));
  return breaks;
}

/// The breaks of the fewest cubics within the tolerance, as even in their deviation as that number allows.
std::vector<double> fewest_breaks(const Source& source, double start, double end, double tolerance) {
  std::vector<double> best = greedy_breaks(source, start, end, tolerance, std::size_t(1) << 30);
  double low = 0.05 * tolerance, high = tolerance;
  for (int i = 0; best.size() > 2 && i < 6; ++i) {
    const double middle = 0.5 * (low + high);
    std::vector<double> breaks = greedy_breaks(source, start, end, middle, best.size() - 1);
    const bool enough = breaks.size() <= best.size() && breaks.back() == end;
    (enough ? high : low) = middle;
    if (enough) best = std::move(breaks);
  }
  return best;
}

/// Appends Hermite cubics within the tolerance [m] of the curve. Where it is only C0 a cubic ends.
void approximate(BezierPath& path, const NurbsCurve& curve, double tolerance) {
  Source source{curve.knots().breaks(), {}};
  std::vector<double> ends;
  for (std::size_t j = 0; j + 1 < source.breaks.size(); ++j) {
    source.pieces.push_back(curve.bezier_points(curve.knots().find_span(source.breaks[j])));
    const double end = source.breaks[j + 1];
    if (end == curve.knots().end() || curve.knots().multiplicity(end) >= curve.degree()) ends.push_back(end);
  }
  double start = source.breaks.front();
  for (const double end : ends) {
    const std::vector<double> breaks = fewest_breaks(source, start, end, tolerance);
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
      const Approximation cubic = hermite(source, breaks[i], breaks[i + 1]);
      path.deviation = std::max(path.deviation, cubic.deviation);
      append(path, RationalCubic(cubic.points), breaks[i], breaks[i + 1]);
    }
    start = end;
  }
}

// ------------------------------------------------------------------------------------------- chains

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
  if (!exact) {
    approximate(path, curve, std::max(tolerance, round_off));
    return path;
  }
  for (std::size_t i = 0; i + 1 < source_breaks.size(); ++i) {
    const double a = source_breaks[i], b = source_breaks[i + 1];
    const BezierPoints bezier = curve.bezier_points(curve.knots().find_span(a));
    append(path, RationalCubic(elevated(bezier, 3)), a, b);
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
