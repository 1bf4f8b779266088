#include "solver/algebra/side_by_side.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace nurbeam {
namespace {

TEST(Alongside, HasDoneItsWorkWhereItIsFinished) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Alongside alongside;
    int sum = 0;
    for (int i = 1; i <= 100; ++i) {
      int next = 0;
      alongside.add([&next, &sum, i] { next = sum + i; });
      alongside.finish();
      sum = next;
    }
    EXPECT_EQ(sum, 5050) << threads;
  }
}

TEST(Alongside, DoesOnePieceAfterAnother) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Alongside alongside;
    std::vector<int> order;
    for (int i = 0; i < 1000; ++i) alongside.add([&order, i] { order.push_back(i); });
    alongside.finish();
    ASSERT_EQ(order.size(), 1000) << threads;
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end())) << threads;
  }
}

TEST(Alongside, LeavesWhatFollowsAProblem) {
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Alongside alongside;
    int count = 0;
    for (int i = 0; i < 10; ++i)
      alongside.add([&count, i] {
        if (i == 3) throw std::runtime_error("a reason");
        ++count;
      });
    EXPECT_THROW(alongside.finish(), std::runtime_error);
    EXPECT_EQ(count, 3) << threads;
  }
}

TEST(Alongside, ThrowsOnWhatItsWorkThrows) {
  Alongside alongside;
  alongside.add([] { throw std::runtime_error("a reason"); });
  EXPECT_THROW(alongside.finish(), std::runtime_error);
  std::atomic<bool> done = false;
  alongside.add([&] { done = true; });
  alongside.finish();
  EXPECT_TRUE(done);
}

TEST(Alongside, LeavesNothingUnderWay) {
  std::atomic<bool> is_there = true, was_gone = false;
  {
    Alongside alongside;
    alongside.add([&] {
      for (int i = 0; i < 1000; ++i) was_gone = was_gone || !is_there;
    });
  }
  is_there = false;
  EXPECT_FALSE(was_gone);
}

}  // namespace
}  // namespace nurbeam
