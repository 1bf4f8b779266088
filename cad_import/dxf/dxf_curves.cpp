#include "cad_import/dxf/dxf_curves.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

#include "cad_import/dxf/drawn_arcs.h"
#include "cad_import/dxf/dxf_helix.h"
#include "cad_import/dxf/dxf_polyline.h"
#include "cad_import/dxf/dxf_spline.h"
#include "cad_import/dxf/own_axes.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

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

}  // namespace

bool is_curve_kind(std::string_view type) {
  static const std::set<std::string_view> kinds{"LINE",   "ARC",   "CIRCLE",     "ELLIPSE",
                                                "SPLINE", "HELIX", "LWPOLYLINE", "POLYLINE"};
  return kinds.contains(type);
}

std::vector<DrawnCurve> curves_of(const DxfEntity& entity, const std::vector<DxfEntity>& all) {
  if (entity.type == "LINE")
    return {{"line", polyline_through({point_at(entity, 10), point_at(entity, 11)})}};
  if (entity.type == "ARC") return {circle(entity, false)};
  if (entity.type == "CIRCLE") return {circle(entity, true)};
  if (entity.type == "ELLIPSE") return {ellipse(entity)};
  if (entity.type == "HELIX" && !has_spline(entity)) return {helix_curve(entity)};
  if (entity.type == "SPLINE" || entity.type == "HELIX") return spline_curves(entity);
  if (entity.type == "LWPOLYLINE") return light_polyline(entity);
  if (entity.type == "POLYLINE") return heavy_polyline(entity, all);
  return {};
}

}  // namespace nurbeam
