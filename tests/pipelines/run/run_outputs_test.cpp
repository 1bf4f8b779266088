#include "pipelines/run/run_outputs.h"

#include <gtest/gtest.h>

#include <thread>

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

}  // namespace
}  // namespace nurbeam
