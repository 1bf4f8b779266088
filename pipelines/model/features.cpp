#include "pipelines/model/features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

namespace nurbeam {

namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// Collects names; a name that all_features() lacks is a mistake of this file.
class Named {
 public:
  void add(const std::string& name, bool is_used = true) {
    if (!is_used) return;
    assert(all_features().contains(name));
    found_.insert(name);
  }
  Features found() && { return std::move(found_); }

 private:
  Features found_;
};

bool has_equal_bending(const SectionStiffness& s) {
  constexpr double round_off = 1e-9;
  return std::abs(s.bending_1 - s.bending_2) <= round_off * s.bending_1 &&
         std::abs(s.bending_product) <= round_off * s.bending_1;
}

void add_element(const Beam& beam, Named& named) {
  named.add("beam that runs in its shape", beam.flow != 0);
  const BeamProperties& p = beam.properties;
  named.add("element: material weights", beam.weights == WeightRule::material);
  named.add("element: constant weights", beam.weights == WeightRule::constant);
  named.add("element: ones for weights", beam.weights == WeightRule::ones);
  named.add("element: papers' form", beam.form == Form::virtual_work);
  named.add("element: papers' merge", beam.merge != MergeRule::standard);
  named.add("axial strain: assumed", p.axial_strain == AxialStrain::ends_and_mean);
  named.add("axial strain: pointwise", p.axial_strain == AxialStrain::pointwise);
  named.add("curvature: material", p.curvature == CurvatureMeasure::material);
  named.add("curvature: spatial", p.curvature == CurvatureMeasure::spatial);
}

void add_law(const BeamProperties& p, Named& named) {
  named.add("law: green", std::holds_alternative<GreenLaw>(p.law));
  named.add("law: hooke", std::holds_alternative<HookeLaw>(p.law));
  named.add("law: rows", std::holds_alternative<ForceOverStretch>(p.law));
  named.add("compression buckles", p.compression == Compression::buckles);
  named.add("damping of strain", p.damping > 0);
  named.add("damping of tension", p.tension_damping > 0);
  named.add("damping by mass", p.mass_damping > 0);
  named.add("unstressed length", p.free_strain.constant != 0);
  named.add("tension as drawn", p.free_strain.of_tension != 0);
  named.add("thermal expansion", !p.free_strain.thermal.empty());
  if (!p.sections) return;
  named.add("torsion");
  named.add("unequal bending", !has_equal_bending(*p.sections));
}

void add_beam(const Beam& beam, Named& named) {
  named.add("rigid track", beam.rigid);
  named.add("ring", beam.is_ring());
  if (beam.rigid) return;
  add_element(beam, named);
  add_law(beam.properties, named);
  named.add("stress-free: straight", beam.curve.straight());
  named.add("stress-free: as drawn", !beam.curve.straight());
  named.add("initial velocity", beam.velocity.has_value());
  named.add("pipe bends", !beam.bends.empty());
  for (const HomeNode& node : beam.home) {
    named.add("slope discontinuity of a rope", node.kind == NodeKind::kink || node.sharp || node.sharp_clamp);
    named.add("corner", node.kind == NodeKind::rigid);
    named.add("hinge", node.kind == NodeKind::hinge);
  }
}

void add_friction(const Friction& friction, Named& named) {
  named.add("friction: coulomb", friction.coefficient > 0 && friction.law == Friction::Law::coulomb);
  named.add("friction: capstan", friction.coefficient > 0 && friction.law == Friction::Law::capstan);
  named.add("friction: bearing", friction.coefficient > 0 && friction.law == Friction::Law::bearing);
  named.add("brake", !friction.force.empty() || !friction.force_over.empty());
  named.add("viscous resistance", friction.viscous > 0);
  named.add("quadratic resistance", friction.quadratic > 0);
}

void add_rider(const Rider& rider, const Structure& structure, Named& named) {
  named.add("sliding body");
  named.add("carried as a point", rider.as_point && !structure.beam_of(rider).rigid);
  named.add("discontinuous slope", !rider.continuous_slope);
  named.add("prescribed place", rider.motion.has_value());
  named.add("release", rider.release.has_value());
  named.add("follows the section", rider.follows_section);
  named.add("offset from the axis", rider.is_offset());
  named.add("turning pulley", rider.turning_inertia > 0);
  named.add("force that drives a pulley", !rider.drive_force.empty());
  if (rider.friction) add_friction(*rider.friction, named);
  named.add("sleeve", rider.direction.has_value());
  if (!rider.reel) return;
  named.add("drum", rider.reel->feed == Reel::Feed::drum);
  named.add("spool", rider.reel->feed == Reel::Feed::spool);
  named.add("rope wound under tension", rider.reel->strain_energy > 0);
}

void add_connector(const Connector& connector, Named& named) {
  named.add("spring", connector.type == ConnectorType::spring);
  named.add("tension-only", connector.type == ConnectorType::tension_only);
  named.add("compression-only", connector.type == ConnectorType::compression_only);
  named.add("rod", connector.type == ConnectorType::rod);
  named.add("damper", connector.damping > 0);
  named.add("connector by rows", connector.rows.has_value());
  named.add("connector along a direction", connector.direction.has_value());
  named.add("connector length to be found", connector.length_rule != ConnectorLength::given);
}

void add_rotational(const RotationalConnector& connector, int dimension, Named& named) {
  named.add(connector.counts(dimension) ? "rotational connector about an axis" : "rotational connector");
  named.add("damper", connector.damping > 0);
}

void add_stop(const Stop& stop, Named& named) {
  named.add("hard stop", !stop.buffer);
  named.add("buffer", stop.buffer.has_value());
  named.add("stop between bodies", stop.other >= 0);
}

// What a beam runs through or is wound on, by its ring.
const char* ring_name(int body, const BeamModel& model) {
  const bool is_reel =
      std::ranges::any_of(model.riders, [&](const Rider& rider) { return rider.body == body && rider.reel; });
  return is_reel ? "reel" : "eyelet";
}

void add_constraint(const Constraint& constraint, const BeamModel& model, Named& named) {
  std::visit(Overloaded{[&](const Support& support) {
                          named.add("clamped", support.clamped);
                          named.add("fork", support.fork);
                          named.add("guided", support.guide.has_value());
                          named.add("hinge with an axis", support.axis.has_value());
                          named.add("pinned",
                                    !support.clamped && !support.fork && !support.guide && !support.axis);
                          named.add("moved support", support.motion.has_value());
                          named.add("support that turns", support.turn.has_value());
                          named.add("clamp that slides", support.guide && (support.clamped || support.fork));
                        },
                        [&](const BeamJoint& joint) {
                          named.add("rigid joint", joint.rigid);
                          named.add("pinned joint", !joint.rigid);
                          named.add("hinge with an axis", joint.axis.has_value());
                        },
                        [&](const HeldBody& held) {
                          const std::string ring = ring_name(held.body, model);
                          named.add(ring);
                          named.add(ring + " on a path", held.motion.has_value());
                        },
                        [&](const CarriedBody& carried) {
                          const std::string ring = ring_name(carried.body, model);
                          named.add(ring);
                          named.add(ring + " on a body");
                        },
                        [&](const BodyJoint& joint) {
                          named.add("joint of a body");
                          named.add("joint that holds a body's attitude", !joint.pairs.empty());
                          named.add("body that slides on a line", joint.slide.has_value());
                          named.add("body held by a beam", joint.to.beam >= 0);
                          named.add("moved support", joint.motion.has_value());
                          named.add("support that turns", joint.turn.has_value());
                        }},
             constraint);
}

void add_load_at_place(const LoadAtPlace& load, Named& named) {
  named.add("load that turns with the beam", load.follower);
  named.add("load that moves", load.speed != 0);
  named.add("load over time", !load.time.empty());
}

void add_force(const Force& force, Named& named) {
  std::visit(Overloaded{[&](const PointLoad& load) {
                          named.add("point force");
                          add_load_at_place(load, named);
                        },
                        [&](const Moment& load) {
                          named.add("moment");
                          add_load_at_place(load, named);
                        },
                        [&](const LineLoad& load) {
                          named.add("force per length");
                          named.add("load over time", !load.time.empty());
                        },
                        [&](const LineTorque& load) {
                          named.add("torque per length");
                          named.add("load over time", !load.time.empty());
                        },
                        [&](const PlaceMass&) { named.add("mass at a place"); },
                        [&](const CustomForce&) { named.add("force of a program"); },
                        [&](const BodyLoad& load) {
                          named.add(load.is_moment ? "moment on a body" : "force on a body");
                          named.add("load that turns with a body", load.follower);
                          named.add("load over time", !load.time.empty());
                        }},
             force);
}

}  // namespace

