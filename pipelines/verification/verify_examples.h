#pragma once
#include <cmath>
#include <numbers>

#include "pipelines/verification/models.h"

/// The sliding examples of Ding & Ouyang 2022, with their curvature measure; g = 9.81 m/s^2.
namespace nurbeam::verification {

/// Example 1: clamped at the left, a body of 0.8 kg at 0.1 m.
inline BeamModel falling_beam(int elements) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                             round_bar(0.01, 7200, 20e6, CurvatureMeasure::spatial), elements, {{0, true}});
  add_slider(model, 0.8, 0.1);
  return model;
}

/// Example 2: the same beam hung at both ends, a body of 5 kg.
inline BeamModel suspended_beam(int elements) {
  BeamModel model =
      one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, round_bar(0.01, 7200, 20e6, CurvatureMeasure::spatial),
               elements, {{0, false}, {1, false}});
  add_slider(model, 5, 0.1);
  return model;
}

/// Example 3: a semicircle of two arcs, radius 2 m, hung at both ends; stress-free as drawn, or straight and
/// bent to it by end moments that are released at the start.
inline BeamModel semicircle(int elements, bool straight) {
  BeamModel model =
      one_beam(arc_cubics({0, 0, 0}, 2, std::numbers::pi, 2 * std::numbers::pi, 2), 2,
               round_bar(0.02, 7200, 200e6, CurvatureMeasure::spatial), elements, {{0, false}, {10, false}});
  if (straight) model.beams[0].curve = model.beams[0].curve.straightened();
  add_slider(model, 0.8, 2 * std::numbers::pi / 16);
  return model;
}

}  // namespace nurbeam::verification
