#pragma once
#include <functional>
#include <numbers>
#include <stdexcept>

#include "fem/model/build.h"
#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/noted.h"
#include "solver/rest/static_equilibrium.h"

/// Rods whose sections twist, as the references of docs/verification.md have them.
namespace nurbeam::verification {

inline RationalCubic cubic(const std::array<Eigen::Vector3d, 4>& P, const std::array<double, 4>& w) {
  Eigen::Matrix4d points;
  for (int i = 0; i < 4; ++i) points.col(i) << w[i] * P[i], w[i];
  return RationalCubic(points);
}

/// Stiffnesses of a rod [N, N m^2]; its sections are named by their first axis, as the references have them.
struct Rod {
  double EA, EI1, EI2, EI12, GJ;

  /// For a drawing whose sections d2 point where the references' d1 do: the two axes change places.
  BeamProperties properties() const {
    BeamProperties p(EA, 0, 1);
    p.sections = SectionStiffness{EI2, EI1, -EI12, GJ, 0.01};
    return p;
  }
};

/// A cantilever, clamped at s = 0.
inline ModelBuilder clamped(const ReferenceCurve& curve, const Rod& rod, int elements) {
  ModelBuilder builder(3);
  const int beam = builder.add_beam(curve, rod.properties(), {elements});
  builder.clamp(beam, 0);
  return builder;
}

/// At rest, from the drawn shape.
struct Rest {
  BeamSystem system;
  State state;

  explicit Rest(const ModelBuilder& builder)
      : system(noted(builder.build(), as_statics)), state(drawn_state(system)) {
    const StaticReport found = find_static_equilibrium(StaticEquilibrium{}, system, state);
    if (found.status != StaticStatus::converged) throw std::runtime_error("no static equilibrium was found");
  }
  double length() const { return system.model().beams[0].curve.length(); }
  Eigen::Vector3d tip() const { return material_point(system, state, 0, length()).r; }
  /// The references' d1.
  Eigen::Vector3d axis() const { return section_point(system, state, 0, length()).triad.d2; }
};

/// Hermite cubics through a curve of parameter x, from 0 to `end`.
inline std::vector<RationalCubic> hermite(const std::function<Eigen::Vector3d(double)>& r,
                                          const std::function<Eigen::Vector3d(double)>& slope, double end,
                                          int pieces) {
  std::vector<RationalCubic> cubics;
  const double h = end / pieces;
  for (int i = 0; i < pieces; ++i) {
    const double a = i * h, b = a + h;
    cubics.push_back(cubic({r(a), r(a) + h / 3 * slope(a), r(b) - h / 3 * slope(b), r(b)}, {1, 1, 1, 1}));
  }
  return cubics;
}

/// A straight round rod along x, from the origin.
inline ReferenceCurve straight_rod(double length) {
  return ReferenceCurve({line_cubic({0, 0, 0}, {length, 0, 0})}, 3).oriented({});
}

}  // namespace nurbeam::verification