Features features_of(const BeamModel& model) {
  Named named;
  named.add(model.dimension == 2 ? "plane" : "space");
  named.add("gravity", !model.gravity.isZero(0));
  if (model.field) {
    named.add("frame that turns", !model.field->rate.isZero(0));
    named.add("gradient of gravity", model.field->radial.has_value());
    named.add("attraction of a point", model.field->attraction != 0);
  }
  for (const Beam& beam : model.beams) add_beam(beam, named);
  for (const Rider& rider : model.riders) add_rider(rider, model, named);
  for (const Body& body : model.bodies) {
    named.add("rigid body", body.rigid.has_value());
    named.add("rotor", body.rigid && !body.rigid->rotor.isZero(0));
    named.add("place of a rigid body", body.point_of.has_value());
    named.add("air drag", body.drag_area > 0 && model.air.density > 0);
    named.add("wind", body.drag_area > 0 && model.air.density > 0 && !model.air.wind.isZero(0));
  }
  for (const Connector& connector : model.connectors) add_connector(connector, named);
  for (const RotationalConnector& connector : model.rotational_connectors)
    add_rotational(connector, model.dimension, named);
  for (const Stop& stop : model.stops) add_stop(stop, named);
  for (const Constraint& constraint : model.constraints) add_constraint(constraint, model, named);
  for (const Force& force : model.forces) add_force(force, named);
  return std::move(named).found();
}

