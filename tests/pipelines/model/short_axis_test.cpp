// A short axis of degree 5 is as near to its curve, for its length, as a long one.

#include <gtest/gtest.h>

#include "pipelines/model/beam_axis.h"

namespace nurbeam {
namespace {

TEST(ApproximationTolerance, IsAPartOfTheLengthOfShortAxes) {
  CaseBeam beam;
  EXPECT_DOUBLE_EQ(approximation_tolerance(beam, 100), 1e-6);
  EXPECT_DOUBLE_EQ(approximation_tolerance(beam, 5e-4), 5e-10);
  beam.approximation_tolerance = 1e-5;
  EXPECT_DOUBLE_EQ(approximation_tolerance(beam, 5e-4), 1e-5);
}

}  // namespace
}  // namespace nurbeam
