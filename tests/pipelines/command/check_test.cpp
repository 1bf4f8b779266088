#include "pipelines/command/check.h"

#include <gtest/gtest.h>

#include <sstream>

#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

std::string checked(const std::vector<std::string>& overrides) {
  const test::TemporaryDirectory directory;
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  std::ostringstream out, err;
  EXPECT_EQ(check_case(report.value.value(), out, err), 0) << err.str();
  return out.str();
}

TEST(CheckCase, PrintsTheShortestAndTheLongestElement) {
  const std::string out = checked({R"(beams[0].elements={"per_segment": 4, "grading": "10 cm"})"});
  EXPECT_NE(out.find("4 elements of 0.1 to 0.4 m"), std::string::npos) << out;
}

TEST(CheckCase, CountsForcesMomentsAndLoadsPerLengthApart) {
  const std::string out = checked({R"(loads=[{"beam": "cable", "at": "end", "force": [0, 0, -1]},
    {"beam": "cable", "at": "end", "moment": [0, 1, 0]}, {"beam": "cable", "force_per_length": [0, 0, -1]}])"});
  EXPECT_NE(out.find("point loads 1, moments 1, distributed loads 1"), std::string::npos) << out;
}

}  // namespace
}  // namespace nurbeam
