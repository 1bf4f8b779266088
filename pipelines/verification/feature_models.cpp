#include "pipelines/verification/feature_models.h"

#include <cmath>
#include <numbers>
#include <utility>

#include "pipelines/verification/models.h"

namespace nurbeam::verification {

namespace {

using Eigen::Vector3d;
using std::numbers::pi;
constexpr double feature_gravity = 9.81;

ModelBuilder in_the_plane() { return ModelBuilder(2, {0, -feature_gravity, 0}); }

/// A body of 5 kg in a half circle of 3 m, let go at 0.6 m.
BeamModel in_a_bowl() {
  ModelBuilder builder = in_the_plane();
  builder.add_guide(ReferenceCurve(arc_cubics({0, 0, 0}, 3, pi, 2 * pi, 4), 2));
  builder.slide(builder.add_body("body", 5), 0, 0.6);
  return builder.build();
}

BeamModel with_friction(BeamModel model, const Friction& friction) {
  model.riders[0].friction = friction;
  return model;
}

/// A body on an arch that is clamped at its start and pinned at its end; it slides over many elements.
BeamModel on_an_arch(double mass, double at, double speed) {
  ModelBuilder builder = in_the_plane();
  builder.add_beam(ReferenceCurve(arc_cubics({0, -3, 0}, 3, 0.75 * pi, 0.3 * pi, 2), 2),
                   BeamProperties(2e5, 900, 3), {10});
  builder.clamp(0, 0).pin(0, 10);
  builder.slide(builder.add_body("body", mass), 0, at, speed);
  return builder.build();
}

BeamProperties taut_rope(double tension) {
  BeamProperties rope(4e5, 2, 0.5);
  rope.free_strain.of_tension = -tension / rope.axial_stiffness;
  return rope;
}

BeamModel as_point(BeamModel model) {
  model.riders[0].as_point = true;
  return model;
}

/// 20 m under tension, with a body of 8 kg at a kink.
BeamModel on_a_rope(double at, double speed, const BeamProperties& rope = taut_rope(6000)) {
  ModelBuilder builder = in_the_plane();
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {20, -2, 0})}, 2), rope, {20});
  builder.pin(0, 0).pin(0, 30);
  Rider& joint = builder.slide(builder.add_body("body", 8), 0, at, speed);
  joint.continuous_slope = false;
  return builder.build();
}

BeamModel in_air(BeamModel model, const Vector3d& wind) {
  model.air = {.density = 1.2, .wind = wind};
  for (Body& body : model.bodies) body.drag_area = 0.6;
  return model;
}

BeamModel with_stops(BeamModel model, std::vector<Stop> stops) {
  model.stops = std::move(stops);
  return model;
}

/// Two trolleys on a guide of 20 m, of which the first runs into the second.
BeamModel two_trolleys() {
  ModelBuilder builder = in_the_plane();
  builder.add_guide(ReferenceCurve({line_cubic({0, 0, 0}, {20, -1, 0})}, 2));
  builder.slide(builder.add_body("first", 30), 0, 5, 3);
  builder.slide(builder.add_body("second", 50), 0, 7, 1);
  return builder.build();
}

BeamModel coupled(ConnectorType type, double stiffness, double damping) {
  ModelBuilder builder = in_the_plane();
  builder.add_guide(ReferenceCurve({line_cubic({0, 0, 0}, {20, -1, 0})}, 2));
  const int first = builder.add_body("first", 30), second = builder.add_body("second", 50);
  builder.slide(first, 0, 5, 1);
  builder.slide(second, 0, 7, 3);
  builder.connect(Grip::on_body(first), Grip::on_body(second), type, stiffness).damping = damping;
  return builder.build();
}

/// A load of 4 kg that hangs on the body of a model.
BeamModel hanging(BeamModel model, ConnectorType type, double stiffness, double damping,
                  const Vector3d& from_body) {
  const Rider& joint = model.riders[0];
  const Vector3d at = model.beam_of(joint).curve.position(joint.s) + from_body;
  model.bodies.push_back({.name = "load", .mass = 4, .position = at, .velocity = {0.5, 0, 0}});
  model.connectors.push_back({.name = "rope",
                              .ends = {Grip::on_body(joint.body), Grip::on_body(joint.body + 1)},
                              .type = type,
                              .stiffness = stiffness,
                              .damping = damping,
                              .length = from_body.norm()});
  return model;
}

/// A string of 10 m that falls onto droppers, clamps of 0.3 kg on it.
BeamModel on_droppers(double damping, double clamp) {
  ModelBuilder builder = in_the_plane();
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {10, 0, 0})}, 2), taut_rope(2000), {10});
  builder.pin(0, 0).pin(0, 10);
  for (const double s : {3.0, 6.0}) {
    Connector& dropper =
        builder.connect(Grip::on_beam(0, s), Grip::at_point({s, 1, 0}), ConnectorType::tension_only, 2e4);
    dropper.length = 1.002;
    dropper.damping = damping;
    if (clamp > 0) builder.add(PlaceMass{0, s, clamp});
  }
  return builder.build();
}

/// A string whose end a weight pulls that swings with it; it is let go with 5 % too much.
BeamModel weighted_end() {
  ModelBuilder builder = in_the_plane();
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {10, 0, 0})}, 2), taut_rope(2000), {10});
  builder.pin(0, 0).guide(0, 10, {1, 0, 0});
  builder.force(0, 10, {2100, 0, 0}).add(PlaceMass{0, 10, 200, false});
  return builder.build();
}

