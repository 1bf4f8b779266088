#include "pipelines/command/study.h"

#include <algorithm>
#include <ostream>
#include <thread>

#include "pipelines/command/companion.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

std::string jobs_of(const Arguments& arguments) {
  const int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  return std::to_string(whole_number(arguments, "--jobs", cores, 1, 1024));
}

}  // namespace

int study_schema_command() { become_program(study_program(), {"schema"}); }

int study_command_line(const Arguments& arguments, Streams streams) {
  const bool check = arguments.positional.size() == 2;
  if (check && arguments.positional[0] != "check")
    throw UsageError("takes one study; before it " + in_quotes("check") + " may stand, not " +
                     in_quotes(arguments.positional[0]));
  const std::filesystem::path file = arguments.positional.back();
  const std::string out = arguments.value("--out", file.stem().string() + "_study");
  if (out.empty()) throw UsageError("--out: the name of the directory is empty");
  streams.out.flush();
  become_program(study_program(),
                 {check ? "check" : "run", file.string(), out, jobs_of(arguments),
                  arguments.has("--resume") ? "resume" : "new", arguments.has("--quiet") ? "quiet" : "loud"});
}

}  // namespace nurbeam
