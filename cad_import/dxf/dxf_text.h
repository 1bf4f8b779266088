#pragma once
#include <string>
#include <vector>

#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The text of a DXF drawing (AutoCAD 2007, AC1021, in UTF-8) with each curve as a SPLINE, a LINE where it is
/// one, on a layer of its name (layer_names()): entities of DXF have no names. Every double is written so
/// that it reads back as itself.
std::string dxf_text(const std::vector<NamedCurve>& curves, LengthUnit unit);

}  // namespace nurbeam
