#include "nurbs/bezier_path.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "nurbs/arc_length.h"
#include "nurbs/bernstein.h"
#include "nurbs/bezier.h"
#include "nurbs/hermite_approximation.h"

namespace nurbeam {
namespace {

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// The direction from an end of the cubic, its first or last control point, to the next one that is not the
/// end itself.
Eigen::Vector3d direction_from(const RationalCubic& cubic, int end) {
  Eigen::Matrix3d legs;
  for (int i = 0; i < 3; ++i)
    legs.col(i) = cubic.control_point(end == 0 ? i + 1 : 2 - i) - cubic.control_point(end);
  const Eigen::RowVector3d lengths = legs.colwise().norm();
  int i = 0;
  while (i < 2 && lengths(i) <= 1e-12 * lengths.maxCoeff()) ++i;
  return legs.col(i);
}

Eigen::Vector3d start_direction(const RationalCubic& cubic) { return direction_from(cubic, 0); }
Eigen::Vector3d end_direction(const RationalCubic& cubic) { return -direction_from(cubic, 3); }

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
    const double u = double(i) / count;
    const Eigen::Vector3d tangent = i < count ? hodograph * quartic_bernstein(u) : end_direction(cubic);
    sum += angle_between(before, tangent);
    before = tangent;
  }
  return sum;
}

/// What turning is no more than: the angles of the control polygon of the hodograph, which every plane
/// through the origin cuts as often or more often; infinite where one of its points is at the origin.
double turning_of_polygon(const RationalCubic& cubic) {
  const Eigen::Matrix<double, 3, 5> hodograph = cubic.hodograph();
  const Eigen::Matrix<double, 1, 5> lengths = hodograph.colwise().norm();
  if (!(lengths.minCoeff() > 1e-12 * lengths.maxCoeff())) return std::numeric_limits<double>::infinity();
  double sum = 0;
  for (int i = 0; i + 1 < 5; ++i) sum += angle_between(hodograph.col(i), hodograph.col(i + 1));
  return sum;
}

bool turns_by_more_than(double angle, const RationalCubic& cubic) {
  return turning_of_polygon(cubic) > angle && turning(cubic) > angle;
}

/// Appends the cubic, whose source lives on [a, b]; a rational one that turns by more than 91 degrees in
/// halves: quarter circles are drawn often, and what is drawn a little off one is divided as it is. A cusp
/// turns however short its piece is, so no more than `halvings` are made.
void append(BezierPath& path, const RationalCubic& cubic, double a, double b, int halvings = 10) {
  constexpr double most_turning = 91 * 1.5707963267948966 / 90;
  if (halvings > 0 && is_rational(cubic) && turns_by_more_than(most_turning, cubic)) {
    const auto [first, second] = cubic.split(0.5);
    const double middle = 0.5 * (a + b);
    append(path, first, a, middle, halvings - 1);
    append(path, second, middle, b, halvings - 1);
  } else {
    path.segments.push_back(cubic);
    path.breaks.push_back(b);
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
    for (const CubicPart& part : hermite_approximation(curve, std::max(tolerance, round_off))) {
      path.deviation = std::max(path.deviation, part.deviation);
      append(path, part.cubic, part.start, part.end);
    }
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

double total_length(std::span<const RationalCubic> segments) {
  double sum = 0;
  for (const RationalCubic& segment : segments) sum += length(segment);
  return sum;
}

std::vector<Corner> corners_of(std::span<const RationalCubic> segments, double angle) {
  std::vector<Corner> corners;
  for (std::size_t j = 0; j + 1 < segments.size(); ++j) {
    const double turn = angle_between(end_direction(segments[j]), start_direction(segments[j + 1]));
    if (turn > angle) corners.push_back({static_cast<int>(j), segments[j].control_point(3), turn});
  }
  return corners;
}

}  // namespace nurbeam
