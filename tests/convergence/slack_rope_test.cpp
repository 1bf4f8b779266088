// Slack ropes in motion beside chains of masses and springs.

#include <gtest/gtest.h>

#include "pipelines/verification/falling_chain.h"

namespace nurbeam {
namespace {

using verification::falling_chain;
using verification::FallingChain;

TEST(SlackRope, FallsAsMassesAndSpringsDoWithoutFolding) {
  const FallingChain coarse = falling_chain(40, 1.3), fine = falling_chain(80, 1.3);
  EXPECT_LT(fine.at_0_6, 1e-3);
  EXPECT_GT(coarse.at_0_6, 4 * fine.at_0_6);  // of second order at least
  EXPECT_LT(fine.at_1_2, 1e-2);
  EXPECT_LT(coarse.at_1_2, 0.04);
  EXPECT_GT(coarse.least_slope, 0.6);
  EXPECT_GT(fine.least_slope, 0.6);
}

// Chains of 400 and 800 masses: 4.37 and 4.20 m.
TEST(SlackRope, ThatBucklesRecoilsAsMassesAndSpringsDo) {
  for (const int elements : {20, 40}) {
    const verification::Recoil found = verification::recoil(elements);
    EXPECT_NEAR(found.end_x, 4.2, 0.25) << elements;
    EXPECT_GT(found.least_slope, 0.35) << elements;
  }
}

}  // namespace
}  // namespace nurbeam
