// Long because its tests share what they build.
#include "solver/rest/static_equilibrium.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "tests/support/dense_system.h"

namespace nurbeam {
namespace {

using testing::DenseSystem;

State resting(Eigen::VectorXd q) {
  State state;
  state.q = std::move(q);
  return state;
}

/// Point masses (x_i, y_i) between two fixed ends (0, 0) and (span, 0), joined by links of natural length
/// `link_length`; each mass weighs `weight` downwards. With a finite `axial_stiffness` EA the links are
/// springs of tension EA (l / link_length - 1), else rigid bars g = (l^2 - link_length^2) / (2 link_length),
/// whose tension is lambda times l / link_length.
class Chain : public DenseSystem {
 public:
  int masses = 9;
  double span = 8;
  double link_length = 1;
  double axial_stiffness = 1e3;
  double weight = 1;

  bool is_rigid() const { return std::isinf(axial_stiffness); }
  int coordinate_count() const override { return 2 * masses; }
  int constraint_count() const override { return is_rigid() ? masses + 1 : 0; }
  Eigen::VectorXd coordinate_scale() const override {
    return Eigen::VectorXd::Constant(coordinate_count(), link_length);
  }

  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    dynamics = state.a;
    for (int i = 0; i < masses; ++i) dynamics[2 * i + 1] += state.load * weight;
    for (int i = 0; i <= masses; ++i) {
      const Eigen::Vector2d link = point(state, i + 1) - point(state, i);
      if (is_rigid()) constraints[i] = (link.squaredNorm() / link_length - link_length) / 2;
      const Eigen::Vector2d force = is_rigid() ? Eigen::Vector2d(state.lambda[i] / link_length * link)
                                               : Eigen::Vector2d(tension(link) * link.normalized());
      if (i > 0) dynamics.segment<2>(2 * (i - 1)) -= force;
      if (i < masses) dynamics.segment<2>(2 * i) += force;
    }
  }

  /// (2 masses) where the masses hang: with horizontal tension H and vertical forces known by symmetry every
  /// link has the direction of its force and the length of its tension; H is found by bisection.
  Eigen::VectorXd hanging() const {
    double low = 1e-9;
    double high = 1e9;
    for (int i = 0; i < 300; ++i) {
      const double middle = std::sqrt(low * high);
      (end_of(middle) < span ? low : high) = middle;
    }
    Eigen::VectorXd q(2 * masses);
    Eigen::Vector2d place = Eigen::Vector2d::Zero();
    for (int i = 0; i < masses; ++i) q.segment<2>(2 * i) = place += link_under(low, i);
    return q;
  }

  /// (2 masses) links of natural length alternating up and down: slack, without tension. `masses` must be
  /// odd.
  Eigen::VectorXd zigzag() const {
    const double rise = std::sqrt(link_length * link_length - std::pow(span / (masses + 1), 2));
    Eigen::VectorXd q(2 * masses);
    for (int i = 0; i < masses; ++i)
      q.segment<2>(2 * i) << span * (i + 1) / (masses + 1), i % 2 == 0 ? rise : 0;
    return q;
  }

