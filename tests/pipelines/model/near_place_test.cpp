#include <gtest/gtest.h>

#include <numbers>

#include "pipelines/model/build_model.h"
#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

/// A quarter circle of radius 1 m about the origin with a place named by a point.
class NearPlace : public ::testing::Test {
 protected:
  BuildReport build(const std::string& supports, const std::string& probes) {
    const CaseFileReport report = read_case_file(
        directory_.write("case.json", test::smallest_case),
        {R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [0, 1, 0], "normal": [0, 0, 1]}})",
         "beams[0].stress_free=straight", "supports=" + supports, R"(output={"probes": )" + probes + "}"});
    return build_model(report.value.value());
  }
  test::TemporaryDirectory directory_;
};

TEST_F(NearPlace, OfASupportAndAProbeIsTheFootOfThePoint) {
  const BuildReport report =
      build(R"([{"beam": "cable", "type": "pinned", "at": {"near": [1, 1, 0], "within": "50 cm"}}])",
            R"([{"name": "p", "beam": "cable", "at": {"near": ["86.7 cm", 0.5, 0.001]}}])");
  ASSERT_TRUE(report.value);
  EXPECT_NEAR(std::get<Support>(report.value->model.constraints.at(0)).s, pi / 4, 1e-14);
  EXPECT_NEAR(report.value->probes.at(0).s, std::atan2(0.5, 0.867), 1e-14);
}

TEST_F(NearPlace, FartherThanTheLimitIsRefusedWithDistanceLimitAndFoot) {
  for (const auto& [within, limit] : {std::pair{R"(, "within": "40 cm")", "0.4 m (\"within\")"},
                                      {"", "0.01570796327 m (1 % of its length"}}) {
    const BuildReport report = build(
        R"([{"beam": "cable", "type": "pinned", "at": {"near": [1, 1, 0])" + std::string(within) + "}}]",
        "[]");
    EXPECT_FALSE(report.value);
    ASSERT_EQ(report.diagnostics.size(), 1u);
    EXPECT_NE(report.diagnostics[0].where.find("supports[0].at.near"), std::string::npos);
    for (const char* part :
         {"(1, 1, 0) m is 0.4142135624 m from beam \"cable\"", limit, "(0.7071067812, 0.7071067812, 0) m"})
      EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
  }
}

}  // namespace
}  // namespace nurbeam
