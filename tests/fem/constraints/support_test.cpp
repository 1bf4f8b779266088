#include "fem/constraints/support.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::support_test {

DisplacementTable motion(int dimension) {
  const Eigen::Vector3d a(0.1, 0.2, dimension == 3 ? 0.3 : 0);
  return DisplacementTable([=](double t) {
    return DisplacementTable::Motion{std::sin(2 * t) * a, 2 * std::cos(2 * t) * a, -4 * std::sin(2 * t) * a};
  });
}

template <int D>
BeamSystem held(double part, bool moves) {
  ModelBuilder builder(D);
  const int beam = add_bent_beam(builder, D);
  Support support{.beam = beam, .s = part * builder.beam(beam).curve.length()};
  if (moves) support.motion = motion(D);
  return BeamSystem(builder.add(support).build());
}

template <int D>
void check_value(double part) {
  std::mt19937 random(1);
  const BeamSystem system = held<D>(part, true);
  const auto support = the_constraint<D, HeldPosition<D>>(system);
  const AffineMap map = random_map(D, random);
  const ReferenceCurve& curve = system.model().beams[0].curve;
  const Eigen::Vector3d r0 = curve.position(part * curve.length());
  State state = mapped_drawing(system, map);
  state.t = 0.4;
  state.load = 0.6;
  const Eigen::Vector3d open = map(r0) - r0 - 0.6 * motion(D).at(0.4).value;
  expect_same(support.value(state), open.head<D>(), 1e-12);

  const Eigen::VectorXd y = random_vector(D, random);
  const Resultant on_beam = resultant(system, state, support.forces(state, y));
  expect_same(on_beam.force, -widened<D>(Eigen::Matrix<double, D, 1>(y)));
  EXPECT_LT(on_beam.about(map(r0)).norm(), 1e-9);
}
TEST(HeldPosition, IsTheWayFromWhereThePlaceIsToBe) {
  for (const double part : {0.0, 0.4, 1.0}) {
    check_value<2>(part);
    check_value<3>(part);
  }
}

template <int D>
void check_derivatives(double part) {
  for (const bool moves : {false, true}) {
    std::mt19937 random(2);
    const BeamSystem system = held<D>(part, moves);
    const auto support = the_constraint<D, HeldPosition<D>>(system);
    State state = disturbed_state(system, random);
    state.t = 0.3;
    expect_derivatives(support, state, random);
    const Eigen::VectorXd y = random_vector(D, random);
    expect_work(support, state, y, y.dot(support.rate(state.t)));
    EXPECT_EQ(support.rate(state.t).norm() > 0, moves);
  }
}
TEST(HeldPosition, HasTheDerivativesOfItsValueAndDoesTheWorkOfItsMotion) {
  for (const double part : {0.0, 0.4, 1.0}) {
    check_derivatives<2>(part);
    check_derivatives<3>(part);
  }
}

// How many rows each kind of support holds, and by what.
TEST(Support, IsBoundToWhatItHolds) {
  const auto rows = [](int dimension, bool torsion, const Support& support) {
    ModelBuilder builder(dimension);
    torsion ? add_twisted_beam(builder) : add_bent_beam(builder, dimension);
    return BeamSystem(builder.add(support).build()).constraint_count();
  };
  const Eigen::Vector3d x(1, 0, 0);
  EXPECT_EQ(rows(2, false, {.beam = 0, .s = 0}), 2);
  EXPECT_EQ(rows(3, false, {.beam = 0, .s = 0}), 3);
  EXPECT_EQ(rows(2, false, {.beam = 0, .s = 0, .clamped = true}), 2 + 1);
  EXPECT_EQ(rows(3, false, {.beam = 0, .s = 0, .clamped = true}), 3 + 2);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .clamped = true}), 3 + 2 + 1);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .fork = true}), 3 + 1);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .axis = x}), 3 + 2);
  EXPECT_EQ(rows(2, false, {.beam = 0, .s = 0, .guide = x}), 1);
  EXPECT_EQ(rows(3, true, {.beam = 0, .s = 0, .guide = x}), 2);
}

}  // namespace nurbeam::testing::support_test
