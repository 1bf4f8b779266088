#pragma once
#include <string>
#include <vector>

#include "cad_import/report/format.h"
#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The text of a STEP file with the curves as a geometric curve set, each a B_SPLINE_CURVE_WITH_KNOTS
/// (rational where its weights differ) that carries the name. Every double is written so that it reads back
/// as itself. Throws std::runtime_error when OpenCASCADE refuses a curve (its degree above 25, knots closer
/// than rounding). Not to be called by two threads at once: OpenCASCADE's translators share global state.
std::string step_text(const std::vector<NamedCurve>& curves, LengthUnit unit, StepSchema schema);

/// The text of a STEP file with manifold solids, else as step_text. Throws
/// std::runtime_error also when a sweep gives no valid solid of the volume that the section times the length
/// has. To be called in a child process: OpenCASCADE's sweep may crash.
std::string step_solid_text(const std::vector<NamedSolid>& solids, LengthUnit unit, StepSchema schema);

}  // namespace nurbeam
