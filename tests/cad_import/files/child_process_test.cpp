#include "cad_import/files/child_process.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <thread>
#include <vector>

#include "cad_import/files/companion_program.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

using Status = ChildResult::Status;

ChildResult run(const std::string& request, const ChildLimits& limits = {}) {
  return run_program(test::misbehaving_program(), request, limits);
}

int own_descriptors() {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}));
}

bool has_children() { return waitpid(-1, nullptr, WNOHANG) >= 0; }

TEST(ChildProcess, RequestAndAnswerArriveWhateverTheirSize) {
  const std::string large(20'000'000, 'y');
  EXPECT_EQ(run(large).output, large);
  const ChildResult result = run("large 20000000");
  EXPECT_EQ(result.status, Status::finished);
  EXPECT_EQ(result.output, std::string(20'000'000, 'x'));
}

TEST(ChildProcess, AnExceptionComesBackAsItsText) {
  const ChildResult result = run("throw");
  EXPECT_EQ(result.status, Status::failed);
  EXPECT_EQ(result.complaint, "no ink");
}

TEST(ChildProcess, ACrashIsAResult) {
  for (int signal_number : {SIGSEGV, SIGABRT, SIGFPE}) {
    const ChildResult result = run("raise " + std::to_string(signal_number));
    EXPECT_EQ(result.status, Status::crashed);
    EXPECT_EQ(result.complaint, strsignal(signal_number));
  }
}

TEST(ChildProcess, AnExitWithoutAReportIsAResult) { EXPECT_EQ(run("exit").status, Status::not_started); }

TEST(ChildProcess, AnEndlessLoopEndsAtTheTimeLimit) {
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run("loop", {std::chrono::seconds(1), 0}).status, Status::timed_out);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
}

TEST(ChildProcess, ASleepingChildEndsAtTheTimeLimitToo) {
  EXPECT_EQ(run("sleep", {std::chrono::seconds(1), 0}).status, Status::timed_out);
}

TEST(ChildProcess, ASleepingChildEndsWhenItIsInterrupted) {
  int asked = 0;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run("sleep", {.interrupted = [&] { return ++asked == 2; }}).status, Status::interrupted);
  EXPECT_EQ(asked, 2);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, TheShareThatAChildTellsIsSeen) {
  double seen = 0;
  EXPECT_EQ(
      run("half", {.watch = [&](const ChildState& state) { seen = std::max(seen, state.share); }}).status,
      Status::finished);
  EXPECT_EQ(seen, 0.5);
}

TEST(ChildProcess, MemoryBeyondTheLimitIsAResult) {
  if (!can_limit_memory()) GTEST_SKIP() << "built with the address sanitizer";
  EXPECT_EQ(run("large 2147483648", {std::chrono::seconds(10), 1U << 30}).status, Status::out_of_memory);
}

TEST(ChildProcess, WhatTheChildPrintsIsNotSeen) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(run("print").status, Status::finished);
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
}

TEST(ChildProcess, NoDescriptorAndNoZombieIsLeft) {
  const int before = own_descriptors();
  for (int i = 0; i < 20; ++i) {
    run("x");
    run("raise " + std::to_string(SIGSEGV));
    run("loop", {std::chrono::seconds(0), 0});
  }
  EXPECT_EQ(own_descriptors(), before);
  EXPECT_FALSE(has_children());
}

TEST(ChildProcess, TheChildOwnsNoOtherDescriptorOfItsParent) {
  // The three standard streams, the answer, and the one that lists them.
  EXPECT_EQ(run("descriptors").output, "5");
}

TEST(ChildProcess, AProgramThatIsNotThereIsAResultThatNamesIt) {
  const ChildResult result = run_program("/no/such/program", "x", {});
  EXPECT_EQ(result.status, Status::not_started);
  EXPECT_NE(result.complaint.find("/no/such/program"), std::string::npos);
}

TEST(ChildProcess, AProgramThatIsAnotherOneIsAResultThatNamesIt) {
  const ChildResult result = run_program("/bin/true", "x", {});
  EXPECT_EQ(result.status, Status::not_started);
  EXPECT_NE(result.complaint.find("/bin/true"), std::string::npos);
}

TEST(CompanionProgram, ThatAVariableNamesMustBeThere) {
  const CompanionProgram program{"nurbeam-cad", "reads", "NURBEAM_TEST_PROGRAM", "cad_import"};
  ::setenv("NURBEAM_TEST_PROGRAM", "/bin/true", 1);
  EXPECT_EQ(program.find(), "/bin/true");
  ::setenv("NURBEAM_TEST_PROGRAM", "/no/such/program", 1);
  try {
    program.find();
    ADD_FAILURE() << "another one is taken";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("NURBEAM_TEST_PROGRAM names /no/such/program"),
              std::string::npos);
  }
  ::unsetenv("NURBEAM_TEST_PROGRAM");
}

TEST(ChildProcess, ManyThreadsMayAskAtOnce) {
  std::atomic<int> right = 0;
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 8; ++t)
      threads.emplace_back([&, t] {
        for (int i = 0; i < 10; ++i) {
          const std::string request = "thread " + std::to_string(t) + " " + std::string(10'000, 'z');
          right += run(request).output == request;
        }
      });
  }
  EXPECT_EQ(right, 80);
}

}  // namespace
}  // namespace nurbeam
