#pragma once
#include <iosfwd>

#include "pipelines/case/case_file.h"

namespace nurbeam {

/// Resolves everything a case names (files, curves, joints) and prints the model it would run; runs nothing.
/// Diagnostics go to `err`. Returns the exit code: done, or bad input.
int check_case(const CaseFile& case_file, std::ostream& out, std::ostream& err);

}  // namespace nurbeam