Features features_of(const SimulationOptions& options) {
  Named named;
  named.add("statics", options.statics);
  if (options.statics) return std::move(named).found();
  named.add("motion");
  named.add("motion from an equilibrium", options.start_from_equilibrium);
  named.add("error control", !options.step);
  std::visit(Overloaded{[&](const GeneralizedAlpha&) { named.add("integrator: generalized-alpha"); },
                        [&](const ExplicitRungeKutta&) { named.add("integrator: rk4"); },
                        [&](const Radau&) { named.add("integrator: radau"); }},
             options.integrator);
  return std::move(named).found();
}

Features features_of(const ModesOptions& options) {
  return {options.kind == ModesOptions::Kind::buckling ? "buckling" : "modes"};
}

const Features& all_features() {
  static const Features all{"air drag",
                            "attraction of a point",
                            "axial strain: assumed",
                            "axial strain: pointwise",
                            "beam that runs in its shape",
                            "body held by a beam",
                            "body that slides on a line",
                            "brake",
                            "buckling",
                            "buffer",
                            "carried as a point",
                            "clamp that slides",
                            "clamped",
                            "compression buckles",
                            "compression-only",
                            "connector along a direction",
                            "connector by rows",
                            "connector length to be found",
                            "corner",
                            "curvature: material",
                            "curvature: spatial",
                            "damper",
                            "damping by mass",
                            "damping of strain",
                            "damping of tension",
                            "discontinuous slope",
                            "drum",
                            "element: constant weights",
                            "element: material weights",
                            "element: ones for weights",
                            "element: papers' form",
                            "element: papers' merge",
                            "error control",
                            "eyelet",
                            "eyelet on a body",
                            "eyelet on a path",
                            "follows the section",
                            "force of a program",
                            "force on a body",
                            "force per length",
                            "force that drives a pulley",
                            "fork",
                            "frame that turns",
                            "friction: bearing",
                            "friction: capstan",
                            "friction: coulomb",
                            "gradient of gravity",
                            "gravity",
                            "guided",
                            "hard stop",
                            "hinge",
                            "hinge with an axis",
                            "initial velocity",
                            "integrator: generalized-alpha",
                            "integrator: radau",
                            "integrator: rk4",
                            "joint of a body",
                            "joint that holds a body's attitude",
                            "law: green",
                            "law: hooke",
                            "law: rows",
                            "load over time",
                            "load that moves",
                            "load that turns with a body",
                            "load that turns with the beam",
                            "mass at a place",
                            "modes",
                            "moment",
                            "moment on a body",
                            "motion",
                            "motion from an equilibrium",
                            "moved support",
                            "offset from the axis",
                            "pinned",
                            "pinned joint",
                            "pipe bends",
                            "place of a rigid body",
                            "plane",
                            "point force",
                            "prescribed place",
                            "quadratic resistance",
                            "reel",
                            "reel on a body",
                            "reel on a path",
                            "release",
                            "rigid body",
                            "rigid joint",
                            "rigid track",
                            "ring",
                            "rod",
                            "rope wound under tension",
                            "rotational connector",
                            "rotational connector about an axis",
                            "rotor",
                            "sleeve",
                            "sliding body",
                            "slope discontinuity of a rope",
                            "space",
                            "spool",
                            "spring",
                            "statics",
                            "support that turns",
                            "stop between bodies",
                            "stress-free: as drawn",
                            "stress-free: straight",
                            "tension as drawn",
                            "tension-only",
                            "thermal expansion",
                            "torque per length",
                            "torsion",
                            "turning pulley",
                            "unequal bending",
                            "unstressed length",
                            "viscous resistance",
                            "wind"};
  return all;
}

}  // namespace nurbeam
