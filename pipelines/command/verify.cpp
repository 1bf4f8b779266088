#include "pipelines/command/verify.h"

#include <ostream>

#include "pipelines/command/companion.h"

namespace nurbeam {

namespace {

const CompanionProgram verify_program{"nurbeam-verify", "computes problems with known answers",
                                      "NURBEAM_VERIFY", "pipelines"};
const CompanionProgram bench_program{"nurbeam-bench", "times nurbeam", "NURBEAM_BENCH", "pipelines"};

/// The words after which a command line has been read.
std::vector<std::string> words_of(const Command& command, const Arguments& arguments) {
  std::vector<std::string> words{command.name};
  for (const auto& [option, values] : arguments.options) {
    if (values.empty()) words.push_back(option);
    for (const std::string& value : values) words.insert(words.end(), {option, value});
  }
  words.insert(words.end(), arguments.positional.begin(), arguments.positional.end());
  return words;
}

}  // namespace

Command verify_entry(int (*run)(const Arguments&, Streams)) {
  return {"verify",
          "[NAME | papers]",
          "computes problems with known answers (those with NAME in their name) and prints a table; with "
          "papers: the examples of the papers beside their tables, as a page with figures",
          0,
          1,
          {{"--out", "DIR", "for the page of the papers"},
           {"--for", "CASE.json",
            "the problems that have most in common with that case, for each of its features"},
           {"--write", "FILE",
            "writes which features each problem covers, with its errors: the table that "
            "nurbeam carries (pipelines/results/verified.tsv)"},
           {"--accuracy", "",
            "computes them with half and a quarter of the elements and steps too, and tells how many true "
            "errors are below what a run estimates"}},
          run,
          exit_not_written};
}

Command bench_entry(int (*run)(const Arguments&, Streams)) {
  return {
      "bench",
      "",
      "times nurbeam on this machine: single elements, systems of 10, 100, ... elements, and whole runs with "
      "their errors",
      0,
      0,
      {{"--largest", "N", "the most elements of a system; otherwise 10000"},
       {"--cad", "FILE", "times the reading of that file too"},
       {"--plot", "FILE", "draws the cost by number of elements, as SVG"}},
      run,
      exit_not_written};
}

int become_verify(const Arguments& arguments, Streams streams) {
  streams.out.flush();
  become_program(verify_program.find(), words_of(verify_entry(become_verify), arguments));
}

int become_bench(const Arguments& arguments, Streams streams) {
  streams.out.flush();
  become_program(bench_program.find(), words_of(bench_entry(become_bench), arguments));
}

}  // namespace nurbeam