  /// (2 masses) evenly on the line between the ends.
  Eigen::VectorXd straight() const {
    Eigen::VectorXd q = Eigen::VectorXd::Zero(2 * masses);
    for (int i = 0; i < masses; ++i) q[2 * i] = span * (i + 1) / (masses + 1);
    return q;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override {
    return Eigen::MatrixXd::Identity(coordinate_count(), coordinate_count());
  }
  Eigen::Matrix2d stiffness_of_link(const State& state, int i) const {
    if (is_rigid()) return state.lambda[i] / link_length * Eigen::Matrix2d::Identity();
    const Eigen::Vector2d link = point(state, i + 1) - point(state, i);
    const Eigen::Vector2d along = link.normalized();
    const Eigen::Matrix2d axial = along * along.transpose();
    return axial_stiffness / link_length * axial +
           tension(link) / link.norm() * (Eigen::Matrix2d::Identity() - axial);
  }
  Eigen::MatrixXd stiffness(const State& state) const override {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(2 * masses + 4, 2 * masses + 4);
    for (int i = 0; i <= masses; ++i) {
      const Eigen::Matrix2d k = stiffness_of_link(state, i);
      whole.block<2, 2>(2 * i, 2 * i) += k;
      whole.block<2, 2>(2 * i + 2, 2 * i + 2) += k;
      whole.block<2, 2>(2 * i, 2 * i + 2) -= k;
      whole.block<2, 2>(2 * i + 2, 2 * i) -= k;
    }
    return whole.block(2, 2, 2 * masses, 2 * masses);
  }
  Eigen::MatrixXd constraint_jacobian(const State& state) const override {
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(constraint_count(), 2 * masses + 4);
    for (int i = 0; i < constraint_count(); ++i) {
      const Eigen::RowVector2d link = (point(state, i + 1) - point(state, i)).transpose() / link_length;
      whole.block<1, 2>(i, 2 * i) = -link;
      whole.block<1, 2>(i, 2 * i + 2) = link;
    }
    return whole.middleCols(2, 2 * masses);
  }

 private:
  Eigen::Vector2d point(const State& state, int i) const {
    if (i == 0) return Eigen::Vector2d::Zero();
    if (i == masses + 1) return Eigen::Vector2d(span, 0);
    return state.q.segment<2>(2 * (i - 1));
  }
  double tension(const Eigen::Vector2d& link) const {
    return axial_stiffness * (link.norm() / link_length - 1);
  }
  Eigen::Vector2d link_under(double horizontal, int i) const {
    const Eigen::Vector2d force(horizontal, weight * (i - masses / 2.0));
    return force.normalized() * link_length * (1 + force.norm() / axial_stiffness);
  }
  double end_of(double horizontal) const {
    double x = 0;
    for (int i = 0; i <= masses; ++i) x += link_under(horizontal, i)[0];
    return x;
  }
};

StaticReport hang(Chain& chain, State& state, StaticEquilibrium settings = {}) {
  return find_static_equilibrium(settings, chain, state);
}

void expect_hanging(Chain chain, const Eigen::VectorXd& start) {
  State state = resting(start);
  const StaticReport report = hang(chain, state);
  ASSERT_EQ(report.status, StaticStatus::converged);
  EXPECT_EQ(report.load_factor, 1);
  EXPECT_EQ(state.load, 1);
  // A position of the size of the span is known to epsilon, a tension to EA / link length of that.
  const double round_off = chain.is_rigid() ? 0
                                            : 2 * std::numeric_limits<double>::epsilon() * chain.span *
                                                  chain.axial_stiffness / chain.link_length;
  EXPECT_LE(report.residual_norm, std::max(1e-10, round_off / chain.weight));
  EXPECT_LT((state.q - chain.hanging()).lpNorm<Eigen::Infinity>(), 1e-8);
  EXPECT_EQ(state.v.norm() + state.a.norm(), 0);
}

TEST(StaticEquilibrium, ASlackChainOfStiffSpringsFallsIntoItsCatenary) {
  for (const double axial_stiffness : {1e2, 1e4, 1e6}) {
    Chain chain;
    chain.axial_stiffness = axial_stiffness;
    expect_hanging(chain, chain.zigzag());
  }
}

TEST(StaticEquilibrium, AStraightChainWithoutTensionSagsFromItsSingularTangent) {
  for (const double axial_stiffness : {1e2, 1e4, 1e6}) {
    Chain chain;
    chain.link_length = chain.span / (chain.masses + 1);
    chain.axial_stiffness = axial_stiffness;
    expect_hanging(chain, chain.straight());
  }
}

TEST(StaticEquilibrium, AStretchedChainIsFoundDirectly) {
  Chain chain;
  chain.link_length = 0.7;
  State state = resting(chain.straight());
  const StaticReport report = hang(chain, state);
  EXPECT_EQ(report.status, StaticStatus::converged);
  EXPECT_EQ(report.load_steps, 1);
  EXPECT_LT((state.q - chain.hanging()).lpNorm<Eigen::Infinity>(), 1e-9);
}

TEST(StaticEquilibrium, ASlackChainOfRigidBarsFallsIntoItsCatenary) {
  Chain chain;
  chain.axial_stiffness = std::numeric_limits<double>::infinity();
  expect_hanging(chain, chain.zigzag());
}

/// Two bars of axial stiffness EA between (-1, 0), the apex (x, y) and (1, 0), drawn with the apex at height
/// `height`, pressed down at the apex.
class ShallowTruss : public Chain {
 public:
  double height = 0.3;
  ShallowTruss() {
    masses = 1;
    span = 2;
    link_length = std::hypot(1, height);
    weight = 3;
  }
  double internal_force(double y) const {
    const double length = std::hypot(1, y);
    return 2 * axial_stiffness * (length / link_length - 1) * y / length;
  }
};

TEST(StaticEquilibrium, BelowItsLimitLoadAShallowTrussStaysUpAndAboveItSnapsThrough) {
  ShallowTruss truss;
  double limit = 0;
  for (double y = 0; y < truss.height; y += 1e-5) limit = std::max(limit, -truss.internal_force(y));
  for (const double relative_load : {0.95, 1.05}) {
    truss.weight = relative_load * limit;
    State state = resting(Eigen::Vector2d(1, truss.height));
    const StaticReport report = hang(truss, state);
    ASSERT_EQ(report.status, StaticStatus::converged);
    EXPECT_NEAR(truss.internal_force(state.q[1]), -truss.weight, 1e-8 * truss.weight);
    EXPECT_NEAR(state.q[0], 1, 1e-9);
    if (relative_load < 1)
      EXPECT_GT(state.q[1], 0.17);
    else
      EXPECT_LT(state.q[1], -truss.height);
  }
}

/// Directions d_i, |d_i| = 1, of the links of a chain clamped along x; neighbours resist their angle with the
/// torque k sin(angle); the last one is turned by a moment: angle = asin(moment / k) in every hinge, by the
/// branch that starts at zero.
class HingedRoll : public DenseSystem {
 public:
  int links = 14;
  double hinge = 2.5;
  double moment = 2;

