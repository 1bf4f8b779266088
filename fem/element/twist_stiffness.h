#pragma once
#include "fem/element/quadrature.h"
#include "fem/element/twist_kinematics.h"
#include "fem/material/section.h"

namespace nurbeam::twist {

/// The second derivative of the strain energy of an element whose ends are fixed by its reduced coordinates.
Eigen::Matrix<double, reduced, reduced> stiffness_of(const Drawing<double, GaussRule::size>& drawing,
                                                     const std::array<Eigen::Matrix3d, 2>& charts,
                                                     const SectionStiffness& section,
                                                     const Fields<double, GaussRule::size>& fields);

}  // namespace nurbeam::twist
