#pragma once
#include "fem/element/twist_kinematics.h"
#include "fem/material/section.h"
#include "solver/system/second_order_system.h"

namespace nurbeam::twist {

using Moments = std::array<SectionMoments<double>, GaussRule::size>;

/// Viscous damping: the fields along the motion, and the time c of the moments c C de/dt.
struct Viscosity {
  Fields<Dual<1>, GaussRule::size> moving;
  double damping;
};

/// The tangent of gradient_of, with the elastic and viscous moments C (e + c de/dt) and fixed ends, in closed
/// form. `viscous`: empty without damping.
Eigen::Matrix<double, reduced, reduced> section_tangent(const Drawing<double, GaussRule::size>& drawing,
                                                        const std::array<Eigen::Matrix3d, 2>& charts,
                                                        const SectionStiffness& section,
                                                        const Fields<double, GaussRule::size>& fields,
                                                        const Moments& moments, const TangentWeights& w,
                                                        const Viscosity* viscous);

}  // namespace nurbeam::twist
