#include "cad_import/dxf/dxf_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "cad_import/dxf/own_axes.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// How many quarters of a turn an arc is made of.
int pieces_of(double sweep) { return std::max(1, static_cast<int>(std::ceil(sweep / (0.5 * pi) - 1e-9))); }

std::vector<double> knots_of_pieces(int pieces) {
  std::vector<double> knots(3, 0);
  for (int i = 1; i <= pieces; ++i) knots.insert(knots.end(), i == pieces ? 3 : 2, i);
  return knots;
}

/// centre + cos(t) a + sin(t) b from t = from to from + sweep, in quarters, as a rational quadratic.
NurbsCurve conic_arc(const Eigen::Vector3d& centre, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                     double from, double sweep) {
  const int pieces = pieces_of(sweep);
  const double half = 0.5 * sweep / pieces, weight = std::cos(half);
  Eigen::Matrix4Xd points(4, 2 * pieces + 1);
  for (int i = 0; i <= 2 * pieces; ++i) {
    const double w = i % 2 == 0 ? 1 : weight, t = from + i * half;
    points.col(i) << w * centre + std::cos(t) * a + std::sin(t) * b, w;
  }
  return {KnotVector(2, knots_of_pieces(pieces)), std::move(points)};
}

NurbsCurve polyline(const std::vector<Eigen::Vector3d>& places) {
  Eigen::Matrix3Xd points(3, places.size());
  std::vector<double> knots{0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = places[i];
    knots.push_back(static_cast<double>(i));
  }
  knots.push_back(knots.back());
  return make_nurbs_curve(KnotVector(1, std::move(knots)), points, Eigen::VectorXd::Ones(points.cols()));
}

/// Counterclockwise; a whole turn where it is one but for the digits that files leave. What is a little more
/// than none is one where the end was written a turn behind the start, or where its arc, of this radius, has
/// no length but that of digits.
double sweep_of(double from, double to, double turn, double radius) {
  const double digits = 2e-7 * turn;              // six decimals of radians
  constexpr double digits_of_coordinates = 1e-6;  // of the drawing's unit
  double sweep = std::fmod(to - from, turn);
  if (sweep < 0) sweep += turn;
  const bool turned = to - from > 0.5 * turn || 2 * pi * sweep / turn * radius <= digits_of_coordinates;
  return (sweep <= digits && turned) || sweep >= turn - digits ? turn : sweep;
}

DrawnCurve circle(const DxfEntity& entity, bool whole) {
  const Eigen::Matrix3d axes = own_axes(entity);
  const double radius = entity.number_of(40, 0), degrees = pi / 180;
  if (!(radius > 0)) throw std::runtime_error("its radius is not positive");
  const double from = whole ? 0 : entity.number_of(50, 0);
  const double sweep = whole ? 360 : sweep_of(from, entity.number_of(51, 360), 360, radius);
  return {"circle", conic_arc(axes * point_at(entity, 10), radius * axes.col(0), radius * axes.col(1),
                              degrees * from, degrees * sweep)};
}

DrawnCurve ellipse(const DxfEntity& entity) {
  const Eigen::Vector3d major = point_at(entity, 11), normal = own_axes(entity).col(2);
  const double from = entity.number_of(41, 0), to = entity.number_of(42, 2 * pi);
  if (entity.number_of(40, 1) == 0) throw std::runtime_error("its minor axis has no length");
  return {"ellipse", conic_arc(point_at(entity, 10), major, entity.number_of(40, 1) * normal.cross(major),
                               from, sweep_of(from, to, 2 * pi, major.norm()))};
}

void check_count(std::size_t count, std::size_t points, const std::string& what) {
  if (count != points)
    throw std::runtime_error("it has " + std::to_string(points) + " x of control points (group 10) and " +
                             std::to_string(count) + " " + what + "; each point needs its own");
}

/// A spline without group 30 lies in the plane z = 0, one without group 41 is not rational.
DrawnCurve spline(const DxfEntity& entity) {
  const std::vector<double> x = entity.numbers_of(10), y = entity.numbers_of(20);
  std::vector<double> z = entity.numbers_of(30), weights = entity.numbers_of(41);
  if (x.empty()) throw std::runtime_error("it has fit points only; draw it with control points");
  if (z.empty()) z.assign(x.size(), 0);
  if (weights.empty()) weights.assign(x.size(), 1);
  check_count(y.size(), x.size(), "y (group 20)");
  check_count(z.size(), x.size(), "z (group 30)");
  check_count(weights.size(), x.size(), "weights (group 41)");
  Eigen::Matrix3Xd points(3, x.size());
  for (std::size_t i = 0; i < x.size(); ++i) points.col(static_cast<Eigen::Index>(i)) << x[i], y[i], z[i];
  return {"bspline",
          make_nurbs_curve(KnotVector(static_cast<int>(entity.number_of(71, 3)), entity.numbers_of(40)),
                           points, Eigen::Map<Eigen::VectorXd>(weights.data(), points.cols()))};
}

/// A corner of a polyline, and the tangent of a quarter of the angle of the arc from it to the next; 0: a
/// line.
struct Corner {
  Eigen::Vector3d point;
  double bulge = 0;
};

