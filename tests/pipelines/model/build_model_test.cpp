#include "pipelines/model/build_model.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "tests/pipelines/case_text.h"

namespace nurbeam {
namespace {

/// Two quarter circles of radius 1 m and a support on the second one, at 0.2 pi from its start.
const std::vector<std::string> half_circle = {
    R"(beams[0].axis={"arc": {"center": [0, 0, 0], "start": [1, 0, 0], "end": [-1, 0, 0], "normal": [0, 0, 1]}})",
    R"(supports=[{"beam": "cable", "at": {"fraction": 0.7}, "type": "clamped"}])"};
const std::string straight = "beams[0].stress_free=straight";

BuildReport build(const std::string& elements) {
  const test::TemporaryDirectory directory;
  std::vector<std::string> overrides = half_circle;
  overrides.insert(overrides.end(), {straight, "beams[0].elements=" + elements});
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  return build_model(report.value.value());
}

std::vector<double> lengths(const BuildReport& report) {
  const std::vector<HomeNode>& home = report.value.value().model.beams.at(0).home;
  std::vector<double> found;
  for (std::size_t i = 1; i < home.size(); ++i) found.push_back(home[i].s - home[i - 1].s);
  return found;
}

TEST(BuildModel, ElementsOfEachSegmentGrowByTheGrading) {
  const double pi = std::numbers::pi;
  for (const auto& [grading, k] : {std::pair{"\"10 cm\"", 0.1}, {"-0.1", -0.1}, {"0", 0.0}}) {
    const BuildReport report = build(std::string(R"({"per_segment": 3, "grading": )") + grading + "}");
    EXPECT_TRUE(report.diagnostics.empty());
    const std::vector<double> found = lengths(report);
    ASSERT_EQ(found.size(), 9u);
    for (int i = 0; i < 9; ++i)
      EXPECT_NEAR(found[i], (i < 3 ? 0.5 : i < 6 ? 0.2 : 0.3) * pi / 3 + (i % 3 - 1) * k, 1e-13);
  }
}

TEST(BuildModel, AGradingThatLeavesNoRoomIsRefusedWithItsRange) {
  // The tightest interval is the one before the support: |k| < 2 (0.2 pi) / (3 * 2).
  const BuildReport report = build(R"({"per_segment": 3, "grading": "30 cm"})");
  EXPECT_FALSE(report.value);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_NE(report.diagnostics[0].where.find("beams[0].elements.grading"), std::string::npos);
  for (const char* part : {"0.3 m", "3 parts", "0.6283185307 m", "greater than -0.2094395102 m",
                           "less than 0.2094395102 m", "between s = 1.570796327 m and s = 2.199114858 m"})
    EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
}

TEST(BuildModel, AGradingWithoutEffectIsMentioned) {
  const BuildReport report = build(R"({"per_segment": 1, "grading": 0.1})");
  EXPECT_EQ(lengths(report).size(), 3u);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].message.find("no effect"), std::string::npos);
}

/// The half circle as a cable of EI = 20 MPa pi (0.01 m)^4 / 4, out of the plane of gravity, with one more
/// override.
BuildReport build_in_space(const std::string& override) {
  const test::TemporaryDirectory directory;
  std::vector<std::string> overrides = half_circle;
  overrides.insert(overrides.end(), {"gravity=[0, -3, -9]", "beams[0].section={\"radius\": 0.01}",
                                     "beams[0].material={\"density\": 7200, \"youngs_modulus\": 2e7}"});
  if (!override.empty()) overrides.push_back(override);
  const CaseFileReport report = read_case_file(directory.write("case.json", test::smallest_case), overrides);
  return build_model(report.value.value());
}

TEST(BuildModel, ABentDrawingOfAStraightBeamIsToldWithItsEnergy) {
  const double pi = std::numbers::pi;
  const double energy = 0.5 * 2e7 * pi * 1e-8 / 4 * pi;  // EI kappa^2 L / 2 with kappa = 1 / m
  const BuildReport report = build_in_space("");
  ASSERT_EQ(report.value.value().model.dimension, 3);
  EXPECT_NEAR(report.value->sources[0].drawn_bending, energy, 1e-9 * energy);
  ASSERT_EQ(report.diagnostics.size(), 1u);
  EXPECT_EQ(report.diagnostics[0].severity, Severity::warning);
  EXPECT_NE(report.diagnostics[0].where.find("beams[0].stress_free"), std::string::npos);
  for (const char* part : {"0.2467 J", "radius of 1 m", "\"straight\"", "\"as-drawn-without-torsion\""})
    EXPECT_NE(report.diagnostics[0].message.find(part), std::string::npos) << report.diagnostics[0].message;
}

TEST(BuildModel, ABentDrawingThatIsSaidToBeStraightKeepsItsEnergyWithoutAWarning) {
  const BuildReport report = build_in_space(straight);
  EXPECT_TRUE(report.diagnostics.empty());
  EXPECT_NEAR(report.value.value().sources[0].drawn_bending, 0.2467, 1e-4);
}

TEST(BuildModel, ADrawingThatHoldsNothingIsNotTold) {
  const BuildReport as_drawn = build_in_space("beams[0].stress_free=as-drawn-without-torsion");
  EXPECT_TRUE(as_drawn.diagnostics.empty());
  EXPECT_EQ(as_drawn.value.value().sources[0].drawn_bending, 0);
  const BuildReport straight = build_in_space(R"(beams[0].axis={"polyline": [[0, 0, 0], [1, 1, 1]]})");
  EXPECT_TRUE(straight.diagnostics.empty());
  EXPECT_EQ(straight.value.value().sources[0].drawn_bending, 0);
}

}  // namespace
}  // namespace nurbeam
