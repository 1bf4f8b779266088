#include "cad_import/step/curve_replica.h"

#include <Eigen/Geometry>
#include <GeomConvert.hxx>
#include <GeomToStep_MakeCurve.hxx>
#include <Geom_Curve.hxx>
#include <Geom_OffsetCurve.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <StepGeom_CartesianTransformationOperator3d.hxx>
#include <StepGeom_Curve.hxx>
#include <StepGeom_CurveReplica.hxx>
#include <StepToGeom.hxx>
#include <gp_Trsf.hxx>
#include <stdexcept>

#include "cad_import/step/transformation_operator.h"

namespace nurbeam {
namespace {

using Operator = StepGeom_CartesianTransformationOperator3d;

gp_Trsf similarity(const Eigen::Affine3d& place) {
  gp_Trsf result;
  result.SetValues(place(0, 0), place(0, 1), place(0, 2), place(0, 3), place(1, 0), place(1, 1), place(1, 2),
                   place(1, 3), place(2, 0), place(2, 1), place(2, 2), place(2, 3));
  return result;
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
  curve->Transform(similarity(place_of(*transformation)));
  const Handle(Geom_Curve) whole = without_trims(curve);
  const bool is_written = !whole->IsKind(STANDARD_TYPE(Geom_TrimmedCurve));
  const GeomToStep_MakeCurve moved(whole);
  if (!is_written || !moved.IsDone() || moved.Value().IsNull())
    throw std::runtime_error("replicas of such curves are not read; draw the curve itself at this place");
  replica.SetParentCurve(moved.Value());
  replica.SetTransformation(transformation_operator(Eigen::Affine3d::Identity()));
}

}  // namespace nurbeam
