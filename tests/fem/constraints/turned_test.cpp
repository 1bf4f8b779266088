#include "fem/constraints/turned.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::turned_test {

constexpr double now = 0.7, load = 0.8;

double angle_now() { return load * (now * now + 2 * now); }

// About an axis askew, in the plane about its normal.
AxisTurn turn_of(int dimension) {
  const Eigen::Vector3d axis = dimension == 3 ? Eigen::Vector3d(0.4, -1, 0.7) : Eigen::Vector3d(0, 0, -1);
  return {axis.normalized(), Eigen::Vector3d(0.3, -0.6, dimension == 3 ? 0.2 : 0), AngleMotion([](double t) {
            return AngleMotion::Moment{t * t + 2 * t, 2 * t + 2, 2};
          })};
}
DisplacementTable displacement(int dimension) {
  const Eigen::Vector3d a(0.1, 0.2, dimension == 3 ? 0.3 : 0);
  return DisplacementTable([=](double t) {
    return DisplacementTable::Motion{std::sin(2 * t) * a, 2 * std::cos(2 * t) * a, -4 * std::sin(2 * t) * a};
  });
}

BeamSystem supported(int dimension, bool torsion, Support support) {
  ModelBuilder builder(dimension);
  torsion ? add_twisted_beam(builder) : add_bent_beam(builder, dimension);
  support.s *= builder.beam(0).curve.length();
  support.turn = turn_of(dimension);
  return BeamSystem(builder.add(support).build());
}

State at_now(const BeamSystem& system, std::mt19937& random) {
  State state = disturbed_state(system, random, 0.1);
  state.t = now;
  return state;
}

// The drawing turned as the support turns.
State turned_drawing(const BeamSystem& system, double angle) {
  const AxisTurn turn = turn_of(system.dimension());
  const Eigen::Matrix3d R = turn.by(angle).R;
  AffineMap motion{R};
  motion.c = turn.about - R * turn.about;
  State state = rigidly_moved(system, drawn_state(system), motion);
  state.t = now;
  state.load = load;
  return state;
}

constexpr double too_far = 0.2;  // [rad]

// How far a support opens at least where the drawing is turned too far: its place by the chord of its way
// round the axis, or where it slides its direction by the sine. The start of the bent beam is only 0.204 m
// off the axis, and nearly square to it: a fork there opens by 0.0425, of which the place has 0.0408.
double least_opening(const BeamSystem& system) {
  const Support& support = std::get<Support>(system.model().constraints.front());
  if (support.guide) return std::sin(too_far);
  const Eigen::Vector3d arm = system.model().beams[0].curve.position(support.s) - support.turn->about,
                        &u = support.turn->axis;
  return 2 * std::sin(too_far / 2) * (arm - arm.dot(u) * u).norm();
}

// All that a support holds is kept where the drawing is turned by its angle, and by no other.
template <int D>
void expect_closed(const BeamSystem& system) {
  const State turned = turned_drawing(system, angle_now());
  Eigen::VectorXd g(system.constraint_count());
  system.constraints(turned, g);
  EXPECT_LT(g.norm(), 1e-11);
  system.constraints(turned_drawing(system, angle_now() + too_far), g);
  EXPECT_GT(g.norm(), (1 - 1e-9) * least_opening(system));
}
TEST(TurnedSupport, HoldsTheDrawingTurnedByItsAngle) {
  const Eigen::Vector3d along(1, 0.4, 0), axis(0.2, 1, 0.5);
  for (const double part : {0.0, 0.45, 1.0}) {
    expect_closed<2>(supported(2, false, {.beam = 0, .s = part, .clamped = true}));
    expect_closed<2>(supported(2, false, {.beam = 0, .s = part, .clamped = true, .guide = along}));
    expect_closed<3>(supported(3, false, {.beam = 0, .s = part, .clamped = true}));
    expect_closed<3>(supported(3, true, {.beam = 0, .s = part, .clamped = true}));
    expect_closed<3>(supported(3, true, {.beam = 0, .s = part, .clamped = true, .guide = along}));
    expect_closed<3>(supported(3, true, {.beam = 0, .s = part, .fork = true}));
    expect_closed<3>(supported(3, true, {.beam = 0, .s = part, .axis = axis}));
  }
}

