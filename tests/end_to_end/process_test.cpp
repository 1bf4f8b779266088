#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "pipelines/results/results.h"
#include "tests/cad_import/step_text_of.h"
#include "tests/end_to_end/case_run.h"
#include "tests/support/places.h"

namespace nurbeam {
namespace {

using test::TemporaryDirectory;

constexpr int done = 0, bad_input = 2, not_written = 4, interrupted = 130;

/// nurbeam as a process of its own, started through the shell; its messages go to a file in the directory.
class Process {
 public:
  /// `before` is shell text that stands in front of the command ("ulimit -f 100;").
  Process(const TemporaryDirectory& directory, const std::string& arguments, const std::string& before = "")
      : messages_(directory.path() / ("messages" + std::to_string(++count_))) {
    const std::string command =
        before + " exec " + test::nurbeam_program().string() + " " + arguments + " 2>" + messages_.string();
    id_ = fork();
    if (id_ == 0) {
      execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      std::_Exit(127);
    }
  }
  ~Process() {
    if (id_ > 0) {
      kill(id_, SIGKILL);
      waitpid(id_, nullptr, 0);
    }
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  void send(int signal) const { kill(id_, signal); }

  /// The exit code, or minus the signal that ended the process.
  int code() {
    int status = 0;
    waitpid(std::exchange(id_, -1), &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

  std::string messages() const {
    std::ifstream stream(messages_);
    return {std::istreambuf_iterator<char>(stream), {}};
  }

 private:
  inline static int count_ = 0;
  std::filesystem::path messages_;
  pid_t id_;
};

std::string run_of(const std::string& end_time, const std::filesystem::path& out) {
  return "run " + test::sample("falling_beam/falling_beam.json").string() +
         " --quiet --set beams[0].elements.count=8 --set analysis.step=1e-3 --set output.every=1e-3 "
         "--set analysis.end_time=" +
         end_time + " --out " + out.string();
}

std::size_t lines_in(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
}

/// Until a run has written some lines of its histories; false after half a minute.
bool wait_for_frames(const std::filesystem::path& out, std::size_t lines = 4) {
  for (int i = 0; i < 3000 && lines_in(out / "histories.csv.part") < lines; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return lines_in(out / "histories.csv.part") >= lines;
}

constexpr const char* endless = "500";

TEST(Process, ASecondRunIntoTheSameDirectoryIsRefusedAndTheFirstOneGoesOn) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process first(directory, run_of(endless, out));
  ASSERT_TRUE(wait_for_frames(out)) << first.messages();
  Process second(directory, run_of("0.01", out));
  EXPECT_EQ(second.code(), not_written);
  EXPECT_NE(second.messages().find("another run writes its results there"), std::string::npos)
      << second.messages();
  first.send(SIGINT);
  EXPECT_EQ(first.code(), interrupted);
  EXPECT_GE(lines_in(out / "histories.csv"), 4u);
}

TEST(Process, AKilledRunHoldsNothing) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process first(directory, run_of(endless, out));
  ASSERT_TRUE(wait_for_frames(out)) << first.messages();
  first.send(SIGKILL);
  EXPECT_EQ(first.code(), -SIGKILL);
  Process second(directory, run_of("0.01", out));
  EXPECT_EQ(second.code(), done) << second.messages();
  EXPECT_FALSE(std::filesystem::exists(out / "results.nc.part"));
}

std::string content_of(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// A run of some seconds, through splits and merges, until the body has left the beam.
std::string long_run(const std::filesystem::path& out, const std::string& rows) {
  return "run " + test::sample("falling_beam/falling_beam.json").string() +
         " --quiet --set beams[0].elements.count=40 --set analysis.step=5e-5 --set output.every=5e-3 "
         "--set analysis.end_time=0.8 --set output.paraview=true " +
         rows + " --out " + out.string();
}

void check_killed_runs(const std::string& rows) {
  const TemporaryDirectory directory;
  const auto whole = directory.path() / "whole", cut = directory.path() / "cut";
  const auto start = std::chrono::steady_clock::now();
  Process uninterrupted(directory, long_run(whole, rows));
  ASSERT_EQ(uninterrupted.code(), done) << uninterrupted.messages();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;

  std::mt19937 random(std::random_device{}());
  std::uniform_real_distribution<double> moment(0, time.count());
  int kills = 0, code = -SIGKILL;
  std::string moments;
  // Each time for as long as the whole run takes at most; a run that is killed before its first restart point
  // begins anew. The last try is not killed.
  for (; code != done && kills < 12; ++kills) {
    const bool resumes = std::filesystem::exists(cut / "restart.nc");
    Process run(directory, long_run(cut, rows) + (resumes ? " --resume" : ""));
    const double wait = moment(random);
    moments += std::to_string(wait) + " ";
    if (kills < 11) {
      std::this_thread::sleep_for(std::chrono::duration<double>(wait));
      run.send(kills % 4 == 3 ? SIGINT : SIGKILL);
    }
    code = run.code();
    // SIGINT before the run has begun ends it as it does any program.
    ASSERT_TRUE(code == done || code == -SIGKILL || code == interrupted || code == -SIGINT)
        << code << run.messages();
    if (code == -SIGKILL && std::filesystem::exists(cut / "restart.nc"))
      EXPECT_FALSE(read_results(cut).frames.empty()) << "killed after " << moments << "s";
  }
  ASSERT_EQ(code, done);
  for (const char* file : {"histories.csv", "frames.pvd"})
    EXPECT_EQ(content_of(cut / file), content_of(whole / file))
        << file << ", killed after " << moments << "s";
  EXPECT_EQ(content_of(cut / "frames/beams_000160.vtu"), content_of(whole / "frames/beams_000160.vtu"));
  EXPECT_FALSE(std::filesystem::exists(cut / "results.chunk0001.nc"));
  EXPECT_FALSE(std::filesystem::exists(cut / "histories.csv.former"));
}
TEST(Process, ARunThatIsKilledAtRandomMomentsAndResumedIsTheRunWithoutABreak) { check_killed_runs(""); }
TEST(Process, SoIsOneWithMoreRowsOfHistoriesThanFrames) {
  check_killed_runs("--set output.histories_every=1.7e-4");
}

// Runs at other levels are kept as they end, and the last of them is killed most likely.
TEST(Process, ARefinementThatIsKilledAndResumedHasTheErrorsOfOneWithoutABreak) {
  const TemporaryDirectory directory;
  const auto whole = directory.path() / "whole", cut = directory.path() / "cut";
  const auto refined = [](const std::filesystem::path& out) {
    return "run " + test::sample("falling_beam/falling_beam.json").string() +
           " --quiet --accuracy 1% --set beams[0].elements.count=20 --set analysis.step=5e-4 "
           "--set analysis.end_time=0.5 --set output.every=0.01 --set output.report=false --out " +
           out.string();
  };
  const auto start = std::chrono::steady_clock::now();
  Process uninterrupted(directory, refined(whole));
  const int code = uninterrupted.code();
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  ASSERT_TRUE(code == done || code == 3) << uninterrupted.messages();
  for (const double part : {0.5, 0.9}) {
    const bool resumes = std::filesystem::exists(cut / "restart.nc");
    Process run(directory, refined(cut) + (resumes ? " --resume" : ""));
    std::this_thread::sleep_for(part * time);
    run.send(SIGKILL);
    (void)run.code();
  }
  const bool resumes = std::filesystem::exists(cut / "restart.nc");
  Process last(directory, refined(cut) + (resumes ? " --resume" : ""));
  EXPECT_EQ(last.code(), code) << last.messages();
  for (const char* file : {"histories.csv", "errors.csv"})
    EXPECT_EQ(content_of(cut / file), content_of(whole / file)) << file;
}

TEST(Process, AnInterruptedRunIsResumedByItsOwnCaseOnly) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process first(directory, run_of(endless, out));
  ASSERT_TRUE(wait_for_frames(out)) << first.messages();
  first.send(SIGINT);
  ASSERT_EQ(first.code(), interrupted);
  Process other(directory, run_of("499", out) + " --resume");
  EXPECT_EQ(other.code(), bad_input);
  EXPECT_NE(other.messages().find("belongs to another case"), std::string::npos) << other.messages();
  const std::size_t before = lines_in(out / "histories.csv");
  Process second(directory, run_of(endless, out) + " --resume");
  while (lines_in(out / "histories.csv.part") < before + 4) std::this_thread::yield();
  second.send(SIGINT);
  EXPECT_EQ(second.code(), interrupted) << second.messages();
  EXPECT_GT(lines_in(out / "histories.csv"), before);
}

std::string diagnostics_in(const std::filesystem::path& out) {
  const std::string summary = content_of(out / "run.json");
  const std::size_t begin = summary.find("\"diagnostics\""), end = summary.find(']', begin);
  return begin == std::string::npos ? "" : summary.substr(begin, end - begin);
}

// Of the start from equilibrium, which a resumed run does not search anew.
TEST(Process, AResumedRunWarnsOfWhatTheRunWarnedOf) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  const auto column = directory.write("column.json", R"({
    "nurbeam": 1,
    "beams": [{"name": "column", "axis": {"polyline": [[0, 0, 0], [0, 0, 1]]}, "section": {"radius": 0.005},
               "material": {"name": "steel", "damping": 1e-4}}],
    "supports": [{"beam": "column", "at": "start", "type": "clamped"}],
    "loads": [{"beam": "column", "at": "end", "force": [0, 0, -400]}],
    "analysis": {"end_time": 500, "step": 1e-3, "initial": "equilibrium"},
    "output": {"every": 1e-3, "report": false}})");
  const std::string command = "run " + column.string() + " --quiet --out " + out.string();
  Process first(directory, command);
  ASSERT_TRUE(wait_for_frames(out)) << first.messages();
  first.send(SIGINT);
  ASSERT_EQ(first.code(), interrupted) << first.messages();
  const std::string said = diagnostics_in(out);
  EXPECT_NE(said.find("snaps through or buckles"), std::string::npos) << said;
  const std::size_t before = lines_in(out / "histories.csv");
  Process second(directory, command + " --resume");
  ASSERT_TRUE(wait_for_frames(out, before + 4)) << second.messages();
  second.send(SIGINT);
  ASSERT_EQ(second.code(), interrupted) << second.messages();
  EXPECT_EQ(diagnostics_in(out), said);
}

TEST(Process, ARunLeavesALogOfWhatItHasSaid) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process run(directory, run_of("0.01", out));
  ASSERT_EQ(run.code(), done) << run.messages();
  const std::string log = content_of(out / "run.log");
  EXPECT_EQ(log.find("nurbeam "), 0u) << log;
  EXPECT_NE(log.find("100 %  t = 0.01 of 0.01 s"), std::string::npos) << log;
  EXPECT_NE(log.find("ended at t = 0.01 s after 10 steps"), std::string::npos) << log;
}

TEST(Process, ThereMustBeARunToResume) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process run(directory, run_of("0.01", out) + " --resume");
  EXPECT_EQ(run.code(), bad_input);
  EXPECT_NE(run.messages().find("there is no run to resume"), std::string::npos) << run.messages();
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Process, EverySignalThatAsksForTheEndIsAnsweredWithResults) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const TemporaryDirectory directory;
    const auto out = directory.path() / "results";
    Process run(directory, run_of(endless, out));
    ASSERT_TRUE(wait_for_frames(out)) << run.messages();
    run.send(signal);
    EXPECT_EQ(run.code(), interrupted) << run.messages();
    for (const char* file : {"histories.csv", "results.nc", "run.json"})
      EXPECT_TRUE(std::filesystem::exists(out / file)) << file;
  }
}

