#pragma once
#include <optional>

#include "fem/material/axial_law.h"
#include "pipelines/case/fields.h"

namespace nurbeam {

/// Rows of stretch and force of a part that carries nothing where it is not stretched. Reports rows that are
/// no such law.
std::optional<ForceRows> force_rows(const Json& json, const std::string& path, Findings& findings);

/// The axial law of a beam: its name, or rows.
std::optional<AxialLaw> axial_law(const Json& json, const std::string& path, Findings& findings);

}  // namespace nurbeam
