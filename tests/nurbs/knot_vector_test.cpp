#include "nurbs/knot_vector.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>
#include <string>

#include "tests/support/curves.h"

namespace nurbeam {
namespace {

/// The message of the std::invalid_argument that these knots raise; empty if they are accepted.
std::string knot_refusal(int degree, std::vector<double> knots) {
  try {
    KnotVector(degree, std::move(knots));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

void expect_refusal(const std::string& words, int degree, std::vector<double> knots) {
  EXPECT_NE(knot_refusal(degree, knots).find(words), std::string::npos) << knot_refusal(degree, knots);
}

TEST(KnotVectorTest, AnInvalidOneIsRefusedWithTheValueAndTheRule) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  expect_refusal("degree is 0", 0, {0, 1});
  expect_refusal("there are 5 knots", 2, {0, 0, 0, 1, 1});
  expect_refusal("there are 0 knots", 1, {});
  expect_refusal("knot 2 is nan", 2, {0, 0, nan, 1, 1, 1});
  expect_refusal("knot 5 is inf", 2, {0, 0, 0, 1, 1, std::numeric_limits<double>::infinity()});
  expect_refusal("knot 3 is 0.5 after 1", 1, {0, 0, 1, 0.5, 2, 2});
  expect_refusal("live on [1, 1]", 1, {1, 1, 1, 1});
  expect_refusal("knot 1 stands 3 times; at most 2", 2, {0, 0, 0, 1, 1, 1, 2, 2, 2});
  expect_refusal("knot 0 stands 4 times; at most 3", 2, {0, 0, 0, 0, 1, 1, 1});
  expect_refusal("knot 1 stands 4 times; at most 3", 2, {0, 0, 0, 1, 1, 1, 1});
  expect_refusal("apart; knots must be equal, or at least 1e-60", 1, {0, 0, 1e-320, 1e-320});
  expect_refusal("apart; knots must be equal, or at least", 1, {0, 0, 1e-70, 1, 1});
}

TEST(KnotVectorTest, InteriorKnotsMayStandAsOftenAsTheDegreeAndEndKnotsOnceMore) {
  EXPECT_EQ(knot_refusal(2, {0, 0, 0, 1, 1, 2, 2, 2}), "");
  EXPECT_EQ(knot_refusal(1, {0, 0, 1, 2, 2}), "");
  EXPECT_EQ(knot_refusal(3, {-3, -2, -1, 0, 1, 2, 3, 4}), "");
}

TEST(KnotVectorTest, AnUnclampedCurveLivesBetweenTheKnotsOfItsDegree) {
  const KnotVector knots(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5});
  EXPECT_EQ(knots.control_point_count(), 5);
  EXPECT_EQ(knots.start(), 0);
  EXPECT_EQ(knots.end(), 2);
  EXPECT_EQ(knots.breaks(), (std::vector<double>{0, 1, 2}));
}

TEST(KnotVectorTest, ASpanHoldsItsLeftKnotAndNotItsRightOne) {
  const KnotVector knots(2, {0, 0, 0, 1, 1, 2, 3, 3, 3});
  EXPECT_EQ(knots.find_span(0), 2);
  EXPECT_EQ(knots.find_span(0.5), 2);
  EXPECT_EQ(knots.find_span(1), 4);
  EXPECT_EQ(knots.find_span(2), 5);
  EXPECT_EQ(knots.find_span(2.5), 5);
}

TEST(KnotVectorTest, OutsideTheCurveTheFirstOrLastNonEmptySpanIsFound) {
  const KnotVector clamped(2, {0, 0, 0, 1, 1, 2, 3, 3, 3});
  EXPECT_EQ(clamped.find_span(-7), 2);
  EXPECT_EQ(clamped.find_span(3), 5);
  EXPECT_EQ(clamped.find_span(7), 5);
  const KnotVector unclamped(2, {-1, 0, 0, 1, 1, 2});
  EXPECT_EQ(unclamped.find_span(-0.5), 2);
  EXPECT_EQ(unclamped.find_span(1), 2);
  const KnotVector repeated_ends(1, {0, 0, 1, 1});
  EXPECT_EQ(repeated_ends.find_span(1), 1);
}

TEST(KnotVectorTest, TheSpanFoundIsNonEmptyAndHoldsTheParameterOnRandomKnots) {
  Generator generator(1);
  for (int i = 0; i < 2000; ++i) {
    const int degree = 1 + i % 5;
    const KnotVector knots = random_knots(generator, degree, i % 2 == 0);
    const double u = uniform(generator, knots.start(), knots.end());
    const int span = knots.find_span(u);
    ASSERT_GE(span, degree);
    ASSERT_LT(span, knots.control_point_count());
    ASSERT_LE(knots.knots()[span], u);
    ASSERT_LT(u, knots.knots()[span + 1]);
  }
}

TEST(KnotVectorTest, MultiplicityCountsEqualKnots) {
  const KnotVector knots(2, {0, 0, 0, 1, 1, 2, 3, 3, 3});
  EXPECT_EQ(knots.multiplicity(0), 3);
  EXPECT_EQ(knots.multiplicity(1), 2);
  EXPECT_EQ(knots.multiplicity(2), 1);
  EXPECT_EQ(knots.multiplicity(0.5), 0);
}

}  // namespace
}  // namespace nurbeam