TEST(Process, TheSecondSignalEndsARunWithinItsStep) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process run(directory, "run " + test::sample("falling_beam/falling_beam.json").string() +
                             " --quiet --set beams[0].elements.count=20000 --set analysis.step=1e-6 "
                             "--set analysis.end_time=1e-3 --out " +
                             out.string());
  ASSERT_TRUE(wait_for_frames(out, 2)) << run.messages();
  // Both reach it in the same step, however short steps are: while it is stopped.
  for (const int signal : {SIGSTOP, SIGINT, SIGTERM, SIGCONT}) run.send(signal);
  EXPECT_EQ(run.code(), interrupted) << run.messages();
  EXPECT_FALSE(std::filesystem::exists(out / "results.nc"));
  EXPECT_FALSE(std::filesystem::exists(out / "run.json"));
}

TEST(Process, AHangUpIsIgnoredWhereItWasIgnoredBefore) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process run(directory, run_of(endless, out), "trap '' HUP;");
  ASSERT_TRUE(wait_for_frames(out)) << run.messages();
  run.send(SIGHUP);
  const std::size_t lines = lines_in(out / "histories.csv.part") + 3;
  for (int i = 0; i < 3000 && lines_in(out / "histories.csv.part") < lines; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  run.send(SIGTERM);
  EXPECT_EQ(run.code(), interrupted);
  EXPECT_GE(lines_in(out / "histories.csv"), lines);
}

