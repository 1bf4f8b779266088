#pragma once
#include "pipelines/case/case_values.h"

namespace nurbeam {

/// A beam of a case; files are relative to `directory`.
CaseBeam read_beam(const Json& json, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings);

}  // namespace nurbeam
