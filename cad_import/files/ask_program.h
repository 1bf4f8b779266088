#pragma once
#include "cad_import/files/child_process.h"
#include "cad_import/report/request.h"

namespace nurbeam {

/// The answer of the program nurbeam-cad to a request; `not_started` also where there is no such program.
ChildResult asked(const CadRequest& request, const ChildLimits& limits);

}  // namespace nurbeam
