#include <cmath>
#include <cstdio>
#include <numbers>

#include "fem/system/beam_system.h"
#include "nurbs/rational_cubic.h"

// The energy of a straight steel wire bent to a quarter circle of radius 1 m: EI/2 times the angle.
int main() {
  const double w = (1 + std::numbers::sqrt2) / 3, h = 2 - std::numbers::sqrt2;
  Eigen::Matrix4d points;
  points.col(0) << 1, 0, 0, 1;
  points.col(1) << w, w * h, 0, w;
  points.col(2) << w * h, w, 0, w;
  points.col(3) << 0, 1, 0, 1;
  const nurbeam::ReferenceCurve quarter({nurbeam::RationalCubic(points)}, 2);

  nurbeam::BeamModel model;
  model.dimension = 2;
  model.beams.push_back({.name = "wire",
                         .curve = quarter,
                         .properties = {.axial_stiffness = 1e5, .bending_stiffness = 2, .mass_per_length = 1},
                         .straight = true,
                         .home = nurbeam::home_nodes({0, quarter.length()}, {4})});
  const nurbeam::BeamSystem<2> system(model, nurbeam::initial_plan(model));
  const double energy = system.energy(system.drawn_state()).bending, expected = std::numbers::pi / 2;
  std::printf("length %.12f m, energy %.12f J\n", quarter.length(), energy);
  return std::abs(energy - expected) < 1e-6 ? 0 : 1;
}
