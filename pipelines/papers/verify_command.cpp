#include "pipelines/papers/verify_command.h"

#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/papers/papers.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

int verify_command(const Arguments& arguments, Streams streams) {
  const std::string part = arguments.positional.empty() ? "" : arguments.positional[0];
  if (part == "papers") {
    write_papers(arguments.value("--out", "papers"), streams.err);
    return exit_done;
  }
  std::vector<VerifyProblem> problems = verification_problems();
  const std::vector<std::string> names = names_of(problems);
  std::erase_if(problems,
                [&](const VerifyProblem& problem) { return problem.name.find(part) == std::string::npos; });
  if (problems.empty())
    throw UsageError("no problem has " + in_quotes(part) + " in its name" + known_names(part, names));
  return verify(problems, streams.out, streams.err);
}

}  // namespace nurbeam
