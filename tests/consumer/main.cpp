#include <cmath>
#include <cstdio>
#include <numbers>

#include "fem/model/build.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
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

  nurbeam::ModelBuilder builder(2);
  builder.add_beam(quarter.straightened(), nurbeam::BeamProperties(1e5, 2, 1), {.elements = 4});
  const nurbeam::BeamSystem system(builder.build());
  const double bent = nurbeam::energy(system, nurbeam::drawn_state(system)).bending,
               expected = std::numbers::pi / 2;
  std::printf("length %.12f m, energy %.12f J\n", quarter.length(), bent);
  return std::abs(bent - expected) < 1e-6 ? 0 : 1;
}
