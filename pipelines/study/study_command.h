#pragma once
#include <filesystem>
#include <iosfwd>
#include <string>

namespace nurbeam {

/// How a study is asked for.
struct StudyOptions {
  std::filesystem::path file;
  std::filesystem::path out;  ///< the directory of its results
  int jobs = 1;               ///< variants that run at a time, without MPI
  bool resume = false, quiet = false;
  std::filesystem::path program;  ///< that runs variants: "PROGRAM worker FILE"
};

/// Reads a study, runs the missing variants and writes its results; under mpirun at every rank. Returns the
/// exit code of the program: 0 done, 2 the study cannot be used, 3 there is no answer, 4 results could not be
/// written, 130 interrupted.
int study_command(const StudyOptions& options, std::ostream& out, std::ostream& err);

/// Says what a study would run, and how long one variant takes: the nominal one is run. Exit code as above.
int study_check_command(const StudyOptions& options, std::ostream& out, std::ostream& err);

/// The work of a process that runs variants.
int study_worker_command(const std::filesystem::path& file, std::ostream& err);

}  // namespace nurbeam
