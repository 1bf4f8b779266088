// Counts the allocations in what a time step repeats.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cstdlib>
#include <vector>

#include "fem/system/assembly.h"
#include "fem/system/initial_state.h"
#include "solver/steps/generalized_alpha.h"
#include "solver/system/consistent.h"
#include "tests/fem/torsion_models.h"

namespace {
long allocations = 0;
}

// Both operator new and Eigen end in malloc. The address sanitizer has a malloc of its own, and no test here.
#ifndef __SANITIZE_ADDRESS__
extern "C" void* __libc_malloc(std::size_t size);
extern "C" void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace nurbeam {
namespace {

using testing::disturbed_state;
using testing::model_with_everything;
using testing::torsion_model;

template <class Work>
long allocations_in(const Work& work) {
  const long before = allocations;
  work();
  return allocations - before;
}

template <int D>
void check(const auto& make_model) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer counts for itself";
#endif
  std::mt19937 random(1);
  const BeamModel model = make_model(random, D);
  const BeamSystem system(model, initial_plan(model));
  const State state = disturbed_state(system, random);
  Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
  Eigen::SparseMatrix<double> kkt = system.tangent_pattern().matrix();
  const TangentWeights all{1, 1, 1};
  for (const MeshElement<D>& e : system.assembly<D>()->elements()) {
    const ElementState<D> x = gather<D>(e, state);
    const Eigen::Matrix<double, D, 1> load = Eigen::Matrix<double, D, 1>::Ones();
    EXPECT_EQ(allocations_in([&] { e.element.force(x, load); }), 0);
    EXPECT_EQ(allocations_in([&] { e.element.tangent(x, load, all); }), 0);
  }
  EXPECT_EQ(allocations_in([&] { system.residual(state, dynamics, constraints); }), 0);
  EXPECT_EQ(allocations_in([&] { system.tangent(state, all, kkt); }), 0);
  EXPECT_EQ(allocations_in([&] { system.admissible(state); }), 0);
}

// A body that slides; more elements than move, so that the part that moves is kept apart.
template <int D>
void check_steps(double damping) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer counts for itself";
#endif
  std::mt19937 random(3);
  BeamModel model =
      testing::one_beam(testing::uneven_axis(random, D), D, {300, 2, 0.7, damping, {}}, 30, {{0, true}});
  testing::add_slider(model, 0.8, 0.33 * model.beams[0].curve.length());
  model.gravity = {0.3, -1, 0};
  const BeamSystem system(model);
  State start = drawn_state(system);
  start_moving(system, start);
  ASSERT_EQ(make_accelerations_consistent(system, start), ConsistencyStatus::done);
  GeneralizedAlphaIntegrator integrator({}, system, start);
  ASSERT_FALSE(system.moving_unknowns().empty());
  const auto advance = [&] { EXPECT_EQ(integrator.advance(1e-3).status, StepStatus::converged); };
  for (int i = 0; i < 120; ++i) advance();
  // Longer than a matrix is kept.
  EXPECT_EQ(allocations_in([&] {
              for (int i = 0; i < 60; ++i) advance();
            }),
            0);
}

#ifndef __SANITIZE_ADDRESS__
TEST(AllocationCount, SeesBothNewAndEigen) {
  std::vector<double> list;
  Eigen::VectorXd vector;
  EXPECT_EQ(allocations_in([&] { list.resize(100); }), 1);
  EXPECT_EQ(allocations_in([&] { vector.resize(100); }), 1);
}
#endif

TEST(ElementAndAssembly, DoNotAllocateInThePlane) { check<2>(model_with_everything); }
TEST(ElementAndAssembly, DoNotAllocateInSpace) { check<3>(model_with_everything); }
TEST(ElementAndAssembly, DoNotAllocateWithTorsion) { check<3>(torsion_model); }

TEST(Steps, DoNotAllocateInThePlane) {
  for (const double damping : {0.0, 0.02}) check_steps<2>(damping);
}
TEST(Steps, DoNotAllocateInSpace) {
  for (const double damping : {0.0, 0.02}) check_steps<3>(damping);
}

}  // namespace
}  // namespace nurbeam
