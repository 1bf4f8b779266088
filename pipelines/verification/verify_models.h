#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "fem/model/beam_model.h"

/// Models for verification problems and tests, made without files; lengths in metres, planar ones in the x-y
/// plane.
namespace nurbeam::verification {

inline RationalCubic line_cubic(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << a + (b - a) * (i / 3.0), 1;
  return RationalCubic(points);
}

/// Circular arcs in the x-y plane from angle `start` to `end` [rad] in equal pieces (Eq. 43 of Ding &
/// Ouyang).
inline std::vector<RationalCubic> arc_cubics(const Eigen::Vector3d& center, double radius, double start,
                                             double end, int pieces) {
  const double step = (end - start) / pieces, w = (1 + 2 * std::cos(step / 2)) / 3;
  const auto radial = [](double angle) { return Eigen::Vector3d(std::cos(angle), std::sin(angle), 0); };
  const auto across = [](double angle) { return Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0); };
  std::vector<RationalCubic> cubics;
  for (int i = 0; i < pieces; ++i) {
    const double a = start + i * step, b = a + step, handle = radius * 2 * std::sin(step / 2) / (3 * w);
    Eigen::Matrix4d points;
    points.col(0) << center + radius * radial(a), 1;
    points.col(1) << w * (center + radius * radial(a) + handle * across(a)), w;
    points.col(2) << w * (center + radius * radial(b) - handle * across(b)), w;
    points.col(3) << center + radius * radial(b), 1;
    cubics.push_back(RationalCubic(points));
  }
  return cubics;
}

/// A solid round section.
inline BeamProperties round_bar(double radius, double density, double youngs_modulus,
                                CurvatureMeasure curvature = CurvatureMeasure::material) {
  const double area = M_PI * radius * radius;
  return {youngs_modulus * area, youngs_modulus * area * radius * radius / 4, density * area, 0, curvature};
}

/// One beam on supports given by (s, clamped); a support beyond the end is at the end.
inline BeamModel one_beam(std::vector<RationalCubic> axis, int dimension, const BeamProperties& properties,
                          int elements, const std::vector<std::pair<double, bool>>& supports) {
  BeamModel model;
  model.dimension = dimension;
  model.gravity = {0, -9.81, 0};
  ReferenceCurve curve(std::move(axis), dimension);
  std::vector<double> places;
  for (const auto& [s, clamped] : supports) {
    places.push_back(std::min(s, curve.length()));
    model.supports.push_back({0, places.back(), clamped});
  }
  const std::vector<double> fixed = fixed_places(curve, places);
  const std::vector<HomeNode> home = home_nodes(fixed, spread_elements(fixed, elements));
  model.beams.push_back({.name = "beam", .curve = std::move(curve), .properties = properties, .home = home});
  return model;
}

/// A body of the given mass on the first beam.
inline void add_slider(BeamModel& model, double mass, double s) {
  model.bodies.push_back({"body", mass});
  SlidingJoint joint{};
  joint.body = static_cast<int>(model.bodies.size()) - 1;
  joint.s = s;
  model.joints.push_back(std::move(joint));
}

/// A dead load at a place of the first beam that may move; beyond the end it is at the end.
inline void add_load(BeamModel& model, PointLoad::Kind kind, const Eigen::Vector3d& value, double s,
                     double speed = 0) {
  PointLoad load;
  load.kind = kind;
  load.value = value;
  load.s = std::min(s, model.beams[0].curve.length());
  load.speed = speed;
  model.point_loads.push_back(std::move(load));
}

/// A dead load per reference length [N/m] on the first beam.
inline void add_line_load(BeamModel& model, const Eigen::Vector3d& value) {
  LineLoad load;
  load.value = value;
  model.line_loads.push_back(std::move(load));
}

}  // namespace nurbeam::verification
