#include <gtest/gtest.h>

#include <numbers>

#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "solver/rest/static_equilibrium.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

// The finer the mesh, the further the first of Newton's steps leads astray, and the more of the residual is
// round-off: neither takes steps of load, nor more of Newton than a search that leads astray may take.
TEST(StraightWire, HangsAfterOneMoreTrialOnAnyMesh) {
  const double area = std::numbers::pi * 1e-4, second_moment = std::numbers::pi * 1e-8 / 4;
  for (const int elements : {100, 500, 1000, 2000, 3000}) {
    BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {1000, 0, 0})}, 2,
                                        BeamProperties(1e11 * area, 1e11 * second_moment, 7800 * area),
                                        elements, {{0, false}, {1000, false}});
    model.gravity = {0, -9.81, 0};
    const BeamSystem system(model);
    State state = drawn_state(system);
    const StaticReport report = find_static_equilibrium({}, system, state);
    EXPECT_EQ(report.status, StaticStatus::converged) << elements;
    EXPECT_LE(report.load_steps, 2) << elements;
    EXPECT_LE(report.newton_iterations, 150) << elements;
  }
}

}  // namespace
}  // namespace nurbeam
