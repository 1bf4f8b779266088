#pragma once
#include <Eigen/Core>
#include <gp_Pnt.hxx>

#include "cad_import/report/length_unit.h"

namespace nurbeam {

/// What edges of solids may lie apart where they are sewn [mm].
constexpr double sewing_tolerance = 1e-6;

/// The place [m] as OpenCASCADE's [mm].
inline gp_Pnt in_millimetres(const Eigen::Vector3d& place) {
  const Eigen::Vector3d p = millimetres_per_metre * place;
  return {p.x(), p.y(), p.z()};
}

}  // namespace nurbeam
