#include "fem/forces/stored_rope.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::stored_rope_test {

constexpr double turn_stretch = 1.1, strain_energy = 7, load = 0.6;

// A bent beam, of which a part is on a reel.
template <int D>
struct Wound {
  Wound(bool at_start, Reel::Feed feed) : sense(at_start ? 1 : -1), system(model(at_start, feed)) {}

  static BeamModel model(bool at_start, Reel::Feed feed) {
    ModelBuilder builder(D, {2, -3, D == 3 ? 4.0 : 0});
    const int beam = add_bent_beam(builder, D);
    Rider& rider = builder.wind_up("reel", beam, 0.4 * builder.beam(beam).curve.length(), at_start);
    rider.reel = Reel{.at_start = at_start,
                      .feed = feed,
                      .pickup = 1.7,
                      .stretch = turn_stretch,
                      .strain_energy = strain_energy};
    return builder.build();
  }

  double rho() const { return system.model().beams[0].properties.mass_per_length; }
  double stored(double s) const { return sense > 0 ? s : system.model().beams[0].curve.length() - s; }
  // The Lagrangian of what is stored.
  double lagrangian(bool turns, const Eigen::VectorXd& q, const Eigen::VectorXd& v) const {
    const int place = system.mesh().riders[0].place, r = system.mesh().bodies[0];
    const double l = stored(q[place]), along = turns ? rho() * turn_stretch * turn_stretch : 0;
    const Eigen::VectorXd g = load * system.model().gravity.head(D);
    return l * (along / 2 * v[place] * v[place] + rho() / 2 * v.segment(r, D).squaredNorm() +
                rho() * g.dot(q.segment(r, D)) - strain_energy);
  }
  // d/dt dL/dv - dL/dq along q + v t + a t^2/2, by differences.
  Eigen::VectorXd expression(bool turns, const State& x) const {
    const auto by = [&](bool rates, double t, int i) {
      constexpr double h = 1e-5;
      Eigen::VectorXd q = x.q + t * x.v + t * t / 2 * x.a, v = x.v + t * x.a;
      double& changed = rates ? v[i] : q[i];
      const double from = changed;
      changed = from + h;
      const double more = lagrangian(turns, q, v);
      changed = from - h;
      return (more - lagrangian(turns, q, v)) / (2 * h);
    };
    Eigen::VectorXd all(x.q.size());
    constexpr double dt = 1e-4;
    for (int i = 0; i < all.size(); ++i)
      all[i] = (by(true, dt, i) - by(true, -dt, i)) / (2 * dt) - by(false, 0, i);
    return all;
  }

  double sense;
  BeamSystem system;
};

template <int D>
void check_drum(bool at_start) {
  std::mt19937 random(1);
  const Wound<D> wound(at_start, Reel::Feed::drum);
  const auto rope = the_force<D, StoredRope<D>>(wound.system);
  State state = disturbed_state(wound.system, random);
  state.load = load;
  expect_same(rope.dynamics(state), wound.expression(true, state), 1e-6);
  expect_tangent(rope, state, random);
  const int place = wound.system.mesh().riders[0].place, r = wound.system.mesh().bodies[0];
  const double l = wound.stored(state.q[place]), v = state.v[place];
  const Eigen::VectorXd u = state.v.segment(r, D);
  const SystemEnergy energy = rope.energy(state);
  EXPECT_NEAR(energy.kinetic, wound.rho() * l / 2 * (turn_stretch * turn_stretch * v * v + u.squaredNorm()),
              1e-12);
  EXPECT_NEAR(energy.gravity,
              -wound.rho() * l * wound.system.model().gravity.head(D).dot(state.q.segment(r, D)), 1e-12);
  EXPECT_NEAR(energy.spring, strain_energy * l, 1e-12);
}
TEST(StoredRope, OfADrumFollowsFromItsLagrangian) {
  for (const bool at_start : {true, false}) {
    check_drum<2>(at_start);
    check_drum<3>(at_start);
  }
}

template <int D>
void check_spool(bool at_start) {
  std::mt19937 random(2);
  const Wound<D> wound(at_start, Reel::Feed::spool);
  const auto rope = the_force<D, StoredRope<D>>(wound.system);
  State state = disturbed_state(wound.system, random);
  state.load = load;
  const int place = wound.system.mesh().riders[0].place;
  state.v[place] = -3 * wound.sense;  // it pays out
  const std::vector<MeshNode>& nodes = wound.system.mesh().nodes[0];
  const Eigen::VectorXd slope = state.q.segment((at_start ? nodes.front() : nodes.back()).slope_left, D);
  const double resistance = wound.rho() * 1.2 * slope.squaredNorm() * 9;
  Eigen::VectorXd needed = wound.expression(false, state);
  needed[place] -= wound.sense * resistance;
  expect_same(rope.dynamics(state), needed, 1e-6);
  expect_tangent(rope, state, random);
  State to = state;
  to.q[place] -= 0.01 * wound.sense;
  EXPECT_NEAR(rope.force.loss(rope.at(), state, to), 0.01 * resistance, 1e-12);
}
TEST(StoredRope, OfASpoolRestsAndIsDrawnOffAtALoss) {
  for (const bool at_start : {true, false}) {
    check_spool<2>(at_start);
    check_spool<3>(at_start);
  }
}

}  // namespace nurbeam::testing::stored_rope_test
