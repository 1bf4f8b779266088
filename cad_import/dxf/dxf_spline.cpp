#include "cad_import/dxf/dxf_spline.h"

#include <Eigen/Geometry>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

#include "cad_import/dxf/drawn_arcs.h"
#include "cad_import/dxf/own_axes.h"
#include "nurbs/full_knots.h"
#include "nurbs/interpolated_cubic.h"

namespace nurbeam {
namespace {

void check_count(std::size_t count, std::size_t points, const std::string& what) {
  if (count != points)
    throw std::runtime_error("it has " + std::to_string(points) + " x of control points (group 10) and " +
                             std::to_string(count) + " " + what + "; each point needs its own");
}

/// A spline without group 30 lies in the plane z = 0, one without group 41 is not rational.
Eigen::Matrix4Xd control_points(const DxfEntity& entity) {
  const std::vector<double> x = entity.numbers_of(10), y = entity.numbers_of(20);
  std::vector<double> z = entity.numbers_of(30), weights = entity.numbers_of(41);
  if (z.empty()) z.assign(x.size(), 0);
  if (weights.empty()) weights.assign(x.size(), 1);
  check_count(y.size(), x.size(), "y (group 20)");
  check_count(z.size(), x.size(), "z (group 30)");
  check_count(weights.size(), x.size(), "weights (group 41)");
  Eigen::Matrix4Xd points(4, x.size());
  for (std::size_t i = 0; i < x.size(); ++i)
    points.col(static_cast<Eigen::Index>(i)) << weights[i] * Eigen::Vector3d(x[i], y[i], z[i]), weights[i];
  return points;
}

// -------------------------------------------------------------------------------------------------------
// fit points

using Places = std::vector<Eigen::Vector3d>;

/// Those that follow one another at the same place as one.
Places fit_points(const DxfEntity& entity) {
  const std::vector<double> x = entity.numbers_of(11), y = entity.numbers_of(21), z = entity.numbers_of(31);
  Places places;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Eigen::Vector3d place(x[i], i < y.size() ? y[i] : 0, i < z.size() ? z[i] : 0);
    if (places.empty() || places.back() != place) places.push_back(place);
  }
  return places;
}

std::optional<Eigen::Vector3d> direction_at(const DxfEntity& entity, int code) {
  const Eigen::Vector3d direction = point_at(entity, code);
  return direction.norm() > 0 ? std::optional(direction.normalized()) : std::nullopt;
}

DrawnCurve spline_through(const DxfEntity& entity) {
  constexpr int start_tangent = 12, end_tangent = 13;
  const bool closed = entity.whole_number_of(70, 0) & 1;
  Places places = fit_points(entity);
  if (places.size() > 2 && closed && places.front() != places.back()) places.push_back(places.front());
  if (places.size() < 2)
    throw std::runtime_error("it has no control points and fewer than two different fit points");
  Eigen::Matrix3Xd points(3, places.size());
  std::vector<double> chords{0};
  for (std::size_t i = 0; i < places.size(); ++i) {
    points.col(static_cast<Eigen::Index>(i)) = places[i];
    if (i > 0) chords.push_back(chords.back() + (places[i] - places[i - 1]).norm());
  }
  if (closed && places.size() > 3)
    return {"bspline", closed_interpolated_cubic(chords, points),
            "a closed spline of fit points only is the cubic through them by chord lengths"};
  return {"bspline",
          interpolated_cubic(chords, points,
                             {direction_at(entity, start_tangent), direction_at(entity, end_tangent)}),
          "a spline of fit points only is the cubic through them by chord lengths, along its end tangents "
          "where it has them, else without curvature at its ends"};
}

}  // namespace

std::vector<DrawnCurve> spline_curves(const DxfEntity& whole) {
  const DxfEntity entity = whole.part_of_class("AcDbSpline");
  const Eigen::Matrix4Xd points = control_points(entity);
  if (points.cols() == 0) return {spline_through(entity)};
  if (!(points.row(3).minCoeff() > 0)) throw std::runtime_error("a weight is not positive");
  std::vector<DrawnCurve> drawn;
  for (NurbsCurve& curve : split_at_full_knots(entity.whole_number_of(71, 3), entity.numbers_of(40), points))
    drawn.push_back({"bspline", std::move(curve)});
  return drawn;
}

}  // namespace nurbeam
