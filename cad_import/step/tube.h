#pragma once
#include <TopoDS_Shape.hxx>

#include "cad_import/step/spine.h"

namespace nurbeam {

/// The solid [mm] that a disk of this radius [m], with a bore an annulus, sweeps along a curve, its ends cut
/// square; of a closed curve the solid without ends.
///
/// B-spline faces, cubics along the curve, in sections exactly circles at their nodes and within 1e-6 of the
/// radius between: the volume is as near to that of the tube. The sections turn about the curve as little as
/// they can; where they do not close after one round of a ring in space, what is left is spread over the
/// length. Towards a corner they lean over into its mitre; each is the square one sheared along the tangent,
/// which keeps the volume. Throws std::runtime_error where there is no room for that, or OpenCASCADE makes no
/// solid of the faces.
TopoDS_Shape tube(const Spine& spine, double radius, double bore);

}  // namespace nurbeam
