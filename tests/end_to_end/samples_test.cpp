#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/end_to_end/case_run.h"

namespace nurbeam {
namespace {

/// What makes a sample quick, by its path below samples/.
const std::map<std::string, std::vector<std::string>> shortened = {
    {"falling_beam/falling_beam.json",
     {"beams[0].elements.count=6", "analysis.step=2e-3", "analysis.end_time=0.2"}},
    {"papers/falling_beam.json",
     {"beams[0].elements.count=5", "analysis.step=2e-3", "analysis.end_time=0.3"}},
    {"papers/suspended_beam.json", {"analysis.step=2e-3", "analysis.end_time=0.3"}},
    {"papers/semicircle_as_drawn.json",
     {"beams[0].elements.count=8", "analysis.step=2e-3", "analysis.end_time=0.3"}},
    {"papers/semicircle_straight.json",
     {"beams[0].elements.count=8", "analysis.step=2e-3", "analysis.end_time=0.3",
      "beams[0].element=ale-ancf"}},
    {"zipline/zipline.json",
     {"beams[0].elements.count=12", "analysis.step=5e-3", "analysis.end_time=0.5",
      "output.cad.times=[0,0.5]"}},
    {"papers/pendulum.json", {"analysis.end_time=0.2"}},
    {"papers/pendulum_own.json", {"analysis.end_time=0.2"}},
    {"papers/pendulum_extreme.json", {"analysis.end_time=0.2"}},
    {"rail/rail.json", {"analysis.end_time=0.05", "output.cad=null"}},
};

TEST(Samples, EveryCaseRunsAndFillsItsResults) {
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::filesystem::path(NURBEAM_SOURCE_DIR) / "samples")) {
    if (entry.path().extension() != ".json") continue;
    const std::string name = entry.path().lexically_relative(test::sample("")).string();
    SCOPED_TRACE(name);
    const auto overrides = shortened.find(name);
    const test::CaseRun run = test::run_file(
        entry.path(), overrides == shortened.end() ? std::vector<std::string>{} : overrides->second);
    EXPECT_EQ(run.code, 0) << run.messages;
    EXPECT_FALSE(run.left_half_files());
    EXPECT_FALSE(run.rows.empty());
    for (const char* file : {"histories.csv", "results.nc", "run.json"})
      EXPECT_NE(std::find(run.files.begin(), run.files.end(), file), run.files.end()) << file;
  }
}

}  // namespace
}  // namespace nurbeam
