#include "fem/structure/displacement_table.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace nurbeam {
namespace {

const std::vector<DisplacementTable::Row> rows = {
    {0, {0, 0, 0}}, {1, {1, 0, -2}}, {1.5, {3, 0, -2}}, {4, {2, 0, 5}}};
const DisplacementTable table(rows);

TEST(DisplacementTable, PassesItsRowsAndRestsOutside) {
  for (const auto& [t, displacement] : rows) EXPECT_EQ(table.at(t).value, displacement);
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

TEST(DisplacementTable, NoSpeedJumpsAndNoAccelerationWhereNothingWaits) {
  const DisplacementTable rising({{0, {0, 0, 0}}, {1, {1, 0, 0}}, {1.5, {1.8, 0, 0}}, {4, {4, 0, 0}}});
  for (const double t : {1.0, 1.5}) {
    const auto before = table.at(t - 1e-9), after = table.at(t + 1e-9);
    EXPECT_LT((after.rate - before.rate).norm(), 1e-6) << t;
    EXPECT_NEAR(rising.at(t + 1e-9).acceleration.x(), rising.at(t - 1e-9).acceleration.x(), 1e-6) << t;
  }
  EXPECT_EQ(table.at(1.2).value.z(), -2);
}

TEST(DisplacementTable, GoesStraightFromRowToRowIfAsked) {
  const DisplacementTable straight(rows, RowJoin::linear);
  EXPECT_EQ(straight.at(0.5).value, Eigen::Vector3d(0.5, 0, -1));
  EXPECT_EQ(straight.at(1.25).rate, Eigen::Vector3d(4, 0, 0));
}

TEST(DisplacementTable, RefusesTimesThatDoNotIncrease) {
  using Row = DisplacementTable::Row;
  EXPECT_THROW(DisplacementTable(std::vector<Row>{{1, {0, 0, 0}}, {1, {1, 0, 0}}}), std::invalid_argument);
  EXPECT_THROW(DisplacementTable(std::vector<Row>{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
