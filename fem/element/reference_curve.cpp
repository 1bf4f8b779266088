#include "fem/element/reference_curve.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

// c = |r' x r''| (signed in the plane) and its first two derivatives, from those of r.
std::array<double, 3> cross_product_derivatives(const std::array<Eigen::Vector3d, 4>& r, int dimension) {
  const auto& [r1, r2, r3, r4] = r;
  if (dimension == 2) {
    const auto across = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
      return a.x() * b.y() - a.y() * b.x();
    };
    return {across(r1, r2), across(r1, r3), across(r2, r3) + across(r1, r4)};
  }
  const Eigen::Vector3d c = r1.cross(r2);
  const Eigen::Vector3d c1 = r1.cross(r3);
  const Eigen::Vector3d c2 = r2.cross(r3) + r1.cross(r4);
  const double norm = c.norm();
  if (norm < 1e-12 * r1.squaredNorm()) return {0, 0, 0};
  const double norm1 = c.dot(c1) / norm;
  return {norm, norm1, (c1.squaredNorm() + c.dot(c2) - norm1 * norm1) / norm};
}

// Whether a cubic has equal weights, and control points in a line at equal distances.
bool uniform_line(const RationalCubic& cubic) {
  constexpr double round_off = 64 * std::numeric_limits<double>::epsilon();
  const Eigen::Matrix4d& p = cubic.points();
  const auto vanishes = [&](const Eigen::Vector4d& x) {
    return (x.cwiseAbs().array() <= round_off * p.cwiseAbs().rowwise().maxCoeff().array()).all();
  };
  return std::abs(cubic.weight(3) - cubic.weight(0)) <= round_off * cubic.weight(0) &&
         vanishes(p.col(1) - (2 * p.col(0) + p.col(3)) / 3) &&
         vanishes(p.col(2) - (p.col(0) + 2 * p.col(3)) / 3);
}

}  // namespace

ReferenceCurve::ReferenceCurve(std::vector<RationalCubic> segments, int dimension, Metric metric, bool closed,
                               const ReferenceCurve* like)
    : segments_(std::move(segments)), dimension_(dimension), metric_(metric), closed_(closed) {
  if (segments_.empty())
    throw std::invalid_argument("a reference curve needs at least one segment, got none");
  if (dimension != 2 && dimension != 3)
    throw std::invalid_argument("a reference curve has dimension 2 or 3, got " + std::to_string(dimension));
  breaks_.push_back(0);
  for (std::size_t j = 0; j < segments_.size(); ++j) {
    const RationalCubic& segment = segments_[j];
    const bool same = like && j < like->segments_.size() && segment.points() == like->segments_[j].points();
    maps_.push_back(same ? like->maps_[j] : std::make_shared<const ArcLengthMap>(segment));
    uniform_line_.push_back(uniform_line(segment));
    breaks_.push_back(breaks_.back() + maps_.back()->length());
  }
  if (!closed_) return;
  if (segment_count() < 2 || metric_ == Metric::label)
    throw std::invalid_argument("a closed reference curve needs two segments or more and its metric");
  const double gap = (segments_.front().point(0) - segments_.back().point(1)).norm();
  if (gap > 1e-9 * length())
    throw std::invalid_argument("a closed reference curve ends where it starts; there is a gap of " +
                                text_of(gap) + " m");
}

ReferenceCurve ReferenceCurve::lengthened(double length, bool at_start) const {
  const double s = at_start ? start() : end();
  const Eigen::Vector3d from = at_start ? Eigen::Vector3d(position(s) - length * tangent(s)) : position(s),
                        way = length * tangent(s, !at_start);
  Eigen::Matrix<double, 4, 4> line;
  for (int i = 0; i < 4; ++i) line.col(i) << from + i / 3.0 * way, 1;
  const RationalCubic cubic(line);
  ReferenceCurve curve = *this;
  const auto insert = [&](auto& list, const auto& item) {
    list.insert(at_start ? list.begin() : list.end(), item);
  };
  insert(curve.segments_, cubic);
  insert(curve.maps_, std::make_shared<const ArcLengthMap>(cubic));
  insert(curve.uniform_line_, uniform_line(cubic));
  insert(curve.breaks_, at_start ? s - length : s + length);
  return curve;
}

double ReferenceCurve::wrapped(double s) const {
  if (!closed_) return s;
  const double rest = s - length() * std::floor(s / length());
  return rest < length() ? rest : 0;  // s a hair below 0
}

double ReferenceCurve::next_break(double s) const {
  const double turns = s - wrapped(s);
  const auto end = breaks_.end() - (closed_ ? 0 : 1);
  auto next = std::upper_bound(breaks_.begin() + 1, end, wrapped(s));
  if (next != end && *next + turns <= s) ++next;  // round-off of a full turn
  if (next != end) return *next + turns;
  return closed_ ? length() + breaks_[1] + turns : std::numeric_limits<double>::infinity();
}

