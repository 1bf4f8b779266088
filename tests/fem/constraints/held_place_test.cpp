#include "fem/constraints/held_place.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_constraint.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::held_place_test {

constexpr int body = 0;

PlaceMotion swing() {
  return PlaceMotion([](double t) {
    return PlaceMotion::Moment{0.7 + 0.2 * std::sin(3 * t), 0.6 * std::cos(3 * t), -1.8 * std::sin(3 * t)};
  });
}

// A body in motion as a node, as a point and on a guide.
template <int D>
std::vector<BeamSystem> systems(const std::optional<PlaceMotion>& motion) {
  std::vector<BeamSystem> all;
  for (const bool rigid : {false, true})
    for (const bool as_point : {false, true}) {
      ModelBuilder builder(D);
      const int beam = rigid ? builder.add_guide(bent_axis(D)) : add_bent_beam(builder, D);
      add_sliding(builder, beam, 0.7, {.as_point = as_point, .motion = motion});
      const BeamModel model = builder.build();
      all.emplace_back(model, initial_plan(model), std::vector<bool>{!motion.has_value()});
    }
  return all;
}

template <int D>
void check_value() {
  std::mt19937 random(1);
  for (const BeamSystem& system : systems<D>(swing())) {
    const auto held = the_constraint<D, HeldPlace<D>>(system);
    EXPECT_EQ(held.constraint.place(), place_of(system, body));
    State state = disturbed_state(system, random);
    state.t = 0.2;
    state.q[place_of(system, body)] = 0.75;
    EXPECT_NEAR(held.value(state)[0], 0.75 - (0.7 + 0.2 * std::sin(0.6)), 1e-15);
    expect_derivatives(held, state, random);
  }
  for (const BeamSystem& system : systems<D>({})) {
    State state = drawn_state(system);
    state.t = 3;
    state.q[place_of(system, body)] = 0.75;
    EXPECT_NEAR((the_constraint<D, HeldPlace<D>>(system).value(state)[0]), 0.05, 1e-15);
  }
}
TEST(HeldPlace, IsOpenByTheWayToTheGivenPlace) {
  check_value<2>();
  check_value<3>();
}

// The multiplier pulls towards the start of the beam.
TEST(HeldPlace, DoesTheWorkOfItsForceAlongTheBeam) {
  std::mt19937 random(2);
  for (const BeamSystem& system : systems<3>(swing())) {
    const auto held = the_constraint<3, HeldPlace<3>>(system);
    State state = disturbed_state(system, random);
    state.t = 0.2;
    state.v[place_of(system, body)] = swing().at(0.2).speed;
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(1, 1.7);
    EXPECT_NEAR(held.forces(state, y)[place_of(system, body)], -1.7, 1e-15);
    expect_work(held, state, y, y.dot(held.rate(state.t)));
  }
}

}  // namespace nurbeam::testing::held_place_test
