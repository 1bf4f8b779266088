#include "cad_import/step/curve_replica.h"

#include <Eigen/Geometry>
#include <GeomConvert.hxx>
#include <GeomToStep_MakeCurve.hxx>
#include <Geom_CartesianPoint.hxx>
#include <Geom_Curve.hxx>
#include <Geom_Direction.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_CurveReplica.hxx>
#include <StepGeom_Direction.hxx>
#include <StepToGeom.hxx>
#include <TCollection_HAsciiString.hxx>
#include <gp_Trsf.hxx>
#include <optional>
#include <stdexcept>
#include <string>

#include "nurbs/number_text.h"

namespace nurbeam {
namespace {

using Operator = StepGeom_CartesianTransformationOperator3d;

std::optional<Eigen::Vector3d> direction_of(const Handle(StepGeom_Direction) & direction) {
  const Handle(Geom_Direction) known =
      direction.IsNull() ? Handle(Geom_Direction)() : StepToGeom::MakeDirection(direction);
  if (known.IsNull()) return std::nullopt;
  return Eigen::Vector3d(known->X(), known->Y(), known->Z());
}

/// What is left of the direction at right angles to the others.
Eigen::Vector3d perpendicular(Eigen::Vector3d direction, std::initializer_list<Eigen::Vector3d> others) {
  for (const Eigen::Vector3d& other : others) direction -= direction.dot(other) * other;
  if (!(direction.norm() > 1e-9)) throw std::runtime_error("its axes do not span space; correct them");
  return direction.normalized();
}

/// base_axis of ISO 10303-42.
Eigen::Matrix3d axes_of(const Operator& transformation) {
  const Eigen::Vector3d x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY();
  const Eigen::Vector3d third = direction_of(transformation.Axis3()).value_or(Eigen::Vector3d::UnitZ());
  const bool x_is_third = third.cross(x).norm() < 1e-9;
  const Eigen::Vector3d first =
      perpendicular(direction_of(transformation.Axis1()).value_or(x_is_third ? y : x), {third});
  const auto given = direction_of(transformation.Axis2());
  Eigen::Matrix3d axes;
  axes << first, given ? perpendicular(*given, {third, first}) : Eigen::Vector3d(third.cross(first)), third;
  return axes;
}

gp_Trsf transformation_of(const Operator& transformation) {
  const double scale = transformation.HasScale() ? transformation.Scale() : 1;
  if (!(scale > 0)) throw std::runtime_error("its scale is " + text_of(scale) + "; it must be positive");
  const Eigen::Matrix3d m = scale * axes_of(transformation);
  const Handle(Geom_CartesianPoint) origin = StepToGeom::MakeCartesianPoint(transformation.LocalOrigin());
  if (origin.IsNull()) throw std::runtime_error("its transformation has no origin in space");
  gp_Trsf result;
  result.SetValues(m(0, 0), m(0, 1), m(0, 2), origin->X(), m(1, 0), m(1, 1), m(1, 2), origin->Y(), m(2, 0),
                   m(2, 1), m(2, 2), origin->Z());
  return result;
}

Handle(Operator) identity() {
  const Handle(StepGeom_CartesianPoint) origin = new StepGeom_CartesianPoint;
  origin->Init3D(new TCollection_HAsciiString(""), 0, 0, 0);
  const Handle(Operator) operation = new Operator;
  operation->Init(new TCollection_HAsciiString(""), false, nullptr, false, nullptr, origin, false, 1, false,
                  nullptr);
  return operation;
}

/// OpenCASCADE writes a piece of a conic as the whole; as a rational quadratic it stays what it is.
Handle(Geom_Curve) without_trims(const Handle(Geom_Curve) & curve) {
  const auto piece = Handle(Geom_TrimmedCurve)::DownCast(curve);
  if (piece.IsNull() || piece->BasisCurve()->IsKind(STANDARD_TYPE(Geom_OffsetCurve))) return curve;
  return GeomConvert::CurveToBSplineCurve(piece, Convert_TgtThetaOver2);
}

}  // namespace

void restate_replica(StepGeom_CurveReplica& replica) {
  const auto transformation = Handle(Operator)::DownCast(replica.Transformation());
  if (transformation.IsNull()) throw std::runtime_error("it has no transformation in space");
  const Handle(Geom_Curve) curve = StepToGeom::MakeCurve(replica.ParentCurve());
  if (curve.IsNull())
    throw std::runtime_error("OpenCASCADE makes no curve of its parent; draw the curve itself at this place");
  curve->Transform(transformation_of(*transformation));
  const Handle(Geom_Curve) whole = without_trims(curve);
  const bool is_written = !whole->IsKind(STANDARD_TYPE(Geom_TrimmedCurve));
  const GeomToStep_MakeCurve moved(whole);
  if (!is_written || !moved.IsDone() || moved.Value().IsNull())
    throw std::runtime_error("replicas of such curves are not read; draw the curve itself at this place");
  replica.SetParentCurve(moved.Value());
  replica.SetTransformation(identity());
}

}  // namespace nurbeam
