#include "nurbs/row_curve.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

namespace nurbeam {
namespace {

using Rows = std::vector<RowCurve::Row>;

Rows rows_of(const std::function<double(double)>& y, const std::vector<double>& places) {
  Rows rows;
  for (const double x : places) rows.emplace_back(x, y(x));
  return rows;
}

std::vector<double> even_places(double from, double to, int count) {
  std::vector<double> places;
  for (int i = 0; i <= count; ++i) places.push_back(from + (to - from) * i / count);
  return places;
}

// Largest jump of a derivative over the inner rows that do not bend.
double jump(const RowCurve& curve, double RowCurve::Point::*derivative) {
  double largest = 0;
  for (std::size_t i = 1; i + 1 < curve.rows().size(); ++i) {
    const double x = curve.rows()[i].first, before = std::nextafter(x, -1e9);
    const bool smooth = derivative != &RowCurve::Point::second || !curve.bends_at(i);
    if (smooth) largest = std::max(largest, std::abs(curve.at(x).*derivative - curve.at(before).*derivative));
  }
  return largest;
}

TEST(RowCurve, IsExactForQuadraticsWhereverTheyTurn) {
  for (const double turn : {-1.0, 0.0, 0.13, 0.31, 1.1, 2.0, 2.04, 2.35, 3.7, 4.0, 9.0})
    for (const std::vector<double>& places :
         {std::vector{0.0, 0.6, 2.0, 4.0}, std::vector{0.0, 0.1, 0.5, 1.5, 3.2, 3.5, 4.0},
          even_places(0, 4, 50)}) {
      const auto y = [&](double x) { return 3 - 2 * (x - turn) * (x - turn); };
      const RowCurve curve(rows_of(y, places));
      for (double x = 0; x < 4; x += 0.01) {
        EXPECT_NEAR(curve.at(x).value, y(x), 1e-11) << turn;
        EXPECT_NEAR(curve.at(x).slope, -4 * (x - turn), 1e-10) << turn;
        EXPECT_NEAR(curve.at(x).second, -4, 1e-8) << turn;
      }
    }
}

TEST(RowCurve, ThreeRowsThatTurnAreOfAParabola) {
  const RowCurve curve({{0, 1}, {1, 4}, {3, 1}});
  EXPECT_NEAR(curve.at(0).slope, 4.5, 1e-14);
  EXPECT_NEAR(curve.at(2).value, 1 + 9 - 6, 1e-14);
}

TEST(RowCurve, TwoRowsAreAStraightLineAndOneIsAConstant) {
  const RowCurve line({{1, 2}, {3, 6}});
  EXPECT_EQ(line.at(1.5).value, 3);
  EXPECT_EQ(line.at(2.9).slope, 2);
  EXPECT_EQ(line.at(1).second, 0);
  EXPECT_EQ(RowCurve({{1, 7}}).at(1).value, 7);
  EXPECT_EQ(*RowCurve({{1, 7}}).slopes_at(1), std::pair(0.0, 0.0));
}

TEST(RowCurve, IsConstantOutsideItsRows) {
  const RowCurve curve({{0, 1}, {1, 4}, {2, 5}});
  for (const auto& [x, y] : {std::pair{-1.0, 1.0}, {2.0, 5.0}, {3.0, 5.0}}) {
    EXPECT_EQ(curve.at(x).value, y);
    EXPECT_EQ(curve.at(x).slope, 0);
  }
}

TEST(RowCurve, ValueSlopeAndSecondDerivativeAreContinuous) {
  const RowCurve curve(rows_of([](double x) { return std::sin(3 * x) + x; }, {0, 0.2, 0.7, 0.8, 1.6, 2, 3}));
  EXPECT_LT(jump(curve, &RowCurve::Point::value), 1e-14);
  EXPECT_LT(jump(curve, &RowCurve::Point::slope), 1e-13);
  EXPECT_LT(jump(curve, &RowCurve::Point::second), 1e-12);
  for (std::size_t i = 1; i + 1 < curve.rows().size(); ++i) EXPECT_FALSE(curve.bends_at(i));
}

TEST(RowCurve, ConvergesWithFourthOrderAndItsSecondDerivativeWithSecond) {
  const auto y = [](double x) { return std::exp(x) * std::cos(2 * x); };
  const auto second = [](double x) { return std::exp(x) * (-3 * std::cos(2 * x) - 4 * std::sin(2 * x)); };
  std::vector<double> of_y, of_second;
  for (const int n : {16, 32, 64, 128}) {
    const RowCurve curve(rows_of(y, even_places(0, 3, n)));
    double e = 0, f = 0;
    for (double x = 0; x < 3; x += 1e-3) {
      e = std::max(e, std::abs(curve.at(x).value - y(x)));
      f = std::max(f, std::abs(curve.at(x).second - second(x)));
    }
    of_y.push_back(e);
    of_second.push_back(f);
  }
  for (std::size_t i = 0; i + 1 < of_y.size(); ++i) {
    EXPECT_GT(std::log2(of_y[i] / of_y[i + 1]), 3.6);
    EXPECT_GT(std::log2(of_second[i] / of_second[i + 1]), 1.7);
  }
}

TEST(RowCurve, DoesNotTurnBackWhereRowsRiseAndWaitsWhereTheyAreEqual) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> step(0, 1);
  for (int i = 0; i < 300; ++i) {
    Rows rows = {{0, 0}};
    for (int k = 0; k < 12; ++k) {
      const double rise = step(random) < 0.3 ? 0 : std::pow(step(random), 6);
      rows.emplace_back(rows.back().first + 0.01 + std::pow(step(random), 4), rows.back().second + rise);
    }
    for (const RowJoin join : {RowJoin::smooth, RowJoin::smooth_at_rest}) {
      const RowCurve curve(rows, join);
      for (double x = 0; x < rows.back().first; x += rows.back().first / 2000)
        EXPECT_GE(curve.at(x).slope, -1e-11) << i;
      for (std::size_t k = 0; k + 1 < rows.size(); ++k)
        if (rows[k].second == rows[k + 1].second)
          EXPECT_EQ(curve.at((rows[k].first + rows[k + 1].first) / 2).value, rows[k].second);
      EXPECT_LT(jump(curve, &RowCurve::Point::slope), 1e-6);
    }
  }
}

TEST(RowCurve, StaysWithinItsBounds) {
  const Rows turns = {{0, 1}, {1, 20}, {1.5, 18}},
             falls = {{0, 1}, {1, 20}, {1.3, 5}, {2, 1}, {4, 0}, {5, 3}};
  EXPECT_GT(RowCurve(turns).largest(), 20.1);
  EXPECT_LT(RowCurve(falls).least(), -0.01);
  for (const Rows& rows : {turns, falls}) {
    const RowCurve within(rows, RowJoin::smooth, {0, 20});
    EXPECT_EQ(within.largest(), 20);
    EXPECT_GE(within.least(), 0);
    EXPECT_LT(jump(within, &RowCurve::Point::slope), 1e-12);
  }
}

TEST(RowCurve, WaitsBetweenAWayOutAndAWayBack) {
  const RowCurve curve({{0, 1}, {2, 5}, {4, 5}, {6, 1}});
  EXPECT_EQ(curve.at(3).value, 5);
  EXPECT_EQ(curve.largest(), 5);
}

TEST(RowCurve, IsSmoothUpToWhereItIsFixed) {
  // From rest, and to rest, by a polynomial of degree 5.
  const auto y = [](double x) { return x < 1 ? x * x * x * (10 - 15 * x + 6 * x * x) : 1; };
  std::vector<double> places = even_places(0, 1, 20);
  places.push_back(1.5);
  const RowCurve curve(rows_of(y, places));
  for (double x = 0.05; x < 0.95; x += 0.01)
    EXPECT_NEAR(curve.at(x).second, 60 * x - 180 * x * x + 120 * x * x * x, 0.15) << x;
  EXPECT_EQ(curve.at(1.2).value, 1);
  EXPECT_EQ(curve.largest(), 1);
}

TEST(RowCurve, RestsAtBothEndsIfAsked) {
  const RowCurve curve({{0, 0}, {1, 1}, {2, 4}}, RowJoin::smooth_at_rest);
  EXPECT_EQ(curve.at(0).slope, 0);
  EXPECT_EQ(*curve.slopes_at(2), std::pair(0.0, 0.0));
  EXPECT_LT(jump(curve, &RowCurve::Point::second), 1e-12);
}

TEST(RowCurve, StraightLinesJumpInTheirSlope) {
  const RowCurve curve({{0, 0}, {1, 2}, {3, 2}}, RowJoin::linear);
  EXPECT_EQ(curve.at(0.25).value, 0.5);
  EXPECT_EQ(*curve.slopes_at(1), std::pair(2.0, 0.0));
  EXPECT_FALSE(curve.slopes_at(0.5));
  EXPECT_TRUE(curve.bends_at(1));
  EXPECT_EQ(curve.steepest(), 2);
}

TEST(RowCurve, KnowsItsExtremes) {
  const RowCurve curve(rows_of([](double x) { return x * x * x - x; }, {-1.2, -0.9, -0.2, 0.4, 1.0, 1.2}));
  const double at = std::sqrt(1 / 3.0), height = 2 * at / 3;
  EXPECT_NEAR(curve.largest(), 1.2 * 1.2 * 1.2 - 1.2, 1e-13);
  EXPECT_NEAR(curve.steepest(), 3 * 1.44 - 1, 1e-12);
  const RowCurve part(rows_of([](double x) { return x * x * x - x; }, {-1, -0.9, -0.2, 0.4, 1.0}));
  EXPECT_NEAR(part.largest(), height, 1e-12);
  EXPECT_NEAR(part.least(), -height, 1e-12);
}

TEST(RowCurve, RefusesRowsThatDoNotIncrease) {
  EXPECT_THROW(RowCurve({{1, 0}, {1, 1}}), std::invalid_argument);
  EXPECT_THROW(RowCurve(Rows{}), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