bool ReferenceCurve::draws_alike(const ReferenceCurve& other, int j, double s, double other_s) const {
  constexpr double round_off = 1e-12;  // part of the length
  return dimension_ == other.dimension_ && metric_ == other.metric_ && straight_ == other.straight_ &&
         j < other.segment_count() && segments_[j].points() == other.segments_[j].points() &&
         std::abs((s - breaks_[j]) - (other_s - other.breaks_[j])) <= round_off * segment_length(j);
}

int ReferenceCurve::segment_at(double s, bool from_left) const {
  s = wrapped(s);
  if (closed_ && from_left && s == 0) return segment_count() - 1;
  const auto inner_begin = breaks_.begin() + 1, inner_end = breaks_.end() - 1;
  const auto next =
      from_left ? std::lower_bound(inner_begin, inner_end, s) : std::upper_bound(inner_begin, inner_end, s);
  return static_cast<int>(next - inner_begin);
}

ChartGeometry ReferenceCurve::geometry(int j, double u) const {
  ChartGeometry g = drawn_geometry(j, u);
  if (straight_) g.curvature = {};
  return g;
}

ChartGeometry ReferenceCurve::drawn_geometry(int j, double u) const {
  const RationalCubic::WeightedDerivatives drawn = segments_[j].weighted_derivatives(u);
  const auto& [r1, r2, r3, r4] = drawn.r;
  const double a0 = r1.squaredNorm();
  const double a1 = 2 * r1.dot(r2);
  const double a2 = 2 * (r2.squaredNorm() + r1.dot(r3));
  const double a3 = 2 * (3 * r2.dot(r3) + r1.dot(r4));
  const double J = std::sqrt(a0);
  const double J1 = a1 / (2 * J);
  const double J2 = (a2 - 2 * J1 * J1) / (2 * J);
  const double J3 = (a3 - 6 * J1 * J2) / (2 * J);
  const auto [c, c1, c2] = cross_product_derivatives(drawn.r, dimension_);
  const double p = 1 / (J * J * J);
  const double k = c * p;
  const double k1 = c1 * p - 3 * c * p * J1 / J;
  const double k2 = c2 * p - 6 * c1 * p * J1 / J + 12 * c * p * J1 * J1 / (J * J) - 3 * c * p * J2 / J;
  std::array<double, 4> stretch{J, J1, J2, J3};
  if (metric_ == Metric::label) stretch = {segment_length(j), 0, 0, 0};
  return {stretch, drawn.weight, {k, k1, k2, 0}};
}

Eigen::Vector3d ReferenceCurve::position(double s) const {
  const int j = segment_at(s);
  return segments_[j].point(parameter(j, s));
}

Eigen::Vector3d ReferenceCurve::tangent(double s, bool from_left) const {
  const int j = segment_at(s, from_left);
  const Eigen::Vector3d r_u = segments_[j].weighted_derivatives(parameter(j, s)).r[0];
  return metric_ == Metric::label ? Eigen::Vector3d(r_u / segment_length(j)) : r_u.normalized();
}

CurvePoint ReferenceCurve::point_in(int j, double s) const {
  const Eigen::Matrix<double, 3, 6> r = segments_[j].derivatives(parameter(j, s));
  const Eigen::Vector3d t = r.col(1).normalized(), r_uu = r.col(2);
  return {r.col(0), t, (r_uu - t * t.dot(r_uu)) / r.col(1).squaredNorm()};
}

double ReferenceCurve::strain(double s, bool from_left) const {
  return metric_ == Metric::label ? (tangent(s, from_left).squaredNorm() - 1) / 2 : 0;
}

ReferenceCurve ReferenceCurve::oriented(Orientation orientation) const {
  if (dimension_ != 3 || metric_ == Metric::label)
    throw std::invalid_argument("only a curve in space with its metric has sections");
  ReferenceCurve curve = *this;
  curve.sections_ =
      std::make_shared<const DrawnSections>(segments_, breaks_, closed_, std::move(orientation));
  return curve;
}

DrawnSection ReferenceCurve::section(double s, bool from_left) const {
  const int j = segment_at(s, from_left);
  const double u = parameter(j, s);
  return sections_->at(segments_[j], j, u, arc_length(j, u));
}

DrawnSectionSeries ReferenceCurve::section_series(int j, double s) const {
  const double u = parameter(j, s);
  return sections_->series(segments_[j], j, u, arc_length(j, u));
}

double ReferenceCurve::section_turn(double s_a, double s_b) const {
  double sum = 0;
  for (double s = s_a; s < s_b;) {
    const double end = std::min(next_break(s), s_b);
    const int j = segment_at((s + end) / 2);
    const double middle = (breaks_[j] + breaks_[j + 1]) / 2;
    sum += sections_->added_turn(unrolled(s, middle), unrolled(end, middle));
    if (sections_->turns_by_rule())
      sum += sections_->rule_turn(segments_[j], j, parameter(j, s), parameter(j, end));
    s = end;
  }
  return sum;
}

double ReferenceCurve::largest_curvature() const {
  constexpr int samples = 33;
  double largest = 0;
  for (int j = 0; j < segment_count(); ++j)
    for (int i = 0; i < samples; ++i)
      largest = std::max(largest, std::abs(drawn_geometry(j, i / (samples - 1.0)).curvature[0]));
  return largest;
}

}  // namespace nurbeam
