#pragma once
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

namespace nurbeam {

/// What many cases that are read in one child came to.
struct Outcomes {
  std::size_t done;
  std::array<std::uint64_t, 4> counts;
  std::uint64_t violations;
};
inline constexpr std::array<const char*, 4> outcomes{"imported", "diagnosed", "out_of_memory",
                                                     "of_these_fewer_unsaid"};

/// Memory that child processes share with this one; zeros at first.
class SharedOutcomes {
 public:
  SharedOutcomes()
      : page_(mmap(nullptr, sizeof(Outcomes), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (page_ == MAP_FAILED) throw std::bad_alloc();
  }
  ~SharedOutcomes() { munmap(page_, sizeof(Outcomes)); }
  SharedOutcomes(const SharedOutcomes&) = delete;
  SharedOutcomes& operator=(const SharedOutcomes&) = delete;
  Outcomes* operator->() const { return static_cast<Outcomes*>(page_); }
  Outcomes& operator*() const { return *operator->(); }

 private:
  void* page_;
};

/// How a child process ended that does this work.
template <class Work>
std::string end_of_child(const Work& work) {
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::strerror(errno));
  if (child == 0) {
    work();
    _exit(0);
  }
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status)) return WTERMSIG(status) == SIGXCPU ? "timed_out" : "crashed_and_contained";
  return "left_early";
}

}  // namespace nurbeam
