// The pendulum of the subdivision paper by its own equations as printed.

#include "pipelines/papers/printed_pendulum.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

// Without the metric of the drawing, the program's own elements are those of the paper.
TEST(PrintedPendulum, WithTheSpatialCurvatureSwingsAsTheProgramsElementsWithoutMetric) {
  for (const PendulumArc arc : {PendulumArc::uniform, PendulumArc::paper}) {
    const PrintedMotion printed =
        printed_pendulum_motion({.arc = arc, .elements = 4, .curvature = PrintedCurvature::spatial});
    const PendulumMotion own =
        pendulum_motion({.arc = arc, .elements = 4, .metric = false}, ExplicitRungeKutta{}, 5e-4);
    ASSERT_TRUE(printed.complete());
    EXPECT_LT(largest_difference_in_AB(printed.AB, own.AB), 1e-6);
    EXPECT_LT(largest_difference_in_AB(printed.fall, own.fall), 1e-6);
  }
}

// An independent program of Eqs. 20-24 with 8 elements, eight Gauss points in each, and steps of 0.5 ms:
// |AB| 0.4854 m at 0.4 s and 0.376 m at 1 s with Eq. 23; 0.5048 and 0.533 m with the spatial curvature.
TEST(PrintedPendulum, IsThatOfAnIndependentProgram) {
  const PrintedMotion second = printed_pendulum_motion({.panels = 2});
  ASSERT_TRUE(second.complete());
  EXPECT_NEAR(second.AB[40], 0.4854, 0.004);  // other points see other places without curvature
  // At 1 s they see others, and round-off is seen: 0.360 to 0.373 m with other steps and numbers of points.
  EXPECT_NEAR(second.AB[100], 0.376, 0.02);
  EXPECT_GT(second.energy_departure, 0.02);
  const PrintedMotion spatial = printed_pendulum_motion({.curvature = PrintedCurvature::spatial});
  EXPECT_NEAR(spatial.AB[40], 0.5048, 6e-5);
  EXPECT_NEAR(spatial.AB[100], 0.533, 6e-4);
  EXPECT_LT(spatial.energy_departure, 1e-6);
}

TEST(PrintedPendulum, StopsWhereItLosesAllBounds) {
  EXPECT_FALSE(printed_pendulum_motion({.elements = 16, .step = 2e-3}).complete());
}

}  // namespace
}  // namespace nurbeam
