#include "cad_import/program/missing_parts.h"

#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <StepGeom_Axis2Placement3d.hxx>
#include <StepGeom_BSplineCurve.hxx>
#include <StepGeom_BSplineCurveWithKnots.hxx>
#include <StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_Conic.hxx>
#include <StepGeom_Direction.hxx>
#include <StepGeom_HArray1OfCartesianPoint.hxx>
#include <StepGeom_Line.hxx>
#include <StepGeom_Polyline.hxx>
#include <StepGeom_Vector.hxx>
#include <TColStd_HArray1OfInteger.hxx>
#include <TColStd_HArray1OfReal.hxx>
#include <TCollection_HAsciiString.hxx>

#include "cad_import/step/step_direction.h"

namespace nurbeam {
namespace {

Handle(StepGeom_CartesianPoint) origin() {
  const Handle(StepGeom_CartesianPoint) point = new StepGeom_CartesianPoint;
  point->Init3D(new TCollection_HAsciiString(""), 0, 0, 0);
  return point;
}

/// Whether one of the points is missing.
bool fill(const Handle(StepGeom_HArray1OfCartesianPoint) & points) {
  bool missing = points.IsNull();
  for (int i = 1; !points.IsNull() && i <= points->Length(); ++i)
    if (points->Value(i).IsNull()) {
      points->SetValue(i, origin());
      missing = true;
    }
  return missing;
}

bool lacks_parts(const StepGeom_Line& line) {
  return line.Pnt().IsNull() || line.Dir().IsNull() || line.Dir()->Orientation().IsNull();
}

void fill(StepGeom_Line& line) {
  if (line.Pnt().IsNull()) line.SetPnt(origin());
  const Handle(StepGeom_Vector) vector = new StepGeom_Vector;
  vector->Init(new TCollection_HAsciiString(""), step_direction(Eigen::Vector3d::UnitZ()), 1);
  line.SetDir(vector);
}

/// The part of the spline that has its knots; none where it has none of its own.
Handle(StepGeom_BSplineCurveWithKnots) with_knots(const Handle(StepGeom_BSplineCurve) & spline) {
  if (const auto rational = Handle(StepGeom_BSplineCurveWithKnotsAndRationalBSplineCurve)::DownCast(spline))
    return rational->BSplineCurveWithKnots();
  return Handle(StepGeom_BSplineCurveWithKnots)::DownCast(spline);
}

/// Whether the knots, or how often they stand, are missing.
bool fill_knots(const Handle(StepGeom_BSplineCurveWithKnots) & spline) {
  if (spline.IsNull() || (!spline->Knots().IsNull() && !spline->KnotMultiplicities().IsNull() &&
                          spline->NbKnots() == spline->NbKnotMultiplicities()))
    return false;
  const Handle(TColStd_HArray1OfReal) knots = new TColStd_HArray1OfReal(1, 2, 0.0);
  knots->SetValue(2, 1);
  spline->SetKnots(knots);
  spline->SetKnotMultiplicities(new TColStd_HArray1OfInteger(1, 2, spline->Degree() + 1));
  return true;
}

void name_placement(const Handle(StepGeom_Axis2Placement3d) & placement, const Interface_Graph& graph,
                    Remarks& remarks) {
  bool has_others = false;
  for (Interface_EntityIterator next = graph.Sharings(placement); next.More(); next.Next())
    if (next.Value()->IsKind(STANDARD_TYPE(StepGeom_Conic)))
      remarks.refuse(next.Value(), "its placement has no point; correct it");
    else
      has_others = true;
  if (has_others)
    remarks.warn(placement, "has no point: the origin is taken, and what it places may be wrong; correct it");
}

}  // namespace

void fill_missing_parts(const StepData_StepModel& model, const Interface_Graph& graph, Remarks& remarks) {
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(Standard_Transient) entity = model.Value(i);
    if (const auto placement = Handle(StepGeom_Axis2Placement3d)::DownCast(entity)) {
      if (!placement->Location().IsNull()) continue;
      placement->SetLocation(origin());
      name_placement(placement, graph, remarks);
    } else if (const auto line = Handle(StepGeom_Line)::DownCast(entity)) {
      if (!lacks_parts(*line)) continue;
      fill(*line);
      remarks.refuse(line, "its point or its direction is missing; correct it");
    } else if (const auto polyline = Handle(StepGeom_Polyline)::DownCast(entity)) {
      if (fill(polyline->Points())) remarks.refuse(polyline, "a point of it is missing; correct it");
    } else if (const auto spline = Handle(StepGeom_BSplineCurve)::DownCast(entity)) {
      const bool lacks_point = fill(spline->ControlPointsList()),
                 lacks_knots = fill_knots(with_knots(spline));
      if (lacks_point) remarks.refuse(spline, "a control point of it is missing; correct it");
      if (lacks_knots) remarks.refuse(spline, "its knots, or how often they stand, are missing; correct it");
    }
  }
}

}  // namespace nurbeam
