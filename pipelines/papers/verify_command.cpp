#include "pipelines/papers/verify_command.h"

#include <optional>
#include <set>
#include <stdexcept>

#include "cad_import/files/atomic_file.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/papers/papers.h"
#include "pipelines/run/run_evidence.h"
#include "pipelines/verification/accuracy_campaign.h"
#include "pipelines/verification/verify.h"

namespace nurbeam {

namespace {

// The names of the problems that are evidence for a case; nothing where it has errors, which are printed.
std::optional<std::set<std::string>> problems_for(const std::string& file, std::ostream& err) {
  const CaseFileReport read = read_case_file(file);
  print_diagnostics(err, read.diagnostics);
  if (!read.value) return {};
  const BuildReport built = build_model(*read.value);
  print_diagnostics(err, built.diagnostics);
  if (!built.value) return {};
  std::set<std::string> names;
  for (const FeatureEvidence& evidence : run_evidence(*read.value, *built.value))
    for (const VerifiedProblem& problem : evidence.problems) names.insert(problem.name);
  return names;
}

int verify(const std::vector<VerifyProblem>& problems, const Arguments& arguments, Streams streams) {
  const std::vector<VerifyResult> results = run_all(problems, streams.err);
  if (arguments.has("--write")) {
    const std::string file = arguments.value("--write", "");
    for (const Diagnostic& problem : write_at_once(file, text_of(verified(problems, results))))
      throw std::runtime_error(problem.where + ": " + problem.message);
  }
  return print_results(problems, results, streams.out);
}

}  // namespace

int verify_command(const Arguments& arguments, Streams streams) {
  const std::string part = arguments.positional.empty() ? "" : arguments.positional[0];
  if (part == "papers") {
    write_papers(arguments.value("--out", "papers"), streams.err);
    return exit_done;
  }
  std::vector<VerifyProblem> problems = verification_problems();
  const std::vector<std::string> names = names_of(problems);
  if (arguments.has("--write") && arguments.has("--accuracy"))
    throw UsageError("--write and --accuracy exclude each other");
  if (arguments.has("--write") && (!part.empty() || arguments.has("--for")))
    throw UsageError("--write tells of all problems: leave out the name and --for");
  if (arguments.has("--for")) {
    const auto asked = problems_for(arguments.value("--for", ""), streams.err);
    if (!asked) return exit_bad_input;
    std::erase_if(problems, [&](const VerifyProblem& problem) { return !asked->contains(problem.name); });
  }
  std::erase_if(problems,
                [&](const VerifyProblem& problem) { return problem.name.find(part) == std::string::npos; });
  if (problems.empty())
    throw UsageError("no problem has " + in_quotes(part) + " in its name" + known_names(part, names));
  if (arguments.has("--accuracy")) return print_accuracy(problems, streams.err, streams.out);
  return verify(problems, arguments, streams);
}

}  // namespace nurbeam
