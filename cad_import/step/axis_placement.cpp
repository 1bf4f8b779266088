#include "cad_import/step/axis_placement.h"

#include "cad_import/step/step_direction.h"

namespace nurbeam {

void complete_axes(StepGeom_Axis2Placement3d& placement) {
  if (placement.HasRefDirection()) return;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis = placement.HasAxis() ? direction_of(placement.Axis()).value_or(z) : z;
  placement.SetRefDirection(step_direction(default_first_axis(axis)));
}

}  // namespace nurbeam
