#include "cad_import/step/axis_placement.h"

#include <StepGeom_CartesianPoint.hxx>
#include <TCollection_HAsciiString.hxx>
#include <stdexcept>

#include "cad_import/step/step_direction.h"

namespace nurbeam {

void complete_axes(StepGeom_Axis2Placement3d& placement) {
  if (placement.HasRefDirection()) return;
  const Eigen::Vector3d z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis = placement.HasAxis() ? direction_of(placement.Axis()).value_or(z) : z;
  placement.SetRefDirection(step_direction(default_first_axis(axis)));
}

Eigen::Affine3d place_of(const StepGeom_Axis2Placement3d& placement) {
  const Handle(StepGeom_CartesianPoint) origin = placement.Location();
  if (origin.IsNull() || origin->NbCoordinates() != 3)
    throw std::runtime_error("its placement has no origin in space");
  const Eigen::Vector3d z = direction_of(placement.Axis()).value_or(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d given = direction_of(placement.RefDirection()).value_or(default_first_axis(z));
  const Eigen::Vector3d x = given - given.dot(z) * z;
  if (!(x.norm() > 1e-9)) throw std::runtime_error("the axes of its placement are parallel; correct them");
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.linear() << x.normalized(), z.cross(x.normalized()), z;
  for (int i = 0; i < 3; ++i) place.translation()[i] = origin->CoordinatesValue(i + 1);
  return place;
}

Handle(StepGeom_Axis2Placement3d) axis_placement(const Eigen::Affine3d& place) {
  const Handle(TCollection_HAsciiString) unnamed = new TCollection_HAsciiString("");
  const Handle(StepGeom_CartesianPoint) origin = new StepGeom_CartesianPoint;
  origin->Init3D(unnamed, place.translation().x(), place.translation().y(), place.translation().z());
  const Handle(StepGeom_Axis2Placement3d) placement = new StepGeom_Axis2Placement3d;
  placement->Init(unnamed, origin, true, step_direction(place.linear().col(2)), true,
                  step_direction(place.linear().col(0)));
  return placement;
}

}  // namespace nurbeam
