// What is found for a motion beside another one, against what is found for it alone.
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "fem/system/beam_system.h"
#include "fem/system/observables.h"
#include "fem/system/same_elements.h"
#include "solver/consistent.h"
#include "solver/start_tangent.h"
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
void check_start(const BeamSystem& system, bool balanced, State start, std::mt19937& random) {
  constexpr double h = 1e-3;
  constexpr TangentWeights averaged{.mass = 1, .damping = 0.6 * h, .stiffness = 0.3 * h * h};
  ASSERT_EQ(project_velocities(system, start).status, ConsistencyStatus::done);
  ASSERT_EQ(make_accelerations_smooth(system, balanced ? 0 : h, start), ConsistencyStatus::done);
  const State direction = direction_at(start, random);
  if (balanced)
    for (Eigen::VectorXd* each : {&start.a, &start.lambda})
      for (double& x : *each) x *= 0.7;
  const auto found = [&](double by) {
    State moved = moved_along(start, direction, by);
    NearSolver solver;
    EXPECT_EQ(balanced ? balance_accelerations(system, averaged, solver, moved)
                       : make_accelerations_smooth(system, h, moved),
              ConsistencyStatus::done);
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
      balanced ? StartTangent(system, averaged, start, at) : StartTangent(system, averaged_over(h), at);
  ASSERT_TRUE(tangent.regular());
  tangent.find(MotionTangents::Matrix::Zero(n, 1), curvature, tangents);
  const auto error = [&](double by) {
    const State more = found(by), less = found(-by);
    return ((more.a - less.a) / (2 * by) - tangents.a.col(0)).norm() / tangents.a.norm() +
           ((more.lambda - less.lambda) / (2 * by) - tangents.lambda.col(0)).norm() / tangents.lambda.norm();
  };
  double step = 1e-4;
  while (step > 1e-11 && error(step) > 3e-4) step /= 2;
  const double coarse = error(2 * step), fine = error(step);
  EXPECT_LT(fine, 3e-3);
  EXPECT_NEAR(coarse / fine, 4, 0.5) << coarse << " " << fine << " at " << step;
}

TEST(StartTangent, IsWhatDifferencesTendToWithTheSquareOfTheirStep) {
  for (const int dimension : {2, 3})
    for (const auto& make : {model_with_everything, joined_model, cornered_model}) {
      std::mt19937 random(70 + dimension);
      const BeamSystem system(make(random, dimension));
      const State state = disturbed_state(system, random, 1e-3);
      for (const bool balanced : {false, true}) check_start(system, balanced, state, random);
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
