#pragma once
#include <numbers>
#include <utility>
#include <vector>

#include "fem/model/build.h"
#include "nurbs/primitives.h"

/// Models that many tests start from.
namespace nurbeam::testing {

using nurbeam::arc_cubics;
using nurbeam::line_cubic;

inline BeamProperties round_bar(double radius, double density, double youngs_modulus,
                                CurvatureMeasure curvature = CurvatureMeasure::material) {
  return {Section::round(radius), Material{.youngs_modulus = youngs_modulus, .density = density}, curvature};
}

/// One beam under gravity along -y, on supports given by (s, clamped); a support beyond the end is at the
/// end.
inline BeamModel one_beam(const std::vector<RationalCubic>& axis, int dimension,
                          const BeamProperties& properties, int elements,
                          const std::vector<std::pair<double, bool>>& supports) {
  ModelBuilder builder(dimension, {0, -9.81, 0});
  const int beam = builder.add_beam(ReferenceCurve(axis, dimension), properties, {elements});
  for (const auto& [s, clamped] : supports)
    builder.add(Support{beam, std::min(s, builder.beam(beam).curve.length()), clamped});
  return builder.build();
}

/// A body of the given mass that slides on the first beam.
inline Rider& add_slider(BeamModel& model, double mass, double s) {
  model.bodies.push_back({.name = "body", .mass = mass});
  return model.riders.emplace_back(
      Rider{.body = static_cast<int>(model.bodies.size()) - 1, .beam = 0, .s = s, .motion = {}});
}

}  // namespace nurbeam::testing
