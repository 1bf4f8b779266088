#include "fem/constraints/joined_points.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::joined_points_test {

// Parts of both beams that are joined: at ends and at inner places; they are apart in the drawing.
struct Places {
  double a, b;
};
constexpr Places places[] = {{1, 0}, {0.4, 0.7}, {0, 1}};

BeamModel joined_at(int dimension, const Places& at, bool rigid, bool torsion = false) {
  ModelBuilder builder(dimension);
  const int a = torsion ? add_twisted_beam(builder) : add_bent_beam(builder, dimension),
            b = builder.add_beam(ReferenceCurve({going_on(dimension)}, dimension),
                                 torsion ? with_sections() : BeamProperties(300, 2, 0.7), {5});
  builder.join(a, at.a * builder.beam(a).curve.length(), b, at.b * builder.beam(b).curve.length(), rigid);
  return builder.build();
}

Eigen::Vector3d drawn_gap(const BeamSystem& system, const Places& at) {
  const ReferenceCurve &a = system.model().beams[0].curve, &b = system.model().beams[1].curve;
  return a.position(at.a * a.length()) - b.position(at.b * b.length());
}

template <int D>
void check_value(const Places& at) {
  std::mt19937 random(1);
  const BeamSystem system(joined_at(D, at, false));
  const AffineMap map = random_map(D, random);
  const Eigen::Vector3d gap = drawn_gap(system, at);
  const auto joint = the_constraint<D, JoinedPoints<D>>(system);
  expect_same(joint.value(mapped_drawing(system, map)), (map.F * gap - gap).head<D>(), 1e-12);
}
TEST(JoinedPoints, AreOpenByTheChangeOfTheDistance) {
  for (const Places& at : places) {
    check_value<2>(at);
    check_value<3>(at);
  }
}

template <int D>
void check_derivatives(const Places& at) {
  std::mt19937 random(2);
  const BeamSystem system(joined_at(D, at, false));
  const auto joint = the_constraint<D, JoinedPoints<D>>(system);
  const State state = disturbed_state(system, random);
  expect_derivatives(joint, state, random);

  const Eigen::Matrix<double, D, 1> y = random_vector(D, random);
  const Eigen::VectorXd forces = joint.forces(state, y);
  const Resultant on_a = resultant(system, state, forces, coordinates_of_beam(system, 0)),
                  on_b = resultant(system, state, forces, coordinates_of_beam(system, 1));
  expect_same(on_a.force, -widened<D>(y));
  expect_same(on_b.force, widened<D>(y));
  if (drawn_gap(system, at).norm() > 1e-9) return;
  // In one place there is no arm between both forces: each beam turns about it without work.
  const Eigen::Vector3d there =
      system.model().beams[0].curve.position(at.a * system.model().beams[0].curve.length());
  const State drawn = drawn_state(system);
  const Resultant at_rest = resultant(system, drawn, joint.forces(drawn, y), coordinates_of_beam(system, 0));
  EXPECT_LT(at_rest.about(there).norm(), 1e-9);
}
TEST(JoinedPoints, HaveTheDerivativesOfTheirValueAndOppositeForces) {
  for (const Places& at : places) {
    check_derivatives<2>(at);
    check_derivatives<3>(at);
  }
}

// What a joint means: of hinges, rigid joints, and of both with torsion.
TEST(BeamJoint, IsBoundToWhatItHolds) {
  const Places& at = places[0];
  const BeamSystem hinge(joined_at(2, at, false)), rigid(joined_at(2, at, true)),
      in_space(joined_at(3, at, true)), sections(joined_at(3, at, true, true)),
      free(joined_at(3, at, false, true));
  EXPECT_EQ(hinge.constraint_count(), 2);
  EXPECT_EQ(rigid.constraint_count(), 2 + 1);
  EXPECT_EQ((count_of<2, JoinedSlopes<2>>(rigid)), 1);
  EXPECT_EQ(in_space.constraint_count(), 3 + 1);
  EXPECT_EQ(sections.constraint_count(), 3 + 3);
  EXPECT_EQ((count_of<3, JoinedSections>(sections)), 1);
  EXPECT_EQ(free.constraint_count(), 3);
}

}  // namespace nurbeam::testing::joined_points_test
