#pragma once
#include <string>
#include <vector>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The layer of each curve: its own, else that of its name, "0" without either. What a layer's name must not
/// hold becomes "_", and it ends after 255 letters; where different ones would be one layer, for which the
/// case of letters does not count, " 2", " 3", ... tells them apart.
std::vector<std::string> layer_names(const std::vector<NamedCurve>& curves);

}  // namespace nurbeam
