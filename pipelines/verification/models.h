#pragma once
#include <algorithm>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "fem/model/build.h"
#include "nurbs/primitives.h"

/// Models for verification problems and tests, made without files; lengths in metres, planar ones in the x-y
/// plane.
namespace nurbeam::verification {

/// A solid round section.
inline BeamProperties round_bar(double radius, double density, double youngs_modulus,
                                CurvatureMeasure curvature = CurvatureMeasure::material) {
  const double area = std::numbers::pi * radius * radius;
  return {youngs_modulus * area, youngs_modulus * area * radius * radius / 4, density * area, 0, curvature};
}

/// One beam on supports given by (s, clamped); a support beyond the end is at the end.
inline BeamModel one_beam(std::vector<RationalCubic> axis, int dimension, const BeamProperties& properties,
                          int elements, const std::vector<std::pair<double, bool>>& supports) {
  ModelBuilder builder(dimension, {0, -9.81, 0});
  const int beam = builder.add_beam(ReferenceCurve(std::move(axis), dimension), properties, {elements});
  builder.beam(beam).name = "beam";
  for (const auto& [s, clamped] : supports) clamped ? builder.clamp(beam, s) : builder.pin(beam, s);
  return builder.build();
}

/// A body of the given mass on the first beam.
inline void add_slider(BeamModel& model, double mass, double s) {
  model.bodies.push_back({.name = "body", .mass = mass});
  Rider joint{};
  joint.body = static_cast<int>(model.bodies.size()) - 1;
  joint.s = s;
  model.riders.push_back(std::move(joint));
}

/// A dead force or moment at a place of the first beam that may move; beyond the end it is at the end.
inline LoadAtPlace load_at(const BeamModel& model, const Eigen::Vector3d& value, double s, double speed = 0) {
  return {.s = std::min(s, model.beams[0].curve.length()), .speed = speed, .value = value};
}
inline void add_force(BeamModel& model, const Eigen::Vector3d& value, double s, double speed = 0) {
  model.forces.push_back(PointLoad{load_at(model, value, s, speed)});
}
inline void add_moment(BeamModel& model, const Eigen::Vector3d& value, double s) {
  model.forces.push_back(Moment{load_at(model, value, s)});
}

/// A dead load per reference length [N/m] on the first beam.
inline void add_line_load(BeamModel& model, const Eigen::Vector3d& value) {
  model.forces.push_back(LineLoad{0, value});
}

}  // namespace nurbeam::verification
