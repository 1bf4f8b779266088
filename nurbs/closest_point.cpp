#include "nurbs/closest_point.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "nurbs/largest_value.h"

namespace nurbeam {
namespace {

/// The box of the control points, in which the cubic lies.
Eigen::AlignedBox3d box_of(const RationalCubic& cubic) {
  const Eigen::Matrix<double, 3, 4> controls =
      cubic.points().topRows<3>().array().rowwise() / cubic.points().row(3).array();
  return {controls.rowwise().minCoeff(), controls.rowwise().maxCoeff()};
}

std::vector<Eigen::AlignedBox3d> boxes_of(std::span<const RationalCubic> segments) {
  std::vector<Eigen::AlignedBox3d> boxes;
  boxes.reserve(segments.size());
  for (const RationalCubic& segment : segments) boxes.push_back(box_of(segment));
  return boxes;
}

/// Bernstein coefficients of (r - p) . r' times W^3, a polynomial of degree 7 whose roots are the stationary
/// distances; those below the round-off of coordinates of this size are set to zero.
std::array<double, 8> stationarity(const RationalCubic& cubic, const Eigen::Vector3d& point) {
  constexpr std::array<double, 4> binomial_3{1, 3, 3, 1};
  constexpr std::array<double, 5> binomial_4{1, 4, 6, 4, 1};
  constexpr std::array<double, 8> binomial_7{1, 7, 21, 35, 35, 21, 7, 1};
  const Eigen::Matrix<double, 3, 5> hodograph = cubic.hodograph();
  const Eigen::Matrix<double, 3, 4> relative = cubic.points().topRows<3>() - point * cubic.points().row(3);
  const Eigen::Matrix<double, 4, 5> products = relative.transpose() * hodograph;
  std::array<double, 8> coefficients{};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 5; ++j) coefficients[i + j] += binomial_3[i] * binomial_4[j] * products(i, j);
  const double size = cubic.points().topRows<3>().norm() + point.norm() * cubic.points().row(3).norm();
  const double round_off = 1e-15 * size * (hodograph.norm() + relative.norm() * cubic.points().row(3).norm());
  for (int k = 0; k < 8; ++k) {
    coefficients[k] /= binomial_7[k];
    if (std::abs(coefficients[k]) <= round_off) coefficients[k] = 0;
  }
  return coefficients;
}

int sign_changes(const std::array<double, 8>& coefficients) {
  int changes = 0;
  double before = 0;
  for (const double c : coefficients) {
    if (c * before < 0) ++changes;
    if (c != 0) before = c;
  }
  return changes;
}

/// The parameter in [a, b] where (r - p) . r' goes through zero, given that it does so once: Newton,
/// bisection where that would leave the bracket.
double stationary_parameter(const RationalCubic& cubic, const Eigen::Vector3d& point, double a, double b) {
  double u = 0.5 * (a + b);
  for (int i = 0; i < 60; ++i) {
    const Eigen::Matrix<double, 3, 6> r = cubic.derivatives(u);
    const Eigen::Vector3d offset = r.col(0) - point;
    const double slope = offset.dot(r.col(1));
    (slope > 0 ? b : a) = u;
    double next = u - slope / (r.col(1).squaredNorm() + offset.dot(r.col(2)));
    if (!(a <= next && next <= b)) next = 0.5 * (a + b);
    const double step = std::abs(next - u);
    u = next;
    if (step <= 1e-15) break;
  }
  return u;
}

/// Search of cubics for the point closest to a given one.
class Search {
 public:
  Search(std::span<const RationalCubic> segments, const Eigen::Vector3d& point)
      : segments_(segments),
        point_(point),
        best_{0, 0, segments.front().point(0), std::numeric_limits<double>::infinity()} {}

  /// `boxes`: those of the segments.
  ClosestPoint among(const BoxTree& boxes) {
    boxes.visit_near(point_, best_.distance, [this](int j) {
      try_parameter(j, 0);
      try_parameter(j, 1);
      visit(j, segments_[j], 0, 1);
      return best_.distance;
    });
    return best_;
  }

 private:
  void try_parameter(int j, double u) {
    const Eigen::Vector3d candidate = segments_[j].point(u);
    const double distance = (candidate - point_).norm();
    if (distance < best_.distance) best_ = {j, u, candidate, distance};
  }

  /// Looks into the piece of segment j on [a, b], whose ends have been tried: done when it can hold nothing
  /// closer, no interior minimum or a single one (no or one change of sign from - to +), else in two halves.
  void visit(int j, const RationalCubic& piece, double a, double b) {
    if (box_of(piece).exteriorDistance(point_) >= best_.distance) return;
    const std::array<double, 8> coefficients = stationarity(piece, point_);
    const int changes = sign_changes(coefficients);
    const double middle = 0.5 * (a + b);
    if (changes == 0) return;
    if (changes == 1) {
      const double first =
          *std::find_if(coefficients.begin(), coefficients.end(), [](double c) { return c != 0; });
      if (first < 0) try_parameter(j, stationary_parameter(segments_[j], point_, a, b));
      return;
    }
    try_parameter(j, middle);
    const auto [left, right] = piece.split(0.5);
    visit(j, left, a, middle);
    visit(j, right, middle, b);
  }

  const std::span<const RationalCubic> segments_;
  const Eigen::Vector3d point_;
  ClosestPoint best_;
};

/// What distances between points of cubics are good to [m].
double round_off_of(std::span<const RationalCubic> segments) {
  double size = 0;
  for (const RationalCubic& segment : segments)
    for (int i = 0; i < 4; ++i) size = std::max(size, segment.control_point(i).cwiseAbs().maxCoeff());
  return 1e-14 * size;
}

}  // namespace

ClosestPoints::ClosestPoints(std::span<const RationalCubic> segments)
    : segments_(segments), boxes_(boxes_of(segments)), round_off_(round_off_of(segments)) {}

ClosestPoint ClosestPoints::to(const Eigen::Vector3d& point) const {
  return Search(segments_, point).among(boxes_);
}

double ClosestPoints::largest_distance(const std::function<Eigen::Vector3d(double)>& curve) const {
  return largest_value([&](double u) { return to(curve(u)).distance; }, round_off_);
}

ClosestPoint closest_point(std::span<const RationalCubic> segments, const Eigen::Vector3d& point) {
  return ClosestPoints(segments).to(point);
}

double largest_distance(const std::function<Eigen::Vector3d(double)>& curve,
                        std::span<const RationalCubic> segments) {
  return ClosestPoints(segments).largest_distance(curve);
}

double hausdorff_distance(std::span<const RationalCubic> a, std::span<const RationalCubic> b) {
  const auto one_way = [](std::span<const RationalCubic> from, std::span<const RationalCubic> to) {
    const ClosestPoints target(to);
    double largest = 0;
    for (const RationalCubic& segment : from)
      largest = std::max(largest, target.largest_distance([&](double u) { return segment.point(u); }));
    return largest;
  };
  return std::max(one_way(a, b), one_way(b, a));
}

}  // namespace nurbeam
