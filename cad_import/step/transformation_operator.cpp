#include "cad_import/step/transformation_operator.h"

#include <Geom_CartesianPoint.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepToGeom.hxx>
#include <TCollection_HAsciiString.hxx>
#include <initializer_list>
#include <optional>
#include <stdexcept>
#include <string>

#include "cad_import/occt/true_places.h"
#include "cad_import/step/step_direction.h"
#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Operator = StepGeom_CartesianTransformationOperator3d;

/// What is left of the direction at right angles to the others.
Eigen::Vector3d perpendicular(Eigen::Vector3d direction, std::initializer_list<Eigen::Vector3d> others) {
  for (const Eigen::Vector3d& other : others) direction -= direction.dot(other) * other;
  if (!(direction.norm() > 1e-9)) throw std::runtime_error("its axes do not span space; correct them");
  return direction.normalized();
}

/// base_axis of ISO 10303-42.
Eigen::Matrix3d axes_of(const Operator& transformation) {
  const Eigen::Vector3d third = direction_of(transformation.Axis3()).value_or(Eigen::Vector3d::UnitZ());
  const Eigen::Vector3d first =
      perpendicular(direction_of(transformation.Axis1()).value_or(default_first_axis(third)), {third});
  const auto given = direction_of(transformation.Axis2());
  Eigen::Matrix3d axes;
  axes << first, given ? perpendicular(*given, {third, first}) : Eigen::Vector3d(third.cross(first)), third;
  return axes;
}

Handle(TCollection_HAsciiString) unnamed() { return new TCollection_HAsciiString(""); }

}  // namespace

Eigen::Affine3d place_of(const Operator& transformation) {
  const double scale = transformation.HasScale() ? transformation.Scale() : 1;
  if (!(scale > 0)) throw std::runtime_error("its scale is " + text_of(scale) + "; it must be positive");
  const Handle(StepGeom_CartesianPoint) given = transformation.LocalOrigin();
  const Handle(Geom_CartesianPoint) origin =
      given.IsNull() ? Handle(Geom_CartesianPoint)() : StepToGeom::MakeCartesianPoint(given);
  if (origin.IsNull()) throw std::runtime_error("its transformation has no origin in space");
  Eigen::Affine3d place = Eigen::Affine3d::Identity();
  place.linear() = scale * axes_of(transformation);
  place.translation() << origin->X(), origin->Y(), origin->Z();
  return place;
}

bool is_location(const Operator& transformation) {
  const bool has_axes = transformation.HasAxis1() && transformation.HasAxis2() && transformation.HasAxis3();
  return has_axes && is_rigid(place_of(transformation));
}

Handle(Operator) transformation_operator(const Eigen::Affine3d& place) {
  const Handle(StepGeom_CartesianPoint) origin = new StepGeom_CartesianPoint;
  origin->Init3D(unnamed(), place.translation().x(), place.translation().y(), place.translation().z());
  const Handle(Operator) operation = new Operator;
  operation->Init(unnamed(), true, step_direction(place.linear().col(0)), true,
                  step_direction(place.linear().col(1)), origin, false, 1, true,
                  step_direction(place.linear().col(2)));
  return operation;
}

}  // namespace nurbeam