  int coordinate_count() const override { return 2 * links; }
  int constraint_count() const override { return links; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    dynamics = state.a + stiffness(state) * state.q;
    dynamics[0] -= hinge;
    for (int i = 0; i < links; ++i) constraints[i] = (state.q.segment<2>(2 * i).squaredNorm() - 1) / 2;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override {
    return Eigen::MatrixXd::Identity(2 * links, 2 * links);
  }
  /// The dynamics are linear in q for given lambda.
  Eigen::MatrixXd stiffness(const State& state) const override {
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(2 * links, 2 * links);
    for (int i = 0; i < links; ++i)
      k.block<2, 2>(2 * i, 2 * i) = state.lambda[i] * Eigen::Matrix2d::Identity();
    for (int i = 0; i + 1 < links; ++i) {
      k.block<2, 2>(2 * i, 2 * i + 2) = -hinge * Eigen::Matrix2d::Identity();
      k.block<2, 2>(2 * i + 2, 2 * i) = -hinge * Eigen::Matrix2d::Identity();
    }
    k.bottomRightCorner<2, 2>() -= state.load * moment * (Eigen::Matrix2d() << 0, -1, 1, 0).finished();
    return k;
  }
  Eigen::MatrixXd constraint_jacobian(const State& state) const override {
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(links, 2 * links);
    for (int i = 0; i < links; ++i) jacobian.block<1, 2>(i, 2 * i) = state.q.segment<2>(2 * i).transpose();
    return jacobian;
  }
};

TEST(StaticEquilibrium, AMomentRollsAChainUpMoreThanTwiceAlongItsBranch) {
  HingedRoll roll;
  State state = resting(Eigen::VectorXd::Zero(2 * roll.links));
  for (int i = 0; i < roll.links; ++i) state.q[2 * i] = 1;
  const StaticReport report = find_static_equilibrium({}, roll, state);
  ASSERT_EQ(report.status, StaticStatus::converged);
  const double expected = std::asin(roll.moment / roll.hinge);
  ASSERT_GT(roll.links * expected, 4 * std::numbers::pi);
  for (int i = 0; i < roll.links; ++i) {
    EXPECT_NEAR(state.q[2 * i], std::cos((i + 1) * expected), 1e-8);
    EXPECT_NEAR(state.q[2 * i + 1], std::sin((i + 1) * expected), 1e-8);
  }
}

TEST(StaticEquilibrium, EndsAtTheEquilibriumThatItIsAskedTo) {
  HingedRoll roll;
  State state = resting(Eigen::VectorXd::Zero(2 * roll.links));
  for (int i = 0; i < roll.links; ++i) state.q[2 * i] = 1;
  const auto turned = [](const State& at) { return at.q[1] > 0.5; };  // the first link by 30 degrees
  const StaticReport report = find_static_equilibrium({.ends_at = turned}, roll, state);
  EXPECT_EQ(report.status, StaticStatus::not_converged);
  EXPECT_GT(report.load_factor, 0);
  EXPECT_LT(report.load_factor, 1);
  const double reached = std::asin(report.load_factor * roll.moment / roll.hinge);
  EXPECT_GT(reached, std::numbers::pi / 6);
  EXPECT_NEAR(state.q[0], std::cos(reached), 1e-8);
}

/// Independent springs pulled by the same force, of stiffnesses many magnitudes apart.
class UnlikeSprings : public DenseSystem {
 public:
  Eigen::Vector2d springs = Eigen::Vector2d(1e6, 1e-6);
  double force = 1e-7;
  int coordinate_count() const override { return 2; }
  int constraint_count() const override { return 0; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd>) const override {
    dynamics = state.a + springs.cwiseProduct(state.q);
    dynamics.array() -= state.load * force;
  }

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::Matrix2d::Identity(); }
  Eigen::MatrixXd stiffness(const State&) const override { return springs.asDiagonal(); }
};

template <class System>
StaticReport find(System& system, State& state) {
  return find_static_equilibrium({}, system, state);
}

/// A rigid bar of length 1, upright at angle 0 on a hinge with a spring of stiffness 1 and a weight of 1.2 on
/// its top: upright is an equilibrium, but above a weight of 1 not a stable one.
class Inverted : public DenseSystem {
 public:
  int coordinate_count() const override { return 1; }
  int constraint_count() const override { return 0; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd>) const override {
    dynamics[0] = state.a[0] + state.q[0] - state.load * weight * std::sin(state.q[0]);
  }
  double weight = 1.2;

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(1, 1); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    return Eigen::MatrixXd::Constant(1, 1, 1 - state.load * weight * std::cos(state.q[0]));
  }
};

TEST(StaticEquilibrium, AnUnstableEquilibriumIsLeftForAStableOne) {
  const Inverted bar;
  State state = resting(Eigen::VectorXd::Zero(1));
  ASSERT_EQ(find_static_equilibrium({}, bar, state).status, StaticStatus::converged);
  const double q = state.q[0];
  EXPECT_NEAR(q / std::sin(q), bar.weight, 1e-9);
  EXPECT_NEAR(std::abs(q), 1.0267, 1e-3);
}

/// The same with a spring of its own that the bar pushes, and that does not push back.
class InvertedPusher : public Inverted {
 public:
  int coordinate_count() const override { return 2; }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    Inverted::residual(state, dynamics.head(1), constraints);
    dynamics[1] = state.a[1] + state.q[1] - push * state.q[0];
  }
  double push = 5;

