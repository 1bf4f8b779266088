#include "cad_import/program/contained_reading.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>

#include "cad_import/program/kept_entities.h"
#include "cad_import/program/read_file.h"
#include "cad_import/report/report_bytes.h"

namespace nurbeam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int out_of_memory = 3, failed = 4;  // exit codes

/// A number that a child process may change.
class SharedNumber {
 public:
  SharedNumber()
      : page_(mmap(nullptr, sizeof(int), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0)) {
    if (page_ == MAP_FAILED) throw std::bad_alloc();
  }
  SharedNumber(const SharedNumber&) = delete;
  SharedNumber& operator=(const SharedNumber&) = delete;
  ~SharedNumber() { munmap(page_, sizeof(int)); }
  int* get() const { return static_cast<int*>(page_); }

 private:
  void* page_;
};

void send_all(int descriptor, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t count = write(descriptor, bytes.data() + sent, bytes.size() - sent);
    if (count < 0 && errno != EINTR) return;
    if (count > 0) sent += static_cast<std::size_t>(count);
  }
}

std::string receive_all(int descriptor) {
  std::string bytes;
  char buffer[1 << 16];
  for (ssize_t count = 1; count != 0;) {
    count = read(descriptor, buffer, sizeof buffer);
    if (count < 0 && errno != EINTR) break;
    if (count > 0) bytes.append(buffer, static_cast<std::size_t>(count));
  }
  return bytes;
}

/// Reads files again and again, each time in a child process.
class Reader {
 public:
  Reader(const std::filesystem::path& file, double tolerance)
      : file_(file), tolerance_(tolerance), begin_(Clock::now()) {
    kept_.count = count_.get();
  }

  std::string report() {
    constexpr std::size_t most_left_out = 10;
    std::optional<std::string> bytes = attempt(kept_);
    while (!bytes && kept_.without.size() < most_left_out) {
      const std::optional<int> culprit = find_culprit();
      if (!culprit) break;
      kept_.without.insert(*culprit);
      bytes = attempt(kept_);
    }
    return bytes ? *bytes : crash_report();
  }

 private:
  /// What was reported; nothing where the reader crashed.
  std::optional<std::string> attempt(const KeptEntities& kept) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
    const Clock::time_point start = Clock::now();
    const pid_t parent = getpid(), child = fork();
    if (child < 0) throw std::runtime_error(std::strerror(errno));
    if (child == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent) _exit(failed);
      read_and_leave(kept, ends[1]);
    }
    close(ends[1]);
    std::string bytes = receive_all(ends[0]);
    close(ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    longest_ = std::max(longest_, Clock::now() - start);
    return outcome(status, std::move(bytes));
  }

  [[noreturn]] void read_and_leave(const KeptEntities& kept, int answer) const {
    try {
      send_all(answer, to_bytes(read_file(file_, tolerance_, kept)));
      _exit(0);
    } catch (const std::bad_alloc&) {
      _exit(out_of_memory);
    } catch (const std::exception& e) {
      send_all(answer, e.what());
    }
    _exit(failed);
  }

  std::optional<std::string> outcome(int status, std::string bytes) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return bytes;
    if (WIFEXITED(status) && WEXITSTATUS(status) == out_of_memory) throw std::bad_alloc();
    if (WIFEXITED(status) && WEXITSTATUS(status) == failed) throw std::runtime_error(bytes);
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {  // this process has run out of its time, too
      signal(SIGXCPU, SIG_DFL);
      raise(SIGXCPU);
    }
    how_ = WIFSIGNALED(status) ? strsignal(WTERMSIG(status)) : "it left";
    return std::nullopt;
  }

  /// The last of the fewest entities that the reader crashes on; nothing where it crashes without any, or
  /// where there is no time.
  std::optional<int> find_culprit() {
    int survived = 0, crashes = *count_.get();
    if (crashes <= 0 || crashes_on(survived).value_or(true)) return std::nullopt;
    while (crashes - survived > 1) {
      const int middle = survived + (crashes - survived) / 2;
      const std::optional<bool> crashed = crashes_on(middle);
      if (!crashed) return std::nullopt;
      (*crashed ? crashes : survived) = middle;
    }
    return crashes - 1;
  }

  /// Whether it crashes on those before that one; nothing where there is no time.
  std::optional<bool> crashes_on(int before) {
    constexpr std::chrono::seconds time{20};
    if (Clock::now() - begin_ + longest_ > time) return std::nullopt;
    KeptEntities kept = kept_;
    kept.before = before;
    return !attempt(kept);
  }

  std::string crash_report() const {
    ImportReport report;
    report.file = file_.string();
    report.diagnostics.push_back({Severity::error, report.file,
                                  "the reader crashed on it (" + how_ +
                                      "); the file is damaged or too deeply nested; export it again"});
    return to_bytes(report);
  }

  std::filesystem::path file_;
  double tolerance_;
  Clock::time_point begin_;
  Clock::duration longest_{};
  SharedNumber count_;
  KeptEntities kept_;
  std::string how_;  // it crashed
};

}  // namespace

std::string contained_reading(const std::filesystem::path& file, double tolerance) {
  return Reader(file, tolerance).report();
}

}  // namespace nurbeam
