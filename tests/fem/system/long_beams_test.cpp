// Beams that are long enough to be shared between threads.
#include <gtest/gtest.h>

#include <random>

#include "fem/system/assembly.h"
#include "fem/system/beam_system.h"
#include "solver/algebra/side_by_side.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::disturbed_state;

constexpr int element_count = 3000;

BeamModel long_ring(int dimension) {
  ModelBuilder builder(dimension);
  builder.add_beam(
      ReferenceCurve(testing::arc_cubics({0, 0, 0}, 5, 0, 2 * M_PI, 4), dimension, Metric::arc_length, true),
      BeamProperties{300, 2, 0.7}, {element_count});
  return builder.build();
}

BeamModel long_beam_with_body(int dimension) {
  std::mt19937 random(2);
  BeamModel model = testing::one_beam(testing::uneven_axis(random, dimension), dimension, {300, 2, 0.7},
                                      element_count, {{0, true}});
  testing::add_slider(model, 0.8, 0.33 * model.beams[0].curve.length());
  return model;
}

struct Sums {
  Eigen::VectorXd dynamics, constraints;
  Eigen::SparseMatrix<double> tangent;
};

Sums sums(const BeamSystem& system, const State& state, int threads) {
  const ThreadLimit limit(threads);
  Sums sums{Eigen::VectorXd(system.coordinate_count()), Eigen::VectorXd(system.constraint_count()),
            system.tangent_pattern().matrix()};
  system.residual(state, sums.dynamics, sums.constraints);
  system.tangent(state, {1, 0.5, 2}, sums.tangent);
  return sums;
}

TEST(LongBeams, HaveTheSameBitsOnAnyNumberOfThreads) {
  for (const int dimension : {2, 3})
    for (const BeamModel& model : {long_ring(dimension), long_beam_with_body(dimension)}) {
      std::mt19937 random(3);
      const BeamSystem system(model, initial_plan(model));
      const State state = disturbed_state(system, random, 1e-3);
      const Sums alone = sums(system, state, 1);
      for (const int threads : {2, 3}) {
        const Sums shared = sums(system, state, threads);
        EXPECT_EQ(shared.dynamics, alone.dynamics);
        EXPECT_EQ(shared.constraints, alone.constraints);
        EXPECT_EQ((shared.tangent - alone.tangent).norm(), 0);
      }
    }
}

TEST(LongBeams, AddUpTheForcesOfAllElementsOfARing) {
  const BeamModel model = long_ring(2);
  std::mt19937 random(4);
  const BeamSystem system(model, initial_plan(model));
  const State state = disturbed_state(system, random, 1e-3);
  const Assembly<2>& assembly = *system.assembly<2>();
  Eigen::VectorXd expected = Eigen::VectorXd::Zero(system.coordinate_count());
  for (const MeshElement<2>& e : assembly.elements()) {
    const ElementVector<2> forces = assembly.element_force(e, state, assembly.line_load(0, state));
    for (int k = 0; k < element_size<2>; ++k)
      if (const int dof = e.dofs[k]; dof >= 0) expected[dof] += forces[k];
  }
  EXPECT_LT((sums(system, state, 2).dynamics - expected).norm(), 1e-11 * expected.norm());
}

}  // namespace
}  // namespace nurbeam
