#pragma once
#include "fem/structure/turn.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// The angle over time that a rotation prescribes; reports a speed where nothing moves.
AngleMotion prescribed_angle(const CaseRotation& from, const CaseAnalysis& analysis, Findings& findings);

/// Whether a motion starts as drawn, so that what is prescribed begins there.
bool starts_as_drawn(const CaseAnalysis& analysis);

}  // namespace nurbeam
