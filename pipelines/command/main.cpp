#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

#include "pipelines/command/command_line.h"
#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/run/kept_memory.h"

namespace {

// Where memory runs short in what must not throw, or before main. What is not yet whole has no final name.
[[noreturn]] void end_for_want_of_memory() {
  try {
    if (const std::exception_ptr error = std::current_exception()) std::rethrow_exception(error);
  } catch (const std::bad_alloc&) {
    std::fputs("error: there is not enough memory; free some, or use fewer elements\n", stderr);
    std::_Exit(nurbeam::exit_not_written);
  } catch (...) {
  }
  std::abort();
}

// Before the statics of the program are made.
[[gnu::constructor(101)]] void expect_want_of_memory() { std::set_terminate(end_for_want_of_memory); }

}  // namespace

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
