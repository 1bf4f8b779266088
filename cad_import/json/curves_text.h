#pragma once
#include <string>
#include <vector>

#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The curves as JSON (docs/cad.md, "JSON of curves"), every number so that it reads back as itself.
std::string json_text(const std::vector<NamedCurve>& curves, LengthUnit unit);

}  // namespace nurbeam
