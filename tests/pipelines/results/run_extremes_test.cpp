#include "pipelines/results/run_extremes.h"

#include <gtest/gtest.h>

namespace nurbeam::of_run_extremes {
namespace {

Snapshot state(double time, double stress, std::optional<double> layer) {
  Snapshot frame;
  frame.time = time;
  frame.beams.resize(1);
  frame.beams[0].stress_max = {stress, 2.5, layer};
  return frame;
}

const RunExtreme& stress_of(const RunExtremes& extremes) {
  for (const RunExtreme& each : extremes.list())
    if (each.quantity == "rope.stress.max") return each;
  throw std::out_of_range("rope.stress.max");
}

// A run that is continued knows as much of its stress as one in a piece.
TEST(RunExtremes, KnowAfterARestartThatAStressIsThatOfALayer) {
  SnapshotNames names;
  names.beams = {"rope"};
  RunExtremes before;
  before.look_at(state(0.5, 4e8, 0.03), names);
  RunExtremes after(before.numbers());
  after.look_at(state(1, 1e8, std::nullopt), names);
  EXPECT_EQ(stress_of(after).value, 4e8);
  EXPECT_EQ(stress_of(after).time, 0.5);
  EXPECT_EQ(stress_of(after).layer, 0.03);
  RunExtremes beside(before.numbers());
  beside.look_at(state(1, -5e8, std::nullopt), names);
  EXPECT_EQ(stress_of(beside).layer, std::nullopt);
}

}  // namespace
}  // namespace nurbeam::of_run_extremes
