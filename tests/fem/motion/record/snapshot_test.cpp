#include "fem/motion/record/snapshot.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fem/model/build.h"
#include "fem/motion/run/simulation.h"
#include "fem/system/assembly.h"
#include "fem/system/initial_state.h"
#include "nurbs/primitives.h"
#include "tests/support/models.h"

namespace nurbeam {
namespace {

constexpr double arc_radius = 0.02, density = 7200, youngs_modulus = 2e8;

// A quarter circle held at one end, with a body that slides on it.
BeamModel arc_with_slider(WeightRule weights) {
  BeamModel model =
      testing::one_beam(testing::arc_cubics({0, 0, 0}, 1, -M_PI / 2, 0, 2), 2,
                        testing::round_bar(arc_radius, density, youngs_modulus), 6, {{0, true}});
  model.beams[0].weights = weights;
  testing::add_slider(model, 0.8, 0.7);
  return model;
}

// Any motion near the drawing.
State moved_state(const BeamSystem& system) {
  State state = drawn_state(system);
  for (int i = 0; i < state.q.size(); ++i) {
    state.q[i] += 0.02 * std::sin(3.0 * i + 1);
    state.v[i] = std::cos(5.0 * i);
  }
  return state;
}

class RecordedElements : public ::testing::TestWithParam<WeightRule> {};

TEST_P(RecordedElements, HaveTheirSamplesAtThirdsOfTheCubicAndTheVelocityOfTheMaterialThere) {
  const BeamModel model = arc_with_slider(GetParam());
  const BeamSystem system(model, initial_plan(model));
  const State state = moved_state(system);
  const BeamRecord beam = record_beams(system, state).at(0);
  ASSERT_EQ(beam.elements.size(), system.mesh().spans.size());
  for (std::size_t i = 0; i < beam.elements.size(); ++i) {
    const MeshElement<2>& e = system.assembly<2>()->elements()[i];
    const auto q = gather<2>(e, state.q);
    const RationalCubic cubic(beam.elements[i].control_points);
    for (int k = 0; k < 4; ++k) {
      const double s = e.element.place(q, k / 3.0), h = 1e-6;
      const auto position = [&](double after) {
        return material_point<2>(e, state.q + after * state.v, state.v, s).r;
      };
      EXPECT_NEAR((cubic.point(k / 3.0).head<2>() - position(0)).norm(), 0, 1e-13);
      const Eigen::Vector2d velocity = (position(h) - position(-h)) / (2 * h);
      EXPECT_NEAR((beam.elements[i].velocity.col(k).head<2>() - velocity).norm(), 0, 1e-8);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, RecordedElements,
                         ::testing::Values(WeightRule::material, WeightRule::constant, WeightRule::ones));

// More elements than are handed over together.
TEST(RecordedBeams, AreTheSameWhereTheirElementsAreHandedOver) {
  BeamModel model =
      testing::one_beam({line_cubic({0, 0, 0}, {1, 0, 0})}, 2, {300, 2, 0.7}, 5000, {{0, true}});
  model.gravity = {0.1, -9.81, 0};
  const BeamSystem system(model, initial_plan(model));
  const State state = moved_state(system);
  const BeamRecord whole = record_beams(system, state).at(0);
  std::vector<ElementRecord> taken;
  std::size_t most = 0;
  const BeamRecord rest = record_beams(system, state, [&](int beam, const std::vector<ElementRecord>& some) {
                            EXPECT_EQ(beam, 0);
                            taken.insert(taken.end(), some.begin(), some.end());
                            most = std::max(most, some.size());
                          }).at(0);
  EXPECT_LT(most, whole.elements.size());
  EXPECT_TRUE(rest.elements.empty());
  EXPECT_EQ(rest.handed_over, whole.elements.size());
  ASSERT_EQ(taken.size(), whole.elements.size());
  for (std::size_t i = 0; i < taken.size(); ++i) {
    EXPECT_EQ(taken[i].control_points, whole.elements[i].control_points);
    EXPECT_EQ(taken[i].shear_force, whole.elements[i].shear_force);
    EXPECT_EQ(taken[i].velocity, whole.elements[i].velocity);
  }
  EXPECT_EQ(rest.length, whole.length);
  EXPECT_EQ(rest.sag, whole.sag);
  EXPECT_EQ(rest.shear_force_max.value, whole.shear_force_max.value);
  EXPECT_EQ(rest.shear_force_max.s, whole.shear_force_max.s);
  EXPECT_EQ(rest.displacement_max.value, whole.displacement_max.value);
  EXPECT_EQ(rest.node_positions, whole.node_positions);
}

TEST(RecordedSections, OfADrawnArcCarryItsCurvatureAndNoForce) {
  BeamModel model = arc_with_slider(WeightRule::material);
  model.gravity.setZero();
  const BeamSystem system(model, initial_plan(model));
  const BeamRecord beam = record_beams(system, drawn_state(system)).at(0);
  for (const ElementRecord& e : beam.elements) {
    EXPECT_NEAR((e.curvature.array() - 1).abs().maxCoeff(), 0, 1e-10);
    EXPECT_NEAR(e.strain.cwiseAbs().maxCoeff(), 0, 1e-12);
    EXPECT_NEAR(e.axial_force.cwiseAbs().maxCoeff(), 0, 1e-12 * youngs_modulus);
    EXPECT_NEAR(e.bending_moment.cwiseAbs().maxCoeff(), 0, 1e-9 * youngs_modulus * std::pow(arc_radius, 4));
    EXPECT_EQ(e.velocity, (Eigen::Matrix<double, 3, 4>::Zero()));
  }
}

Snapshot resting(const BeamModel& model) {
  Snapshot last;
  SimulationObserver observer;
  observer.snapshot = [&](const Snapshot& frame) { last = frame; };
  SimulationOptions options;
  options.statics = true;
  EXPECT_EQ(simulate(model, {}, options, observer).status, SimulationStatus::done);
  return last;
}

// Down from its held end; each section carries what hangs below it.
TEST(RecordedSections, OfAHangingBarCarryTheWeightBelow) {
  BeamModel model =
      testing::one_beam({testing::line_cubic({0, 0, 0}, {0, -2, 0})}, 2,
                        testing::round_bar(arc_radius, density, youngs_modulus), 16, {{0, true}});
  const double weight_per_length = density * M_PI * arc_radius * arc_radius * 9.81;
  const BeamRecord beam = resting(model).beams.at(0);
  for (const ElementRecord& e : beam.elements)
    for (int k = 0; k < 4; ++k) {
      const double s = e.s_start + k / 3.0 * (e.s_end - e.s_start);
      EXPECT_NEAR(e.axial_force[k], weight_per_length * (2 - s), 1e-3 * weight_per_length * 2);
      EXPECT_NEAR(e.strain[k], e.axial_force[k] / (youngs_modulus * M_PI * arc_radius * arc_radius), 1e-6);
    }
}

// Largest relative error of moment and curvature along a cantilever bent to a quarter circle.
double roll_up_error(int elements) {
  BeamModel model =
      testing::one_beam({testing::line_cubic({0, 0, 0}, {1, 0, 0})}, 2,
                        testing::round_bar(arc_radius, density, youngs_modulus), elements, {{0, true}});
  model.gravity.setZero();
  const double EI = model.beams[0].properties.bending_stiffness, curvature = M_PI / 2;
  model.forces.push_back(Moment{{.s = model.beams[0].curve.length(), .value = {0, 0, EI * curvature}}});
  double error = 0;
  const BeamRecord beam = resting(model).beams.at(0);
  for (const ElementRecord& e : beam.elements) {
    error = std::max(error, (e.bending_moment.array() / (EI * curvature) - 1).abs().maxCoeff());
    error = std::max(error, (e.curvature.array() / curvature - 1).abs().maxCoeff());
  }
  return error;
}

TEST(RecordedSections, OfACantileverUnderAnEndMomentApproachThatMomentAtSecondOrder) {
  const double coarse = roll_up_error(8), fine = roll_up_error(16);
  EXPECT_LT(fine, 1e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

// Of a body in the air, a place of a beam and a point.
TEST(RecordedConnectors, HaveTheirEndsWhereThatIsWhichTheyHold) {
  ModelBuilder builder(2);
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {2, 0, 0})}, 2), BeamProperties(1e5, 2, 1),
                   {.elements = 2});
  builder.pin(0, 0);
  const int body = builder.add_body("load", 3, {1.5, -1, 0});
  builder.connect(Grip::on_beam(0, 2), Grip::on_body(body), ConnectorType::spring, 10);
  builder.connect(Grip::at_point({0.5, 2, 0}), Grip::on_beam(0, 2), ConnectorType::rod);
  const BeamModel model = builder.build();
  const BeamSystem system(model, initial_plan(model));
  const State state = moved_state(system);
  const Snapshot snapshot = record_snapshot(system, state, {});
  ASSERT_EQ(snapshot.connectors.size(), 2);
  EXPECT_EQ(snapshot.connectors[0].from, snapshot.beams[0].node_positions.back());
  EXPECT_EQ(snapshot.connectors[0].to, snapshot.bodies[0].point.position);
  EXPECT_EQ(snapshot.connectors[1].from, Eigen::Vector3d(0.5, 2, 0));
  EXPECT_EQ(snapshot.connectors[1].to, snapshot.connectors[0].from);
  for (const ConnectorRecord& connector : snapshot.connectors)
    EXPECT_NEAR(connector.length, (connector.to - connector.from).norm(), 1e-15);
}

// The acceleration of the material is the second difference of where it is; beside a node that moves too.
TEST(RecordedAccelerations, AreThoseOfTheMaterialAndOfWhatSlides) {
  BeamModel model = arc_with_slider(WeightRule::material);
  model.gravity = {0, -9.81, 0};
  model.accelerations = true;
  const BeamSystem system(model, initial_plan(model));
  State state = moved_state(system);
  for (int i = 0; i < state.a.size(); ++i) state.a[i] = std::sin(2.0 * i + 1);
  const auto at = [&](double h) {
    State then = state;
    then.q += h * state.v + h * h / 2 * state.a;
    return then;
  };
  constexpr double h = 1e-4;
  for (const double s : {0.1, 0.66, 0.75, 1.3}) {
    const Snapshot snapshot = record_snapshot(system, state, {{.beam = 0, .s = s}});
    const auto place = [&](double time) { return material_point(system, at(time), 0, s).r; };
    const Eigen::Vector3d a = (place(h) - 2 * place(0) + place(-h)) / (h * h);
    const FeltRecord& felt = snapshot.probes[0].felt.value();
    EXPECT_LT((felt.acceleration - a).norm(), 1e-5 * (1 + a.norm())) << s;
    const Eigen::Vector3d t = material_point(system, state, 0, s).rs.normalized(),
                          f = (felt.acceleration - model.gravity) / 9.80665;
    EXPECT_NEAR(felt.load_factor[0], f.dot(t), 1e-12);
    EXPECT_EQ(felt.load_factor[1], 0);
    EXPECT_NEAR(felt.load_factor[2], f.dot(Eigen::Vector3d(-t.y(), t.x(), 0)) * (t.x() > 0 ? 1 : -1), 1e-12);
  }
  const FeltRecord body = record_snapshot(system, state, {}).bodies[0].felt.value();
  const int r = system.mesh().bodies[0];
  EXPECT_EQ(body.acceleration.head<2>(), (state.a.segment<2>(r)));
  EXPECT_NEAR(body.load_factor.norm(), (body.acceleration - model.gravity).norm() / 9.80665, 1e-12);
  EXPECT_FALSE(body.in_space);
}

TEST(RecordedAccelerations, AreThereWhereTheyAreAskedFor) {
  const BeamModel model = arc_with_slider(WeightRule::material);
  const BeamSystem system(model, initial_plan(model));
  const Snapshot snapshot = record_snapshot(system, moved_state(system), {{.beam = 0, .s = 0.1}});
  EXPECT_FALSE(snapshot.probes[0].felt);
  EXPECT_FALSE(snapshot.bodies[0].felt);
}

}  // namespace
}  // namespace nurbeam
