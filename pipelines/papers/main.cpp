#include <iostream>

#include "pipelines/command/command_line.h"
#include "pipelines/papers/verify_command.h"
#include "pipelines/run/kept_memory.h"

/// The program nurbeam-verify, which `nurbeam verify` becomes.
int main(int count, char** words) {
  nurbeam::keep_memory();
  return nurbeam::run_command_line({nurbeam::verify_entry(nurbeam::verify_command)},
                                   {words + 1, words + count}, std::cout, std::cerr);
}
