#include "fem/constraints/guided_place.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"

namespace nurbeam::testing::guided_place_test {

constexpr double place = 0.7;

Eigen::Vector3d along(int dimension) { return {0.8, 0.6, dimension == 3 ? -0.5 : 0}; }

DisplacementTable motion(int dimension) {
  const Eigen::Vector3d a(0.1, 0.2, dimension == 3 ? 0.3 : 0), b(0.2, -0.1, dimension == 3 ? 0.1 : 0);
  return DisplacementTable([=](double t) {
    return DisplacementTable::Motion{std::sin(2 * t) * a + t * t * b, 2 * std::cos(2 * t) * a + 2 * t * b,
                                     -4 * std::sin(2 * t) * a + 2 * b};
  });
}

template <int D>
BeamSystem guided(bool moves) {
  ModelBuilder builder(D);
  const int beam = add_bent_beam(builder, D);
  Support support{.beam = beam, .s = place, .guide = along(D)};
  if (moves) support.motion = motion(D);
  return BeamSystem(builder.add(support).build());
}

template <int D>
void check_value() {
  std::mt19937 random(1);
  const BeamSystem system = guided<D>(true);
  const auto guide = the_constraint<D, GuidedPlace<D>>(system);
  const AffineMap map = random_map(D, random);
  const Eigen::Vector3d r0 = system.model().beams[0].curve.position(place), u = along(D).normalized();
  State state = mapped_drawing(system, map);
  state.t = 0.4;
  state.load = 0.6;
  const Eigen::Vector3d open = map(r0) - r0 - state.load * motion(D).at(state.t).value;
  const Eigen::VectorXd value = guide.value(state);
  EXPECT_NEAR(value.norm(), (open - open.dot(u) * u).norm(), 1e-12);
  if constexpr (D == 2) EXPECT_NEAR(value[0], u.cross(open).z(), 1e-12);

  // Anywhere along the guide.
  state = mapped_drawing(system, {Eigen::Matrix3d::Identity(), motion(D).at(0.4).value + 0.3 * along(D)});
  state.t = 0.4;
  EXPECT_LT(guide.value(state).norm(), 1e-14);
}
TEST(GuidedPlace, IsThePartOfTheDisplacementAcrossTheGuide) {
  check_value<2>();
  check_value<3>();
}

template <int D>
void check_derivatives() {
  for (const bool moves : {false, true}) {
    std::mt19937 random(2);
    const BeamSystem system = guided<D>(moves);
    const auto guide = the_constraint<D, GuidedPlace<D>>(system);
    State state = disturbed_state(system, random);
    state.t = 0.3;
    expect_derivatives(guide, state, random);
    const Eigen::VectorXd y = random_vector(D - 1, random);
    expect_work(guide, state, y, y.dot(guide.rate(state.t)));
    EXPECT_EQ(guide.rate(state.t).norm() > 0, moves);
  }
}
TEST(GuidedPlace, HasTheDerivativesOfItsValueAndDoesTheWorkOfItsMotion) {
  check_derivatives<2>();
  check_derivatives<3>();
}

template <int D>
void check_force() {
  std::mt19937 random(3);
  const BeamSystem system = guided<D>(true);
  const auto guide = the_constraint<D, GuidedPlace<D>>(system);
  const State state = disturbed_state(system, random);
  const Eigen::VectorXd y = random_vector(D - 1, random);
  const Resultant on_beam = resultant(system, state, guide.forces(state, y));
  expect_same(on_beam.force, guide.constraint.force(y));
  EXPECT_NEAR(on_beam.force.dot(along(D)), 0, 1e-10);
  EXPECT_NEAR(on_beam.force.norm(), y.norm(), 1e-10);
  const MaterialPoint<D> p =
      material_point(guide.in.beams().element_at(state.q, 0, place), state.q, state.v, place);
  EXPECT_LT(on_beam.about(widened<D>(p.r)).norm(), 1e-9);
}
TEST(GuidedPlace, PushesAcrossTheGuideAlone) {
  check_force<2>();
  check_force<3>();
}

}  // namespace nurbeam::testing::guided_place_test
