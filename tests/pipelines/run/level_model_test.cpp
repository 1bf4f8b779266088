#include "pipelines/run/level_model.h"

#include <gtest/gtest.h>

#include "pipelines/case/case_file.h"

namespace nurbeam {
namespace {

BuiltModel divided_bar(int elements, const std::string& more = "") {
  const CaseFileReport read = read_case_text(R"json({"nurbeam": 1, "gravity": [0, -9.81, 0],
    "beams": [{"name": "bar", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"radius": 0.01},
               "material": {"density": 1150, "youngs_modulus": 5e6}, "elements": {"count": )json" +
                                                 std::to_string(elements) + R"json(}}],
    "supports": [{"beam": "bar", "at": "start", "type": "clamped"})json" +
                                                 more + R"json(],
    "analysis": {"type": "static"}})json",
                                             "case.json");
  for (const Diagnostic& d : read.diagnostics)
    if (d.severity == Severity::error) ADD_FAILURE() << d.where << ": " << d.message;
  return std::move(*build_model(*read.value).value);
}

TEST(LevelModel, HasEverySecondNode) {
  const BuiltModel built = divided_bar(12);
  const auto half = at_level(built, -1), quarter = at_level(built, -2), twice = at_level(built, 1);
  ASSERT_TRUE(half && quarter && twice);
  EXPECT_EQ(element_count(half->model), 6);
  EXPECT_EQ(element_count(quarter->model), 3);
  EXPECT_EQ(element_count(twice->model), 24);
  for (int h = 0; h <= 6; ++h)
    EXPECT_DOUBLE_EQ(half->model.beams[0].home[h].s, built.model.beams[0].home[2 * h].s);
}

TEST(LevelModel, KeepsNodesOfSupports) {
  const BuiltModel built = divided_bar(14, R"(, {"beam": "bar", "at": {"length": 0.3}, "type": "pinned"})");
  const auto half = at_level(built, -1);
  ASSERT_TRUE(half);
  EXPECT_GE(half->model.beams[0].home_at(0.3), 0);
  EXPECT_EQ(half->model.beams[0].home[half->model.beams[0].home_at(0.3)].hold, Hold::position);
}

TEST(LevelModel, OfAnOddNumberHasLessThanHalf) {
  const auto half = at_level(divided_bar(7), -1);
  ASSERT_TRUE(half);
  EXPECT_EQ(element_count(half->model), 3);
  EXPECT_NEAR(half->model.beams[0].home[1].s, 1.0 / 3, 1e-12);
}

TEST(LevelModel, IsNotThereWithTooFewElements) {
  EXPECT_FALSE(at_level(divided_bar(5), -1));
  EXPECT_TRUE(at_level(divided_bar(6), -1));
  EXPECT_FALSE(at_level(divided_bar(6), -2));
}

}  // namespace
}  // namespace nurbeam
