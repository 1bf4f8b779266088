#include "fem/constraints/square_axes.h"

#include "fem/constraints/turned.h"
#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"
#include "tests/fem/rigid_bodies.h"

namespace nurbeam::testing::square_axes_test {

const Eigen::Vector3d axis(0.3, -0.5, 0.8);

struct Joined {
  BeamSystem system;
  int body, other;
};

// A body joined to space, to another body, or to a section of a twisted beam.
template <class Hold>
BeamSystem joined(Hold&& hold) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const int body = add_tumbling_body(builder), other = add_tumbling_body(builder, "other", {1, 0, 0});
  hold(builder, beam, body, other);
  return BeamSystem(builder.build());
}
BeamSystem joined_to_space(std::vector<AxisPair> pairs) {
  return joined([&](ModelBuilder& builder, int, int body, int) {
    builder.add(
        Constraint(BodyJoint{.name = "", .point = body, .to = Grip::at_point(tumbling_at), .pairs = pairs}));
  });
}
BeamSystem joined_to_body(std::vector<AxisPair> pairs) {
  return joined([&](ModelBuilder& builder, int, int body, int other) {
    builder.add(Constraint(BodyJoint{.name = "",
                                     .point = body,
                                     .to = Grip::on_body(other),
                                     .arm = tumbling_at - Eigen::Vector3d(1, 0, 0),
                                     .pairs = pairs}));
  });
}
BeamSystem joined_to_section(std::vector<AxisPair> pairs) {
  return joined([&](ModelBuilder& builder, int beam, int body, int) {
    const double s = builder.beam(beam).curve.end();
    builder.add(
        Constraint(BodyJoint{.name = "", .point = body, .to = Grip::on_beam(beam, s), .pairs = pairs}));
  });
}

template <int N>
void check(const BeamSystem& system, int seed) {
  std::mt19937 random(seed);
  const auto square = the_constraint<3, SquareAxes<N>>(system);
  EXPECT_LT(square.value(drawn_state(system)).norm(), 1e-14);
  expect_derivatives(square, general_state(system, random), random);
}

TEST(SquareAxes, HasTheDerivativesOfItsValue) {
  const std::vector<AxisPair> one = {hinge_pairs(axis)[0]};
  int seed = 1;
  for (const auto& join : {joined_to_space, joined_to_body, joined_to_section}) {
    check<1>(join(one), seed++);
    check<2>(join(hinge_pairs(axis)), seed++);
    check<3>(join(rigid_pairs()), seed++);
  }
}

TEST(SquareAxes, LeavesATurnAboutTheAxisOfAHingeFreeAndNoOther) {
  const BeamSystem system = joined_to_space(hinge_pairs(axis));
  const auto hinge = the_constraint<3, SquareAxes<2>>(system);
  State state = drawn_state(system);
  const int body = 0;
  put(system, state, body, tumbling_at, Eigen::Quaterniond(Eigen::AngleAxisd(2.3, axis.normalized())));
  EXPECT_LT(hinge.value(state).norm(), 1e-14);
  put(system, state, body, tumbling_at, Eigen::Quaterniond(Eigen::AngleAxisd(0.2, axis.unitOrthogonal())));
  EXPECT_NEAR(hinge.value(state).norm(), std::sin(0.2), 1e-14);
}

// The couple is the moment about which the multipliers turn the body.
TEST(SquareAxes, TellsTheCoupleOnTheBody) {
  std::mt19937 random(5);
  const BeamSystem system = joined_to_body(rigid_pairs());
  const auto rigid = the_constraint<3, SquareAxes<3>>(system);
  State state = drawn_state(system);
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.9, axis.normalized()));
  put(system, state, 0, tumbling_at, turn);
  const Eigen::Vector3d y = random_vector(3, random), spin = random_vector(3, random);
  const int p = system.mesh().attitudes[0];
  const Eigen::Vector4d rate = attitude::rate(state.q.segment<4>(p), spin);
  EXPECT_NEAR(rigid.forces(state, y).segment<4>(p).dot(rate),
              rigid.constraint.couple(rigid.in.beams(), state, y).dot(spin), 1e-14);
}

// ---- Pairs that turn against each other ----

constexpr double now = 0.7, load = 0.8;

AxisTurn turn_about(const Eigen::Vector3d& u) {
  return {u.normalized(), tumbling_at, AngleMotion([](double t) {
            return AngleMotion::Moment{t * t + 2 * t, 2 * t + 2, 2};
          })};
}
BeamSystem driven(const std::vector<AxisPair>& pairs, const Grip& to) {
  ModelBuilder builder(3);
  const int beam = add_twisted_beam(builder);
  const int body = add_tumbling_body(builder), other = add_tumbling_body(builder, "other", {1, 0, 0});
  BodyJoint joint{.name = "", .point = body, .to = to, .pairs = pairs, .turn = turn_about(axis)};
  if (to.body >= 0) joint.to = Grip::on_body(other), joint.arm = tumbling_at - Eigen::Vector3d(1, 0, 0);
  if (to.beam >= 0) joint.to = Grip::on_beam(beam, builder.beam(beam).curve.end());
  builder.add(Constraint(joint));
  return BeamSystem(builder.build());
}
const std::array<Grip, 3> holders = {Grip::at_point(tumbling_at), Grip::on_body(0), Grip::on_beam(0, 0)};

template <int N>
void check_driven(const BeamSystem& system, int seed) {
  std::mt19937 random(seed);
  const auto held = the_constraint<3, Turned<3, SquareAxes<N>>>(system);
  State state = general_state(system, random);
  state.t = now;
  state.load = load;
  expect_derivatives(held, state, random);
  const Eigen::VectorXd y = random_vector(held.rows, random);
  expect_work(held, state, y, y.dot(held.rate_in(state)));
  EXPECT_GT(held.rate_in(state).norm(), 0.01);
}
TEST(DrivenAxes, HaveTheDerivativesAndRatesOfTheirValue) {
  int seed = 11;
  for (const Grip& to : holders) {
    check_driven<2>(driven(hinge_pairs(axis), to), seed++);
    check_driven<3>(driven(rigid_pairs(), to), seed++);
  }
}

// The body goes round its axis by the angle, with what holds it; the moment of the drive is that about the
// axis as it is then.
TEST(DrivenAxes, TurnTheBodyByTheirAngleAgainstWhatHoldsIt) {
  const BeamSystem system = driven(rigid_pairs(), Grip::on_body(1));
  const auto held = the_constraint<3, Turned<3, SquareAxes<3>>>(system);
  const Eigen::Vector3d u = axis.normalized();
  const Eigen::Quaterniond other(Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, 2, -1).normalized()));
  State state = drawn_state(system);
  state.t = now;
  state.load = load;
  const double angle = load * (now * now + 2 * now);
  put(system, state, 1, {1, 0, 0}, other);
  put(system, state, 0, tumbling_at, other * Eigen::Quaterniond(Eigen::AngleAxisd(angle, u)));
  EXPECT_LT(held.value(state).norm(), 1e-14);
  const Eigen::Vector3d y(0.3, -0.8, 0.5);
  EXPECT_NEAR(held.constraint.drive(held.in.beams(), state, y),
              held.constraint.couple(held.in.beams(), state, y).dot(other * u), 1e-14);
  put(system, state, 0, tumbling_at, other * Eigen::Quaterniond(Eigen::AngleAxisd(angle + 0.1, u)));
  EXPECT_GT(held.value(state).norm(), 0.05);
}

}  // namespace nurbeam::testing::square_axes_test
