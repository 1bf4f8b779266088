#pragma once
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// Gives beams that do not say it torsion where a support, a joint, a load or a sliding body needs their
/// sections; an error where the beam has said that it has none.
void give_asked_torsion(ResolvedCase& resolved, Findings& findings);

}  // namespace nurbeam
