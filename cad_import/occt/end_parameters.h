#pragma once
#include <Geom_BSplineCurve.hxx>
#include <TopoDS_Edge.hxx>
#include <gp_Pnt.hxx>

namespace nurbeam {

/// The parameter at which a B-spline curve is closest to a point: OpenCASCADE's own search now and then finds
/// another place where the distance is stationary only.
double closest_parameter(const Geom_BSplineCurve& curve, const gp_Pnt& point);

/// Where an edge of the curve begins and ends: `first` and `last` as it says, but where its vertices lie on
/// the curve elsewhere, there.
void correct_ends(const TopoDS_Edge& edge, const Geom_BSplineCurve& curve, double& first, double& last);

}  // namespace nurbeam
