#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "fem/motion/remesh/transfer.h"
#include "tests/fem/random_models.h"

namespace nurbeam {
namespace {

using testing::disturbed_state;

constexpr double radius = 0.7;

/// A circle about the origin from four quarters, without supports.
BeamModel ring_model(int dimension, int elements = 16) {
  ModelBuilder builder(dimension);
  builder.add_beam(ReferenceCurve(testing::arc_cubics({0, 0, 0}, radius, 0, 2 * M_PI, 4), dimension,
                                  Metric::arc_length, true),
                   BeamProperties{300, 2, 0.7}, {elements});
  return builder.build();
}

TEST(RingCurve, GoesOnOverItsSeam) {
  const ReferenceCurve curve(testing::arc_cubics({0, 0, 0}, radius, 0, 2 * M_PI, 4), 2, Metric::arc_length,
                             true);
  const double L = curve.length();
  EXPECT_NEAR(L, 2 * M_PI * radius, 1e-14);
  for (const double s : {-0.3, -1e-20, 0.0, 0.4, 4.3, 4.5, 9.0}) {
    const double angle = s / radius;
    EXPECT_LT((curve.position(s) - radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0)).norm(),
              1e-14);
    EXPECT_LT((curve.tangent(s) - Eigen::Vector3d(-std::sin(angle), std::cos(angle), 0)).norm(), 1e-13);
    EXPECT_GE(curve.wrapped(s), 0);
    EXPECT_LT(curve.wrapped(s), L);
  }
  EXPECT_EQ(curve.segment_at(0, true), 3);
  EXPECT_EQ(curve.segment_at(L), 0);
  EXPECT_NEAR(curve.next_break(0.9 * L), L, 1e-15);
  EXPECT_NEAR(curve.next_break(L), 1.25 * L, 1e-15);
  EXPECT_NEAR(curve.next_break(-0.1 * L), 0, 1e-15);
  EXPECT_NEAR(curve.parameter(0, 1.125 * L), 0.5, 1e-12);
  EXPECT_NEAR(curve.unrolled(0.1 * L, 2.9 * L), 3.1 * L, 1e-14);
}

TEST(RingCurve, OfACurveThatIsNotClosedIsRefused) {
  EXPECT_THROW(ReferenceCurve(testing::arc_cubics({0, 0, 0}, radius, 0, 6, 4), 2, Metric::arc_length, true),
               std::invalid_argument);
  EXPECT_THROW(ReferenceCurve(testing::arc_cubics({0, 0, 0}, radius, 0, 2 * M_PI, 4), 2, Metric::label, true),
               std::invalid_argument);
}

TEST(Ring, HasAsManyNodesAsElements) {
  const BeamModel model = ring_model(2);
  const BeamSystem system(model, initial_plan(model));
  EXPECT_EQ(system.mesh().spans.size(), 16u);
  EXPECT_EQ(system.coordinate_count(), 16 * 4);
}

template <int D>
Eigen::VectorXd ring_residual(const BeamSystem& system, const State& state) {
  Eigen::VectorXd force(system.coordinate_count()), constraints(system.constraint_count());
  system.residual(state, force, constraints);
  return force;
}

/// r -> A r + b and r_s -> A r_s of all nodes.
template <int D>
void map(const BeamSystem& system, const Eigen::Matrix<double, D, D>& A, const Eigen::Matrix<double, D, 1>& b,
         Eigen::VectorXd& q) {
  for (const MeshNode& node : system.mesh().nodes[0]) {
    q.segment<D>(node.r) = (A * q.segment<D>(node.r) + b).eval();
    for (const int slope : std::set{node.slope_left, node.slope_right})
      q.segment<D>(slope) = (A * q.segment<D>(slope)).eval();
  }
}

TEST(Ring, AsDrawnAndTurnedAndMovedHasNoForce) {
  BeamModel model = ring_model(2);
  testing::add_slider(model, 0.3, 0.001);
  model.riders[0].continuous_slope = false;  // hides the seam
  const BeamSystem system(model, initial_plan(model));
  EXPECT_FALSE(system.mesh().plan.beams[0].present[0]);
  State state = drawn_state(system);
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(2.1).toRotationMatrix();
  map<2>(system, turn, Eigen::Vector2d(3, -1), state.q);
  // Both elements at the slider are plain cubics in arc length: not exactly arcs.
  EXPECT_LT(energy(system, state).mechanical(), 1e-4);
  model.riders.clear();
  model.bodies.clear();
  const BeamSystem alone(model, initial_plan(model));
  state = drawn_state(alone);
  map<2>(alone, turn, Eigen::Vector2d(3, -1), state.q);
  EXPECT_LT(energy(alone, state).mechanical(), 1e-24);
  EXPECT_LT(ring_residual<2>(alone, state).norm(), 1e-11);
}

TEST(Ring, SpinningIsStretchedByItsHoopForce) {
  // N = EA e sqrt(1 + 2 e) with Green's strain e, and the ring's N / R = rho A omega^2 R sqrt(1 + 2 e):
  // e = rho A omega^2 R^2 / EA, whatever EI, as the rotation per reference length stays.
  const BeamModel model = ring_model(2);
  const BeamProperties& p = model.beams[0].properties;
  const BeamSystem system(model, initial_plan(model));
  const double omega = 11, e = p.mass_per_length * omega * omega * radius * radius / p.axial_stiffness;
  State state = drawn_state(system);
  map<2>(system, Eigen::Matrix2d::Identity() * std::sqrt(1 + 2 * e), Eigen::Vector2d::Zero(), state.q);
  state.v = state.a = state.q;
  Eigen::Matrix2d spin;
  spin << 0, -omega, omega, 0;
  map<2>(system, spin, Eigen::Vector2d::Zero(), state.v);
  map<2>(system, -omega * omega * Eigen::Matrix2d::Identity(), Eigen::Vector2d::Zero(), state.a);
  EXPECT_GT(e, 0.1);
  EXPECT_LT(ring_residual<2>(system, state).norm(), 1e-10 * p.axial_stiffness * e);
  const double L = model.beams[0].curve.length();
  EXPECT_NEAR(energy(system, state).axial, p.axial_stiffness * e * e / 2 * L, 1e-10);
  EXPECT_NEAR(energy(system, state).kinetic,
              p.mass_per_length * L * omega * omega * radius * radius * (1 + 2 * e) / 2, 1e-10);
  EXPECT_NEAR(beam_length(system, state, 0), L * std::sqrt(1 + 2 * e), 1e-11);
}

// Forces at rest are the gradient of the energy, for a slider whose element spans the seam.
template <int D>
void check_gradient(double place) {
  std::mt19937 random(71);
  BeamModel model = ring_model(D);
  if (D == 3) model.beams[0].curve = model.beams[0].curve.straightened();
  model.gravity = {0.3, -9.81, 0};
  testing::add_slider(model, 0.8, place);
  model.riders[0].continuous_slope = false;
  const BeamSystem system(model, initial_plan(model));
  State state = disturbed_state(system, random, 0.01);
  state.v.setZero();
  state.a.setZero();
  const Eigen::VectorXd force = ring_residual<D>(system, state);
  for (int i = 0; i < system.coordinate_count(); ++i) {
    const auto moved_energy = [&](double h) {
      State moved = state;
      moved.q[i] += h;
      return energy(system, moved).mechanical();
    };
    const double h = 1e-5, slope = (8 * (moved_energy(h) - moved_energy(-h)) - moved_energy(2 * h) +
                                    moved_energy(-2 * h)) /
                                   (12 * h);
    ASSERT_NEAR(force[i], slope, 1e-6 * std::max(1.0, std::abs(slope))) << i;
  }
}

TEST(Ring, HasTheGradientOfItsEnergyAsForceWhereASliderSpansTheSeam) {
  const double L = 2 * M_PI * radius;
  for (const double place : {0.001, L - 0.1, 2 * L - 0.002}) {
    check_gradient<2>(place);
    check_gradient<3>(place);
  }
}

TEST(Ring, IsTheSameHoweverOftenTheSliderHasGoneRound) {
  std::mt19937 random(72);
  BeamModel model = ring_model(2);
  testing::add_slider(model, 0.8, 0.4);
  const double L = model.beams[0].curve.length();
  for (const double place : {0.4, 0.001, L - 0.001}) {
    model.riders[0].s = place;
    const BeamSystem first(model, initial_plan(model));
    const State state = disturbed_state(first, random, 0.01);
    for (const int turns : {-2, 1, 5}) {
      model.riders[0].s = place + turns * L;
      const BeamSystem later(model, initial_plan(model));
      State same = state;
      same.q[later.mesh().riders[0].place] += turns * L;
      EXPECT_LT((ring_residual<2>(later, same) - ring_residual<2>(first, state)).norm(),
                1e-9 * ring_residual<2>(first, state).norm());
      EXPECT_NEAR(energy(later, same).mechanical(), energy(first, state).mechanical(), 1e-9);
      EXPECT_LT((momentum(later, same) - momentum(first, state)).norm(), 1e-9);
    }
  }
}

TEST(Ring, ANodeThatComesAndGoesAtTheSeamKeepsEnergyAndMomentum) {
  std::mt19937 random(73);
  for (const double place : {0.004, -0.004}) {
    BeamModel model = ring_model(2);
    testing::add_slider(model, 0.8, place);
    model.riders[0].continuous_slope = false;
    MeshPlan hidden = initial_plan(model), there = hidden;
    ASSERT_FALSE(hidden.beams[0].present[0]);
    there.beams[0].present[0] = true;
    const BeamSystem with(model, there), without(model, hidden);
    State state = drawn_state(with);
    std::uniform_real_distribution<double> unit(-1, 1);
    for (double& v : state.v) v = unit(random);
    for (const auto& [from, to] : {std::pair{&with, &without}, {&without, &with}}) {
      const std::optional<Transferred> after = projected(*from, state, *to);
      ASSERT_TRUE(after);
      EXPECT_LT((momentum(*to, after->state) - momentum(*from, state)).norm(), 1e-6);
      const double before = energy(*from, state).mechanical();
      EXPECT_NEAR(energy(*to, after->state).mechanical(), before, 1e-9 * before);
      state = after->state;
    }
  }
}

TEST(Ring, LengthControlDoesAtTheSeamWhatItDoesAtEveryBreak) {
  // Four equal quarters: the changes of the mesh over a quarter of a turn are those over every other.
  BeamModel model = ring_model(2);
  const double L = model.beams[0].curve.length();
  testing::add_slider(model, 0.8, L / 32);
  for (const auto& [speed, continuous] : {std::pair{1.0, true}, {-1.0, true}, {1.0, false}, {-1.0, false}}) {
    model.riders[0].continuous_slope = continuous;
    MeshPlan plan = initial_plan(model);
    std::vector<std::vector<std::pair<MeshChange, long>>> quarters(12);
    constexpr int per_quarter = 300, steps = 12 * per_quarter;
    for (int i = 0; i < steps; ++i) {
      plan.places[0] = L / 32 + speed * (i + 0.5) / steps * 3 * L;
      while (true) {
        const BeamSystem system(model, plan);
        State state = drawn_state(system);
        state.v[system.mesh().riders[0].place] = speed;
        ASSERT_TRUE(system.admissible(state));
        const NextPlan next = next_plan(system, state, LengthControl{});
        if (next.change == MeshChange::none) break;
        quarters[i / per_quarter].emplace_back(next.change, i % per_quarter);
        ASSERT_LE(quarters[i / per_quarter].size(), 30u);
        plan = next.plan;
      }
    }
    EXPECT_GT(quarters[1].size(), 4u);
    for (int k = 2; k < 12; ++k) {
      ASSERT_EQ(quarters[k].size(), quarters[1].size()) << k;
      for (std::size_t j = 0; j < quarters[k].size(); ++j) {
        EXPECT_EQ(quarters[k][j].first, quarters[1][j].first);
        EXPECT_NEAR(double(quarters[k][j].second), double(quarters[1][j].second), 1);
      }
    }
  }
}

}  // namespace
}  // namespace nurbeam
