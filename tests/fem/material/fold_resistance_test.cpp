#include "fem/material/fold_resistance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace nurbeam {
namespace {

using Pair = std::array<double, 2>;

double energy(const BeamProperties& beam, const Pair& e) { return FoldStresses<double>(beam, 1, e).energy; }

TEST(FoldResistance, ActsBeyondItsRadiusAlone) {
  const BeamProperties beam(300, 1, 1);
  for (const double part : {0.0, 0.5, 0.999}) {
    const Pair e{0, part * FoldResistance::r_0 / std::sqrt(FoldResistance::of_4)};
    const FoldStresses<double> none(beam, 1, e);
    EXPECT_EQ(none.energy, 0);
    EXPECT_EQ(none.force, (Pair{0, 0}));
    EXPECT_EQ(none.stiffness[1], (Pair{0, 0}));
  }
  // zeta/2 EA (R - r_0)^2
  const Pair e{0.14 / std::sqrt(FoldResistance::of_3), 0};
  EXPECT_NEAR(energy(beam, e), 0.25 * 300 * 0.01, 1e-14);
  EXPECT_NEAR(FoldStresses<double>(beam, 0.3, e).energy, 0.3 * energy(beam, e), 1e-14);
}

TEST(FoldResistance, HasTheDerivativesOfItsEnergy) {
  const BeamProperties beam(300, 1, 1, 0.1);
  const Pair e{0.08, -0.15}, rate{0.3, 0.7};
  const FoldStresses<double> at(beam, 0.7, e);
  for (const std::size_t i : {0, 1}) {
    const double h = 1e-5;
    Pair more = e, less = e;
    more[i] += h;
    less[i] -= h;
    const FoldStresses<double> above(beam, 0.7, more), below(beam, 0.7, less);
    EXPECT_NEAR(at.force[i], (above.energy - below.energy) / (2 * h), 1e-7);
    for (const std::size_t j : {0, 1}) {
      EXPECT_NEAR(at.stiffness[j][i], (above.force[j] - below.force[j]) / (2 * h), 1e-6);
      EXPECT_NEAR(at.viscous_force_by_e(rate)[j][i],
                  (above.viscous_force(rate)[j] - below.viscous_force(rate)[j]) / (2 * h), 1e-6);
      EXPECT_NEAR(at.viscosity()[j][i] * rate[i], i == j ? at.viscous_force(rate)[j] : 0, 1e-13);
    }
  }
  EXPECT_GT(at.viscous_force(rate)[0] * rate[0], 0);
}

}  // namespace
}  // namespace nurbeam
