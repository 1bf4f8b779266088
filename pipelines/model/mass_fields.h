#pragma once
#include <optional>

#include "fem/structure/mass_field.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/model/model_frame.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

/// What acts on all mass besides even gravity, in the model's own axes; nothing where a case has no such
/// thing. Errors with what does not feel it.
std::optional<MassField> mass_field(const ResolvedCase& resolved, const ModelFrame& frame,
                                    Findings& findings);

}  // namespace nurbeam
