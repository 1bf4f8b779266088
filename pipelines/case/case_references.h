#pragma once
#include "pipelines/case/case_values.h"

namespace nurbeam {

/// What must fit across a case file: names that differ, references that exist, bodies, times, CAD output.
void check_across(const Json& json, const CaseFile& case_file, Findings& findings);

}  // namespace nurbeam