/// A body that slides on two beams which cross, a level cantilever and a bar on a hinge.
BeamModel on_two_beams() {
  ModelBuilder builder = in_the_plane();
  builder.add_beam(ReferenceCurve({line_cubic({0, 0, 0}, {4, 0, 0})}, 2), BeamProperties(2e5, 400, 2), {8});
  builder.add_beam(ReferenceCurve({line_cubic({1, -1, 0}, {3, 1, 0})}, 2), BeamProperties(2e5, 400, 2), {8});
  builder.clamp(0, 0).pin(0, 4).pin(1, 0);
  const int body = builder.add_body("ring", 3);
  builder.slide(body, 0, 2);
  builder.slide(body, 1, std::sqrt(2.0));
  return builder.build();
}

BeamModel damped(double alpha, double beta) {
  BeamProperties rope = taut_rope(6000);
  rope.mass_damping = alpha;
  rope.damping = rope.tension_damping = beta;
  return on_a_rope(6, 2, rope);
}

}  // namespace

std::vector<FeatureModel> feature_models() {
  const std::string guide = "rigid guide", drawn = "material, Green, as drawn",
                    taut = "material, Green, under tension";
  const TimeTable closing{{0, 0}, {0.2, 0}, {0.5, 40}};
  std::vector<FeatureModel> all;
  const auto add = [&](const char* name, const std::string& measures, BeamModel model, double end,
                       double step, double most = 1e-4) {
    all.push_back({name, measures, std::move(model), end, step, most});
  };
  add("guide", guide, in_a_bowl(), 2, 4e-3);
  add("friction", guide, with_friction(in_a_bowl(), {.coefficient = 0.2}), 0.8, 4e-3);
  add("sticking", guide, with_friction(in_a_bowl(), {.coefficient = 0.3, .static_coefficient = 0.5}), 3,
      4e-3);
  add("brake", guide, with_friction(in_a_bowl(), {.force = closing}), 1.6, 4e-3);
  add("viscous", guide, with_friction(in_a_bowl(), {.viscous = 4}), 2, 4e-3);
  add("friction-on-an-arch", drawn, with_friction(on_an_arch(2, 0.5, 3), {.coefficient = 0.2}), 0.5, 5e-4);
  add("point-on-an-arch", drawn, as_point(with_friction(on_an_arch(2, 0.5, 3), {.coefficient = 0.2})), 0.5,
      5e-4);
  add("parked-on-an-arch", drawn, with_friction(on_an_arch(2, 2.1, 0), {.coefficient = 0.8}), 0.3, 2.5e-4);
  add("capstan", taut, with_friction(on_a_rope(6, 4), {.coefficient = 0.3, .law = Friction::Law::capstan}),
      0.5, 2.5e-4);
  add("drag", guide, in_air(in_a_bowl(), {0, 0, 0}), 2, 4e-3);
  add("wind", guide, in_air(in_a_bowl(), {12, 3, 0}), 2, 4e-3);
  add("stop", guide, with_stops(in_a_bowl(), {{.rider = 0, .place = 6, .restitution = 0.7}}), 2, 4e-3);
  add("stop-on-an-arch", drawn,
      with_stops(on_an_arch(2, 0.5, 3), {{.rider = 0, .place = 1.4, .restitution = 0.5}}), 0.5, 1e-4, 1e-3);
  add("buffer", guide, with_stops(in_a_bowl(), {{.rider = 0, .place = 6, .buffer = Buffer{4e3}}}), 2, 2e-3);
  add("damped-buffer", guide, with_stops(in_a_bowl(), {{.rider = 0, .place = 6, .buffer = Buffer{4e3, 60}}}),
      2, 2e-3);
  add("kept-apart", guide,
      with_stops(two_trolleys(), {{.rider = 0, .other = 1, .place = 0.5, .restitution = 0.4}}), 3, 4e-3);
  add("spring", guide, coupled(ConnectorType::spring, 2000, 0), 2, 2e-3);
  add("damper", guide, coupled(ConnectorType::spring, 2000, 80), 2, 2e-3);
  add("one-sided", guide, coupled(ConnectorType::tension_only, 2000, 0), 1.2, 2e-3);
  add("one-sided-damper", guide, coupled(ConnectorType::tension_only, 2000, 80), 1.2, 4e-3);
  add("rod", guide, hanging(in_a_bowl(), ConnectorType::rod, 0, 0, {0.6, -0.8, 0}), 1.2, 2e-3);
  add("hanging-on-an-arch", drawn,
      hanging(on_an_arch(2, 0.5, 2), ConnectorType::spring, 3000, 5, {0.1, -0.8, 0}), 0.6, 1e-3);
  add("hanging-on-a-rope", taut, hanging(on_a_rope(6, 4), ConnectorType::rod, 0, 0, {0, -1, 0}), 0.6, 2.5e-4);
  add("two-joints", drawn, on_two_beams(), 0.3, 5e-4);
  add("droppers", taut, on_droppers(0, 0), 0.4, 2.5e-4);
  add("damped-droppers", taut, on_droppers(40, 0), 0.4, 2.5e-4);
  add("end-masses", taut, on_droppers(0, 0.3), 0.4, 2.5e-4);
  add("weighted-end", taut, weighted_end(), 1, 1e-3);
  add("tension", taut, on_a_rope(6, 4), 0.6, 2.5e-4);
  add("mass-damping", taut, damped(0.8, 0), 0.6, 2.5e-4);
  add("stiffness-damping", taut, damped(0, 2e-3), 0.6, 2.5e-4);
  return all;
}

}  // namespace nurbeam::verification
