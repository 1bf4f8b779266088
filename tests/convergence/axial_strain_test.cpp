// What an axial strain must not do: lock, or leave a mode without energy.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "fem/motion/record/snapshot.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/initial_state.h"
#include "fem/system/observables.h"
#include "pipelines/verification/verify_oracles.h"
#include "solver/rest/static_equilibrium.h"
#include "solver/system/tangent_matrix.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

using std::numbers::pi;

// The cantilever of `nurbeam verify axial-strain-cantilever`, which asks the assumed strain for 4e-6 m.
TEST(PointwiseAxialStrain, LocksInASlenderCantilever) {
  constexpr double EA = 1e8, P = 10;
  BeamProperties properties(EA, 1, 1);
  properties.axial_strain = AxialStrain::pointwise;
  BeamModel model =
      testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2, properties, 16, {{0, true}});
  model.gravity.setZero();
  model.forces.push_back(PointLoad{{.s = 1, .value = {0, -P, 0}}});
  const BeamSystem system(model);
  State state = drawn_state(system);
  ASSERT_EQ(find_static_equilibrium({}, system, state).status, StaticStatus::converged);
  const verification::Tip exact = verification::stretching_elastica_tip(EA, P);
  const Eigen::Vector2d tip = record_beams(system, state)[0].node_positions.back().head<2>();
  EXPECT_GT((tip - Eigen::Vector2d(exact.x, exact.y)).norm(), 5e-4);
}

/// Squares of the natural frequencies, ascending, of a model in its drawn state but for the slopes and
/// positions of a uniform stretch along x.
Eigen::VectorXd squared_frequencies(const BeamModel& model, double stretch) {
  const BeamSystem system(model);
  State state = drawn_state(system);
  const int n = system.coordinate_count(), D = model.dimension;
  state.lambda = Eigen::VectorXd::Zero(system.constraint_count());
  for (int i = 0; i < n; i += D) state.q[i] *= stretch;
  Eigen::SparseMatrix<double> kkt = tangent_matrix(system, state, {.stiffness = 1});
  const Eigen::MatrixXd K = Eigen::MatrixXd(kkt).topLeftCorner(n, n);
  system.tangent(state, {.mass = 1}, kkt);
  const Eigen::MatrixXd M = Eigen::MatrixXd(kkt).topLeftCorner(n, n);
  EXPECT_LT((K - K.transpose()).norm(), 1e-9 * K.norm());
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>((K + K.transpose()) / 2, M).eigenvalues();
}

// Count of zero-energy modes: those of the rigid body and no other.
TEST(AssumedAxialStrain, HasNoZeroEnergyModesBesideTheRigidOnes) {
  for (const double ratio : {1.0, 1e4, 1e8, 1e12})
    for (const int dimension : {2, 3})
      for (const int elements : {1, 2, 4})
        for (const bool curved : {false, true}) {
          if (curved && dimension == 3) continue;  // as drawn it needs torsion
          const auto axis = curved ? testing::arc_cubics({0, 0, 0}, 1, 0, 1, 1)
                                   : std::vector{testing::line_cubic({0, 0, 0}, {1, 0, 0})};
          BeamProperties properties(ratio, 1, 1);
          properties.axial_strain = AxialStrain::ends_and_mean;
          BeamModel model = testing::one_beam(axis, dimension, properties, elements, {});
          model.gravity.setZero();
          const Eigen::VectorXd squares = squared_frequencies(model, 1);
          const int rigid = dimension == 2 ? 3 : 5;  // a straight line has no turn about itself
          const double lowest = std::pow(4.730, 4);  // of a free beam: EI (4.73 / L)^4 / (rho A)
          // Less for the softest stretching of the thick one; the round-off of the stiffest mode is left.
          const double least = std::min(0.5 * lowest, 0.5 * ratio * pi * pi);
          const double round_off = 1e-13 * squares.tail(1)[0];
          EXPECT_LT(std::abs(squares[rigid - 1]), 0.1 * least + round_off)
              << ratio << ' ' << dimension << ' ' << elements;
          EXPECT_GT(squares[rigid], least - round_off) << ratio << ' ' << dimension << ' ' << elements;
        }
}

TEST(AssumedAxialStrain, ATautStringHasTheFrequenciesOfThePointwiseOne) {
  double lowest[2];
  for (const bool pointwise : {false, true}) {
    BeamProperties properties(1e6, 1e-4, 1);
    properties.axial_strain = pointwise ? AxialStrain::pointwise : AxialStrain::ends_and_mean;
    BeamModel model = testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2, properties, 8, {});
    model.gravity.setZero();
    const Eigen::VectorXd squares = squared_frequencies(model, 1.01);
    lowest[pointwise] = squares[squares.size() / 2];
  }
  EXPECT_NEAR(lowest[0], lowest[1], 1e-9 * lowest[1]);
}

}  // namespace
}  // namespace nurbeam
