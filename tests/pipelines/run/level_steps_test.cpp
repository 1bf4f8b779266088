#include "pipelines/run/level_steps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <future>

namespace nurbeam {
namespace {

StepRecord step(double start, double end) { return {.time = end, .size = end - start}; }

TEST(LevelSteps, OfFinerRunsArePartsOfSteps) {
  LevelSteps steps({0, 4});
  steps.add(step(0, 2));
  steps.add(step(2, 4));
  steps.end();
  EXPECT_DOUBLE_EQ(steps.at(0, 1).end, 1);
  EXPECT_DOUBLE_EQ(steps.at(0, 1).length, 1);
  EXPECT_DOUBLE_EQ(steps.at(1, 1).end, 2);
  EXPECT_DOUBLE_EQ(steps.at(2, 2).end, 2.5);
  EXPECT_DOUBLE_EQ(steps.at(0, 0).end, 2);
}

TEST(LevelSteps, OfTheCoarserRunAreTwoBetweenFrames) {
  LevelSteps steps({0, 3, 4});
  for (int i = 0; i < 4; ++i) steps.add(step(i, i + 1));
  steps.end();
  EXPECT_DOUBLE_EQ(steps.at(0, -1).end, 2);
  EXPECT_DOUBLE_EQ(steps.at(2, -1).end, 3) << "the frame ends it";
  EXPECT_DOUBLE_EQ(steps.at(3, -1).end, 4);
  EXPECT_TRUE(std::isinf(steps.at(4, -1).end));
}

TEST(LevelSteps, AShortRestIsNoStepOfItsOwn) {
  LevelSteps steps({0, 4});
  for (int i = 0; i < 4; ++i) steps.add(step(i, i + 1));
  steps.end();
  EXPECT_DOUBLE_EQ(steps.at(0.9, 0).end, 2);
  EXPECT_DOUBLE_EQ(steps.at(0.7, 0).end, 1);
}

TEST(LevelSteps, WaitForTheRunThatTakesThem) {
  LevelSteps steps({0, 2});
  auto asked = std::async(std::launch::async, [&] { return steps.at(0, -1).end; });
  EXPECT_EQ(asked.wait_for(std::chrono::milliseconds(20)), std::future_status::timeout);
  steps.add(step(0, 1));
  steps.add(step(1, 2));
  EXPECT_DOUBLE_EQ(asked.get(), 2);
  steps.end();
}

TEST(LevelSteps, KnowWhetherFramesEndEachStep) {
  LevelSteps each({0, 1, 2, 3}), some({0, 4});
  for (int i = 0; i < 4; ++i) some.add(step(i, i + 1));
  for (int i = 0; i < 3; ++i) each.add(step(i, i + 1));
  each.end();
  some.end();
  EXPECT_FALSE(each.has_pairs());
  EXPECT_TRUE(some.has_pairs());
}

}  // namespace
}  // namespace nurbeam
