#include "pipelines/model/model_summary.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "pipelines/case/case_file.h"
#include "pipelines/model/build_model.h"

namespace nurbeam::of_model_summary {
namespace {

nlohmann::json beam_of(const std::string& temperature) {
  const CaseFileReport read = read_case_text(
      R"({ "nurbeam": 1, "beams": [{ "name": "bar", "axis": { "polyline": [[0, 0, 0], [2, 0, 0]] },
      "section": { "radius": 0.01 }, "material": { "name": "steel", "thermal_expansion": 1.2e-5 })" +
          temperature + R"(}], "supports": [{ "beam": "bar", "at": "start", "type": "clamped" }],
    "analysis": { "type": "static" } })",
      "case.json");
  const auto report = build_model(*read.value);
  return nlohmann::json::parse(model_summary(*read.value, *report.value)).at("beams").at(0);
}

TEST(ModelSummary, TellsTheLargestThermalStrain) {
  EXPECT_NEAR(beam_of(R"(, "temperature": 60)").at("thermal strain at most"), 60 * 1.2e-5, 1e-6);
  EXPECT_NEAR(beam_of(R"(, "temperature": [[0, 10], [1, -40], [2, 0]])").at("thermal strain at most"),
              -40 * 1.2e-5, 1e-6);
  EXPECT_FALSE(beam_of("").contains("thermal strain at most"));
}

}  // namespace
}  // namespace nurbeam::of_model_summary
