// What is found for a motion beside another one, against what is found for it alone.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "fem/system/beam_system.h"
#include "fem/system/observables.h"
#include "fem/system/same_elements.h"
#include "solver/system/consistent.h"
#include "solver/tangents/start_tangent.h"
#include "tests/fem/random_models.h"
#include "tests/fem/torsion_models.h"

namespace nurbeam {
namespace {

using testing::cornered_model;
using testing::disturbed_state;
using testing::joined_model;
using testing::model_with_everything;
using testing::torsion_model;

/// Somewhere off a state: places of joints stay in their elements.
State direction_at(const State& state, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  State direction = state;
  for (Eigen::VectorXd* each : {&direction.q, &direction.v, &direction.a, &direction.lambda})
    for (double& x : *each) x = unit(random);
  return direction;
}

State moved_along(const State& state, const State& direction, double by) {
  State moved = state;
  moved.q += by * direction.q;
  moved.v += by * direction.v;
  moved.a += by * direction.a;
  moved.lambda += by * direction.lambda;
  return moved;
}

Eigen::VectorXd bound_accelerations(const BeamSystem& system, const State& state, const Eigen::VectorXd& a) {
  return system.constraint_product(state, a) + system.constraint_curvature(state);
}

// Differences of what make_accelerations_smooth finds, or balance_accelerations from others, tend to the
// tangent with the square of their step.
void check_start(const BeamSystem& system, const std::optional<std::vector<int>>& around, State start,
                 std::mt19937& random) {
  const bool is_local = around && !around->empty();
  const double h = is_local ? 1e-6 : 1e-3;
  ASSERT_EQ(project_velocities(system, start).status, ConsistencyStatus::done);
  ASSERT_EQ(make_accelerations_smooth(system, around ? 0 : h, start), ConsistencyStatus::done);
  State direction = direction_at(start, random);
  // Near a change all else is in balance, and stays so.
  if (is_local)
    for (Eigen::VectorXd* each : {&direction.q, &direction.v, &direction.a}) {
      const Eigen::VectorXd all = std::exchange(*each, Eigen::VectorXd::Zero(each->size()));
      for (const int i : *around)
        if (i < all.size()) (*each)[i] = all[i];
    }
  if (is_local) direction.lambda.setZero();
  if (around)
    for (const int i : *around)
      if (i < start.a.size()) start.a[i] *= 0.7;
  const auto found = [&](double by) {
    State moved = moved_along(start, direction, by);
    NearSolver solver;
    if (!around) {
      EXPECT_EQ(make_accelerations_smooth(system, h, moved), ConsistencyStatus::done);
      return moved;
    }
    const Balance balance = balance_accelerations(system, h, *around, solver, moved);
    EXPECT_EQ(balance.status, ConsistencyStatus::done);
    EXPECT_EQ(balance.near, is_local);
    return moved;
  };
  const State at = found(0);
  const Eigen::Index n = at.q.size(), m = at.lambda.size();
  constexpr double small = 1e-6;
  MotionTangents::Matrix curvature(m, 1);
  curvature << (bound_accelerations(system, moved_along(at, direction, small), at.a) -
                bound_accelerations(system, moved_along(at, direction, -small), at.a)) /
                   (2 * small);
  MotionTangents tangents = MotionTangents::zero(n, m, 1);
  tangents.start_afresh(0, direction);
  const StartTangent tangent =
      around ? StartTangent(system, h, *around, start.a, at) : StartTangent(system, h, at);
  ASSERT_TRUE(tangent.regular());
  tangent.find(MotionTangents::Matrix::Zero(n, 1), curvature, tangents);
  // Multipliers of what is held far away are lost in round-off beside those near.
  const double of_lambda = is_local ? 0 : 1 / tangents.lambda.norm();
  const auto error = [&](double by) {
    const State more = found(by), less = found(-by);
    return ((more.a - less.a) / (2 * by) - tangents.a.col(0)).norm() / tangents.a.norm() +
           of_lambda * ((more.lambda - less.lambda) / (2 * by) - tangents.lambda.col(0)).norm();
  };
  double step = 1e-4;
  while (step > 1e-11 && error(step) > (is_local ? 3e-3 : 3e-4)) step /= 2;
  const double coarse = error(2 * step), fine = error(step);
  EXPECT_LT(fine, 3e-3);
  if (!is_local)
    EXPECT_NEAR(coarse / fine, 4, 0.5) << coarse << " " << fine << " at " << step;
  else
    EXPECT_GT((tangents.a.col(0).array() == direction.a.array()).count(), n / 2) << "those far away";
}

TEST(StartTangent, IsWhatDifferencesTendToWithTheSquareOfTheirStep) {
  for (const int dimension : {2, 3})
    for (const auto& make : {model_with_everything, joined_model, cornered_model}) {
      std::mt19937 random(70 + dimension);
      const BeamSystem system(make(random, dimension));
      const State state = disturbed_state(system, random, 1e-3);
      check_start(system, {}, state, random);
      check_start(system, std::vector<int>{}, state, random);
    }
}

TEST(StartTangent, IsOfTheUnknownsNearAChangeOfTheMeshAlone) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(80 + dimension);
    BeamModel model = testing::one_beam(testing::uneven_axis(random, dimension), dimension,
                                        {300, 2, 0.7, 0.02, {}}, 300, {{0, true}});
    testing::add_slider(model, 0.8, 0.33 * model.beams[0].curve.length());
    const BeamSystem from(model);
    MeshPlan plan = initial_plan(model);
    plan.beams[0].present.assign(plan.beams[0].present.size(), true);
    plan.beams[0].present[101] = false;
    plan.places[0] = (model.beams[0].home[100].s + model.beams[0].home[102].s) / 2;
    const auto to = from.replanned(plan);
    const std::vector<int> around = changed_unknowns(from, *to);
    ASSERT_FALSE(around.empty());
    ASSERT_FALSE(solved_near(*to, around).empty());
    check_start(*to, around, disturbed_state(*to, random, 1e-6), random);
  }
}

