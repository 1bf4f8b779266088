#pragma once
#include <string>
#include <vector>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The STEP file with the layers and colours of its curves, whose instances have these numbers, in the order
/// of the curves (ISO 10303-46: PRESENTATION_LAYER_ASSIGNMENT, STYLED_ITEM).
std::string with_looks(std::string text, const std::vector<int>& instances,
                       const std::vector<NamedCurve>& curves);

}  // namespace nurbeam
