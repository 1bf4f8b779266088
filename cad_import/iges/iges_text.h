#pragma once
#include <string>
#include <vector>

#include "cad_import/report/length_unit.h"
#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The text of an IGES 5.3 file with the curves as entities 126, the name in a Name property (406 form 15)
/// and its first eight characters in the label, on the level that the layer names, in their colours. Else as
/// step_text.
std::string iges_text(const std::vector<NamedCurve>& curves, LengthUnit unit);

}  // namespace nurbeam
