#include <gtest/gtest.h>

#include <array>

#include "fem/system/initial_state.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "tests/support/ida/ida_integrator.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

// A soft clamped beam with a sliding mass, over a time without event.
TEST(TwoIntegrators, ApproachEachOtherOnABeamWithASlidingMassAsGeneralizedAlphaIsRefined) {
  BeamModel model =
      testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {60, 0.5, 2, 0, {}}, 4, {{0, true}});
  testing::add_slider(model, 0.8, 0.4);
  model.riders[0].speed = 0.2;
  const BeamSystem system(model, initial_plan(model));
  State start = drawn_state(system);
  start_moving(system, start);
  ASSERT_EQ(make_accelerations_consistent(system, start), ConsistencyStatus::done);
  const double end = 0.1;
  IdaIntegrator ida({.tolerance = 1e-9}, system, start);
  ASSERT_EQ(ida.advance(end).status, StepStatus::converged);
  EXPECT_LT(ida.internal_steps(), 2000);
  const State& one = ida.state();
  std::array<Eigen::Array3d, 3> apart;
  for (std::size_t i = 0; i < apart.size(); ++i) {
    GeneralizedAlphaIntegrator alpha({.rho_infinity = 0.6, .newton_tolerance = 1e-12}, system, start);
    const int steps = 300 << (2 * i);
    for (int k = 0; k < steps; ++k) ASSERT_EQ(alpha.advance(end / steps).status, StepStatus::converged);
    const State& other = alpha.state();
    apart[i] = {(one.q - other.q).norm(), (one.v - other.v).norm(), (one.lambda - other.lambda).norm()};
    if (i > 0) EXPECT_TRUE((apart[i] < apart[i - 1] / 10).all()) << apart[i].transpose();
  }
  EXPECT_TRUE((apart.back() < Eigen::Array3d(1e-6, 5e-4, 2e-4)).all()) << apart.back().transpose();
}

}  // namespace
}  // namespace nurbeam
