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

bool send(int descriptor, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = write(descriptor, bytes.data() + sent, bytes.size() - sent);
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

// Each report goes after the number of its bytes.
[[noreturn]] void read_in_child(const std::vector<std::string>& files, int answer, std::chrono::seconds time,
                                std::size_t memory_bytes) {
  const rlimit memory{memory_bytes, memory_bytes}, none{0, 0};
  setrlimit(RLIMIT_AS, &memory);
  setrlimit(RLIMIT_CORE, &none);
  const int null = open("/dev/null", O_WRONLY | O_CLOEXEC);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO}) dup2(null, stream);
  for (const std::string& file : files) {
    limit_processor_time(time);
    std::string bytes;
    try {
      bytes = to_bytes(read_file(file, 1e-7));
    } catch (const std::bad_alloc&) {
      bytes = "memory";
    }
    const std::size_t size = bytes.size();
    if (!send(answer, std::string(reinterpret_cast<const char*>(&size), sizeof size) + bytes)) break;
  }
  _exit(0);
}

ImportReport refusal(const std::string& file, const std::string& message) {
  ImportReport report;
  report.file = file;
  report.diagnostics.push_back({Severity::error, file, message});
  return report;
}

enum class Received { all, ended, too_late };

// That many bytes.
Received receive(Clock::time_point deadline, int descriptor, char* bytes, std::size_t size) {
  while (size > 0) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0) return Received::too_late;
    pollfd ready{descriptor, POLLIN, 0};
    if (poll(&ready, 1, static_cast<int>(left)) <= 0) continue;
    const ssize_t count = read(descriptor, bytes, size);
    if (count <= 0) return Received::ended;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return Received::all;
}

Received receive_report(Clock::time_point deadline, int descriptor, std::string& bytes) {
  constexpr std::size_t longest = std::size_t{1} << 30;
  std::size_t size = 0;
  const Received received = receive(deadline, descriptor, reinterpret_cast<char*>(&size), sizeof size);
  if (received != Received::all) return received;
  if (size > longest) return Received::ended;
  bytes.resize(size);
  return receive(deadline, descriptor, bytes.data(), size);
}

ImportReport report_of(const std::string& bytes, const std::string& file) {
  if (bytes == "memory") return refusal(file, "more than the memory limit of the test");
  try {
    return report_from_bytes(bytes);
  } catch (const std::exception&) {
    return refusal(file, "the reader was damaged by it");
  }
}

ImportReport report_of_end(Received received, int status, const std::string& file) {
  const bool out_of_time =
      received == Received::too_late || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU);
  if (out_of_time) return refusal(file, "longer than the time limit of the test");
  const std::string how = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "it left";
  return refusal(file, "the reader crashed on it: " + how);
}

}  // namespace

void limit_processor_time(std::chrono::seconds time) {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  constexpr rlim_t parts = 1'000'000;
  const rlim_t microseconds = used.ru_utime.tv_usec + used.ru_stime.tv_usec;
  const rlim_t begun = used.ru_utime.tv_sec + used.ru_stime.tv_sec + (microseconds + parts - 1) / parts;
  const rlim_t until = begun + static_cast<rlim_t>(time.count());
  const rlimit cpu{until, RLIM_INFINITY};
  setrlimit(RLIMIT_CPU, &cpu);
}

std::vector<ImportReport> warm_reports(const std::vector<std::string>& files, std::chrono::seconds time,
                                       std::size_t memory_bytes) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
  const pid_t child = fork();
  if (child < 0) throw std::runtime_error(std::strerror(errno));
  if (child == 0) read_in_child(files, ends[1], time, memory_bytes);
  close(ends[1]);
  std::vector<ImportReport> reports;
  Received received = Received::all;
  constexpr int share =
      30;  // A busy machine gives a process that part of the time; only one that sleeps takes longer.
  while (received == Received::all && reports.size() < files.size()) {
    std::string bytes;
    received = receive_report(Clock::now() + share * time, ends[0], bytes);
    if (received == Received::all) reports.push_back(report_of(bytes, files[reports.size()]));
  }
  close(ends[0]);
  if (received == Received::too_late) kill(child, SIGKILL);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (reports.empty()) reports.push_back(report_of_end(received, status, files[0]));
  return reports;
}

}  // namespace nurbeam
