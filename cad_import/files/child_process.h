#pragma once
#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>

namespace nurbeam {

/// How far a child process is.
struct ChildState {
  double seconds;      ///< that it has worked
  std::size_t memory;  ///< that it holds [bytes]
  double share = 0;    ///< of its work that is done, as it tells; 0: it has told none yet
};

/// What a child process may use.
struct ChildLimits {
  std::chrono::seconds time{30};  ///< wall and CPU time
  std::size_t memory_bytes = 0;   ///< address space; 0: no limit
  /// Asked ten times a second whether nobody waits for the answer any more.
  std::function<bool()> interrupted = {};
  std::function<void(const ChildState&)> watch = {};  ///< told ten times a second
};

/// How a child process ended, and what it sent.
struct ChildResult {
  /// crashed: by a signal; not_started: there is no such program, or another one, which ends without an
  /// answer.
  enum class Status { finished, failed, out_of_memory, timed_out, interrupted, crashed, not_started };

  Status status;
  std::string output;     ///< its answer when finished
  std::string complaint;  ///< the exception text when failed, the signal's name when crashed, the reason when
                          ///< not started
  std::size_t peak_memory = 0;  ///< that it has held [bytes]
};

/// Whether this build can limit the address space (a build with the address sanitizer cannot).
bool can_limit_memory();

/// The answer of a program that serves one request (child_work.h), run under the limits by posix_spawn: to be
/// called from any thread.
///
/// The child is silent (standard streams are /dev/null), owns no other descriptor of this process and dies
/// with it. No zombie and no descriptor is left behind, however the child ends. Never throws for what happens
/// in the child.
ChildResult run_program(const std::filesystem::path& program, const std::string& request,
                        const ChildLimits& limits);

}  // namespace nurbeam
