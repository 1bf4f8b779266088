#include "fem/motion/remesh/relative_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/motion/remesh/balanced_nodes.h"
#include "fem/motion/remesh/new_elements.h"
#include "fem/motion/remesh/transfer.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

// A beam in flight with a body on it, and the plan without the node behind the body.
struct Flight {
  BeamModel model;
  MeshPlan full, coarse;

  Flight(std::mt19937& random, int dimension, AxialStrain strain = AxialStrain::ends_and_mean) {
    BeamProperties properties(300, 2, 0.7, 0, {});
    properties.axial_strain = strain;
    model = testing::one_beam(testing::uneven_axis(random, dimension), dimension, properties, 8, {});
    // Bent as drawn, a beam without torsion would be held by nothing in space.
    if (dimension == 3) model.beams[0].curve = model.beams[0].curve.straightened();
    const auto& home = model.beams[0].home;
    testing::add_slider(model, 0.8, home[2].s + 0.3 * (home[3].s - home[2].s));
    full = initial_plan(model);
    full.beams[0].present.assign(home.size(), true);
    coarse = full;
    coarse.beams[0].present[3] = false;
  }
};

// All of a system as it turns about the origin with a spin w, or moves on with it.
Eigen::VectorXd rigid_motion(const BeamSystem& system, const State& state, const Eigen::Vector3d& w,
                             bool turns) {
  const Mesh& mesh = system.mesh();
  const int D = mesh.dimension;
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(system.coordinate_count());
  const auto set = [&](int x, bool is_slope) {
    const Eigen::Vector3d at = vector_at(system, state.q, x);
    motion.segment(x, D) = (turns ? w.cross(at) : is_slope ? Eigen::Vector3d::Zero().eval() : w).head(D);
  };
  for (const MeshNode& node : mesh.nodes[0]) {
    set(node.r, false);
    set(node.slope_left, true);
    set(node.slope_right, true);
  }
  for (const int body : mesh.bodies) set(body, false);
  return motion;
}

// Linear or angular momentum as the rate of the kinetic energy, which is a parabola of the velocities.
double momentum_along(const BeamSystem& system, State state, const Eigen::VectorXd& motion) {
  const Eigen::VectorXd v = state.v;
  state.v = v + motion;
  const double more = energy(system, state).kinetic;
  state.v = v - motion;
  return (more - energy(system, state).kinetic) / 2;
}

TEST(RelativeMotion, GrowsWithoutMomentumAndTakesTheEnergyThatItSays) {
  std::mt19937 random(41);
  for (const int D : {2, 3})
    for (const bool splits : {true, false}) {
      const Flight flight(random, D);
      const BeamSystem coarse(flight.model, flight.coarse), full(flight.model, flight.full);
      const BeamSystem &from = splits ? coarse : full, &to = splits ? full : coarse;
      const State next = interpolated(from, testing::disturbed_state(from, random, 0.02), to);
      const RelativeMotion relative = relative_motion(from, to, next);
      ASSERT_GT(relative.kinetic, 0);
      const double kinetic = energy(to, next).kinetic;
      EXPECT_LT(relative.kinetic, kinetic);
      State twice = next;
      twice.v(relative.coordinates) += relative.velocities;
      EXPECT_NEAR(energy(to, twice).kinetic - kinetic, 3 * relative.kinetic, 1e-10 * kinetic);
      for (const bool turns : {false, true})
        for (int k = 0; k < 3; ++k) {
          if (D == 2 && turns != (k == 2)) continue;
          const Eigen::VectorXd rigid = rigid_motion(to, next, Eigen::Vector3d::Unit(k), turns);
          EXPECT_NEAR(momentum_along(to, twice, rigid), momentum_along(to, next, rigid), 1e-9 * kinetic);
        }
      const double e = -1e-4 * relative.kinetic;
      const std::optional<double> growth = relative.growth(e);
      ASSERT_TRUE(growth);
      State grown = next;
      grown.v(relative.coordinates) += *growth * relative.velocities;
      EXPECT_NEAR(energy(to, grown).kinetic - kinetic, -e, 1e-10 * kinetic);
      EXPECT_FALSE(relative.growth(-relative.kinetic / 10));  // the body would slide 5 % faster
    }
}

TEST(RelativeMotion, LeavesWhatConstraintsHold) {
  std::mt19937 random(42);
  BeamModel model = testing::joined_model(random, 3);
  const auto& home = model.beams[0].home;
  model.riders.clear();
  const int last = static_cast<int>(home.size()) - 1;
  testing::add_slider(model, 0.8, home[last].s - 0.3 * (home[last].s - home[last - 1].s));
  MeshPlan full = initial_plan(model), coarse = full;
  full.beams[0].present.assign(home.size(), true);
  coarse.beams[0].present = full.beams[0].present;
  coarse.beams[0].present[last - 1] = false;
  const BeamSystem from(model, full), to(model, coarse);
  State next = interpolated(from, testing::disturbed_state(from, random, 0.01), to);
  ASSERT_TRUE(close_constraints(to, 1e-13, next));
  ASSERT_EQ(project_velocities(to, next).status, ConsistencyStatus::done);
  const RelativeMotion relative = relative_motion(from, to, next);
  ASSERT_GT(relative.kinetic, 0);
  Eigen::VectorXd motion = Eigen::VectorXd::Zero(to.coordinate_count());
  motion(relative.coordinates) = relative.velocities;
  EXPECT_LT(to.constraint_product(next, motion).lpNorm<Eigen::Infinity>(), 1e-10 * motion.norm());
}

TEST(BalancedNodes, AreInBalanceWithTheirAccelerations) {
  std::mt19937 random(43);
  for (const int D : {2, 3}) {
    const Flight flight(random, D);
    const BeamSystem from(flight.model, flight.coarse), to(flight.model, flight.full);
    State before = testing::disturbed_state(from, random, 5e-4);
    before.v *= 0.1;
    before.a *= 0.1;
    const State on_curve = interpolated(from, before, to);
    State next = on_curve;
    balance_added_nodes(from, to, next);
    const auto residual = [&](const State& state) {
      Eigen::VectorXd dynamics(to.coordinate_count()), constraints(to.constraint_count());
      to.residual(state, dynamics, constraints);
      const NodeSet added = new_nodes(from, to);
      EXPECT_EQ(added.size(), 1U);
      const MeshNode& node = to.mesh().nodes[0][added.begin()->second];
      return Eigen::VectorXd(dynamics.segment(node.r, D)).norm() +
             dynamics.segment(node.slope_left, D).norm();
    };
    EXPECT_GT(residual(on_curve), 1e-3);
    EXPECT_LT(residual(next), 1e-9);
    const int body = to.mesh().bodies[0];
    EXPECT_EQ(next.q.segment(body, D), on_curve.q.segment(body, D));
  }
}

TEST(BalancedNodes, StayWhereTheStrainIsPointwise) {
  std::mt19937 random(44);
  const Flight flight(random, 2, AxialStrain::pointwise);
  const BeamSystem from(flight.model, flight.coarse), to(flight.model, flight.full);
  const State on_curve = interpolated(from, testing::disturbed_state(from, random, 0.005), to);
  State next = on_curve;
  balance_added_nodes(from, to, next);
  EXPECT_EQ(next.q, on_curve.q);
}

}  // namespace
}  // namespace nurbeam
