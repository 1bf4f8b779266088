#include "fem/constraints/corner_angle.h"

#include <cmath>
#include <numbers>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::corner_angle_test {

// Number of the node at the corner of a model with one.
int corner_of(const BeamSystem& system) {
  const double s = system.model().beams[0].curve.breaks()[2];
  const std::vector<MeshNode>& nodes = system.mesh().nodes[0];
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i)
    if (std::abs(nodes[static_cast<std::size_t>(i)].s - s) < 1e-9) return i;
  return -1;
}

template <int D>
BeamSystem with_corner() {
  std::mt19937 random(D);
  return BeamSystem(cornered_model(random, D));
}

// Of the slopes opened further by an angle about the normal of their plane, and of stretched ones.
template <int D>
void check_value() {
  const BeamSystem system = with_corner<D>();
  const MeshNode& node = system.mesh().nodes[0][static_cast<std::size_t>(corner_of(system))];
  const auto corner = the_constraint<D, CornerAngle<D>>(system);
  State state = drawn_state(system);
  EXPECT_NEAR(corner.value(state)[0], 0, 1e-14);
  const Eigen::Vector3d a = vector_at(system, state.q, node.slope_left),
                        b = vector_at(system, state.q, node.slope_right), normal = a.cross(b).normalized();
  const double drawn = std::acos(a.dot(b)), opened = 0.3;
  state.q.segment<D>(node.slope_left) *= 1.2;
  state.q.segment<D>(node.slope_right) =
      0.8 * (Eigen::AngleAxisd(opened, normal).toRotationMatrix() * b).template head<D>();
  const double expected =
      0.96 * (D == 2 ? normal.z() * std::sin(opened) : std::cos(drawn + opened) - std::cos(drawn));
  EXPECT_NEAR(corner.value(state)[0], expected, 1e-13);
}
TEST(CornerAngle, IsTheChangeOfTheAngleBetweenBothSlopes) {
  check_value<2>();
  check_value<3>();
}

template <int D>
void check_derivatives() {
  std::mt19937 random(2);
  const BeamSystem system = with_corner<D>();
  const auto corner = the_constraint<D, CornerAngle<D>>(system);
  const State state = disturbed_state(system, random);
  expect_derivatives(corner, state, random);
  const State moved = rigidly_moved(system, state, random_rigid_motion(D, random));
  expect_same(corner.value(moved), corner.value(state), 1e-12);
}
TEST(CornerAngle, HasTheDerivativesOfItsValueAndKnowsNoRigidMotion) {
  check_derivatives<2>();
  check_derivatives<3>();
}

template <int D>
void check_couples() {
  std::mt19937 random(3);
  const BeamSystem system = with_corner<D>();
  const State state = disturbed_state(system, random);
  const Eigen::VectorXd forces =
      the_constraint<D, CornerAngle<D>>(system).forces(state, Eigen::VectorXd::Constant(1, 1.3));
  const Resultant before =
      resultant(system, state, forces, coordinates_before_node(system, 0, corner_of(system)));
  EXPECT_LT(before.force.norm(), 1e-10);
  EXPECT_GT(before.moment.norm(), 0.1);
  expect_opposite(resultant(system, state, forces), {});
}
TEST(CornerAngle, IsOppositeCouplesOnBothSides) {
  check_couples<2>();
  check_couples<3>();
}

// The rigid corners alone, and with torsion none: sections are held there.
TEST(CornerAngle, IsAskedForByRigidCornersWithoutTorsion) {
  EXPECT_EQ((count_of<2, CornerAngle<2>>(with_corner<2>())), 1);
  EXPECT_EQ((count_of<3, CornerAngle<3>>(with_corner<3>())), 1);
  std::mt19937 random(4);
  EXPECT_EQ((count_of<3, CornerAngle<3>>(BeamSystem(torsion_model(random, 3)))), 0);
  EXPECT_EQ((count_of<2, CornerAngle<2>>(BeamSystem(model_with_everything(random, 2)))), 0);
}

}  // namespace nurbeam::testing::corner_angle_test
