#pragma once
#include <csignal>

namespace nurbeam {

/// While one lives, SIGINT (Ctrl-C), SIGTERM and SIGHUP ask the run to end after its step; the second one
/// ends the process at once, with exit code 130. A SIGHUP that was ignored before (nohup) stays ignored.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool interrupted() const;

 private:
  using Action = struct sigaction;
  Action interrupt_{}, terminate_{}, hang_up_{};  // before
};

/// While one lives, writing to a pipe that nobody reads fails and does not end the process.
class BrokenPipeGuard {
 public:
  BrokenPipeGuard();
  ~BrokenPipeGuard();
  BrokenPipeGuard(const BrokenPipeGuard&) = delete;
  BrokenPipeGuard& operator=(const BrokenPipeGuard&) = delete;

 private:
  struct sigaction before_ {};
};

}  // namespace nurbeam
