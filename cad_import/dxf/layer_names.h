#pragma once
#include <string>
#include <vector>

#include "cad_import/report/named_curve.h"

namespace nurbeam {

/// The layer of each curve: that of its name, "0" without one. What a layer's name must not hold becomes "_",
/// and it ends after 255 letters; where curves of different names would share a layer, for which the case of
/// letters does not count, " 2", " 3", ... tells them apart.
std::vector<std::string> layer_names(const std::vector<NamedCurve>& curves);

}  // namespace nurbeam
