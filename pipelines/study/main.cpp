#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "pipelines/diagnostics/exit_code.h"
#include "pipelines/run/kept_memory.h"
#include "pipelines/study/study_command.h"
#include "pipelines/study/study_file.h"

/// What `nurbeam study` starts, with its arguments resolved:
///   nurbeam-study run|check STUDY.json OUT JOBS new|resume quiet|loud
///   nurbeam-study worker STUDY.json
///   nurbeam-study schema
int main(int count, char** words) {
  nurbeam::keep_memory();
  const std::vector<std::string> arguments(words + 1, words + count);
  if (arguments.size() == 1 && arguments[0] == "schema") {
    std::cout << nurbeam::study_file_schema();
    return nurbeam::exit_done;
  }
  if (arguments.size() == 2 && arguments[0] == "worker")
    return nurbeam::study_worker_command(arguments[1], std::cerr);
  if (arguments.size() != 6) {
    std::cerr << "nurbeam-study is a part of nurbeam: use nurbeam study\n";
    return nurbeam::exit_bad_input;
  }
  const nurbeam::StudyOptions options{.file = arguments[1],
                                      .out = arguments[2],
                                      .jobs = std::atoi(arguments[3].c_str()),
                                      .resume = arguments[4] == "resume",
                                      .quiet = arguments[5] == "quiet",
                                      .program = std::filesystem::read_symlink("/proc/self/exe")};
  int code = nurbeam::exit_not_written;
  try {
    code = arguments[0] == "check" ? nurbeam::study_check_command(options, std::cout, std::cerr)
                                   : nurbeam::study_command(options, std::cout, std::cerr);
  } catch (const std::exception& problem) {
    std::cerr << "error: " << problem.what() << "\n";
  }
  // HDF5 crashes at the end of a process whose files it could not close, as on a full disk.
  if (code == nurbeam::exit_not_written) {
    std::cout.flush();
    std::_Exit(code);
  }
  return code;
}