TEST(Process, ARunOutlivesTheReaderOfItsMessages) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  // The joint at the held end gives a warning; the pipe's reader has gone by then.
  const std::string command = "(sleep 0.2; exec " + test::nurbeam_program().string() + " " +
                              run_of("0.01", out) + "; ) 2>&1 >/dev/null | true; exit 0";
  EXPECT_EQ(std::system(command.c_str()), 0);
  for (int i = 0; i < 3000 && !std::filesystem::exists(out / "run.json"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(std::filesystem::exists(out / "run.json"));
}

TEST(Process, AFullDiskEndsWithFourAndLeavesNoHalfFileUnderAFinalName) {
  // ulimit -f counts blocks of 512 bytes; the stored frames alone need more.
  for (const char* blocks : {"8", "100", "200"}) {
    const TemporaryDirectory directory;
    const auto out = directory.path() / "results";
    Process run(directory, run_of("0.1", out), std::string("ulimit -f ") + blocks + ";");
    EXPECT_EQ(run.code(), not_written) << run.messages();
    EXPECT_NE(run.messages().find("File too large"), std::string::npos) << run.messages();
    for (const auto& entry : std::filesystem::directory_iterator(out)) {
      const std::string name = entry.path().filename().string();
      EXPECT_TRUE(name == "run.log" || name == "histories.csv.part") << name;
    }
  }
}

TEST(Process, AnExportThatMayNotGrowEndsWithFour) {
  const TemporaryDirectory directory;
  const auto out = directory.path() / "results";
  Process run(directory, run_of("0.1", out));
  ASSERT_EQ(run.code(), done) << run.messages();
  const std::filesystem::path file = directory.path() / "curves.step";
  Process cut(directory, "export " + out.string() + " --time 0 --to " + file.string(), "ulimit -f 1;");
  EXPECT_EQ(cut.code(), not_written) << cut.messages();
  EXPECT_NE(cut.messages().find("File too large"), std::string::npos) << cut.messages();
  EXPECT_FALSE(std::filesystem::exists(file));
}

/// Curves made of curves made of curves, each twice: 2^40 of them in a few kilobytes.
std::string nest_of_curves() {
  std::string entities = "#100 = CIRCLE('',#11,1.);\n", below = "#100";
  for (int level = 0; level < 40; ++level) {
    const auto reference = [&](int i) { return "#" + std::to_string(101 + 3 * level + i); };
    for (int i : {0, 1})
      entities += reference(i) + " = COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.," + below + ");\n";
    entities += reference(2) + " = COMPOSITE_CURVE('',(" + reference(0) + "," + reference(1) + "),.F.);\n";
    below = reference(2);
  }
  return step_text_of(below, entities);
}

TEST(Process, HostileCadFilesEndWithExitCode2WithinThirtySecondsAndTwoGibibytes) {
  const TemporaryDirectory directory;
  directory.write("nest.step", nest_of_curves());
  directory.write("large.step", "ISO-10303-21;\n");
  std::filesystem::resize_file(directory.path() / "large.step", std::uintmax_t{1} << 30);
  std::string references = "#100";
  // OpenCASCADE reads a list in the time of its square. The one curve of this one has no length.
  for (int i = 0; i < 40'000; ++i) references += ",#100";
  const std::string no_curve = "#100 = POLYLINE('',(#12,#12));";
  directory.write("list.step", step_text_of(references, no_curve));
  for (const char* file : {"nest.step", "large.step", "list.step"}) {
    const auto begin = std::chrono::steady_clock::now();
    Process process(directory, "inspect " + (directory.path() / file).string());
    EXPECT_EQ(process.code(), 2) << file;
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(30)) << file;
    EXPECT_NE(process.messages().find(std::string("error: ") + (directory.path() / file).string()),
              std::string::npos)
        << process.messages();
  }
  rusage children{};
  getrusage(RUSAGE_CHILDREN, &children);
  EXPECT_LT(children.ru_maxrss, 2L << 20);  // [kB]
}

}  // namespace
}  // namespace nurbeam
