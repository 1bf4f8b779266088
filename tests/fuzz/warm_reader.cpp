#include "tests/fuzz/warm_reader.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>

#include "cad_import/program/read_file.h"
#include "cad_import/report/report_bytes.h"

namespace nurbeam {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void read_in_child(const std::string& file, int answer, std::chrono::seconds time,
                                std::size_t memory_bytes) {
  const auto seconds = static_cast<rlim_t>(time.count());
  const rlimit cpu{seconds, seconds + 1}, memory{memory_bytes, memory_bytes}, none{0, 0};
  setrlimit(RLIMIT_CPU, &cpu);
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &none);
  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
  std::string bytes;
  try {
    bytes = to_bytes(read_file(file, 1e-7));
  } catch (const std::bad_alloc&) {
    bytes = "memory";
  }
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = write(answer, bytes.data() + sent, bytes.size() - sent);
    if (count <= 0) break;
    sent += static_cast<std::size_t>(count);
  }
  _exit(0);
}

ImportReport refusal(const std::string& file, const std::string& message) {
  ImportReport report;
  report.file = file;
  report.diagnostics.push_back({Severity::error, file, message});
  return report;
}

// Everything up to the end of the stream; false when the deadline passes first.
bool receive_until(Clock::time_point deadline, int descriptor, std::string& bytes) {
  char buffer[1 << 16];
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{descriptor, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(left)) <= 0) continue;
    const ssize_t count = read(descriptor, buffer, sizeof buffer);
    if (count <= 0) return true;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
}

ImportReport report_of(const std::string& bytes, int status, const std::string& file) {
  if (bytes == "memory") return refusal(file, "more than the memory limit of the test");
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU)
    return refusal(file, "longer than the time limit of the test");
  if (WIFSIGNALED(status))
    return refusal(file, std::string("the reader crashed on it: ") + strsignal(WTERMSIG(status)));
  try {
    return report_from_bytes(bytes);
  } catch (const std::exception&) {
    return refusal(file, "the reader was damaged by it");
  }
}

}  // namespace

ImportReport warm_report(const std::string& file, std::chrono::seconds time, std::size_t memory_bytes) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::strerror(errno));
  if (child == 0) read_in_child(file, ends[1], time, memory_bytes);
  close(ends[1]);
  std::string bytes;
  const bool in_time = receive_until(Clock::now() + time, ends[0], bytes);
  close(ends[0]);
  if (!in_time) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return in_time ? report_of(bytes, status, file) : refusal(file, "longer than the time limit of the test");
}

}  // namespace nurbeam
