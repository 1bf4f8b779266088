#include "pipelines/model/drawn_bending.h"

#include <cmath>

#include "nurbs/gauss_panels.h"

namespace nurbeam {

DrawnBending drawn_bending(const ReferenceCurve& drawn, double bending_stiffness) {
  constexpr int samples = 33;         // where the largest curvature is looked for
  constexpr double tolerance = 1e-9;  // of the energy, which is told in few digits
  DrawnBending bending;
  for (int j = 0; j < drawn.segment_count(); ++j) {
    const auto density = [&](double u) {
      const ChartGeometry geometry = drawn.geometry(j, u);
      return 0.5 * bending_stiffness * geometry.curvature[0] * geometry.curvature[0] * geometry.stretch[0];
    };
    bending.energy += panels_of(density, 0, 1, gauss(density, 0, 1), tolerance).integrals.back();
    for (int i = 0; i < samples; ++i) {
      const double u = i / (samples - 1.0), curvature = std::abs(drawn.geometry(j, u).curvature[0]);
      if (curvature > bending.curvature) {
        bending.curvature = curvature;
        bending.s = drawn.arc_length(j, u);
      }
    }
  }
  return bending;
}

}  // namespace nurbeam