/// The arc through these places, an odd number of them at equal angles, from each second one to the next a
/// conic section whose own weight in the middle is `weight`.
NurbsCurve arc_through(const std::vector<Eigen::Vector3d>& places, double weight) {
  Eigen::Matrix4Xd points(4, places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    auto point = points.col(static_cast<Eigen::Index>(i));
    if (i % 2 == 0)
      point << places[i], 1;
    else
      point << (1 + weight) * places[i] - 0.5 * (places[i - 1] + places[i + 1]), weight;
  }
  return {KnotVector(2, knots_of_pieces(static_cast<int>(places.size() / 2))), std::move(points)};
}

/// Its arc by chords from its start, so that it meets both corners however flat it is.
DrawnCurve side(const Corner& from, const Corner& to, const Eigen::Vector3d& normal) {
  if (from.bulge == 0) return {"line", polyline({from.point, to.point})};
  const Eigen::Vector3d chord = to.point - from.point, left = normal.cross(chord);
  const double b = from.bulge, sweep = 4 * std::atan(b);
  const double chord_of_diameter = 2 * b / (1 + b * b);  // sin(sweep / 2)
  const int pieces = pieces_of(std::abs(sweep));
  std::vector<Eigen::Vector3d> places{from.point};
  for (int i = 1; i < 2 * pieces; ++i) {
    const double angle = i * sweep / (2 * pieces), turn = 0.5 * (angle - sweep);
    places.push_back(from.point + std::sin(0.5 * angle) / chord_of_diameter *
                                      (std::cos(turn) * chord + std::sin(turn) * left));
  }
  places.push_back(to.point);
  return {"circle", arc_through(places, std::cos(0.5 * sweep / pieces))};
}

std::vector<DrawnCurve> polyline_of(std::vector<Corner> corners, bool closed, const Eigen::Vector3d& normal) {
  if (closed && !corners.empty()) corners.push_back(corners.front());
  if (corners.size() < 2) throw std::runtime_error("it has fewer than two corners");
  std::vector<DrawnCurve> drawn;
  std::vector<Eigen::Vector3d> places{corners[0].point};
  bool straight = true;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    if (corners[i].point == corners[i + 1].point) continue;
    drawn.push_back(side(corners[i], corners[i + 1], normal));
    places.push_back(corners[i + 1].point);
    straight = straight && corners[i].bulge == 0;
  }
  if (straight && places.size() > 1) return {{"bspline", polyline(places)}};
  return drawn;
}

bool is_closed_flag(const DxfEntity& entity) { return static_cast<int>(entity.number_of(70, 0)) & 1; }

std::vector<DrawnCurve> light_polyline(const DxfEntity& entity) {
  const Eigen::Matrix3d axes = own_axes(entity);
  const double height = entity.number_of(38, 0);
  std::vector<Eigen::Vector3d> places;
  std::vector<double> bulges;
  DxfEntity one{entity.type, entity.number, {}};
  for (const DxfPair& pair : entity.pairs) {  // 10, 20 and perhaps 42 of each corner
    one.pairs = {pair};
    if (pair.code == 10) {
      places.emplace_back(one.number_of(10, 0), 0, height);
      bulges.push_back(0);
    } else if (!places.empty() && pair.code == 20) {
      places.back().y() = one.number_of(20, 0);
    } else if (!places.empty() && pair.code == 42) {
      bulges.back() = one.number_of(42, 0);
    }
  }
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < places.size(); ++i) corners.push_back({axes * places[i], bulges[i]});
  return polyline_of(std::move(corners), is_closed_flag(entity), axes.col(2));
}

/// A POLYLINE, whose corners are the VERTEX entities after it.
std::vector<DrawnCurve> heavy_polyline(const DxfEntity& entity, const std::vector<DxfEntity>& all) {
  constexpr int in_space = 8, surface = 16 | 64, spline_frame = 16;
  const int flags = static_cast<int>(entity.number_of(70, 0));
  if (flags & surface) throw std::runtime_error("it is a mesh");
  const Eigen::Matrix3d axes = flags & in_space ? Eigen::Matrix3d::Identity() : own_axes(entity);
  const double height = flags & in_space ? 0 : entity.number_of(30, 0);  // of all its corners
  std::vector<Corner> corners;
  for (std::size_t i = entity.number; i < all.size() && all[i].type == "VERTEX"; ++i) {
    if (static_cast<int>(all[i].number_of(70, 0)) & spline_frame) continue;
    Eigen::Vector3d place = point_at(all[i], 10);
    if (height != 0) place.z() = height;
    corners.push_back({axes * place, flags & in_space ? 0 : all[i].number_of(42, 0)});
  }
  return polyline_of(std::move(corners), is_closed_flag(entity), axes.col(2));
}

}  // namespace

std::vector<DrawnCurve> curves_of(const DxfEntity& entity, const std::vector<DxfEntity>& all) {
  if (entity.type == "LINE") return {{"line", polyline({point_at(entity, 10), point_at(entity, 11)})}};
  if (entity.type == "ARC") return {circle(entity, false)};
  if (entity.type == "CIRCLE") return {circle(entity, true)};
  if (entity.type == "ELLIPSE") return {ellipse(entity)};
  if (entity.type == "SPLINE") return {spline(entity)};
  if (entity.type == "LWPOLYLINE") return light_polyline(entity);
  if (entity.type == "POLYLINE") return heavy_polyline(entity, all);
  if (std::set<std::string>{"MLINE", "RAY", "XLINE", "HELIX", "REGION", "3DFACE", "3DSOLID"}.contains(
          entity.type))
    throw std::runtime_error("entities of this kind are not read");
  return {};
}

}  // namespace nurbeam
