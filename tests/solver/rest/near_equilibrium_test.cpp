#include "solver/rest/near_equilibrium.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/support/dense_system.h"

namespace nurbeam {
namespace {

using Vector = Eigen::VectorXd;

/// Unknowns between stiff and soft springs to the next ones, each pulled to where sinh(x_i - a_i) is small,
/// and held so that the first and the last one have a given sum.
class Springs : public testing::DenseSystem {
 public:
  static constexpr int n = 12;
  double pull = 0.3;            ///< on each
  double spring_stiffness = 1;  ///< of every other spring, those between being a thousand times as stiff
  mutable int tangents = 0;

  int coordinate_count() const override { return n; }
  int constraint_count() const override { return 1; }

  void residual(const State& state, Eigen::Ref<Vector> dynamics,
                Eigen::Ref<Vector> constraints) const override {
    const Vector& x = state.q;
    dynamics = x.array().sinh() - pull;
    for (int i = 0; i + 1 < n; ++i) {
      const double force = stiffness_of(i) * std::sinh(x[i + 1] - x[i]);
      dynamics[i] -= force;
      dynamics[i + 1] += force;
    }
    dynamics[0] += state.lambda[0];
    dynamics[n - 1] += state.lambda[0];
    constraints[0] = x[0] + x[n - 1] - 0.5;
  }

  void tangent(const State& state, const TangentWeights& w, SparseValues kkt) const override {
    tangents += w.stiffness != 0;
    DenseSystem::tangent(state, w, kkt);
  }

 private:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(n, n); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    const Vector& x = state.q;
    Eigen::MatrixXd K = x.array().cosh().matrix().asDiagonal();
    for (int i = 0; i + 1 < n; ++i) {
      const double k = stiffness_of(i) * std::cosh(x[i + 1] - x[i]);
      K(i, i) += k;
      K(i + 1, i + 1) += k;
      K(i, i + 1) -= k;
      K(i + 1, i) -= k;
    }
    return K;
  }
  Eigen::MatrixXd constraint_jacobian(const State&) const override {
    Eigen::MatrixXd G = Eigen::MatrixXd::Zero(1, n);
    G(0, 0) = G(0, n - 1) = 1;
    return G;
  }
  double stiffness_of(int spring) const { return spring_stiffness * (spring % 2 == 0 ? 1000 : 1); }

 public:
  /// With factors of its own tangent at every correction.
  State rest() const {
    State state = drawn();
    for (int i = 0; i < 30; ++i) {
      const Vector x = factors(state).solve(open(state));
      state.q -= x.head(n);
      state.lambda -= x.tail(1);
    }
    return state;
  }
  static State drawn() {
    return {.q = Vector::Zero(n), .v = Vector::Zero(n), .a = Vector::Zero(n), .lambda = Vector::Zero(1)};
  }
  Vector open(const State& state) const {
    Vector rows(n + 1);
    residual(state, rows.head(n), rows.tail(1));
    return rows;
  }
  EquilibratedKkt factors(const State& state) const {
    Eigen::SparseMatrix<double> matrix = tangent_pattern().matrix();
    DenseSystem::tangent(state, {.stiffness = 1}, matrix);
    return {matrix, n};
  }
};

/// Ten neighbours of a rest, up to `apart` away from it in pull and stiffness, from its own state.
struct Neighbours {
  Springs own;
  State rest = own.rest();
  std::vector<Springs> systems{10};
  std::vector<State> states;
  std::vector<NearRest> all;

  explicit Neighbours(double apart) {
    for (std::size_t k = 0; k < systems.size(); ++k) {
      const double part = apart * (static_cast<double>(k) - 4.5) / 4.5;
      systems[k].pull *= 1 + part;
      systems[k].spring_stiffness *= 1 - part / 2;
      states.push_back(rest);
    }
    for (std::size_t k = 0; k < systems.size(); ++k) all.push_back({&systems[k], &states[k]});
  }
  int tangents() const {
    int sum = 0;
    for (const Springs& each : systems) sum += each.tangents;
    return sum;
  }
  void expect_at_rest() const {
    for (std::size_t k = 0; k < systems.size(); ++k) {
      const State own_rest = systems[k].rest();
      EXPECT_LT((states[k].q - own_rest.q).lpNorm<Eigen::Infinity>(), 1e-14) << k;
      EXPECT_LT((states[k].lambda - own_rest.lambda).lpNorm<Eigen::Infinity>(), 1e-13) << k;
    }
  }
};

TEST(NearEquilibrium, IsReachedWithFactorsThatAllShare) {
  Neighbours of(1e-4);
  ASSERT_TRUE(settle_near(of.all, of.own.factors(of.rest)));
  EXPECT_EQ(of.tangents(), 0);
  of.expect_at_rest();
}

TEST(NearEquilibrium, IsReachedWithFactorsOfEachWhereSharedOnesDoNotServe) {
  Neighbours of(1e-4);
  Springs soft;
  soft.spring_stiffness = 0.05;
  ASSERT_TRUE(settle_near(of.all, soft.factors(of.rest)));
  EXPECT_EQ(of.tangents(), 10);  // one each
  of.expect_at_rest();
}

TEST(NearEquilibrium, SaysWhereThereIsNone) {
  Neighbours of(1e-4);
  of.systems[3].pull = std::nan("");
  EXPECT_FALSE(settle_near(of.all, of.own.factors(of.rest)));
}

}  // namespace
}  // namespace nurbeam
