#pragma once
#include <TopoDS_Shape.hxx>

#include "cad_import/step/spine.h"

namespace nurbeam {

/// The solid [mm] that a disk of this radius [m], with a bore an annulus, sweeps along lines and arcs: of
/// cylinders and tori, with mitres at corners. Null where the spine is not of lines and arcs only.
TopoDS_Shape arc_pipe(const Spine& spine, double radius, double bore);

}  // namespace nurbeam
