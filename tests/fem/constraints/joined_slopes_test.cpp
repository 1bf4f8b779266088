#include "fem/constraints/joined_slopes.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::joined_slopes_test {

// Two beams joined rigidly at these parts of their lengths.
BeamSystem joined(int dimension, double part_a, double part_b) {
  ModelBuilder builder(dimension);
  const int a = add_bent_beam(builder, dimension),
            b = builder.add_beam(ReferenceCurve({going_on(dimension)}, dimension),
                                 BeamProperties(300, 2, 0.7), {5});
  builder.join(a, part_a * builder.beam(a).curve.length(), b, part_b * builder.beam(b).curve.length(), true);
  return BeamSystem(builder.build());
}
constexpr double parts[][2] = {{1, 0}, {0.4, 0.7}, {0, 1}};

template <int D>
void check_value(double part_a, double part_b) {
  std::mt19937 random(1);
  const BeamSystem system = joined(D, part_a, part_b);
  const AffineMap map = random_map(D, random);
  const ReferenceCurve &of_a = system.model().beams[0].curve, &of_b = system.model().beams[1].curve;
  const Eigen::Vector3d t_a = of_a.tangent(part_a * of_a.length(), part_a == 1),
                        t_b = of_b.tangent(part_b * of_b.length(), part_b == 1), a = map.F * t_a,
                        b = map.F * t_b;
  const auto angle = [](const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    return D == 2 ? std::atan2(from.cross(to).z(), from.dot(to))
                  : std::acos(from.normalized().dot(to.normalized()));
  };
  const double expected =
      D == 2 ? std::sin(angle(a, b) - angle(t_a, t_b)) : std::cos(angle(a, b)) - std::cos(angle(t_a, t_b));
  const auto joint = the_constraint<D, JoinedSlopes<D>>(system);
  EXPECT_NEAR(joint.value(mapped_drawing(system, map))[0], a.norm() * b.norm() * expected, 1e-12);
}
TEST(JoinedSlopes, AreOpenByTheChangeOfTheirAngle) {
  for (const auto& [a, b] : parts) {
    check_value<2>(a, b);
    check_value<3>(a, b);
  }
}

template <int D>
void check_derivatives(double part_a, double part_b) {
  std::mt19937 random(2);
  const BeamSystem system = joined(D, part_a, part_b);
  const auto joint = the_constraint<D, JoinedSlopes<D>>(system);
  const State state = disturbed_state(system, random, 0.1);
  expect_derivatives(joint, state, random);
  const State moved = rigidly_moved(system, state, random_rigid_motion(D, random));
  expect_same(joint.value(moved), joint.value(state), 1e-12);

  const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 1.3), forces = joint.forces(state, y);
  const Resultant on_a = resultant(system, state, forces, coordinates_of_beam(system, 0));
  EXPECT_LT(on_a.force.norm(), 1e-10);
  EXPECT_GT(on_a.moment.norm(), 0.01);
  expect_same(on_a.moment, joint.constraint.couple(joint.in.beams(), state, y));
  expect_opposite(on_a, resultant(system, state, forces, coordinates_of_beam(system, 1)));
}
TEST(JoinedSlopes, HaveTheDerivativesOfTheirValueAndOppositeCouples) {
  for (const auto& [a, b] : parts) {
    check_derivatives<2>(a, b);
    check_derivatives<3>(a, b);
  }
}

}  // namespace nurbeam::testing::joined_slopes_test
