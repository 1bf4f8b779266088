#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <stdexcept>

#include "cad_import/files/child_work.h"
#include "cad_import/files/told_share.h"

// Does what the request says, for the tests of run_program().
namespace {

std::string open_descriptors() {
  return std::to_string(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

std::string work(const std::string& request) {
  const std::string word = request.substr(0, request.find(' '));
  const auto number = [&] { return std::stoul(request.substr(word.size() + 1)); };
  if (word == "large") return std::string(number(), 'x');
  if (word == "throw") throw std::runtime_error("no ink");
  if (word == "raise") raise(static_cast<int>(number()));
  if (word == "exit") _exit(0);
  if (word == "sleep") sleep(100);
  if (word == "half") {
    nurbeam::tell_share(0.5);
    sleep(1);
  }
  if (word == "descriptors") return open_descriptors();
  if (word == "print") {
    std::printf("noise");
    std::fflush(stdout);
  }
  if (word == "loop")
    for (std::atomic<int> turns = 0;;) ++turns;
  return request;
}

}  // namespace

int main(int argc, char** argv) { return nurbeam::serve_one_request(argc, argv, work); }
