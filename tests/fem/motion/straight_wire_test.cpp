#include <gtest/gtest.h>

#include <memory>
#include <numbers>

#include "fem/motion/rest/resting_place.h"
#include "fem/system/beam_system.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
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

// A moment in space has no energy, and the rolled rod no stable equilibrium: the search for one must not cost
// more than some times the answer. It took 4558 tangents once.
TEST(RolledRod, ASearchForAStableStateIsBounded) {
  ModelBuilder builder(3);
  BeamProperties rod(1e4, 0, 0.01);
  rod.sections = SectionStiffness{100, 100, 0, 100, 1e-4};
  builder.add_beam(ReferenceCurve({testing::line_cubic({0, 0, 0}, {10, 0, 0})}, 3).oriented({}), rod, {20});
  builder.clamp(0, 0).force(0, 10, {0, 0, 5}).moment(0, 10, {0, 0, 20 * std::numbers::pi});
  MeshedState at = MeshedState::drawn(std::make_shared<const BeamModel>(builder.build()));
  int tangents = 0;
  const RestReport report = find_rest(at, {}, [&] { return ++tangents < 0; });
  ASSERT_FALSE(report.failure);
  EXPECT_TRUE(report.diverges);
  EXPECT_LT(tangents, 3000);
  const Eigen::Vector3d tip = material_point(*at.system, at.state, 0, 10).r;
  EXPECT_NEAR((tip - Eigen::Vector3d(0.410418, 0.053828, -1.096506)).norm(), 0, 5e-4);
}

}  // namespace
}  // namespace nurbeam
