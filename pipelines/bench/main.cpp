#include <iostream>

#include "pipelines/bench/bench_command.h"
#include "pipelines/command/command_line.h"
#include "pipelines/run/kept_memory.h"

/// The program nurbeam-bench, which `nurbeam bench` becomes.
int main(int count, char** words) {
  nurbeam::keep_memory();
  return nurbeam::run_command_line({nurbeam::bench_entry(nurbeam::bench_command)}, {words + 1, words + count},
                                   std::cout, std::cerr);
}
