#pragma once

namespace nurbeam {

/// The program's exit codes.
enum ExitCode : int {
  exit_done = 0,
  exit_failed = 1,         ///< a comparison or verification failed
  exit_bad_input = 2,      ///< arguments, case file, CAD file
  exit_not_converged = 3,  ///< the solver
  exit_not_written = 4,    ///< results
  exit_interrupted = 130
};

}  // namespace nurbeam
