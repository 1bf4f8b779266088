#include "fem/time_table.h"

#include <gtest/gtest.h>

namespace nurbeam {
namespace {

TEST(TimeTable, IsLinearBetweenItsRowsAndConstantOutside) {
  const TimeTable table{{1, 2}, {3, 6}, {4, 0}};
  for (const auto& [t, value, slope] : {std::tuple{0.0, 2.0, 0.0},
                                        {1.0, 2.0, 2.0},
                                        {2.5, 5.0, 2.0},
                                        {3.0, 6.0, -6.0},
                                        {3.5, 3.0, -6.0},
                                        {4.0, 0.0, 0.0},
                                        {9.0, 0.0, 0.0}}) {
    EXPECT_DOUBLE_EQ(value_and_slope(table, t).first, value) << t;
    EXPECT_DOUBLE_EQ(value_and_slope(table, t).second, slope) << t;
  }
}

TEST(TimeTable, WithoutRowsIsOne) { EXPECT_EQ(value_and_slope({}, 3), std::pair(1.0, 0.0)); }

TEST(TimeTable, WithOneRowIsThatValue) { EXPECT_EQ(value_and_slope({{2, 7}}, 3), std::pair(7.0, 0.0)); }

}  // namespace
}  // namespace nurbeam
