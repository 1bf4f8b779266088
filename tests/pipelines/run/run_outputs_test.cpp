#include "pipelines/run/run_outputs.h"

#include <gtest/gtest.h>

#include <thread>

#include "pipelines/results/restart_file.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

// Whoever it is that works: the programs that write CAD files are others.
TEST(RunOutputs, ARestartPointIsDueTwoSecondsAfterTheLast) {
  const test::TemporaryDirectory directory;
  const CaseFile c = read_case_file(directory.write("case.json", test::smallest_case), {}).value.value();
  const BuiltModel built = build_model(c).value.value();
  RunOutputs outputs(c, built, directory.path(), "", nullptr);
  EXPECT_FALSE(outputs.checkpoint_due());
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));
  EXPECT_TRUE(outputs.checkpoint_due());
}

TEST(RunOutputs, WarningsOfFilesOutliveAResumedRun) {
  const test::TemporaryDirectory directory;
  const CaseFile c = read_case_file(directory.write("case.json", test::smallest_case), {}).value.value();
  const BuiltModel built = build_model(c).value.value();
  Checkpoint from;
  from.said_of_files = {"one.step", "not written", "two.step", "not written either"};
  RunOutputs outputs(c, built, directory.path(), "", &from);
  EXPECT_EQ(outputs.diagnostics(),
            (std::vector<Diagnostic>{{Severity::warning, "one.step", "not written"},
                                     {Severity::warning, "two.step", "not written either"}}));
  outputs.write(Checkpoint{});
  outputs.finish();
  EXPECT_EQ(read_checkpoint(directory.path() / "restart.nc").said_of_files, from.said_of_files);
}

}  // namespace
}  // namespace nurbeam
