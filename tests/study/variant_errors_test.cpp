#include "pipelines/study/variant_errors.h"

#include "tests/study/study_of_case.h"

namespace nurbeam::test {
namespace {

// P L^2/EI = 2 E/1e6: the end of a cantilever comes up to 0.4934584 m.
const std::string cantilever = R"json({"nurbeam": 1, "gravity": [0, 0, 0],
  "beams": [{"name": "b", "axis": {"polyline": [[0, 0, 0], [1, 0, 0]]}, "section": {"area": 1, "second_moment": 1e-6},
             "material": {"density": 1, "youngs_modulus": 1e6}, "elements": {"count": 8}}],
  "supports": [{"beam": "b", "at": "start", "type": "clamped"}],
  "loads": [{"beam": "b", "at": "end", "force": [0, 2, 0]}],
  "analysis": {"type": "static"}, "output": {"probes": [{"name": "tip", "beam": "b", "at": "end"}]}})json";

std::string of_tip(const std::string& range, const std::string& more) {
  return R"json("variables": [{"name": "E", "path": "beams[0].material.youngs_modulus", "range": )json" +
         range + R"json(}], "quantities": [{"name": "rise", "value": "last(tip.y)"})json" + more +
         R"json(], "plan": {"grid": 3})json";
}

TEST(VariantErrors, HoldAKnownAnswer) {
  StudyOfCase of(cantilever,
                 of_tip("[0.9e6, 1.1e6]", R"json(, {"name": "err", "value": "error(last(tip.y))"})json"));
  const Variant variant = of.run({1e6}, false);
  ASSERT_EQ(variant.quantities.size(), 2U);
  EXPECT_LE(std::abs(variant.quantities[0] - 0.4934584), variant.quantities[1]);
  EXPECT_LT(variant.quantities[1], 1e-3);
}

TEST(VariantErrors, StandBesideEachQuantity) {
  StudyOfCase of(cantilever, of_tip("[0.9e6, 1.1e6]", "") + R"json(, "accuracy": true)json");
  ASSERT_EQ(of.study.quantities.size(), 2U);
  EXPECT_EQ(of.study.quantities[1].name, "rise.error");
  EXPECT_TRUE(asks_for_errors(of.study));
}

TEST(VariantErrors, TellWhatDrownsInThem) {
  StudyOfCase of(cantilever, of_tip("[0.9e6, 1.1e6]", "") + R"json(, "accuracy": true)json");
  std::vector<Variant> variants(2);
  variants[0].quantities = {1, 0.5};
  variants[1].quantities = {1.1, 0.5};
  EXPECT_EQ(drowned_in_errors(of.study, variants), std::vector<std::string>{"rise"});
  variants[1].quantities = {2, 0.5};
  EXPECT_TRUE(drowned_in_errors(of.study, variants).empty());
}

}  // namespace
}  // namespace nurbeam::test
