#pragma once
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <Geom_BezierCurve.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Pnt.hxx>

#include "nurbs/nurbs_curve.h"

namespace nurbeam {

/// A cubic from the origin to (300, 0, 0), `height` [mm] high.
inline TopoDS_Edge arch(double height) {
  TColgp_Array1OfPnt poles(1, 4);
  poles(1) = gp_Pnt(0, 0, 0);
  poles(2) = gp_Pnt(100, 0, height);
  poles(3) = gp_Pnt(200, 50, height);
  poles(4) = gp_Pnt(300, 0, 0);
  return BRepBuilderAPI_MakeEdge(new Geom_BezierCurve(poles)).Edge();
}

/// The curve, half as high again.
inline NurbsCurve stretched(const NurbsCurve& curve) {
  Eigen::Matrix4Xd points = curve.control_points();
  points.row(2) *= 1.5;
  return {curve.knots(), points};
}

}  // namespace nurbeam
