#include "cad_import/files/child_process.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

namespace nurbeam {
namespace {

using Clock = std::chrono::steady_clock;
using Status = ChildResult::Status;

// What the child sends: a status byte, the size of the text, the text.
constexpr char message_done = 'D';
constexpr char message_failed = 'F';
constexpr char message_out_of_memory = 'M';
constexpr std::size_t header_size = 1 + sizeof(std::uint64_t);

void limit(decltype(RLIMIT_CPU) resource, rlim_t soft, rlim_t hard) {
  const rlimit value{soft, hard};
  setrlimit(resource, &value);
}

void apply(const ChildLimits& limits) {
  const auto seconds = static_cast<rlim_t>(std::max<std::chrono::seconds::rep>(limits.time.count(), 1));
  limit(RLIMIT_CPU, seconds, seconds + 1);
  limit(RLIMIT_CORE, 0, 0);
  if (limits.memory_bytes > 0 && can_limit_memory())
    limit(RLIMIT_AS, limits.memory_bytes, limits.memory_bytes);
}

void silence_standard_streams() {
  const int null = open("/dev/null", O_RDWR);
  for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
}

void close_all_but_standard_streams_and(int descriptor) {
  close_range(STDERR_FILENO + 1, static_cast<unsigned>(descriptor) - 1, 0);
  close_range(static_cast<unsigned>(descriptor) + 1, ~0U, 0);
}

void restore_default_signals() {
  for (int number : {SIGINT, SIGTERM, SIGHUP, SIGPIPE, SIGSEGV, SIGFPE, SIGBUS, SIGILL, SIGABRT}) {
    signal(number, SIG_DFL);
  }
}

void send(int descriptor, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t sent = write(descriptor, data, size);
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0) return;
    data += sent;
    size -= static_cast<std::size_t>(sent);
  }
}

void send_message(int descriptor, char status, const char* text, std::uint64_t size) {
  char header[header_size] = {status};
  std::memcpy(header + 1, &size, sizeof size);
  send(descriptor, header, sizeof header);
  send(descriptor, text, size);
}

// Leaves by _exit: neither the destructors nor the buffers of the parent are run twice.
[[noreturn]] void be_the_child(const std::function<std::string()>& work, const ChildLimits& limits,
                               int descriptor) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  restore_default_signals();
  silence_standard_streams();
  close_all_but_standard_streams_and(descriptor);
  apply(limits);
  try {
    const std::string output = work();
    send_message(descriptor, message_done, output.data(), output.size());
  } catch (const std::bad_alloc&) {
    send_message(descriptor, message_out_of_memory, "", 0);
  } catch (const std::exception& e) {
    send_message(descriptor, message_failed, e.what(), std::strlen(e.what()));
  } catch (...) {
    send_message(descriptor, message_failed, "unknown exception", 17);
  }
  _exit(0);
}

int milliseconds_until(Clock::time_point deadline) {
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
  return static_cast<int>(std::clamp<std::chrono::milliseconds::rep>(left, 0, 1'000'000));
}

// Everything up to the end of the stream; false when the deadline passes first.
bool receive_until(Clock::time_point deadline, int descriptor, std::string& bytes) {
  char buffer[1 << 16];
  while (Clock::now() < deadline) {
    pollfd ready{descriptor, POLLIN, 0};
    if (poll(&ready, 1, milliseconds_until(deadline)) <= 0) continue;
    const ssize_t count = read(descriptor, buffer, sizeof buffer);
    if (count == 0) return true;
    if (count < 0 && errno != EINTR) return true;
    if (count > 0) bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return false;
}

bool is_complete(const std::string& bytes) {
  if (bytes.size() < header_size) return false;
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data() + 1, sizeof size);
  return bytes.size() - header_size == size;
}

// The status word of the ended child. A child that has closed its end without leaving is killed.
int reap(pid_t child) {
  kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

// A child that has closed its end of the pipe is about to end: its own status is wanted, if it comes in time.
int wait_for_end(pid_t child, Clock::time_point deadline) {
  int status = 0;
  while (Clock::now() < deadline) {
    const pid_t ended = waitpid(child, &status, WNOHANG);
    if (ended == child) return status;
    if (ended < 0 && errno != EINTR) return 0;
    poll(nullptr, 0, 1);
  }
  return reap(child);
}

ChildResult result_of(const std::string& bytes) {
  const std::string text = bytes.substr(header_size);
  if (bytes[0] == message_done) return {Status::finished, text, ""};
  if (bytes[0] == message_out_of_memory) return {Status::out_of_memory, "", ""};
  return {Status::failed, "", text};
}

ChildResult result_of(int wait_status) {
  if (!WIFSIGNALED(wait_status)) return {Status::failed, "", "it ended without a report"};
  const int number = WTERMSIG(wait_status);
  if (number == SIGXCPU) return {Status::timed_out, "", ""};
  return {Status::crashed, "", strsignal(number)};
}

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

ChildResult run_in_child(const std::function<std::string()>& work, const ChildLimits& limits) {
  const Clock::time_point deadline = Clock::now() + limits.time;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) return {Status::not_started, "", std::strerror(errno)};
  const pid_t child = fork();
  if (child == 0) be_the_child(work, limits, ends[1]);
  const int fork_error = errno;
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    return {Status::not_started, "", std::strerror(fork_error)};
  }
  std::string bytes;
  const bool in_time = receive_until(deadline, ends[0], bytes);
  close(ends[0]);
  const int wait_status = in_time ? wait_for_end(child, deadline) : reap(child);
  if (is_complete(bytes)) return result_of(bytes);
  return in_time ? result_of(wait_status) : ChildResult{Status::timed_out, "", ""};
}

}  // namespace nurbeam
