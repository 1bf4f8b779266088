#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>

#include "fem/motion/record/snapshot.h"
#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"

namespace nurbeam {

struct RunOptions {
  std::filesystem::path out;  ///< results directory, made if it does not exist
  bool quiet = false;         ///< no progress; errors and warnings are still printed
  bool resume = false;        ///< goes on from the restart point in `out`
  int threads = 0;            ///< the most that share the work of a long beam; 0: one a core
  /// Asked after every step: true ends the run. Where empty, Ctrl-C and the like are taken for it.
  std::function<bool()> interrupted = nullptr;
  std::function<void(const StepRecord&)> progress = nullptr;  ///< told every step, instead of the lines
  std::ostream* messages = nullptr;                           ///< stderr where null
  bool json = false;  ///< messages and progress as one JSON object a line (run_messages.h)
};

/// Runs a case and writes its results directory. Returns the exit code: 0 done, 2 bad input (a CAD file), 3
/// the solver did not converge, 4 results could not be written, 130 interrupted. Messages go to stderr or
/// where the options say.
int run_case(const CaseFile& case_file, const RunOptions& options);

/// The same of the model of a case, without the messages of building it, which took `build_seconds`. What
/// functions in the model throw comes out once the frames until then are written; a std::runtime_error of
/// theirs would be taken for that of a file. Precondition: there is a model.
int run_model(const CaseFile& case_file, const BuildReport& report, const RunOptions& options,
              double build_seconds = 0);

}  // namespace nurbeam
