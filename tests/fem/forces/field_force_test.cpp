#include "fem/forces/field_force.h"

#include "tests/fem/bent_beams.h"
#include "tests/fem/bound_force.h"
#include "tests/fem/fastened_parts.h"

namespace nurbeam::testing::field_force_test {

// Everything at once: a frame that turns about a point, on an orbit, near a point that attracts.
MassField field(int dimension) {
  MassField field;
  field.rate = dimension == 3 ? Eigen::Vector3d(0.3, -0.5, 0.7) : Eigen::Vector3d(0, 0, 0.9);
  field.about = {0.4, -0.2, dimension == 3 ? 0.3 : 0};
  field.radial = dimension == 3 ? Eigen::Vector3d(5, 3, 0).normalized() : Eigen::Vector3d(0.6, 0.8, 0);
  field.attraction = 30;
  field.centre = {-4, 5, dimension == 3 ? -3 : 0};
  return field;
}

TEST(MassField, HasAPotentialForWhatRests) {
  for (const int dimension : {2, 3}) {
    const MassField of = field(dimension);
    const Eigen::Vector3d r(1.1, 0.7, dimension == 3 ? -0.6 : 0);
    for (int k = 0; k < dimension; ++k) {
      constexpr double h = 1e-5;
      const Eigen::Vector3d step = h * Eigen::Vector3d::Unit(k);
      EXPECT_NEAR((of.potential(r - step) - of.potential(r + step)) / (2 * h), of.at_rest(r)[k], 1e-8);
      const Eigen::Vector3d slope = (of.at_rest(r + step) - of.at_rest(r - step)) / (2 * h);
      EXPECT_LT((slope - of.gradient(r).col(k)).norm(), 1e-8);
    }
  }
}

// What moves straight on in space, seen from the frame.
TEST(MassField, LetsWhatIsFreeMoveStraightOn) {
  MassField frame;
  frame.rate = {0.2, -0.4, 0.5};
  frame.about = {1, 2, 3};
  const Eigen::Vector3d from(2, 1, -1), speed(0.3, 0.4, -0.2);
  const auto seen = [&](double t) {
    const Eigen::AngleAxisd turned(-frame.rate.norm() * t, frame.rate.normalized());
    return Eigen::Vector3d(frame.about + turned * (from + t * speed - frame.about));
  };
  constexpr double t = 0.7, h = 1e-3;
  const Eigen::Vector3d r = seen(t), v = (seen(t + h) - seen(t - h)) / (2 * h),
                        a = (seen(t + h) - 2 * r + seen(t - h)) / (h * h);
  EXPECT_LT((frame.at_rest(r) + frame.by_velocity() * v - a).norm(), 1e-6);
}

// A bent beam with a moving node.
template <int D>
BeamSystem system_in_field() {
  ModelBuilder builder(D);
  const int beam = add_bent_beam(builder, D);
  builder.slide(builder.add_body("body", 0.8), beam, 0.43 * builder.beam(beam).curve.length());
  BeamModel model = builder.build();
  model.field = field(D);
  return BeamSystem(std::move(model));
}

// The power of what acts on the material, by many points, against that of the generalised forces.
template <int D>
void check_beams() {
  std::mt19937 random(3);
  const BeamSystem system = system_in_field<D>();
  const auto force = the_force<D, FieldOnBeams<D>>(system);
  State state = disturbed_state(system, random);
  state.load = 0.6;
  expect_tangent(force, state, random);
  double power = 0, potential = 0;
  const MassField& of = *system.model().field;
  for (const MeshElement<D>& e : system.assembly<D>()->elements()) {
    constexpr int parts = 200;
    const double start = e.span->start(state.q), length = (e.span->end(state.q) - start) / parts;
    for (int i = 0; i < parts; ++i) {
      const auto p = material_point(e, state.q, state.v, start + (i + 0.5) * length);
      const Eigen::Vector3d r = widened<D>(p.r), v = widened<D>(p.velocity);
      const double mass = length * e.element.properties().mass_per_length;
      power += 0.6 * mass * of.at_rest(r).dot(v);
      potential += mass * of.potential(r);
    }
  }
  EXPECT_NEAR(force.power(state), power, 1e-4 * std::abs(power));
  EXPECT_NEAR(force.energy(state).gravity, potential, 1e-4 * std::abs(potential));
}
TEST(FieldOnBeams, ActsOnTheMaterial) {
  check_beams<2>();
  check_beams<3>();
}

template <int D>
void check_body() {
  std::mt19937 random(4);
  const BeamSystem system = system_in_field<D>();
  const auto force = the_force<D, FieldOnBody<D>>(system);
  const MassField& of = *system.model().field;
  State state = disturbed_state(system, random);
  state.load = 0.6;
  expect_tangent(force, state, random);
  const int r = system.mesh().bodies[0];
  const Eigen::Vector3d at = widened<D>(state.q.segment<D>(r)), v = widened<D>(state.v.segment<D>(r));
  Eigen::VectorXd needed = Eigen::VectorXd::Zero(force.n);
  needed.segment<D>(r) = -0.6 * 0.8 * (of.at_rest(at) - 2 * of.rate.cross(v)).head<D>();
  expect_same(force.dynamics(state), needed, 1e-12);
  EXPECT_NEAR(force.energy(state).gravity, 0.8 * of.potential(at), 1e-12);
}
TEST(FieldOnBody, ActsOnItsMass) {
  check_body<2>();
  check_body<3>();
}

}  // namespace nurbeam::testing::field_force_test
