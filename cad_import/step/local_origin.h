#pragma once
#include <Eigen/Core>
#include <TopoDS_Shape.hxx>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// Where shapes of the curve are made about, in whole metres [m]: far from the origin OpenCASCADE's
/// tolerances are below the digits of its numbers. The origin itself for a curve near it.
Eigen::Vector3d local_origin(const NurbsCurve& curve);

/// The curve, and a solid, moved so that this point is the origin [m].
NurbsCurve moved_to_origin(const NurbsCurve& curve, const Eigen::Vector3d& point);
NamedSolid moved_to_origin(NamedSolid solid, const Eigen::Vector3d& point);

/// A shape that was made about this point [m], where it belongs.
TopoDS_Shape moved_back(const TopoDS_Shape& shape, const Eigen::Vector3d& point);

/// The shape without a location, its curves and surfaces moved instead. Readers that give shapes tolerances
/// of their own see the digits that these lose far from the origin, but not those that a location loses.
TopoDS_Shape moved_in_itself(const TopoDS_Shape& shape);

/// local_origin() of its axis, or of one of its lines.
Eigen::Vector3d local_origin(const NamedSolid& solid);

}  // namespace nurbeam
