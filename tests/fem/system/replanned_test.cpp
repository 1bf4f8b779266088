#include <gtest/gtest.h>

#include <algorithm>

#include "fem/system/assembly.h"
#include "fem/system/same_elements.h"
#include "solver/system/consistent.h"
#include "solver/system/tangent_matrix.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::disturbed_state;
using testing::one_beam;
using testing::uneven_axis;

constexpr int elements = 300;

/// A clamped beam of many elements with two bodies that slide on it.
BeamModel long_beam(std::mt19937& random, int dimension) {
  BeamModel model =
      one_beam(uneven_axis(random, dimension), dimension, {300, 2, 0.7, 0.02, {}}, elements, {{0, true}});
  const double L = model.beams[0].curve.length();
  testing::add_slider(model, 0.8, 0.33 * L);
  testing::add_slider(model, 0.5, 0.8 * L);
  return model;
}

/// What length control does where the first body has gone on by one element: the node that it has hidden
/// comes back behind it, or the next one goes ahead of it, or both.
MeshPlan moved_on(const BeamModel& model, bool comes_back, bool goes) {
  MeshPlan plan = initial_plan(model);
  std::vector<bool>& present = plan.beams[0].present;
  const auto hidden = std::find(present.begin(), present.end(), false) - present.begin();
  const auto& home = model.beams[0].home;
  plan.places[0] = 0.4 * home[hidden].s + 0.6 * home[hidden + 1].s;
  if (comes_back) present[hidden] = true;
  if (goes) present[hidden + 1] = false;
  return plan;
}

template <class Check>
void for_each_change(int dimension, Check&& check) {
  std::mt19937 random(40 + dimension);
  const BeamModel model = long_beam(random, dimension);
  const BeamSystem from(model);
  for (const auto& [comes_back, goes] : {std::pair{true, true}, {true, false}, {false, true}}) {
    const MeshPlan plan = moved_on(model, comes_back, goes);
    check(from, *from.replanned(plan), BeamSystem(model, plan), random);
  }
}

Eigen::SparseMatrix<double> tangent_of(const BeamSystem& system, const State& state,
                                       const TangentWeights& w) {
  return tangent_matrix(system, state, w);
}

// (n) M v.
Eigen::VectorXd momentum_of(const BeamSystem& system, const State& state) {
  const int n = system.coordinate_count();
  return tangent_of(system, state, {.mass = 1}).topLeftCorner(n, n) * state.v;
}

// How many of them have changed.
Eigen::Index changes(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  return (a.array() != b.array()).count();
}

void expect_equal(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b) {
  ASSERT_EQ(a.rows(), b.rows());
  ASSERT_EQ(a.nonZeros(), b.nonZeros());
  EXPECT_TRUE(std::equal(a.outerIndexPtr(), a.outerIndexPtr() + a.cols() + 1, b.outerIndexPtr()));
  EXPECT_TRUE(std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()));
  EXPECT_TRUE(std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()));
}

TEST(Replanned, IsTheSystemThatIsMadeAnewToTheLastBit) {
  for (const int dimension : {2, 3})
    for_each_change(
        dimension,
        [](const BeamSystem&, const BeamSystem& carried, const BeamSystem& fresh, std::mt19937& random) {
          const State state = disturbed_state(fresh, random);
          Eigen::VectorXd f(fresh.coordinate_count()), g(fresh.constraint_count()), f_carried = f,
                                                                                    g_carried = g;
          fresh.residual(state, f, g);
          carried.residual(state, f_carried, g_carried);
          EXPECT_EQ(f, f_carried);
          EXPECT_EQ(g, g_carried);
          carried.constraints(state, g);
          EXPECT_EQ(g, g_carried);
          const TangentWeights w{.mass = 1, .damping = 0.3, .stiffness = 0.2};
          expect_equal(tangent_of(carried, state, w), tangent_of(fresh, state, w));
          EXPECT_EQ(carried.moving_unknowns(), fresh.moving_unknowns());
          EXPECT_EQ(energy(carried, state).mechanical(), energy(fresh, state).mechanical());
        });
}

TEST(Replanned, DiffersInTheElementsAroundTheChangeAlone) {
  for (const int dimension : {2, 3})
    for_each_change(
        dimension,
        [](const BeamSystem& from, const BeamSystem& to, const BeamSystem&, std::mt19937&) {
          const std::vector<int> changed = changed_unknowns(from, to);
          ASSERT_FALSE(changed.empty());
          // One element to three that are new, with two nodes to four, of which one moves.
          const auto per_node = static_cast<std::size_t>(2 * to.dimension());
          EXPECT_GE(changed.size(), 2 * per_node + 1);
          EXPECT_LE(changed.size(), 4 * per_node + 1);
        });
}

