#include "pipelines/study/process_worker.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <iostream>
#include <stdexcept>

#include "nurbs/number_text.h"
#include "pipelines/study/rows.h"

extern char** environ;

namespace nurbeam {

namespace {

/// A pipe whose ends are not inherited.
struct Pipe {
  int read = -1, write = -1;
  Pipe() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0)
      throw std::runtime_error(std::string("no pipe can be made: ") + std::strerror(errno));
    read = ends[0];
    write = ends[1];
  }
};

bool write_all(int descriptor, const std::string& text) {
  for (std::size_t written = 0; written < text.size();) {
    const ssize_t n = write(descriptor, text.data() + written, text.size() - written);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    written += static_cast<std::size_t>(n);
  }
  return true;
}

/// Of waitpid.
std::string how_it_ended(int status) {
  if (WIFSIGNALED(status)) return std::string("its process was ended by ") + strsignal(WTERMSIG(status));
  return "its process ended with exit code " + std::to_string(WEXITSTATUS(status));
}

}  // namespace

ProcessWorker::ProcessWorker(WorkerCommand command, std::optional<double> time_limit)
    : command_(std::move(command)), time_limit_(time_limit) {
  signal(SIGPIPE, SIG_IGN);  // a process that has ended is found by the write's failure
}

ProcessWorker::~ProcessWorker() { stop(); }

void ProcessWorker::start() {
  const Pipe to, from;
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, to.read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, from.write, STDOUT_FILENO);
  std::vector<char*> arguments;
  for (std::string& word : command_) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int error = posix_spawn(&process_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(to.read);
  close(from.write);
  input_ = to.write;
  output_ = from.read;
  received_.clear();
  if (error == 0) return;
  process_ = -1;
  stop();
  throw std::runtime_error(command_[0] + " cannot be started: " + std::strerror(error));
}

void ProcessWorker::stop() {
  if (input_ >= 0) close(input_);
  if (output_ >= 0) close(output_);
  input_ = output_ = -1;
  if (process_ < 0) return;
  kill(process_, SIGKILL);
  waitpid(process_, nullptr, 0);
  process_ = -1;
}

void ProcessWorker::begin(VariantTask task) {
  const std::string line =
      std::to_string(task.threads) + ' ' + line_of({.number = task.number, .values = task.values});
  task_ = std::move(task);
  begun_ = std::chrono::steady_clock::now();
  if (process_ < 0) start();
  if (write_all(input_, line)) return;
  stop();  // it ended between two tasks
  start();
  if (!write_all(input_, line)) throw std::runtime_error(command_[0] + " ends as soon as it is started");
}

Variant ProcessWorker::ended(VariantStatus status, std::string reason) {
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun_;
  Variant variant{.number = task_->number,
                  .values = task_->values,
                  .status = status,
                  .reason = std::move(reason),
                  .seconds = taken.count()};
  task_.reset();
  return variant;
}

std::optional<Variant> ProcessWorker::take() {
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begun_;
  pollfd ready{output_, POLLIN, 0};
  if (poll(&ready, 1, 0) > 0) {
    char buffer[4096];
    const ssize_t n = read(output_, buffer, sizeof buffer);
    if (n > 0) {
      received_.append(buffer, static_cast<std::size_t>(n));
      const auto end = received_.find('\n');
      if (end == std::string::npos) return {};
      Variant variant = variant_of(received_.substr(0, end));
      received_.erase(0, end + 1);
      task_.reset();
      return variant;
    }
    if (n < 0 && errno == EINTR) return {};
    int status = 0;
    waitpid(process_, &status, 0);
    process_ = -1;
    stop();
    return ended(VariantStatus::crashed, how_it_ended(status));
  }
  // A run ends itself at the limit; what does not come to its next step is ended here.
  constexpr double grace = 5;  // [s]
  if (!time_limit_ || taken.count() < *time_limit_ + grace) return {};
  stop();
  return ended(VariantStatus::timed_out, "did not end within " + text_of(*time_limit_ + grace) + " s");
}

int serve_variants(const StudyFile& study, const StudyCase* study_case) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd study_end{STDIN_FILENO, 0, 0};
  if (poll(&study_end, 1, 0) > 0 && (study_end.revents & POLLHUP)) return 1;  // it ended before that
  signal(SIGINT, SIG_IGN);                                                    // the study ends its processes
  std::string line;
  for (int threads = 1; std::cin >> threads && std::getline(std::cin, line);) {
    const Variant task = variant_of(line);
    const Variant variant = run_variant(study, study_case, task.number, task.values, threads);
    std::cout << line_of(variant) << std::flush;
    if (!std::cout) return 1;
  }
  return 0;
}

}  // namespace nurbeam
