#pragma once
#include "cad_import/report/leniency.h"

class IGESGeom_OffsetCurve;

namespace nurbeam {

/// Says an offset curve (130) anew as OpenCASCADE takes it: it reads the distance, and parameters that are
/// lengths, in millimetres, those of a line as lengths, and turns the normal twice. `unit`: of the file [mm];
/// the base curve must be as it is in the file. Throws std::runtime_error where the base is none of a line, a
/// circular arc, a B-spline and a whole ellipse or parabola, or where one offset is of another that is moved
/// or turned.
void restate_offset(IGESGeom_OffsetCurve& offset, double unit, const Leniency& leniency);

}  // namespace nurbeam
