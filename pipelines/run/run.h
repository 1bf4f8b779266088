#pragma once
#include <filesystem>

#include "pipelines/case/case_file.h"

namespace nurbeam {

struct RunOptions {
  std::filesystem::path out;  ///< results directory, made if it does not exist
  bool quiet = false;         ///< no progress; errors and warnings are still printed
  bool resume = false;        ///< goes on from the restart point in `out`
};

/// Runs a case and writes its results directory. Returns the exit code: 0 done, 2 bad input (a CAD file), 3
/// the solver did not converge, 4 results could not be written, 130 interrupted. Messages go to stderr.
int run_case(const CaseFile& case_file, const RunOptions& options);

}  // namespace nurbeam
