#pragma once
#include "pipelines/case/case_values.h"

namespace nurbeam {

/// Reads "output", which has been checked against its shape, of a case with that analysis; files are relative
/// to `directory`.
CaseOutput read_output(const Json& json, const CaseAnalysis& analysis, const std::filesystem::path& directory,
                       Findings& findings);

}  // namespace nurbeam
