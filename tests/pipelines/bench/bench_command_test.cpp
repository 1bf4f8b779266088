#include "pipelines/bench/bench_command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "pipelines/command/command_line.h"

namespace nurbeam {
namespace {

struct ProgramOutcome {
  int code;
  std::string out, err;
};

ProgramOutcome run_program(const std::vector<std::string>& arguments) {
  std::ostringstream out, err;
  const int code = run_command_line({bench_entry(bench_command)}, arguments, out, err);
  return {code, out.str(), err.str()};
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(BenchCommand, TimesItsPartsAndTellsErrorsOfRuns) {
  const auto plot = std::filesystem::path(testing::TempDir()) / "bench.svg";
  const ProgramOutcome bench = run_program({"bench", "--largest", "10", "--plot", plot.string()});
  EXPECT_EQ(bench.code, 0) << bench.err;
  for (const char* part : {"One element by itself", "in space, damped", "sliding body",
                           "change of the mesh [us]", "Example 1", "error [mm]", "478.0"})
    EXPECT_TRUE(holds(bench.out, part)) << part << "\n" << bench.out;
  EXPECT_FALSE(holds(bench.out, "nan"));
  EXPECT_GT(std::filesystem::file_size(plot), 1000u);
  const ProgramOutcome wrong = run_program({"bench", "--largest", "few"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_TRUE(holds(wrong.err, "--largest: \"few\"")) << wrong.err;
  EXPECT_EQ(run_program({"bench", "--largest", "10", "--cad", "no_such.step"}).code, 2);
  EXPECT_EQ(run_program({"bench", "--largest", "10", "--plot", "/nowhere/plot.svg"}).code, 4);
}

}  // namespace
}  // namespace nurbeam
