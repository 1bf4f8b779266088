#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/end_to_end/case_run.h"

namespace nurbeam::histories_every_test {
namespace {

using test::CaseRun;

CaseRun swinging_beam(const std::string& output) {
  return test::run_text(R"({ "nurbeam": 1,
    "beams": [{ "name": "beam", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.005 },
      "material": { "density": 7800, "youngs_modulus": 2e11 }, "elements": { "count": 8 } }],
    "supports": [{ "beam": "beam", "at": "start", "type": "clamped", "name": "wall" }],
    "analysis": { "end_time": 0.05, "step": 1e-3 },
    "output": { "every": 0.01, "report": false, "probes": [{ "name": "tip", "beam": "beam", "at": "end" }])" +
                        output + " } }");
}

// The rows of a run at the times of another: equal bit by bit.
void expect_rows_of(const CaseRun& few, const CaseRun& many) {
  ASSERT_EQ(few.header, many.header);
  std::size_t k = 0;
  for (const std::vector<double>& row : few.rows) {
    while (k < many.rows.size() && many.rows[k][0] < row[0]) ++k;
    ASSERT_LT(k, many.rows.size());
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_TRUE(row[i] == many.rows[k][i] || (std::isnan(row[i]) && std::isnan(many.rows[k][i])))
          << few.header[i] << " at " << row[0];
  }
}

TEST(HistoriesEvery, AddsRowsOfStepsAndLeavesTheMotionAsItIs) {
  const CaseRun frames = swinging_beam(""), steps = swinging_beam(R"(, "histories_every": "step")");
  ASSERT_EQ(frames.code, 0) << frames.messages;
  ASSERT_EQ(steps.code, 0) << steps.messages;
  EXPECT_EQ(frames.rows.size(), 6u);
  ASSERT_EQ(steps.rows.size(), 51u);
  expect_rows_of(frames, steps);
  for (std::size_t i = 0; i < steps.rows.size(); ++i) {
    EXPECT_NEAR(steps.value(i, "time [s]"), 1e-3 * static_cast<double>(i), 1e-12);
    const bool is_frame = i % 10 == 0;
    EXPECT_EQ(std::isnan(steps.value(i, "beam.moment.max [N m]")), !is_frame);
    EXPECT_EQ(std::isnan(steps.value(i, "beam.length [m]")), !is_frame);
    for (const char* column :
         {"tip.uz [m]", "tip.moment [N m]", "energy.total [J]", "wall.fz [N]", "tip.speed [m/s]"})
      EXPECT_FALSE(std::isnan(steps.value(i, column))) << column;
  }
}

// At the first step at or after each multiple: of 2.5 ms at 3, 5, 8, 10 ms, ...
TEST(HistoriesEvery, AddsRowsOfAnInterval) {
  const CaseRun run = swinging_beam(R"(, "histories_every": "2.5 ms")");
  ASSERT_EQ(run.code, 0) << run.messages;
  ASSERT_EQ(run.rows.size(), 21u);
  for (std::size_t i = 0; i < run.rows.size(); ++i)
    EXPECT_NEAR(run.value(i, "time [s]"), 1e-3 * std::ceil(2.5 * static_cast<double>(i) - 1e-9), 1e-12) << i;
  expect_rows_of(run, swinging_beam(R"(, "histories_every": "step")"));
}

TEST(HistoriesEvery, IsOfMotionsAlone) {
  const CaseRun run = test::run_text(R"({ "nurbeam": 1,
    "beams": [{ "name": "beam", "axis": { "polyline": [[0, 0, 0], [1, 0, 0]] }, "section": { "radius": 0.005 },
      "material": { "density": 7800, "youngs_modulus": 2e11 } }],
    "supports": [{ "beam": "beam", "at": "start", "type": "clamped" }],
    "analysis": { "type": "static" }, "output": { "report": false, "histories_every": "step" } })");
  EXPECT_EQ(run.code, 0);
  EXPECT_TRUE(run.says("output.histories_every")) << run.messages;
  EXPECT_EQ(run.rows.size(), 1u);
}

TEST(HistoriesEvery, RefusesMoreRowsThanStepsThereMayBe) {
  const CaseRun run = swinging_beam(R"(, "histories_every": 1e-11)");
  EXPECT_EQ(run.code, 2);
  EXPECT_TRUE(run.says("rows of histories")) << run.messages;
}

}  // namespace
}  // namespace nurbeam::histories_every_test
