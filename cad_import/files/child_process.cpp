#include "cad_import/files/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "cad_import/files/child_message.h"
#include "cad_import/files/told_share.h"

namespace nurbeam {
namespace {

using Clock = std::chrono::steady_clock;
using Status = ChildResult::Status;

/// A descriptor that is closed with it.
class Descriptor {
 public:
  explicit Descriptor(int value) : value_(value) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { reset(); }
  int get() const { return value_; }
  void reset() {
    if (value_ >= 0) close(value_);
    value_ = -1;
  }

 private:
  int value_;
};

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(left, 0, 1'000'000));
}

// What a process and those that it has started hold at this moment [bytes]; 0 where that is not known.
std::size_t resident_memory(pid_t process) {
  const std::string place = "/proc/" + std::to_string(process);
  std::ifstream statm(place + "/statm"), children(place + "/task/" + std::to_string(process) + "/children");
  std::size_t size = 0, resident = 0;
  statm >> size >> resident;
  std::size_t all = resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  for (pid_t child = 0; children >> child;) all += resident_memory(child);
  return all;
}

/// A child process at work: where its answer comes from, and where its request stands.
struct Working {
  pid_t child;
  int answer, request;
  std::size_t request_size;
};

// Everything up to the end of the stream; false when the deadline passes first or an interruption comes.
bool receive_until(Clock::time_point deadline, const ChildLimits& limits, const Working& working,
                   std::string& bytes) {
  constexpr int asked_every = 100;  // [ms]
  const Clock::time_point start = Clock::now();
  Clock::time_point told = start;
  const auto tell = [&] {
    if (!limits.watch || Clock::now() < told + std::chrono::milliseconds(asked_every)) return;
    told = Clock::now();
    limits.watch({std::chrono::duration<double>(told - start).count(), resident_memory(working.child),
                  told_share(working.request, working.request_size)});
  };
  char buffer[1 << 16];
  while (Clock::now() < deadline && !(limits.interrupted && limits.interrupted())) {
    tell();
    pollfd ready{working.answer, POLLIN, 0};
    const int longest = limits.interrupted || limits.watch ? asked_every : milliseconds_until(deadline);
    if (poll(&ready, 1, std::min(longest, milliseconds_until(deadline))) <= 0) continue;
    const ssize_t count = read(working.answer, buffer, sizeof buffer);
    if (count == 0) return true;
    if (count < 0 && errno != EINTR) return true;
    if (count > 0) bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return false;
}

bool is_complete(const std::string& bytes) {
  if (bytes.size() < child_message::header_size) return false;
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + 1, sizeof size);
  return bytes.size() - child_message::header_size == size;
}

/// How a child has ended.
struct ChildEnd {
  int status = 0;  // as waitpid gives it
  std::size_t peak_memory = 0;
};

std::size_t peak_memory(const rusage& usage) { return static_cast<std::size_t>(usage.ru_maxrss) << 10; }

// A child that has closed its end without leaving is killed.
ChildEnd reap(pid_t child) {
  kill(child, SIGKILL);
  int status = 0;
  rusage usage{};
  while (wait4(child, &status, 0, &usage) < 0 && errno == EINTR) {
  }
  return {status, peak_memory(usage)};
}

// A child that has closed its end of the pipe is about to end: its own status is wanted, if it comes in time.
ChildEnd wait_for_end(pid_t child, Clock::time_point deadline) {
  int status = 0;
  rusage usage{};
  while (Clock::now() < deadline) {
    const pid_t ended = wait4(child, &status, WNOHANG, &usage);
    if (ended == child) return {status, peak_memory(usage)};
    if (ended < 0 && errno != EINTR) return {};
    poll(nullptr, 0, 1);
  }
  return reap(child);
}

ChildResult result_of(const std::string& bytes) {
  const std::string text = bytes.substr(child_message::header_size);
  if (bytes[0] == child_message::done) return {Status::finished, text, ""};
  if (bytes[0] == child_message::out_of_memory) return {Status::out_of_memory, "", ""};
  return {Status::failed, "", text};
}

