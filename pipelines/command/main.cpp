#include <csignal>
#include <cstdlib>
#include <iostream>

#include "pipelines/command/command_line.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/run/kept_memory.h"

int main(int count, char** words) {
  nurbeam::keep_memory();
  std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is found by the write's failure
  const int code = nurbeam::run_command_line({words + 1, words + count}, std::cout, std::cerr);
  if (code == nurbeam::exit_not_written) {
    // HDF5 would try once more at exit to write what it could not write, and crash.
    std::cout.flush();
    std::cerr.flush();
    std::_Exit(code);
  }
  return code;
}