TEST(Replanned, MeansAllUnknownsWhereModesOfJointsChange) {
  std::mt19937 random(3);
  const BeamModel model = long_beam(random, 2);
  const BeamSystem from(model);
  MeshPlan plan = initial_plan(model);
  plan.modes[1] = Carried::point;
  EXPECT_TRUE(changed_unknowns(from, *from.replanned(plan)).empty());
}

TEST(TangentNear, IsRightInTheRowsThatAreNear) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(50 + dimension);
    const BeamSystem system(testing::model_with_everything(random, dimension));
    const State state = disturbed_state(system, random);
    const TangentWeights w{.mass = 1, .damping = 0.3, .stiffness = 0.2};
    const Eigen::SparseMatrix<double> whole = tangent_of(system, state, w);
    for (int first = 0; first < whole.rows(); first += 7) {
      std::vector<bool> near(static_cast<std::size_t>(whole.rows()), false);
      near[first] = true;
      std::vector<double> values(static_cast<std::size_t>(whole.nonZeros()), 0);
      system.tangent_near(state, w, near, values.data());
      for (int column = 0; column < whole.cols(); ++column)
        for (int k = whole.outerIndexPtr()[column]; k < whole.outerIndexPtr()[column + 1]; ++k)
          if (whole.innerIndexPtr()[k] == first)
            EXPECT_NEAR(values[k], whole.valuePtr()[k], 1e-13 * (1 + std::abs(whole.valuePtr()[k])));
    }
  }
}

TEST(ResidualNear, IsRightInTheRowsThatAreNear) {
  for (const int dimension : {2, 3}) {
    std::mt19937 random(50 + dimension);
    const BeamSystem system(testing::model_with_everything(random, dimension));
    const State state = disturbed_state(system, random);
    const int n = system.coordinate_count(), m = system.constraint_count();
    Eigen::VectorXd whole(n), closed(m), dynamics(n), constraints(m);
    system.residual(state, whole, closed);
    for (int row = 0; row < n; ++row) {
      std::vector<bool> near(static_cast<std::size_t>(n + m), false);
      near[row] = true;
      system.residual_near(state, near, dynamics, constraints);
      EXPECT_NEAR(dynamics[row], whole[row], 1e-12 * whole.norm()) << row;
      EXPECT_EQ(constraints, closed);
    }
  }
}

TEST(LocalVelocities, HaveTheMomentumThatThoseOfAllUnknownsHave) {
  for (const int dimension : {2, 3})
    for_each_change(
        dimension,
        [](const BeamSystem& from, const BeamSystem& to, const BeamSystem&, std::mt19937& random) {
          std::vector<int> around = changed_unknowns(from, to);
          State local = disturbed_state(to, random, 0.01);
          ASSERT_EQ(project_velocities(to, local).status, ConsistencyStatus::done);
          Eigen::VectorXd momentum = momentum_of(to, local);
          std::uniform_real_distribution<double> unit(-1, 1);
          for (const int i : around)
            if (i < momentum.size()) momentum[i] *= 1 + 0.3 * unit(random);
          State whole = local;
          const State start = local;
          ProjectionSolver solver;
          const Projection near = velocities_from_momentum(to, momentum, around, solver, local);
          const Projection all = velocities_from_momentum(to, momentum, whole);
          ASSERT_EQ(near.status, ConsistencyStatus::done);
          ASSERT_EQ(all.status, ConsistencyStatus::done);
          EXPECT_LT((local.v - whole.v).lpNorm<Eigen::Infinity>(), 1e-12 * whole.v.lpNorm<Eigen::Infinity>());
          EXPECT_LT((near.impulse - all.impulse).norm(), 1e-12 * momentum.norm());
          EXPECT_GT((local.v - start.v).norm(), 1e-3);
          EXPECT_LT(changes(local.v, start.v), local.v.size() / 2) << "those far away";
        });
}