ChildResult result_of(int wait_status, const std::filesystem::path& program) {
  if (!WIFSIGNALED(wait_status))
    return {Status::not_started, "",
            program.string() + " ended without an answer; it must be the program of this version of nurbeam"};
  const int number = WTERMSIG(wait_status);
  if (number == SIGXCPU) return {Status::timed_out, "", ""};
  return {Status::crashed, "", strsignal(number)};
}

// The request in memory, to be read from its start; -1 where that fails.
int descriptor_with(const std::string& request) {
  const int descriptor = memfd_create("request", MFD_CLOEXEC);
  if (descriptor < 0) return -1;
  for (std::size_t written = 0; written < request.size();) {
    const ssize_t count = write(descriptor, request.data() + written, request.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      close(descriptor);
      return -1;
    }
    written += static_cast<std::size_t>(count);
  }
  lseek(descriptor, 0, SEEK_SET);
  return descriptor;
}

// Default actions for the signals that this process may handle, and none blocked.
class SpawnAttributes {
 public:
  SpawnAttributes() {
    posix_spawnattr_init(&value_);
    sigset_t handled, none;
    sigemptyset(&handled);
    for (int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGABRT})
      sigaddset(&handled, number);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(&value_, &handled);
    posix_spawnattr_setsigmask(&value_, &none);
    posix_spawnattr_setflags(&value_, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK);
  }
  SpawnAttributes(const SpawnAttributes&) = delete;
  SpawnAttributes& operator=(const SpawnAttributes&) = delete;
  ~SpawnAttributes() { posix_spawnattr_destroy(&value_); }
  const posix_spawnattr_t* get() const { return &value_; }

 private:
  posix_spawnattr_t value_;
};

// The request on the standard input, the answer on its descriptor, and nothing else.
class SpawnActions {
 public:
  SpawnActions(int request, int answer) {
    posix_spawn_file_actions_init(&value_);
    // Neither may be overwritten before it is copied.
    const int spare = std::max({request, answer, child_message::descriptor}) + 1;
    posix_spawn_file_actions_adddup2(&value_, request, spare);
    posix_spawn_file_actions_adddup2(&value_, answer, spare + 1);
    posix_spawn_file_actions_adddup2(&value_, spare, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&value_, spare + 1, child_message::descriptor);
    for (int stream : {STDOUT_FILENO, STDERR_FILENO})
      posix_spawn_file_actions_addopen(&value_, stream, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addclosefrom_np(&value_, child_message::descriptor + 1);
  }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  ~SpawnActions() { posix_spawn_file_actions_destroy(&value_); }
  const posix_spawn_file_actions_t* get() const { return &value_; }

 private:
  posix_spawn_file_actions_t value_;
};

}  // namespace

bool can_limit_memory() {
#if defined(__SANITIZE_ADDRESS__)
  return false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
  return false;
#else
  return true;
#endif
#else
  return true;
#endif
}

ChildResult run_program(const std::filesystem::path& program, const std::string& request,
                        const ChildLimits& limits) {
  const Clock::time_point deadline = Clock::now() + limits.time;
  Descriptor asked(descriptor_with(request));
  int ends[2];
  if (asked.get() < 0 || pipe2(ends, O_CLOEXEC) != 0) return {Status::not_started, "", std::strerror(errno)};
  Descriptor answer(ends[0]), childs_end(ends[1]);
  std::string arguments[] = {program.string(), std::to_string(getpid()), std::to_string(limits.time.count()),
                             std::to_string(limits.memory_bytes)};
  char* argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), arguments[3].data(),
                  nullptr};
  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), SpawnActions(asked.get(), childs_end.get()).get(),
                                SpawnAttributes().get(), argv, environ);
  childs_end.reset();
  if (error != 0) return {Status::not_started, "", program.string() + ": " + std::strerror(error)};
  std::string bytes;
  const bool in_time =
      receive_until(deadline, limits, {child, answer.get(), asked.get(), request.size()}, bytes);
  answer.reset();
  const ChildEnd end = in_time ? wait_for_end(child, deadline) : reap(child);
  ChildResult result{Clock::now() < deadline ? Status::interrupted : Status::timed_out, "", ""};
  if (is_complete(bytes))
    result = result_of(bytes);
  else if (in_time)
    result = result_of(end.status, program);
  result.peak_memory = end.peak_memory;
  return result;
}

}  // namespace nurbeam
