#include <malloc.h>

#include <cstdlib>
#include <iostream>

#include "pipelines/command/command_line.h"
#include "pipelines/diagnostics/exit_code.h"

int main(int count, char** words) {
  // Vectors of large models are taken and given back in every step: what is given back is kept, or the kernel
  // would clear the same pages again and again.
  constexpr int most = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
  const int code = nurbeam::run_command_line({words + 1, words + count}, std::cout, std::cerr);
  if (code == nurbeam::exit_not_written) {
    // HDF5 would try once more at exit to write what it could not write, and crash.
    std::cout.flush();
    std::cerr.flush();
    std::_Exit(code);
  }
  return code;
}
