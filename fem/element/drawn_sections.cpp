#include "fem/element/drawn_sections.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fem/element/section_frame.h"
#include "nurbs/monotone_cubic.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double smallest_angle = pi / 180;  ///< between the tangent and `up`

// A parameter, or a number that varies with it: value, first and second derivative.
using Varying = Dual<1, Dual<1>>;

// The first three derivatives of the segment by its parameter, at u.
std::array<Vector3d, 3> rates(const RationalCubic& segment, double u) {
  const std::array<Vector3d, 4> r = segment.weighted_derivatives(u).r;
  return {r[0], r[1], r[2]};
}
std::array<Vector3<Varying>, 3> rates(const RationalCubic& segment, const Varying& u) {
  const Eigen::Matrix<double, 3, 6> r = segment.derivatives(plain(u));
  const Varying step = u - plain(u);
  std::array<Vector3<Varying>, 3> along;
  for (int k = 1; k <= 3; ++k)
    for (int d = 0; d < 3; ++d)
      along[k - 1][d] = Varying(r(d, k)) + r(d, k + 1) * step + (r(d, k + 2) / 2) * (step * step);
  return along;
}

// Speed, tangent and curvature vector at a parameter.
template <class T>
struct Bend {
  T speed;
  Vector3<T> t, K;
  T torsion_numerator;  // (r' x r'') . r''' over |r'|^6: torsion times curvature^2

  Bend(const RationalCubic& segment, const T& u) {
    using std::sqrt;
    const auto [r1, r2, r3] = rates(segment, u);
    const Vector3<T> across = r1.cross(r2);
    speed = sqrt(r1.dot(r1));
    const T cubed = speed * speed * speed;
    t = r1 / speed;
    K = across / cubed;
    torsion_numerator = across.dot(r3) / (cubed * cubed);
  }
};

// d(angle)/du of parallel transport along a segment against the smallest rotation from t_a: transport_rate
// times |r'|. As it is evaluated often, r' and r'' come from the powers of u in (W r, W), with r from the
// first control point.
class TransportRate {
 public:
  TransportRate(const RationalCubic& segment, const Vector3d& t_a) : t_a_(t_a), weight_(segment.weight(0)) {
    const Vector3d origin = segment.control_point(0);
    std::array<Eigen::Vector4d, 4> b;
    for (int i = 0; i < 4; ++i)
      b[i] << segment.weight(i) * (segment.control_point(i) - origin), segment.weight(i);
    c1_ = 3 * (b[1] - b[0]);
    c2_ = 3 * (b[2] - 2 * b[1] + b[0]);
    c3_ = b[3] - b[0] - 3 * (b[2] - b[1]);
  }

  double operator()(double u) const {
    const Eigen::Vector4d H = u * (c1_ + u * (c2_ + u * c3_)), H1 = c1_ + u * (2 * c2_ + (3 * u) * c3_),
                          H2 = 2 * c2_ + (6 * u) * c3_;
    const double W = weight_ + H[3];
    const Vector3d r = H.head<3>() / W, r1 = (H1.head<3>() - H1[3] * r) / W,
                   r2 = (H2.head<3>() - 2 * H1[3] * r1 - H2[3] * r) / W;
    const double speed = r1.norm();
    return r1.cross(r2).dot(t_a_) / (speed * (speed + r1.dot(t_a_)));
  }

 private:
  Vector3d t_a_;
  double weight_;
  Eigen::Vector4d c1_, c2_, c3_;
};

double transport_angle(const RationalCubic& segment, double from, double to, const Vector3d& t_a) {
  return gauss(TransportRate(segment, t_a), from, to);
}

// Whether one Gauss rule from u_0 to u_1 transports to round-off.
bool is_short(const RationalCubic& segment, double u_0, double u_1) {
  if (u_1 - u_0 < 1e-6) return true;
  const double middle = (u_0 + u_1) / 2;
  const Vector3d t = Bend<double>(segment, u_0).t;
  if (t.dot(Bend<double>(segment, middle).t) < 0.7 || t.dot(Bend<double>(segment, u_1).t) < 0.5) return false;
  const double whole = transport_angle(segment, u_0, u_1, t);
  return std::abs(transport_angle(segment, u_0, middle, t) + transport_angle(segment, middle, u_1, t) -
                  whole) < 1e-14;
}

