#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "pipelines/study/variant.h"

namespace nurbeam {

/// A variant that is to run.
struct VariantTask {
  std::size_t number = 0;
  std::vector<double> values;  ///< of all variables
  int threads = 1;             ///< that it may use
};

/// What runs variants.
class StudyEngine {
 public:
  virtual ~StudyEngine() = default;
  /// Runs them all, in any order; `finished` is told each as it ends, in this thread. Ends early, with
  /// variants left out, once `interrupted`() is true.
  virtual void run(const std::vector<VariantTask>& tasks, const std::function<void(Variant)>& finished,
                   const std::function<bool()>& interrupted) = 0;
  /// How many variants run at a time.
  virtual int workers() const = 0;
};

/// The command line of a process that runs variants (serve_variants).
using WorkerCommand = std::vector<std::string>;

/// So many processes on this machine, each started where there is a variant for it, and running one after
/// another: one that crashes or does not end costs its variant alone. run() throws std::runtime_error where
/// no process can be started. `time_limit`: of a variant [s].
std::unique_ptr<StudyEngine> make_process_pool(const WorkerCommand& command, int workers,
                                               std::optional<double> time_limit);

/// The work of such a process: runs the tasks that come on standard input, and writes the variants to
/// standard output, until the input ends. Standard output must not be written to by anything else.
int serve_variants(const StudyFile& study, const StudyCase* study_case);

}  // namespace nurbeam