TEST(BalancedAccelerations, AnswerWhatIsOpenAndNothingElse) {
  constexpr double h = 1e-7;
  for (const int dimension : {2, 3})
    for_each_change(dimension, [&](const BeamSystem& from, const BeamSystem& to, const BeamSystem&,
                                   std::mt19937& random) {
      const std::vector<int> around = changed_unknowns(from, to);
      State whole = disturbed_state(to, random, 1e-4);
      ASSERT_EQ(project_velocities(to, whole).status, ConsistencyStatus::done);
      ASSERT_EQ(make_accelerations_smooth(to, h, whole), ConsistencyStatus::done);
      // In balance, then not near the change.
      ASSERT_EQ(make_accelerations_consistent(to, whole), ConsistencyStatus::done);
      for (const int i : around)
        if (i < whole.a.size()) whole.a[i] = 0;
      const State start = whole;
      State local = whole;
      NearSolver solver, other;
      ASSERT_EQ(balance_accelerations(to, h, {}, solver, whole).status, ConsistencyStatus::done);
      const Eigen::VectorXd correction = whole.a - start.a;
      State still = whole;
      still.a.setZero();
      still.lambda.setZero();
      const Eigen::Index n = to.coordinate_count(), m = to.constraint_count();
      Eigen::VectorXd padded = Eigen::VectorXd::Zero(n + m), dynamics(n), constraints(m);
      padded.head(n) = correction;
      to.residual(whole, dynamics, constraints);
      const double largest = dynamics.lpNorm<Eigen::Infinity>();
      dynamics += (tangent_of(to, still, {.damping = h / 2, .stiffness = h * h / 4}) * padded).head(n);
      EXPECT_LT(dynamics.lpNorm<Eigen::Infinity>(), 1e-9 * largest);
      EXPECT_LT((to.constraint_product(whole, whole.a) + to.constraint_curvature(whole)).norm(),
                1e-9 * whole.a.norm());

      const Balance near = balance_accelerations(to, h, around, other, local);
      ASSERT_EQ(near.status, ConsistencyStatus::done);
      EXPECT_TRUE(near.near);
      EXPECT_LT((local.a - whole.a).lpNorm<Eigen::Infinity>(), 1e-3 * correction.lpNorm<Eigen::Infinity>());
      EXPECT_LT((local.lambda - whole.lambda).norm(), 1e-6 * (1 + whole.lambda.norm()));
      EXPECT_LT(changes(local.a, start.a), local.a.size() / 2) << "those far away";
      State again = whole;
      ASSERT_EQ(balance_accelerations(to, 0, {}, other, again).status, ConsistencyStatus::done);
      const State balanced = again;
      ASSERT_EQ(balance_accelerations(to, h, {}, other, again).status, ConsistencyStatus::done);
      EXPECT_LT((again.a - balanced.a).lpNorm<Eigen::Infinity>(), 1e-9 * balanced.a.lpNorm<Eigen::Infinity>())
          << "what is in balance";
    });
}

TEST(CarriedSums, AreThoseOfTheOtherMesh) {
  for (const int dimension : {2, 3})
    for_each_change(
        dimension,
        [](const BeamSystem& from, const BeamSystem& to, const BeamSystem&, std::mt19937& random) {
          const State state = disturbed_state(from, random, 0.01);
          // Nodes that both have move alike but for some; the others anyhow.
          State next = disturbed_state(to, random, 0.01);
          for (std::size_t i = 0; i < to.mesh().nodes[0].size(); ++i) {
            const MeshNode& node = to.mesh().nodes[0][i];
            for (const MeshNode& old : from.mesh().nodes[0]) {
              if (old.home != node.home || old.rider != node.rider || i % 40 == 3) continue;
              for (const auto& [target, source] :
                   {std::pair{node.r, old.r}, {node.slope_left, old.slope_left}}) {
                next.q.segment(target, to.dimension()) = state.q.segment(source, to.dimension());
                next.v.segment(target, to.dimension()) = state.v.segment(source, to.dimension());
              }
            }
          }
          const MotionSums carried = carried_sums(motion_sums(from, state, 0), from, state, to, next, 0);
          const MotionSums expected = motion_sums(to, next, 0);
          const double scale = expected.energy.kinetic + expected.energy.strain();
          EXPECT_NEAR(carried.energy.mechanical(), expected.energy.mechanical(), 1e-12 * scale);
          EXPECT_NEAR(energy_change(from, state, to, next),
                      expected.energy.mechanical() - energy(from, state).mechanical(), 1e-12 * scale);
          EXPECT_NEAR(carried.energy.kinetic, expected.energy.kinetic, 1e-12 * scale);
          EXPECT_NEAR(carried.energy.bending, expected.energy.bending, 1e-12 * scale);
          EXPECT_LT((carried.momentum - expected.momentum).norm(), 1e-12 * (1 + expected.momentum.norm()));
          EXPECT_NEAR(carried.length, expected.length, 1e-12 * expected.length);
          EXPECT_GT(std::abs(expected.energy.mechanical() - motion_sums(from, state, 0).energy.mechanical()),
                    1e-6 * scale);
        });
}

}  // namespace
}  // namespace nurbeam