// Adds the ends of pieces from u_0 to u_1 that are short enough.
void add_pieces(const RationalCubic& segment, double u_0, double u_1, std::vector<double>& ends) {
  if (is_short(segment, u_0, u_1)) {
    ends.push_back(u_1);
    return;
  }
  add_pieces(segment, u_0, (u_0 + u_1) / 2, ends);
  add_pieces(segment, (u_0 + u_1) / 2, u_1, ends);
}

Vector3d across(const Vector3d& direction, const Vector3d& t) { return direction - direction.dot(t) * t; }

// Axis d1 of the triad whose d2 points along the part of `direction` across t.
Vector3d first_axis(const Vector3d& direction, const Vector3d& t, double s) {
  const Vector3d d2 = across(direction, t);
  if (!(d2.norm() > std::sin(smallest_angle) * direction.norm()))
    throw std::invalid_argument(
        "the section's direction is within 1 degree of the axis at s = " + text_of(s) + " m");
  return d2.normalized().cross(t);
}

Vector3d default_direction(const Vector3d& t) {
  return across(Vector3d::UnitZ(), t).norm() > std::sin(smallest_angle) ? Vector3d::UnitZ()
                                                                        : Vector3d::UnitX();
}

}  // namespace

DrawnSections::DrawnSections(const std::vector<RationalCubic>& segments, const std::vector<double>& breaks,
                             bool closed, Orientation orientation)
    : orientation_(std::move(orientation)), length_(breaks.back()) {
  check_twist(closed);
  slopes_ = monotone_slopes(orientation_.twist);
  check(segments, breaks);
  if (turns_by_rule()) {
    for (const RationalCubic& segment : segments)
      turns_.push_back(panels_of([&](double u) { return twist_by_parameter(segment, u); }, 0, 1, 1, 1e-12));
    return;
  }
  const Vector3d t = Bend<double>(segments.front(), 0).t;
  Vector3d& direction = orientation_.direction;
  if (direction.isZero(0)) direction = default_direction(t);
  transport(segments, first_axis(direction, t, 0));
  if (!closed) return;
  const Piece& start = pieces_.front().front();
  const Vector3d end = transported(segments.back(), static_cast<int>(segments.size()) - 1, 1,
                                   Bend<double>(segments.back(), 1).t);
  const Vector3d back = turned_with<double>(end, Bend<double>(segments.back(), 1).t, start.t);
  holonomy_ = std::atan2(back.dot(start.t.cross(start.d1)), back.dot(start.d1));
}

void DrawnSections::transport(const std::vector<RationalCubic>& segments, const Vector3d& start) {
  Vector3d t = Bend<double>(segments.front(), 0).t, d1 = start;
  for (int j = 0; j < static_cast<int>(segments.size()); ++j) {
    const Vector3d t_j = Bend<double>(segments[j], 0).t;
    if (t.dot(t_j) < -1 + 1e-9)
      throw std::invalid_argument("the axis turns back on itself where segment " + std::to_string(j + 1) +
                                  " starts: no section can be carried over");
    pieces_.push_back({{0, t_j, turned_with<double>(d1, t, t_j).normalized()}});
    std::vector<double> ends;
    add_pieces(segments[j], 0, 1, ends);
    for (const double u : ends) {
      t = Bend<double>(segments[j], u).t;
      d1 = across(transported(segments[j], j, u, t), t).normalized();
      pieces_[j].push_back({u, t, d1});
    }
  }
}

Vector3d DrawnSections::transported(const RationalCubic& segment, int j, double u, const Vector3d& t) const {
  const std::vector<Piece>& pieces = pieces_[j];
  const auto after = std::upper_bound(pieces.begin() + 1, pieces.end(), u,
                                      [](double at, const Piece& piece) { return at < piece.u; });
  const Piece& piece = *(after - 1);
  const SectionTriad<double> start{piece.d1, piece.t.cross(piece.d1), piece.t};
  return carried_section<double>(start, t, transport_angle(segment, piece.u, u, piece.t)).d1;
}

