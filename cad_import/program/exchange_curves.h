#pragma once
#include "cad_import/report/request.h"

namespace nurbeam {

/// The text of a STEP file with its curves in their deformed shape, as export_into_step() says. Throws
/// std::runtime_error. For the program nurbeam-cad only: a bad file may crash it.
Exchanged exchange_curves(const std::filesystem::path& source, const std::vector<DeformedCurve>& curves);

}  // namespace nurbeam
