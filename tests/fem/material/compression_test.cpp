#include "fem/material/compression.h"

#include <gtest/gtest.h>

#include "fem/material/section.h"

namespace nurbeam {
namespace {

AxialPoint<double> point(double strain, const AxialLaw& law = GreenLaw()) {
  return buckling_point(law, 500.0, strain, 0, 0.01);
}

TEST(Buckling, LeavesTheLawAsItIsUpToItsLoad) {
  for (const AxialLaw& law : {AxialLaw(GreenLaw()), AxialLaw(HookeLaw())})
    for (const double strain : {0.3, 0.0, -0.0099}) {
      const AxialPoint<double> whole = axial_point(law, 500.0, strain, 0);
      EXPECT_EQ(point(strain, law).energy, whole.energy);
      EXPECT_EQ(point(strain, law).force, whole.force);
      EXPECT_EQ(point(strain, law).stiffness, whole.stiffness);
    }
}

TEST(Buckling, CarriesLittleMoreThanItsLoadUntilTheSectionIsCrushed) {
  EXPECT_NEAR(point(-0.2).force, -5 - 0.5 * 0.19, 1e-12);
  EXPECT_NEAR(point(-0.2).stiffness, 0.5, 1e-12);
  EXPECT_NEAR(point(-0.4).force, -5 - 0.5 * 0.39 - 500 * 0.1, 1e-12);
  const BeamProperties beam(500, 2, 1);  // 40 EI/l^2 = 20
  EXPECT_NEAR(500 * beam.buckling_strain(2), 20, 1e-12);
}

TEST(Buckling, HasTheDerivativesOfItsEnergy) {
  constexpr double h = 1e-6;
  for (const AxialLaw& law : {AxialLaw(GreenLaw()), AxialLaw(HookeLaw())})
    for (const double strain : {0.1, -0.005, -0.15, -0.35}) {
      const AxialPoint<double> at = point(strain, law), more = point(strain + h, law),
                               less = point(strain - h, law);
      EXPECT_NEAR(at.force, (more.energy - less.energy) / (2 * h), 1e-6);
      EXPECT_NEAR(at.stiffness, (more.force - less.force) / (2 * h), 1e-6);
    }
}

}  // namespace
}  // namespace nurbeam
