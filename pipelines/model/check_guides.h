#pragma once
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Reports what a case does to rigid guides that only beams which deform can have done to them.
void check_guides(const ResolvedCase& resolved, Findings& findings);

}  // namespace nurbeam
