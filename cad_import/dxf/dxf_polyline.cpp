#include "cad_import/dxf/dxf_polyline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "cad_import/dxf/drawn_arcs.h"
#include "cad_import/dxf/own_axes.h"
#include "nurbs/bezier_path.h"
#include "nurbs/closest_point.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Places = std::vector<Eigen::Vector3d>;

/// A corner of a polyline, and the tangent of a quarter of the angle of the arc from it to the next; 0: a
/// line.
struct PolylineCorner {
  Eigen::Vector3d point;
  double bulge = 0;
};

DrawnCurve side(const PolylineCorner& from, const PolylineCorner& to, const Eigen::Vector3d& normal) {
  if (from.bulge == 0) return {"line", polyline_through({from.point, to.point})};
  return {"circle", arc_over_chord(from.point, to.point, from.bulge, normal)};
}

std::vector<DrawnCurve> polyline_of(std::vector<PolylineCorner> corners, bool closed,
                                    const Eigen::Vector3d& normal) {
  if (closed && !corners.empty()) corners.push_back(corners.front());
  if (corners.size() < 2) throw std::runtime_error("it has fewer than two corners");
  Places places{corners[0].point};
  bool straight = true;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    if (corners[i].point == corners[i + 1].point) continue;
    straight = straight && corners[i].bulge == 0;
    places.push_back(corners[i + 1].point);
  }
  if (places.size() < 2) throw std::runtime_error("it has no length");
  if (straight) return {{"bspline", polyline_through(places)}};
  std::vector<DrawnCurve> drawn;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i)
    if (corners[i].point != corners[i + 1].point) drawn.push_back(side(corners[i], corners[i + 1], normal));
  return drawn;
}

bool is_closed_flag(const DxfEntity& entity) { return entity.whole_number_of(70, 0) & 1; }

// -------------------------------------------------------------------------------------------------------
// fitted by a spline

constexpr int quadratic_fit = 5;  // group 75; others are cubic

/// A uniform B-spline: through the ends of its frame, or around it where it is closed.
NurbsCurve spline_of_frame(Places frame, int degree, bool closed) {
  degree = std::min(degree, static_cast<int>(frame.size()) - 1);
  if (closed)
    for (int i = 0; i < degree; ++i) frame.push_back(frame[i]);
  const int count = static_cast<int>(frame.size()), spans = count - degree;
  std::vector<double> knots;
  for (int i = -degree; i <= spans + degree; ++i) knots.push_back(closed ? i : std::clamp(i, 0, spans));
  Eigen::Matrix3Xd points(3, count);
  for (int i = 0; i < count; ++i) points.col(i) = frame[i];
  return make_nurbs_curve(KnotVector(degree, std::move(knots)), points, Eigen::VectorXd::Ones(count));
}

double largest_distance(const Places& from, const NurbsCurve& curve) {
  const BezierPath path = BezierPath::from_nurbs(curve, 0);
  const ClosestPoints closest(path.segments);
  double largest = 0;
  for (const Eigen::Vector3d& place : from) largest = std::max(largest, closest.to(place).distance);
  return largest;
}

/// The spline of its frame, if the places on it that the drawing has, too, say so; else these by chords.
DrawnCurve fitted(const Places& frame, const Places& drawn, int degree, bool closed) {
  const auto by_chords = [&](const std::string& why) {
    Places chords = drawn;
    if (closed && !chords.empty()) chords.push_back(chords.front());
    if (chords.size() < 2) throw std::runtime_error("it has fewer than two corners");
    return DrawnCurve{"bspline", polyline_through(chords),
                      "a polyline fitted by a spline is read by its chords, for " + why};
  };
  if (frame.size() < 2) return by_chords("the drawing has no frame of it");
  const NurbsCurve curve = spline_of_frame(frame, degree, closed);
  const Eigen::Matrix3Xd points = curve.control_points().colwise().hnormalized();
  const double size = (points.colwise() - points.col(0)).colwise().norm().maxCoeff();
  const double off = largest_distance(drawn, curve);
  constexpr double most = 1e-4;  // of the size: of drawings with few digits
  if (off <= most * size) return {"bspline", curve};
  return by_chords("they lie up to " + text_of(off / size) + " of its size off the spline of its frame");
}

}  // namespace

std::vector<DrawnCurve> light_polyline(const DxfEntity& entity) {
  const Eigen::Matrix3d axes = own_axes(entity);
  const double height = entity.number_of(38, 0);
  std::vector<PolylineCorner> corners;
  for (const DxfPair& pair : entity.pairs)  // 10, 20 and perhaps 42 of each corner
    if (pair.code == 10)
      corners.push_back({{pair.number(), 0, height}});
    else if (!corners.empty() && pair.code == 20)
      corners.back().point.y() = pair.number();
    else if (!corners.empty() && pair.code == 42)
      corners.back().bulge = pair.number();
  for (PolylineCorner& corner : corners) corner.point = axes * corner.point;
  return polyline_of(std::move(corners), is_closed_flag(entity), axes.col(2));
}

bool is_mesh(const DxfEntity& entity) {
  constexpr int surface = 16 | 64;
  return entity.type == "POLYLINE" && (entity.whole_number_of(70, 0) & surface);
}

std::vector<DrawnCurve> heavy_polyline(const DxfEntity& entity, const std::vector<DxfEntity>& all) {
  constexpr int by_spline = 4, in_space = 8, of_frame = 16;
  const int flags = entity.whole_number_of(70, 0);
  const Eigen::Matrix3d axes = flags & in_space ? Eigen::Matrix3d::Identity() : own_axes(entity);
  const double height = flags & in_space ? 0 : entity.number_of(30, 0);  // of all its corners
  std::vector<PolylineCorner> corners;
  Places frame, drawn;
  for (std::size_t i = entity.number; i < all.size() && all[i].type == "VERTEX"; ++i) {
    Eigen::Vector3d place = point_at(all[i], 10);
    if (height != 0) place.z() = height;
    place = axes * place;
    const bool is_frame = all[i].whole_number_of(70, 0) & of_frame;
    (is_frame ? frame : drawn).push_back(place);
    if (!is_frame) corners.push_back({place, flags & in_space ? 0 : all[i].number_of(42, 0)});
  }
  const bool closed = is_closed_flag(entity);
  if (flags & by_spline)
    return {fitted(frame, drawn, entity.whole_number_of(75, 0) == quadratic_fit ? 2 : 3, closed)};
  return polyline_of(std::move(corners), closed, axes.col(2));
}

}  // namespace nurbeam
