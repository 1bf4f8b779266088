#include "fem/constraints/node_section.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/section_witness.h"

namespace nurbeam::testing::node_section_test {

struct Twisted {
  BeamSystem system;
  double L;

  Twisted() : system(made()), L(system.model().beams[0].curve.length()) {}
  static BeamModel made() {
    ModelBuilder builder(3);
    add_twisted_beam(builder);
    return builder.build();
  }
  MeshedBeams<3> at() const { return system.assembly<3>()->beams(); }
  NodeSection section(double part) const { return NodeSection::at(at(), drawn_state(system).q, 0, part * L); }
};

TEST(NodeSection, IsInTheDrawingTheDrawnOneWithNoAngle) {
  const Twisted twisted;
  for (const double part : {0.0, 0.5, 1.0}) {
    const NodeSection node = twisted.section(part);
    const DrawnSection drawn = twisted.system.model().beams[0].curve.section(part * twisted.L, part == 1);
    Eigen::Matrix3d triad;
    triad << drawn.d1, drawn.d2, drawn.t;
    EXPECT_LT((node.drawn - triad).norm(), 1e-12) << part;
    const Eigen::Vector4d x = node.coordinates(drawn_state(twisted.system).q);
    EXPECT_LT((x.head<3>() - drawn.t).norm(), 1e-12) << part;
    EXPECT_EQ(x[3], 0);
    EXPECT_LT((node.triad<double>(x).matrix() - triad).norm(), 1e-12) << part;
  }
}

// Seen from the element before it and from the one after it.
TEST(NodeSection, IsTheSameFromBothSides) {
  const Twisted twisted;
  std::mt19937 random(1);
  const State state = disturbed_state(twisted.system, random);
  const auto& elements = twisted.at().elements;
  const NodeSection before(elements[2], 1), after(elements[3], 0);
  EXPECT_EQ(before.dofs, after.dofs);
  expect_same(before.triad<double>(before.coordinates(state.q)).matrix().reshaped(),
              after.triad<double>(after.coordinates(state.q)).matrix().reshaped(), 1e-12);
}

TEST(NodeSection, IsTurnedBySmallestRotationAndThenByItsAngle) {
  const Twisted twisted;
  std::mt19937 random(2);
  const NodeSection node = twisted.section(0.5);
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::Vector4d x = node.coordinates(drawn_state(twisted.system).q) + random_vector(4, random);
    x[3] *= 3;
    expect_same(node.triad<double>(x).matrix().reshaped(),
                turned_section(node.drawn, x.head<3>(), x[3]).reshaped(), 1e-13);
  }
}

// The work of a moment m over a small motion is m . spin, whatever coordinates move.
TEST(NodeSection, TakesTheWorkOfAMomentOnItsSpin) {
  const Twisted twisted;
  std::mt19937 random(3);
  const NodeSection node = twisted.section(0.5);
  for (int trial = 0; trial < 5; ++trial) {
    const Eigen::Vector4d x = node.coordinates(drawn_state(twisted.system).q) +
                              0.5 * random_vector(4, random),
                          dx = random_vector(4, random);
    const Eigen::Vector3d m = random_vector(3, random);
    const Eigen::Matrix3d now = turned_section(node.drawn, x.head<3>(), x[3]);
    expect_rate_of_number(
        [&](double h) {
          const Eigen::Vector4d there = x + h * dx;
          return m.dot(
              rotation_vector(turned_section(node.drawn, there.head<3>(), there[3]) * now.transpose()));
        },
        node.force<double>(x, m).dot(dx));
  }
}

}  // namespace nurbeam::testing::node_section_test