// One correction misses what is of second order, and of half the difference of two neighbours of third.
TEST(VelocitiesBeside, MissWhatGoesOutOfHalfTheDifference) {
  for (const int dimension : {2, 3})
    for (const auto& make : {model_with_everything, joined_model, cornered_model}) {
      std::mt19937 random(90 + dimension);
      const BeamSystem system(make(random, dimension));
      const State at = disturbed_state(system, random, 1e-3);
      const State direction = direction_at(at, random);
      const Eigen::VectorXd momentum = direction_at(at, random).q, change = direction_at(at, random).q;
      const auto alone = [&](double by) {
        State moved = moved_along(at, direction, by);
        EXPECT_EQ(velocities_from_momentum(system, momentum + by * change, moved).status,
                  ConsistencyStatus::done);
        return moved.v;
      };
      NeighbourSolver solver;
      const auto beside = [&](double by) {
        State moved = moved_along(at, direction, by);
        EXPECT_EQ(velocities_beside(system, momentum + by * change, {}, solver, moved).status,
                  ConsistencyStatus::done);
        return moved.v;
      };
      const double size = alone(0).norm();
      EXPECT_LT((beside(0) - alone(0)).norm(), 1e-10 * size);
      const auto missed = [&](double by) { return Eigen::VectorXd(beside(by) - alone(by)); };
      const auto odd = [&](double by) { return (missed(by) - missed(-by)).norm() / (2 * size); };
      constexpr double coarse = 4e-3, fine = 2e-3;
      const double ratio = missed(coarse).norm() / missed(fine).norm();
      EXPECT_NEAR(ratio, 4, 1) << missed(fine).norm() / size;
      EXPECT_NEAR(odd(coarse) / odd(fine), 8, 3) << odd(fine);
    }
}

// What is found anew of all elements is the witness, of states that differ in a single place, angle or rate.
TEST(EnergyBesideAnother, IsWhatIsFoundAnew) {
  std::mt19937 random(23);
  std::vector<BeamModel> models;
  for (const int dimension : {2, 3}) models.push_back(model_with_everything(random, dimension));
  models.push_back(torsion_model(random, 3));
  models.push_back(testing::torsion_sliding_model(random, 0.1));
  for (const BeamModel& model : models) {
    const BeamSystem system(model);
    const State first = disturbed_state(system, random);
    const SystemEnergy known = energy(system, first);
    const double round_off = 1e-12 * (known.kinetic + std::abs(known.gravity) + known.strain());
    for (Eigen::Index i = 0; i < first.q.size(); ++i)
      for (const bool moves : {false, true}) {
        State other = first;
        (moves ? other.v : other.q)[i] += 1e-3;
        const SystemEnergy carried = carried_energy(known, system, first, other),
                           anew = energy(system, other);
        EXPECT_NEAR(carried.kinetic, anew.kinetic, round_off) << i;
        EXPECT_NEAR(carried.gravity, anew.gravity, round_off) << i;
        EXPECT_NEAR(carried.strain(), anew.strain(), round_off) << i;
      }
  }
}

}  // namespace
}  // namespace nurbeam
