// The mismatch that decides on the number of elements, against known answers: it is met, and it says how
// large the error of positions is.

#include "fem/motion/rest/adapted_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "pipelines/verification/models.h"
#include "pipelines/verification/verify_oracles.h"
#include "solver/rest/static_equilibrium.h"

namespace nurbeam {
namespace {

using namespace verification;
using std::numbers::pi;

BeamModel cantilever(double ratio) {
  BeamModel model = one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {ratio, 1, 1}, 4, {{0, true}});
  model.gravity.setZero();
  return model;
}

Eigen::Vector2d tip_at_rest(const BeamModel& model) {
  const BeamSystem system(model);
  State state = drawn_state(system);
  EXPECT_EQ(find_static_equilibrium({}, system, state).status, StaticStatus::converged);
  return material_point(system, state, 0, model.beams[0].curve.length()).r.head<2>();
}

constexpr double tolerances[] = {1e-4, 1e-5, 1e-6, 1e-7};

/// The error of the tip, which the adapted mesh shall bring within the tolerance, and not to nothing.
void expect_met(BeamModel model, double tolerance, const Eigen::Vector2d& exact) {
  const AdaptedMesh adapted = adapt_mesh(model, {tolerance}, 1000);
  EXPECT_TRUE(adapted.reached && adapted.from_equilibrium);
  EXPECT_LE(adapted.error, tolerance);
  const double error = (tip_at_rest(model) - exact).norm() / model.beams[0].curve.length();
  EXPECT_LT(error, tolerance);
  EXPECT_GT(error, 0.1 * tolerance) << model.beams[0].home_intervals() << " elements";
}

TEST(AdaptedMesh, OfALoadedCantileverMeetsItsTolerance) {
  for (const double ratio : {1e4, 1e8})
    for (const double load : {1.0, 10.0})
      for (const double tolerance : tolerances) {
        BeamModel model = cantilever(ratio);
        add_force(model, {0, -load, 0}, 1);
        const Tip exact = stretching_elastica_tip(ratio, load);
        expect_met(model, tolerance, {exact.x, exact.y});
      }
}

TEST(AdaptedMesh, OfAnUnevenlyDrawnCantileverMeetsItsTolerance) {
  // A line whose parameter runs thirty times as fast at its end as at its start, and one with weights.
  Eigen::Matrix4d slow_start = line_cubic({0, 0, 0}, {1, 0, 0}).points(), weights = slow_start;
  slow_start.row(0) << 0, 0.02, 0.04, 1;
  weights.row(0) << 0, 0.2, 0.1, 1;
  weights.row(3) << 1, 2, 0.5, 1;
  for (const Eigen::Matrix4d& drawn : {slow_start, weights})
    for (const double tolerance : tolerances) {
      BeamModel model = one_beam({RationalCubic(drawn)}, 2, {1e6, 1, 1}, 4, {{0, true}});
      model.gravity.setZero();
      add_force(model, {0, -0.1, 0}, 1);
      const AdaptedMesh adapted = adapt_mesh(model, {tolerance}, 1000);
      EXPECT_TRUE(adapted.reached);
      const Tip exact = stretching_elastica_tip(1e6, 0.1);
      const double error = (tip_at_rest(model) - Eigen::Vector2d(exact.x, exact.y)).norm();
      EXPECT_LT(error, tolerance);
      EXPECT_GT(error, 0.02 * tolerance) << model.beams[0].home_intervals() << " elements";
    }
}

TEST(AdaptedMesh, OfABeamRolledUpMeetsItsTolerance) {
  for (const double tolerance : tolerances) {
    BeamModel model = cantilever(1e8);
    add_moment(model, {0, 0, 2 * pi}, 1);
    expect_met(model, tolerance, {0, 0});
  }
}

TEST(AdaptedMesh, GivesTheSegmentThatBendsMoreElements) {
  // Clamped in the middle; only the right half is loaded.
  BeamModel model =
      one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {1e6, 1, 1}, 4, {{0, false}, {0.5, true}});
  model.gravity.setZero();
  add_force(model, {0, -20, 0}, 1);
  adapt_mesh(model, {1e-6}, 1000);
  int left = 0, right = 0;
  for (const HomeNode& node : model.beams[0].home) ++(node.s < 0.5 ? left : right);
  EXPECT_EQ(left, 2);
  EXPECT_GT(right, 6);
}

TEST(AdaptedMesh, WithoutEquilibriumIsJudgedByTheDrawing) {
  // Nothing holds it.
  BeamModel model = one_beam(arc_cubics({0, 1, 0}, 1, -pi / 2, pi / 2, 2), 2, {1e6, 1, 1}, 4, {});
  const AdaptedMesh adapted = adapt_mesh(model, {1e-5}, 1000);
  EXPECT_FALSE(adapted.from_equilibrium);
  const double l = pi / model.beams[0].home_intervals();
  EXPECT_LE(2.5 * std::pow(l, 4) / 560, 1e-5);
}

TEST(AdaptedMesh, StopsAtTheMostElements) {
  BeamModel model = cantilever(1e6);
  add_force(model, {0, -10, 0}, 1);
  EXPECT_FALSE(adapt_mesh(model, {1e-9}, 20).reached);
  EXPECT_LE(model.beams[0].home_intervals(), 20);
}

TEST(AdaptedMesh, EndsWhereItIsInterrupted) {
  BeamModel model = cantilever(1e6);
  add_force(model, {0, -10, 0}, 1);
  int asked = 0;
  const AdaptedMesh adapted = adapt_mesh(model, {1e-9}, 1000, [&] { return ++asked == 3; });
  EXPECT_TRUE(adapted.interrupted);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace nurbeam
