#pragma once
#include "fem/structure/structure.h"

namespace nurbeam {

/// The box of even density that has the mass and the inertia of a rigid body, about its centre of mass.
struct InertiaBox {
  Eigen::Vector3d principal;  ///< moments of inertia [kg m^2]
  Eigen::Vector3d sides;      ///< [m]
  Eigen::Matrix3d axes;  ///< columns: their directions, along the axes of the model as drawn; right-handed

  /// Columns: from the centre to the middle of three faces [m].
  Eigen::Matrix3d half_edges() const { return axes * (sides / 2).asDiagonal(); }
};
InertiaBox inertia_box(const Body& body);

}  // namespace nurbeam
