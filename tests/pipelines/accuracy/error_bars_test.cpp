#include "pipelines/accuracy/error_bars.h"

#include <gtest/gtest.h>

#include <cmath>

#include "pipelines/accuracy/accuracy_table.h"
#include "pipelines/accuracy/event_order.h"

namespace nurbeam {
namespace {

HistoryColumn column(const std::string& of, const std::string& name, const std::string& quantity,
                     const std::string& unit) {
  return {of, 0, name, quantity, unit, {}, {}};
}

/// A run of columns x, y of one place and a force, at times 0, 1, 2, ...
LevelNumbers run_of(int level, const std::vector<std::vector<double>>& rows) {
  LevelNumbers run{
      .level = level, .elements = 10L << (level + 2), .steps = 100L << (level + 2), .rows = rows};
  run.done = true;
  for (std::size_t i = 0; i < rows.size(); ++i) run.times.push_back(static_cast<double>(i));
  run.end = run.times.back();
  return run;
}

AccuracyModel model_of(bool moves, const std::vector<HistoryColumn>& columns) {
  AccuracyModel model{.moves = moves, .quantities = history_quantities(columns), .has_jumps = {}};
  model.has_jumps.assign(model.quantities.size(), false);
  return model;
}

const std::vector<HistoryColumn> place_and_force = {column("probe", "tip", "x", "m"),
                                                    column("probe", "tip", "y", "m"),
                                                    column("probe", "tip", "axial_force", "N")};

TEST(Quantities, ComponentsOfAPlaceAreOne) {
  const auto quantities = history_quantities(place_and_force);
  ASSERT_EQ(quantities.size(), 2U);
  EXPECT_EQ(quantities[0].columns, (std::vector<std::size_t>{0, 1}));
  EXPECT_TRUE(is_position(quantities[0]));
  EXPECT_EQ(quantities[1].kind, "sections [N]");
  EXPECT_EQ(quantity_of_extreme(quantities, "tip.axial_force"), 1U);
  EXPECT_FALSE(quantity_of_extreme(quantities, "top.axial_force"));
}

TEST(ErrorBars, OfMotionNeverFallInTime) {
  const LevelNumbers fine = run_of(0, {{0, 0, 5}, {1, 1, 6}, {1, 0, 5}}),
                     coarse = run_of(-1, {{0, 0, 5}, {1, 1.2, 6}, {1, 0, 5}});
  const AccuracyModel model = model_of(true, place_and_force);
  const ErrorBars bars(model, {&fine, &coarse}, fine);
  EXPECT_NEAR(bars.fine(0, 0), 1e-7, 1e-10);
  EXPECT_NEAR(bars.fine(0, 1), 1.25 * 0.2 + 1e-7, 1e-10);
  EXPECT_NEAR(bars.fine(0, 2), 1.25 * 0.2 + 1e-7, 1e-10);
  EXPECT_NEAR(bars.fine(1, 2), 6e-7, 1e-12);
}

TEST(ErrorBars, WhatIsZeroInBothRunsHasNone) {
  const LevelNumbers fine = run_of(0, {{1, 1, 0}}), coarse = run_of(-1, {{1, 1, 0}});
  const AccuracyModel model = model_of(true, place_and_force);
  const ErrorBars bars(model, {&fine, &coarse}, fine);
  EXPECT_EQ(bars.fine(1, 0), 0);
  EXPECT_GT(bars.fine(0, 0), 0);
}

TEST(ErrorBars, OfACoarserOwnRunAreLarger) {
  const LevelNumbers fine = run_of(1, {{1, 0, 5}}), own = run_of(0, {{1, 0.1, 5}});
  const AccuracyModel model = model_of(true, place_and_force);
  const ErrorBars bars(model, {&fine, &own}, own);
  EXPECT_NEAR(bars.own(0, 0), 1.5 * 0.1 + 1e-7, 1e-10);
}

// 1 + h^p with h halved twice: a Richardson estimate with the order that it has, times 1.5.
TEST(ErrorBars, OfStaticsHaveTheOrderOfThreeRuns) {
  for (const double p : {1.0, 2.0, 3.0}) {
    const double error = std::pow(0.25, p), first = std::pow(0.5, p) - error, second = 1 - std::pow(0.5, p);
    EXPECT_NEAR(bounded_order_error(first, second, p == 1) / error, 1.5, 1e-12) << p;
  }
  EXPECT_NEAR(bounded_order_error(1e-6, 1, false), 1.5 * 0.125 / 7, 1e-12) << "never more than order 3";
  EXPECT_NEAR(bounded_order_error(1, 1, false), 1.5 / (std::sqrt(2.0) - 1), 1e-12) << "nor less than 1/2";
  EXPECT_NEAR(bounded_order_error(1e-6, 1, true), 1.5 * 0.5, 1e-12) << "across a jump order 1";
  EXPECT_NEAR(bounded_order_error(2, std::nullopt, false), 3, 1e-12);
}

TEST(Events, AreComparedInTheirOrder) {
  LevelNumbers one = run_of(0, {{0, 0, 0}}), other = one;
  one.events = {{.time = 1, .kind = EventKind::hits_stop, .body = 0},
                {.time = 2, .kind = EventKind::left_beam, .body = 0}};
  other.events = one.events;
  EXPECT_FALSE(time_of_other_events(one, other));
  other.events.pop_back();
  EXPECT_EQ(common_events(one, other), 1U);
  EXPECT_EQ(time_of_other_events(one, other), 2);
  EXPECT_EQ(names_of_events({one.events[0], one.events[0]}, {"mass"}),
            (std::vector<std::string>{"mass hits a stop", "mass hits a stop (2)"}));
}

TEST(AccuracyTable, SaysWhatIsNotConvergedAndWhenRunsPart) {
  const LevelNumbers fine = run_of(0, {{1, 0, 5}, {1, 0, 5}, {1, 0, 5}}),
                     coarse = run_of(-1, {{1, 0, 5}, {0.99, 0, 5}, {0.4, 0.5, 5}});
  AccuracyQuestion question{.model = model_of(true, place_and_force), .columns = place_and_force};
  const AccuracyTable table(question, {&fine, &coarse}, fine);
  const Accuracy& accuracy = table.accuracy();
  EXPECT_EQ(accuracy.parted, 2);
  ASSERT_EQ(accuracy.numbers.size(), 3U);
  EXPECT_NE(accuracy.numbers[0].not_converged.find("the runs part from t = 2 s on"), std::string::npos);
  EXPECT_EQ(accuracy.numbers[2].not_converged, "");
}

TEST(AccuracyTable, FindsRunsThatHardlyDifferInSteps) {
  LevelNumbers fine = run_of(0, {{1, 0, 5}}), coarse = run_of(-1, {{1, 0, 5}});
  coarse.steps = fine.steps;
  AccuracyQuestion question{.model = model_of(true, place_and_force), .columns = place_and_force};
  const AccuracyTable table(question, {&fine, &coarse}, fine);
  EXPECT_NE(table.accuracy().numbers[0].not_converged, "");
}

TEST(AccuracyQuestion, NamesNumbersThatTheCaseCanHave) {
  AccuracyQuestion question{.model = model_of(true, place_and_force), .columns = place_and_force};
  question.bodies = {"mass"};
  question.of = {"tip.x", "max(tip.y)", "mass left the beam", "mass sticks (2)", "tip.w"};
  EXPECT_EQ(unknown_numbers(question, false), std::vector<std::string>{"tip.w"});
}

}  // namespace
}  // namespace nurbeam
