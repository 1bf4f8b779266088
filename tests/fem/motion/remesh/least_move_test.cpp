#include "fem/motion/remesh/least_move.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>

namespace nurbeam {
namespace {

Eigen::MatrixXd numbers(Eigen::Index rows, Eigen::Index columns, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return unit(random); });
}

// With `soft` of n directions in which the energy falls from the start on.
EnergyParabola parabola(int n, int soft, std::mt19937& random) {
  const Eigen::MatrixXd A = numbers(n, n, random), Q = numbers(n, n, random).householderQr().householderQ();
  Eigen::VectorXd values = 20 * (numbers(n, 1, random).array() + 1.1);
  values.head(soft) *= -1;
  return {Q * values.asDiagonal() * Q.transpose(), A * A.transpose() + Eigen::MatrixXd::Identity(n, n),
          numbers(n, 1, random)};
}

double change(const EnergyParabola& energy, const Eigen::VectorXd& d) {
  return energy.g.dot(d) + 0.5 * d.dot(energy.K * d);
}

// Stationary for the Lagrangian d'Md/2 + (g'd + d'Kd/2 + e) / mu, and no other such move tried is smaller.
TEST(LeastMove, BringsTheEnergyByTheLeastDisplacements) {
  std::mt19937 random(3);
  for (const int soft : {0, 2})
    for (const double e : {1e-3, -1e-3, 1e-7, -0.2}) {
      const EnergyParabola energy = parabola(7, soft, random);
      const auto [d, mu] = least_move(energy, e);
      EXPECT_NEAR(change(energy, d), -e, 1e-12 * std::abs(e)) << soft << " " << e;
      EXPECT_LT((energy.K * d + mu * (energy.M * d) + energy.g).norm(), 1e-11 * energy.g.norm());
      const double least = d.dot(energy.M * d);
      for (int i = 0; i < 50; ++i) {
        // Along a random line from d to where the energy has changed as much.
        const Eigen::VectorXd along = numbers(7, 1, random);
        const double slope = (energy.g + energy.K * d).dot(along), bend = 0.5 * along.dot(energy.K * along);
        const Eigen::VectorXd other = d - slope / bend * along;
        EXPECT_GE(other.dot(energy.M * other), least * (1 - 1e-12));
      }
    }
}

TEST(LeastMove, GoesToTheLowestWhereTheParabolaHasNoSuchPlace) {
  std::mt19937 random(4);
  const EnergyParabola energy = parabola(5, 0, random);
  const Eigen::VectorXd lowest = energy.K.llt().solve(-energy.g);
  EXPECT_LT((least_move(energy, -2 * change(energy, lowest)).d - lowest).norm(), 1e-6 * lowest.norm());
}

TEST(LeastMove, IsTheSameFromThatOfANeighbour) {
  std::mt19937 random(5);
  for (const int soft : {0, 3})
    for (const double e : {1e-3, -1e-3, 0.05})
      for (const double part : {0.0, 1e-6, 1e-3, 0.3}) {
        const EnergyParabola energy = parabola(9, soft, random);
        EnergyParabola near = energy;
        near.K += part * Eigen::MatrixXd::Identity(9, 9);
        near.g *= 1 + part;
        const LeastMove found = least_move(near, (1 - part) * e), own = least_move(energy, e, found.mu);
        const LeastMove expected = least_move(energy, e);
        EXPECT_LT((own.d - expected.d).norm(), 1e-10 * expected.d.norm()) << soft << " " << e << " " << part;
        EXPECT_NEAR(own.mu, expected.mu, 1e-9 * std::abs(expected.mu));
      }
}

// From a value on the wrong side, or of a parabola that has no such place.
TEST(LeastMove, FindsItsOwnWhereANeighboursIsOfNoUse) {
  std::mt19937 random(6);
  const EnergyParabola energy = parabola(6, 2, random);
  for (const double mu : {-3.0, 1e-12, 1e12}) {
    const LeastMove expected = least_move(energy, 1e-3);
    EXPECT_LT((least_move(energy, 1e-3, mu).d - expected.d).norm(), 1e-9 * expected.d.norm()) << mu;
  }
}

}  // namespace
}  // namespace nurbeam