 protected:
  Eigen::MatrixXd mass(const State&) const override { return Eigen::MatrixXd::Identity(2, 2); }
  Eigen::MatrixXd stiffness(const State& state) const override {
    return Eigen::Matrix2d{{Inverted::stiffness(state)(0, 0), 0}, {-push, 1}};
  }
};

TEST(StaticEquilibrium, AnUnstableEquilibriumUnderForcesWithoutEnergyIsLeftToo) {
  InvertedPusher bar;
  State state = resting(Eigen::VectorXd::Zero(2));
  ASSERT_EQ(find_static_equilibrium({}, bar, state).status, StaticStatus::converged);
  EXPECT_NEAR(state.q[0] / std::sin(state.q[0]), bar.weight, 1e-9);
  EXPECT_NEAR(std::abs(state.q[0]), 1.0267, 1e-3);
  EXPECT_NEAR(state.q[1], bar.push * state.q[0], 1e-9);
}

// Its tangent is not positive definite: the push is ten times what that takes.
TEST(StaticEquilibrium, BelowTheCriticalWeightForcesWithoutEnergyLeaveItUpright) {
  InvertedPusher bar;
  bar.weight = 0.99;
  State state = resting(Eigen::VectorXd::Zero(2));
  ASSERT_EQ(find_static_equilibrium({}, bar, state).status, StaticStatus::converged);
  EXPECT_EQ(state.q.norm(), 0);
}

