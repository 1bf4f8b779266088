#include "cad_import/files/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace nurbeam {
namespace {

using Status = ChildResult::Status;

int open_descriptors() {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

bool has_children() { return waitpid(-1, nullptr, WNOHANG) >= 0; }

[[noreturn]] std::string loop_for_ever() {
  std::atomic<int> turns = 0;
  while (true) ++turns;
}

TEST(ChildProcess, WhatTheWorkReturnsComesBackWhateverItsSize) {
  const std::string large(20'000'000, 'x');
  const ChildResult result = run_in_child([&] { return large; }, {});
  EXPECT_EQ(result.status, Status::finished);
  EXPECT_EQ(result.output, large);
}

TEST(ChildProcess, AnExceptionComesBackAsItsText) {
  const ChildResult result = run_in_child([]() -> std::string { throw std::runtime_error("no ink"); }, {});
  EXPECT_EQ(result.status, Status::failed);
  EXPECT_EQ(result.complaint, "no ink");
}

TEST(ChildProcess, ACrashIsAResult) {
  for (int signal_number : {SIGSEGV, SIGABRT, SIGFPE}) {
    const ChildResult result = run_in_child(
        [=] {
          raise(signal_number);
          return std::string();
        },
        {});
    EXPECT_EQ(result.status, Status::crashed);
    EXPECT_EQ(result.complaint, strsignal(signal_number));
  }
}

TEST(ChildProcess, AnExitWithoutAReportIsAResult) {
  const ChildResult result = run_in_child([]() -> std::string { _exit(0); }, {});
  EXPECT_EQ(result.status, Status::failed);
}

TEST(ChildProcess, AnEndlessLoopEndsAtTheTimeLimit) {
  const auto begin = std::chrono::steady_clock::now();
  const ChildResult result = run_in_child(loop_for_ever, {std::chrono::seconds(1), 0});
  EXPECT_EQ(result.status, Status::timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST(ChildProcess, ASleepingChildEndsAtTheTimeLimitToo) {
  const ChildResult result = run_in_child(
      [] {
        sleep(100);
        return std::string();
      },
      {std::chrono::seconds(1), 0});
  EXPECT_EQ(result.status, Status::timed_out);
}

TEST(ChildProcess, MemoryBeyondTheLimitIsAResult) {
  if (!can_limit_memory()) GTEST_SKIP() << "built with the address sanitizer";
  const ChildResult result = run_in_child([] { return std::string(std::size_t{2} << 30, 'x'); },
                                          {std::chrono::seconds(10), 1U << 30});
  EXPECT_EQ(result.status, Status::out_of_memory);
}

TEST(ChildProcess, WhatTheChildPrintsIsNotSeen) {
  testing::internal::CaptureStdout();
  run_in_child(
      [] {
        std::printf("noise");
        std::fflush(stdout);
        return std::string();
      },
      {});
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ChildProcess, NoDescriptorAndNoZombieIsLeft) {
  const int before = open_descriptors();
  for (int i = 0; i < 20; ++i) {
    run_in_child([] { return std::string("x"); }, {});
    run_in_child(
        [] {
          raise(SIGSEGV);
          return std::string();
        },
        {});
    run_in_child(loop_for_ever, {std::chrono::seconds(0), 0});
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, TheChildOwnsNoOtherDescriptorOfItsParent) {
  const ChildResult result = run_in_child([] { return std::to_string(open_descriptors()); }, {});
  // The three standard streams, the pipe, and the one that lists them.
  EXPECT_EQ(result.output, "5");
}

}  // namespace
}  // namespace nurbeam
