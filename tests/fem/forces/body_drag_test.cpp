#include "fem/forces/body_drag.h"

#include <cmath>

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::body_drag_test {

constexpr double density = 1.2, area = 0.5;

template <int D>
BeamSystem in_air(const Eigen::Vector3d& wind) {
  ModelBuilder builder(D);
  builder.add_body("in a vacuum", 1, {0, 0, 0});
  builder.add_body("in air", 2, {1, 0, 0});
  BeamModel model = builder.build();
  model.air = {density, wind};
  model.bodies[1].drag_area = area;
  return BeamSystem(model);
}
constexpr int body = 1;

template <int D>
void check_drag() {
  std::mt19937 random(1);
  for (const Eigen::Vector3d& wind : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, -2, 0)}) {
    const BeamSystem system = in_air<D>(wind);
    EXPECT_EQ((number_of<D, BodyDrag<D>>(system)), 1);
    const auto drag = the_force<D, BodyDrag<D>>(system);
    State state = disturbed_state(system, random);
    const Eigen::Matrix<double, D, 1> v = state.v.segment<D>(position_of(system, body)),
                                      w = wind.head<D>() - v, expected = density / 2 * area * w.norm() * w;
    expect_same(-drag.dynamics(state).segment(position_of(system, body), D), expected, 1e-13);
    EXPECT_EQ(drag.dynamics(state).segment(position_of(system, 0), D).norm(), 0);
    expect_same(drag.force.on_body(drag.at(), body, state), expected, 1e-13);
    EXPECT_EQ(drag.force.on_body(drag.at(), 0, state).norm(), 0);
    state.load = 0.6;
    expect_same(-drag.dynamics(state).segment(position_of(system, body), D), 0.6 * expected, 1e-13);
    expect_tangent(drag, state, random);
  }
}
TEST(BodyDrag, GrowsWithTheSquareOfTheAirsSpeed) {
  check_drag<2>();
  check_drag<3>();
}

// The power on the body is what the wind puts in less what is lost, and that is never less than nothing.
template <int D>
void check_account() {
  std::mt19937 random(2);
  for (const Eigen::Vector3d& wind : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, -2, 0)}) {
    const BeamSystem system = in_air<D>(wind);
    const auto drag = the_force<D, BodyDrag<D>>(system);
    const State state = disturbed_state(system, random);
    const Eigen::Matrix<double, D, 1> w = wind.head<D>() - state.v.segment<D>(position_of(system, body));
    const auto change = [&](double h, const auto& of) {
      return of(state, at_time(state, h)) - of(state, at_time(state, -h));
    };
    const auto loss = [&](const State& a, const State& b) { return drag.force.loss(drag.at(), a, b); };
    const auto work = [&](const State& a, const State& b) { return drag.force.work(drag.at(), a, b); };
    const double lost = density / 2 * area * std::pow(w.norm(), 3);
    expect_rate_of_number([&](double h) { return change(h, loss) / 2; }, lost);
    const double blown = density / 2 * area * w.norm() * w.dot(wind.head<D>());
    expect_rate_of_number([&](double h) { return change(h, work) / 2; }, blown);
    EXPECT_NEAR(drag.power(state), blown - lost, 1e-13);
    EXPECT_GE(loss(state, at_time(state, 0.01)), 0);
    if (wind.isZero()) EXPECT_EQ(work(state, at_time(state, 0.01)), 0);
  }
}
TEST(BodyDrag, LosesWhatItTakesOfTheBodyAndOfTheWind) {
  check_account<2>();
  check_account<3>();
}

// Where the air rests on the body there is neither a force nor a direction.
TEST(BodyDrag, IsRegularWhereNothingMoves) {
  const BeamSystem system = in_air<3>({0, 0, 0});
  const auto drag = the_force<3, BodyDrag<3>>(system);
  const State still = drawn_state(system);
  EXPECT_EQ(drag.dynamics(still).norm(), 0);
  EXPECT_EQ(drag.tangent(still, {.mass = 1, .damping = 1, .stiffness = 1}).norm(), 0);
}

}  // namespace nurbeam::testing::body_drag_test