TEST(StaticEquilibrium, BelowTheCriticalWeightTheBarStaysUpright) {
  Inverted bar;
  bar.weight = 0.99;
  State state = resting(Eigen::VectorXd::Zero(1));
  ASSERT_EQ(find_static_equilibrium({}, bar, state).status, StaticStatus::converged);
  EXPECT_EQ(state.q[0], 0);
}

TEST(StaticEquilibrium, StiffnessesTwelveMagnitudesApartAreBothSatisfied) {
  UnlikeSprings system;
  State state = resting(Eigen::Vector2d::Zero());
  ASSERT_EQ(find(system, state).status, StaticStatus::converged);
  EXPECT_NEAR(state.q[0], 1e-13, 1e-22);
  EXPECT_NEAR(state.q[1], 0.1, 1e-10);
}

TEST(StaticEquilibrium, WithoutAnEquilibriumTheSearchEndsWithTheLastOne) {
  UnlikeSprings system;
  system.springs[1] = 0;
  State state = resting(Eigen::Vector2d::Zero());
  const StaticReport report = find(system, state);
  EXPECT_NE(report.status, StaticStatus::converged);
  EXPECT_EQ(report.load_factor, 0);
  EXPECT_EQ(state.load, 0);
  EXPECT_EQ(state.q.norm(), 0);
}

/// A spring whose force fails beyond a place, as an exception or as no number.
class BrittleSpring : public UnlikeSprings {
 public:
  bool throws = true;
  BrittleSpring() {
    springs = Eigen::Vector2d(1, 1);
    force = 0.5;
  }
  void residual(const State& state, Eigen::Ref<Eigen::VectorXd> dynamics,
                Eigen::Ref<Eigen::VectorXd> constraints) const override {
    UnlikeSprings::residual(state, dynamics, constraints);
    if (state.q[0] < 0.25) return;
    if (throws) throw std::runtime_error("the spring broke");
    dynamics.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
};

TEST(StaticEquilibrium, AnExceptionOfTheSystemArrivesOnOurSide) {
  BrittleSpring system;
  State state = resting(Eigen::Vector2d::Zero());
  try {
    const StaticReport report = find(system, state);
    FAIL() << static_cast<int>(report.status);
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), "the spring broke");
  }
}

TEST(StaticEquilibrium, AForceThatIsNoNumberIsAStatusAtTheLoadReached) {
  BrittleSpring system;
  system.throws = false;
  State state = resting(Eigen::Vector2d::Zero());
  const StaticReport report = find(system, state);
  EXPECT_EQ(report.status, StaticStatus::not_converged);
  EXPECT_NEAR(report.load_factor, 0.5, 2e-3);
  EXPECT_NEAR(state.q[0], 0.5 * report.load_factor, 1e-10);
}

TEST(StaticEquilibrium, RefusesSettingsOutOfRangeAndAStartOfTheWrongSize) {
  Chain chain;
  State state = resting(chain.straight());
  State empty;
  EXPECT_THROW((void)hang(chain, state, {.tolerance = 0}), std::invalid_argument);
  EXPECT_THROW((void)hang(chain, state, {.max_iterations = 0}), std::invalid_argument);
  EXPECT_THROW((void)hang(chain, empty), std::invalid_argument);
}

}  // namespace
}  // namespace nurbeam