DrawnSection DrawnSections::at(const RationalCubic& segment, int j, double u, double s) const {
  const Bend<double> bend(segment, u);
  Vector3d d1;
  switch (orientation_.rule) {
    case Orientation::Rule::start:
      d1 = transported(segment, j, u, bend.t);
      break;
    case Orientation::Rule::up:
      d1 = first_axis(orientation_.direction, bend.t, s);
      break;
    case Orientation::Rule::frenet:
      d1 = -bend.K.normalized();
      break;
  }
  const Vector3d d2 = bend.t.cross(d1);
  const double angle = added_turn(s).angle, c = std::cos(angle), sine = std::sin(angle);
  return {c * d1 + sine * d2, c * d2 - sine * d1, bend.t, bend.K,
          rule_twist(segment, u) + added_turn(s).rate[0]};
}

double DrawnSections::twist_by_parameter(const RationalCubic& segment, double u) const {
  return rule_twist(segment, u) * rates(segment, u)[0].norm();
}

double DrawnSections::rule_turn(const RationalCubic& segment, int j, double u_0, double u_1) const {
  const auto to = [&](double u) {
    const Panels& panels = turns_[j];
    const auto after = std::upper_bound(panels.breaks.begin() + 1, panels.breaks.end() - 1, u);
    const auto k = after - panels.breaks.begin() - 1;
    return panels.integrals[k] +
           gauss([&](double x) { return twist_by_parameter(segment, x); }, panels.breaks[k], u);
  };
  return to(u_1) - to(u_0);
}

// The twist by the rule, without the added twist.
template <class T>
T DrawnSections::rule_twist(const RationalCubic& segment, const T& u) const {
  if (orientation_.rule == Orientation::Rule::start) return 0.0;
  const Bend<T> bend(segment, u);
  if (orientation_.rule == Orientation::Rule::frenet) return bend.torsion_numerator / bend.K.dot(bend.K);
  // (up . t) k2/|up across t|
  const Vector3<T> up = orientation_.direction.cast<T>();
  const Vector3<T> up_across = up - up.dot(bend.t) * bend.t;
  return up.dot(bend.t) * bend.K.dot(up_across) / up_across.dot(up_across);
}

namespace {

// The derivatives by s of a number that varies with the parameter; J = ds/du is the stretch.
std::array<double, 3> by_length(const Varying& f, const Varying& J) {
  const double first = f.d[0].value / J.value.value;
  return {f.value.value, first, (f.d[0].d[0] - first * J.d[0].value) / (J.value.value * J.value.value)};
}

// y and its derivatives for y' = W x y.
std::array<Vector3d, 3> turning(const Vector3d& y, const std::array<Vector3d, 3>& W) {
  const Vector3d first = W[0].cross(y);
  return {y, first, W[1].cross(y) + W[0].cross(first)};
}

std::array<double, 3> product(const std::array<Vector3d, 3>& x, const std::array<Vector3d, 3>& y) {
  return {x[0].dot(y[0]), x[1].dot(y[0]) + x[0].dot(y[1]),
          x[2].dot(y[0]) + 2 * x[1].dot(y[1]) + x[0].dot(y[2])};
}

}  // namespace

// The triad turns with K + twist t per length.
DrawnSectionSeries DrawnSections::series(const RationalCubic& segment, int j, double u, double s) const {
  const DrawnSection here = at(segment, j, u, s);
  const Varying varying = Varying::variable(Dual<1>::variable(u, 0), 0);
  const Bend<Varying> bend(segment, varying);
  DrawnSectionSeries series;
  std::array<Vector3d, 3> K;
  for (int d = 0; d < 3; ++d) {
    const std::array<double, 3> along = by_length(bend.K[d], bend.speed);
    for (int k = 0; k < 3; ++k) K[k][d] = along[k];
  }
  series.twist = by_length(rule_twist(segment, varying), bend.speed);
  const std::array<double, 3> added = added_turn(s).rate;
  for (int k = 0; k < 3; ++k) series.twist[k] += added[k];
  series.t = turning(here.t, K);
  std::array<Vector3d, 3> W = K;
  W[0] += series.twist[0] * series.t[0];
  W[1] += series.twist[1] * series.t[0] + series.twist[0] * series.t[1];
  series.d1 = turning(here.d1, W);
  series.d2 = turning(here.d2, W);
  series.k1 = product(K, series.d1);
  series.k2 = product(K, series.d2);
  return series;
}