TEST(TurnedSupport, HoldsAsManyRowsAsOneThatStands) {
  const Eigen::Vector3d along(1, 0.4, 0);
  const auto rows = [](int dimension, bool torsion, const Support& support) {
    return supported(dimension, torsion, support).constraint_count();
  };
  EXPECT_EQ(rows(2, false, {.beam = 0, .s = 0, .clamped = true}), 2 + 1);
  EXPECT_EQ(rows(2, false, {.beam = 0, .s = 0, .clamped = true, .guide = along}), 1 + 1);
  EXPECT_EQ(rows(3, false, {.beam = 0, .s = 0, .clamped = true}), 3 + 2);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .clamped = true}), 3 + 3);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .clamped = true, .guide = along}), 2 + 3);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .fork = true}), 3 + 1);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .axis = along}), 3 + 2);
}

// Derivatives, the work of a motion, and the couple on the beam.
template <int D, class C>
void check(const BeamSystem& system) {
  std::mt19937 random(7);
  const auto held = the_constraint<D, C>(system);
  const State state = at_now(system, random);
  expect_derivatives(held, state, random);
  const Eigen::VectorXd y = random_vector(held.rows, random);
  expect_work(held, state, y, y.dot(held.rate_in(state)));
  EXPECT_GT(held.rate_in(state).norm(), 0.01);
  if constexpr (C::offers.couple) {
    const Resultant on_beam = resultant(system, state, held.forces(state, y));
    EXPECT_LT(on_beam.force.norm(), 1e-9);
    expect_same(on_beam.moment, held.constraint.couple(held.in.beams(), state, y));
  } else if constexpr (C::offers.force) {
    expect_same(resultant(system, state, held.forces(state, y)).force, held.constraint.force(state, y));
  }
}
TEST(TurnedSupport, HasTheDerivativesOfWhatItHolds) {
  const Eigen::Vector3d along(1, 0.4, 0), axis(0.2, 1, 0.5);
  for (const double part : {0.0, 0.45, 1.0}) {
    check<2, Turned<2, ClampedDirection<2>>>(supported(2, false, {.beam = 0, .s = part, .clamped = true}));
    check<3, Turned<3, ClampedDirection<3>>>(supported(3, false, {.beam = 0, .s = part, .clamped = true}));
    const BeamSystem clamp = supported(3, true, {.beam = 0, .s = part, .clamped = true});
    check<3, Turned<3, ClampedSection>>(clamp);
    check<3, HeldPosition<3>>(clamp);
    check<3, Turned<3, TurnedFork>>(supported(3, true, {.beam = 0, .s = part, .fork = true}));
    check<3, Turned<3, TurnedHinge>>(supported(3, true, {.beam = 0, .s = part, .axis = axis}));
    for (const bool moves : {false, true}) {
      Support slides{.beam = 0, .s = part, .clamped = true, .guide = along};
      if (moves) slides.motion = displacement(2);
      check<2, TurnedGuide<2>>(supported(2, false, slides));
      if (moves) slides.motion = displacement(3);
      check<3, TurnedGuide<3>>(supported(3, true, slides));
    }
  }
}

// The moment of a clamp is its multiplier.
TEST(ClampedSection, HasItsMomentForAMultiplier) {
  const BeamSystem system = supported(3, true, {.beam = 0, .s = 0, .clamped = true});
  const auto held = the_constraint<3, Turned<3, ClampedSection>>(system);
  const Eigen::Vector3d y(0.3, -0.5, 0.2);
  expect_same(held.constraint.couple(held.in.beams(), turned_drawing(system, angle_now()), y), -y, 1e-9);
}

}  // namespace nurbeam::testing::turned_test
