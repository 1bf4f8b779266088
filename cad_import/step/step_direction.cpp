#include "cad_import/step/step_direction.h"

#include <Eigen/Geometry>
#include <Geom_Direction.hxx>
#include <StepToGeom.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>

namespace nurbeam {

std::optional<Eigen::Vector3d> direction_of(const Handle(StepGeom_Direction) & direction) {
  // One whose values are lost has no ratios, which OpenCASCADE does not expect.
  if (direction.IsNull() || direction->DirectionRatios().IsNull()) return std::nullopt;
  const Handle(Geom_Direction) known = StepToGeom::MakeDirection(direction);
  if (known.IsNull()) return std::nullopt;
  return Eigen::Vector3d(known->X(), known->Y(), known->Z());
}

Handle(StepGeom_Direction) step_direction(const Eigen::Vector3d& direction) {
  const Handle(TColStd_HArray1OfReal) ratios = new TColStd_HArray1OfReal(1, 3);
  for (int i = 0; i < 3; ++i) ratios->SetValue(i + 1, direction(i));
  const Handle(StepGeom_Direction) result = new StepGeom_Direction;
  result->Init(new TCollection_HAsciiString(""), ratios);
  return result;
}

Eigen::Vector3d default_first_axis(const Eigen::Vector3d& third) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX();
  return third.cross(x).norm() < 1e-9 ? Eigen::Vector3d::UnitY() : x;
}

}  // namespace nurbeam
