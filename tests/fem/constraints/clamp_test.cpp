#include "fem/constraints/clamp.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::clamp_test {

BeamSystem clamped(int dimension, double part) {
  ModelBuilder builder(dimension);
  const int beam = add_bent_beam(builder, dimension);
  builder.clamp(beam, part * builder.beam(beam).curve.length());
  return BeamSystem(builder.build());
}

Eigen::Vector3d drawn_tangent(const BeamSystem& system, double part) {
  const ReferenceCurve& curve = system.model().beams[0].curve;
  return curve.tangent(part * curve.length(), part == 1);
}

template <int D>
void check_value(double part) {
  std::mt19937 random(1);
  const BeamSystem system = clamped(D, part);
  const AffineMap map = random_map(D, random);
  const Eigen::Vector3d t = drawn_tangent(system, part), slope = map.F * t;
  const auto clamp = the_constraint<D, HeldDirection<D>>(system);
  const Eigen::VectorXd value = clamp.value(mapped_drawing(system, map));
  EXPECT_NEAR(value.norm(), (slope - slope.dot(t) * t).norm(), 1e-12);
  if constexpr (D == 2) EXPECT_NEAR(value[0], t.cross(slope).z(), 1e-12);
  // Stretched and moved, not turned.
  EXPECT_LT(clamp.value(mapped_drawing(system, {1.2 * Eigen::Matrix3d::Identity(), map.c})).norm(), 1e-13);
}
TEST(HeldDirection, IsThePartOfTheSlopeAcrossTheDrawnOne) {
  for (const double part : {0.0, 0.4, 1.0}) {
    check_value<2>(part);
    check_value<3>(part);
  }
}

template <int D>
void check_derivatives(double part) {
  std::mt19937 random(2);
  const BeamSystem system = clamped(D, part);
  expect_derivatives(the_constraint<D, HeldDirection<D>>(system), disturbed_state(system, random), random);
}
TEST(HeldDirection, HasTheDerivativesOfItsValue) {
  for (const double part : {0.0, 0.4, 1.0}) {
    check_derivatives<2>(part);
    check_derivatives<3>(part);
  }
}

template <int D>
void check_couple(double part) {
  std::mt19937 random(3);
  const BeamSystem system = clamped(D, part);
  const State state = disturbed_state(system, random);
  const auto clamp = the_constraint<D, HeldDirection<D>>(system);
  const Eigen::VectorXd y = Eigen::Vector2d(1.3, -0.8).head<D - 1>();
  const Resultant on_beam = resultant(system, state, clamp.forces(state, y));
  EXPECT_LT(on_beam.force.norm(), 1e-10);
  EXPECT_GT(on_beam.moment.norm(), 0.01);
  expect_same(on_beam.moment, clamp.constraint.couple(clamp.in.beams(), state, y));
}
TEST(HeldDirection, IsACoupleOnTheBeam) {
  for (const double part : {0.0, 0.4, 1.0}) {
    check_couple<2>(part);
    check_couple<3>(part);
  }
}

}  // namespace nurbeam::testing::clamp_test
