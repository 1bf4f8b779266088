#pragma once
#include "pipelines/case/case_json.h"
#include "pipelines/case/parts/axis.h"

namespace nurbeam {

/// The axis of a beam, or another curve that is given like one; files are relative to `directory`.
CaseAxis read_beam_axis(const Json& axis, const std::string& path, const std::filesystem::path& directory,
                        Findings& findings);

/// Reports a CAD file that is not there.
void check_cad_file(const std::filesystem::path& file, const std::string& path, Findings& findings);

}  // namespace nurbeam
