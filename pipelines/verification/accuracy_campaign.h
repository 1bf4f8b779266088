#pragma once
#include <iosfwd>

#include "pipelines/verification/verify.h"

namespace nurbeam {

/// Computes problems with fewer elements and longer steps too, at their own mesh, a half and a quarter of it,
/// estimates the error of each row that has a known answer by the rule of docs/accuracy.md, and prints how
/// many true errors are below their estimates. Rows whose error is below 3e-7 of their scale are counted
/// apart. Returns the exit code: 0, or 1 where fewer than 95 of 100 are inside, or the middle of estimate
/// over error is above 12.
int print_accuracy(const std::vector<VerifyProblem>& problems, std::ostream& progress, std::ostream& out);

}  // namespace nurbeam