DrawnSections::Turn DrawnSections::added_turn(double s) const {
  Turn turn{-holonomy_ * s / length_, {-holonomy_ / length_, 0, 0}};
  const auto& rows = orientation_.twist;
  if (rows.empty()) return turn;
  const auto next =
      std::upper_bound(rows.begin(), rows.end(), s, [](double x, const auto& row) { return x < row.first; });
  if (next == rows.begin() || (next == rows.end() && s > rows.back().first) || rows.size() == 1) {
    turn.angle += (next == rows.begin() ? rows.front() : rows.back()).second;
    return turn;
  }
  const std::size_t i = std::min<std::size_t>(next - rows.begin(), rows.size() - 1) - 1;
  const double l = rows[i + 1].first - rows[i].first, x = (s - rows[i].first) / l;
  const double rise = rows[i + 1].second - rows[i].second, a = slopes_[i] * l, b = slopes_[i + 1] * l;
  // Cubic Hermite: y_0 + a x + (3 rise - 2 a - b) x^2 + (a + b - 2 rise) x^3.
  const double c2 = 3 * rise - 2 * a - b, c3 = a + b - 2 * rise;
  turn.angle += rows[i].second + x * (a + x * (c2 + x * c3));
  turn.rate[0] += (a + x * (2 * c2 + x * 3 * c3)) / l;
  turn.rate[1] += (2 * c2 + 6 * c3 * x) / (l * l);
  turn.rate[2] += 6 * c3 / (l * l * l);
  return turn;
}

void DrawnSections::check_twist(bool closed) const {
  const auto& rows = orientation_.twist;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i)
    if (!(rows[i].first < rows[i + 1].first))
      throw std::invalid_argument("the places of a twist must increase; " + text_of(rows[i + 1].first) +
                                  " m follows " + text_of(rows[i].first) + " m");
  if (!closed || rows.empty()) return;
  const double total = rows.back().second - rows.front().second;
  if (std::abs(std::remainder(total, 2 * pi)) > 1e-9)
    throw std::invalid_argument("the twist of a closed beam must be full turns; it comes back turned by " +
                                text_of(total) + " rad");
}

void DrawnSections::check(const std::vector<RationalCubic>& segments,
                          const std::vector<double>& breaks) const {
  if (orientation_.rule == Orientation::Rule::start) return;
  constexpr int samples = 33;
  for (std::size_t j = 0; j < segments.size(); ++j)
    for (int i = 0; i < samples; ++i) {
      const double u = i / (samples - 1.0), s = breaks[j] + u * (breaks[j + 1] - breaks[j]);
      const Bend<double> bend(segments[j], u);
      if (orientation_.rule == Orientation::Rule::up)
        first_axis(orientation_.direction, bend.t, s);
      else if (!(bend.K.norm() * length_ > 1e-6))
        throw std::invalid_argument("the axis has no curvature near s = " + text_of(s) +
                                    " m, so no centre of curvature for its section to point to");
    }
  if (orientation_.rule == Orientation::Rule::up) return;
  for (std::size_t j = 0; j + 1 < segments.size(); ++j) {
    const Vector3d before = Bend<double>(segments[j], 1).K.normalized(),
                   after = Bend<double>(segments[j + 1], 0).K.normalized();
    if (before.cross(after).norm() > 1e-6 || before.dot(after) < 0)
      throw std::invalid_argument(
          "the direction of the centre of curvature jumps at s = " + text_of(breaks[j + 1]) + " m");
  }
}

}  // namespace nurbeam
