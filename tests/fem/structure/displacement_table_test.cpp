#include "fem/structure/displacement_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

namespace nurbeam {
namespace {

const DisplacementTable table({{0, {0, 0, 0}}, {1, {1, 0, -2}}, {1.5, {3, 0, -2}}, {4, {2, 0, 5}}});

TEST(DisplacementTable, PassesItsRowsAndRestsOutside) {
  for (const auto& [t, displacement] : table.rows()) EXPECT_EQ(table.at(t).value, displacement);
  for (const double t : {-1.0, 4.0, 9.0}) {
    EXPECT_EQ(table.at(t).rate, Eigen::Vector3d::Zero());
    EXPECT_EQ(table.at(t).acceleration, Eigen::Vector3d::Zero());
  }
}

TEST(DisplacementTable, RateAndAccelerationAreRates) {
  constexpr double h = 1e-5;
  for (const double t : {0.2, 0.7, 1.1, 1.4, 2.0, 3.9}) {
    const Eigen::Vector3d rate = (table.at(t + h).value - table.at(t - h).value) / (2 * h),
                          acceleration = (table.at(t + h).rate - table.at(t - h).rate) / (2 * h);
    EXPECT_LT((rate - table.at(t).rate).norm(), 1e-8) << t;
    EXPECT_LT((acceleration - table.at(t).acceleration).norm(), 1e-8) << t;
  }
}

TEST(DisplacementTable, OvershootsNothingAndNoSpeedJumps) {
  for (std::size_t i = 0; i + 1 < table.rows().size(); ++i) {
    const auto& [t0, a] = table.rows()[i];
    const auto& [t1, b] = table.rows()[i + 1];
    for (int k = 0; k <= 100; ++k) {
      const Eigen::Vector3d d = table.at(t0 + k * (t1 - t0) / 100).value;
      for (int c = 0; c < 3; ++c) {
        EXPECT_GE(d[c], std::min(a[c], b[c]) - 1e-15);
        EXPECT_LE(d[c], std::max(a[c], b[c]) + 1e-15);
      }
    }
    EXPECT_LT((table.at(t1 - 1e-9).rate - table.at(t1 + 1e-9).rate).norm(), 1e-6) << t1;
  }
}

TEST(DisplacementTable, RefusesTimesThatDoNotIncrease) {
  using Row = DisplacementTable::Row;
  EXPECT_THROW(DisplacementTable(std::vector<Row>{{1, {0, 0, 0}}, {1, {1, 0, 0}}}), std::invalid_argument);
  EXPECT_THROW(DisplacementTable(std::vector<Row>{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
