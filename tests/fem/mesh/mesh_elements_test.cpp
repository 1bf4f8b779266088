#include "fem/mesh/mesh_elements.h"

#include <gtest/gtest.h>

#include <cmath>

#include "fem/material/fold_resistance.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "nurbs/gauss_panels.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

// A bar of 1 m as one element, bent towards a half circle: its axial energy over EA.
double axial_energy_of_half_circle(double bending_stiffness) {
  constexpr double EA = 300;
  const BeamModel model = testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                                            {EA, bending_stiffness, 0.7}, 1, {{0, false}, {1, false}});
  const BeamSystem system(model, initial_plan(model));
  State state = drawn_state(system);
  const std::vector<MeshNode>& nodes = system.mesh().nodes[0];
  state.q.segment<2>(nodes[0].slope_right) << 0, 1;
  state.q.segment<2>(nodes[1].r) << 2 / M_PI, 0;
  state.q.segment<2>(nodes[1].slope_left) << 0, -1;
  return energy(system, state).axial / EA;
}

// R of FoldResistance, from the strain of that cubic and Legendre's polynomials.
double residue_of_half_circle() {
  const auto strain = [](double x) {
    const double along = 6 * x * (1 - x) * 2 / M_PI;
    const double across = (1 - x) * (1 - 3 * x) - x * (3 * x - 2);
    return (along * along + across * across - 1) / 2;
  };
  const auto coefficient = [&](int k) {
    return (2 * k + 1) * gauss([&](double x) { return strain(x) * std::legendre(k, 2 * x - 1); }, 0, 1);
  };
  const double e_3 = coefficient(3), e_4 = coefficient(4);
  return std::sqrt(10. / 21 * e_3 * e_3 + 14. / 45 * e_4 * e_4);
}

TEST(MeshElements, ResistFoldingWhereTheyAreSlender) {
  const double R = residue_of_half_circle();
  ASSERT_GT(R, 1.2 * FoldResistance::r_0);
  const double slender = axial_energy_of_half_circle(1e-4), stiff = axial_energy_of_half_circle(1);
  const double excess = R - FoldResistance::r_0;
  EXPECT_NEAR(slender - stiff, FoldResistance::zeta / 2 * excess * excess, 1e-12);
  EXPECT_EQ(axial_energy_of_half_circle(0), slender);
  EXPECT_EQ(axial_energy_of_half_circle(0.0031), stiff);  // EA l^2 < 1e5 EI
}

}  // namespace
}  // namespace nurbeam
