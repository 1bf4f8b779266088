// Long because it is all steps from a case to its model, in their order.
#include "pipelines/model/build_model.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/model/build.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/findings.h"
#include "pipelines/diagnostics/joined_warnings.h"
#include "pipelines/model/add_stops.h"
#include "pipelines/model/asked_torsion.h"
#include "pipelines/model/beam_axis.h"
#include "pipelines/model/beam_section.h"
#include "pipelines/model/bodies.h"
#include "pipelines/model/body_start.h"
#include "pipelines/model/cad_files.h"
#include "pipelines/model/check_drawing.h"
#include "pipelines/model/check_freedom.h"
#include "pipelines/model/check_guides.h"
#include "pipelines/model/check_sizes.h"
#include "pipelines/model/collectors.h"
#include "pipelines/model/connectors.h"
#include "pipelines/model/divide_beam.h"
#include "pipelines/model/drawn_beam.h"
#include "pipelines/model/drawn_bending.h"
#include "pipelines/model/eyelets.h"
#include "pipelines/model/flows.h"
#include "pipelines/model/join_beams.h"
#include "pipelines/model/law_points.h"
#include "pipelines/model/loads.h"
#include "pipelines/model/mass_fields.h"
#include "pipelines/model/measures.h"
#include "pipelines/model/pipe_bends.h"
#include "pipelines/model/reels.h"
#include "pipelines/model/resolved_case.h"
#include "pipelines/model/sliding_joints.h"
#include "pipelines/model/supports.h"
#include "pipelines/model/ways_to_eyelets.h"
#include "pipelines/model/why_torsion.h"

namespace nurbeam {

namespace {

// The axes of all beams, as far as the first that is wrong.
std::vector<BeamAxis> axes_of(const ResolvedCase& resolved, CadFiles& files, Findings& findings) {
  std::vector<BeamAxis> axes;
  for (std::size_t b = 0; b < resolved.beams.size() && !findings.has_errors(); ++b) {
    const CaseBeam& beam = resolved.beams[b];
    const Sliders sliders{
        resolved.sliding_bodies(beam.name),
        std::ranges::any_of(resolved.eyelets, [&](const CaseEyelet& e) { return e.beam == beam.name; })};
    axes.push_back(beam_axis(beam, resolved.chains[b], sliders, files, findings));
  }
  return axes;
}

// Whether a guide says along which axes is told what bodies on it feel.
bool tells_axes(const ResolvedCase& resolved, const CaseBeam& beam) {
  return resolved.accelerations && beam.rigid && beam.has_orientation;
}

// That of the axes, gravity and loads.
ModelFrame frame_of(const ResolvedCase& resolved, const std::vector<BeamAxis>& axes) {
  std::vector<RationalCubic> segments;
  for (const BeamAxis& axis : axes)
    segments.insert(segments.end(), axis.segments.begin(), axis.segments.end());
  std::vector<Eigen::Vector3d> forces = {resolved.gravity, resolved.air.wind}, moments;
  for (const CaseLoad& load : resolved.loads)
    (load.kind == CaseLoad::Kind::moment ? moments : forces).push_back(load.value);
  for (const CaseSupport& support : resolved.supports) {
    for (const auto& [time, displacement] : support.motion) forces.push_back(displacement);
    if (support.direction) forces.push_back(*support.direction);
    if (support.rotation) moments.push_back(support.rotation->axis);
  }
  for (const CaseBeam& beam : resolved.beams)
    if (beam.velocity) {
      forces.push_back(beam.velocity->translation);
      moments.push_back(beam.velocity->rotation);
    }
  const bool turns =
      std::ranges::any_of(resolved.bodies, [](const CaseBody& body) { return body.inertia.has_value(); });
  if (segments.empty()) return {.origin = resolved.bodies.front().position.value_or(Eigen::Vector3d::Zero())};
  // Points besides the axes are in the plane of a planar model too.
  const Eigen::Vector3d origin = segments.front().point(0);
  for (const CaseConnector& connector : resolved.connectors) {
    if (connector.direction) forces.push_back(*connector.direction);
    for (const CaseConnectorEnd& end : connector.ends)
      if (end.point) forces.push_back(*end.point - origin);
  }
  for (const CaseConnector& connector : resolved.rotational_connectors)
    if (connector.axis) moments.push_back(*connector.axis);
  for (const CaseBody& body : resolved.bodies) {
    if (body.position) forces.push_back(*body.position - origin);
    if (body.velocity) forces.push_back(*body.velocity);
  }
  for (const CaseEyelet& eyelet : resolved.eyelets) {
    if (eyelet.position) forces.push_back(*eyelet.position - origin);
    if (eyelet.direction) forces.push_back(*eyelet.direction);
    for (const auto& [time, place] : eyelet.moves) forces.push_back(place - origin);
  }
  for (const CaseReel& reel : resolved.reels)
    for (const auto& [time, place] : reel.moves) forces.push_back(place - origin);
  if (resolved.field) {
    moments.push_back(resolved.field->rate);
    if (resolved.field->attraction > 0) forces.push_back(resolved.field->centre - origin);
    if (resolved.field->radial) forces.push_back(*resolved.field->radial);
  }
  for (const CaseCollector& collector : resolved.collectors)
    forces.insert(forces.end(), {collector.travel, collector.up});
  for (const CaseLaw& law : resolved.laws)
    if (law.spatial)
      for (int d = 0; d < 3; ++d) forces.emplace_back(Eigen::Vector3d::Unit(d));
  const bool torsion = std::any_of(resolved.beams.begin(), resolved.beams.end(), [&](const CaseBeam& beam) {
    return beam.torsion || tells_axes(resolved, beam);
  });
  return model_frame(segments, forces, moments, torsion || turns);
}

bool is_curved(const ReferenceCurve& curve) { return curve.largest_curvature() * curve.length() > 1e-9; }

bool is_straight(const CaseBeam& from, const ReferenceCurve& curve, Findings& findings) {
  if (from.torsion) return from.stress_free == StressFree::straight;
  if (curve.dimension() == 2 || from.stress_free == StressFree::straight)
    return from.stress_free == StressFree::straight;
  if (from.stress_free == StressFree::as_drawn_without_torsion) return false;
  if (from.stress_free == StressFree::as_drawn && is_curved(curve))
    findings.error(
        from.path + ".stress_free",
        "\"as-drawn\" needs torsional stiffness for a curved axis in a spatial model: \"torsion\": true; or "
        "use \"straight\" (exact for cables) or \"as-drawn-without-torsion\" (the limit of no torsional "
        "stiffness)");
  return true;
}

// The energy that a curved drawing holds of a beam which is straight when it is free [J]; said where the case
// does not ask for that.
double bending_as_drawn(const CaseBeam& from, const ReferenceCurve& drawn, const Beam& beam,
                        const ModelFrame& frame, Findings& findings) {
  if (!beam.curve.straight()) return 0;
  const DrawnBending bending = drawn_bending(drawn, beam.properties.bending_stiffness);
  if (!(bending.curvature * drawn.length() > 1e-9)) return 0;
  constexpr int digits = 4;
  if (from.stress_free != StressFree::straight)
    findings.warn(
        from.path + ".stress_free",
        "is not given: in space a beam is straight when it is free, but this one is drawn curved; as "
        "drawn it holds " +
            text_of(bending.energy, digits) + " J of bending, its tightest bend having a radius of " +
            text_of(1 / bending.curvature, digits) + " m at s = " + text_of(bending.s, digits) + " m, " +
            text_of(frame.to_world(drawn.position(bending.s))) +
            ". For a cable that was straight, say so with \"straight\"; for a pipe, rail or spring "
            "that was made as it is drawn, give \"as-drawn-without-torsion\"");
  return bending.energy;
}

// The comparison of the subdivision paper: its strain law and measure, no sliding.
void check_without_metric(const CaseBeam& beam, const std::vector<CaseSlidingJoint>& joints,
                          Findings& findings) {
  if (beam.curvature != CurvatureMeasure::spatial)
    findings.error(beam.path + ".metric",
                   "\"none\" needs \"curvature\": \"spatial\", which it is defined for");
  for (const CaseSlidingJoint& joint : joints)
    if (joint.beam == beam.name)
      findings.error(beam.path + ".metric", "\"none\" is a comparison without sliding joints, but body \"" +
                                                joint.body + "\" slides on this beam; use \"reference\"");
}

// Whether the axis turns right back at one of its corners, over which no section can be carried; said there.
bool turns_back(const CaseBeam& from, const ReferenceCurve& curve, const ModelFrame& frame,
                Findings& findings) {
  for (std::size_t i = 1; i + 1 < curve.breaks().size(); ++i) {
    const double s = curve.breaks()[i];
    if (curve.tangent(s, true).normalized().dot(curve.tangent(s).normalized()) >= -1 + 1e-9) continue;
    findings.error(from.path + ".axis",
                   "turns right back on itself at " + text_of(frame.to_world(curve.position(s))) +
                       ": no section can be carried over that; take one of the curves that meet there "
                       "(\"curve\"), or round the turn");
    return true;
  }
  return false;
}

// Whether a beam needs sections: for torsion, or a guide for what is felt on it, or for bodies that follow
// them.
bool needs_sections(const ResolvedCase& resolved, const CaseBeam& from) {
  return from.torsion || tells_axes(resolved, from) ||
         (from.rigid && std::ranges::any_of(
                            resolved.sliding_joints,
                            [&](const CaseSlidingJoint& joint) {
                              return joint.beam == from.name &&
                                     (joint.follows != Follows::nothing || joint.follows_section);
                            }));
}

// The curve with the sections of the beam, where it needs them.
ReferenceCurve oriented(const ResolvedCase& resolved, const CaseBeam& from, ReferenceCurve curve,
                        const ModelFrame& frame, Findings& findings) {
  if (!needs_sections(resolved, from) || turns_back(from, curve, frame, findings)) return curve;
  try {
    return curve.oriented(from.orientation);
  } catch (const std::invalid_argument& problem) {
    findings.error(from.path + ".orientation", problem.what());
    return curve;
  }
}

// The unstressed over the drawn length.
double free_stretch(const CaseBeam& from, const ReferenceCurve& drawn, Findings& findings) {
  constexpr double least = 0.5, most = 2;
  const double stretch = from.unstressed_length.value_or(drawn.length()) / drawn.length();
  if (stretch < least || stretch > most)
    findings.error(from.path + ".unstressed_length",
                   "is " + text_of(*from.unstressed_length) + " m of a beam that is drawn " +
                       text_of(drawn.length()) + " m long; must be between " +
                       text_of(least * drawn.length()) + " and " + text_of(most * drawn.length()) +
                       " m (is the unit right?)");
  return std::clamp(stretch, least, most);
}

// Expansion is relative to the unstressed length, Green's strain to the drawn one.
void add_temperature(const CaseBeam& from, BeamProperties& properties) {
  const double stretch_squared = 1 + 2 * properties.free_strain.constant;
  for (const auto& [time, kelvin] : from.temperature)
    properties.free_strain.thermal.emplace_back(time,
                                                stretch_squared * *from.material.thermal_expansion * kelvin);
}

// Whether a ring runs along itself so fast that its tension bends it: S = rho A v^2 holds any shape.
bool runs_in_its_shape(const CaseBeam& from, const ReferenceCurve& drawn, const BeamProperties& properties) {
  constexpr double near = 0.01;
  if (!drawn.closed() || !from.velocity) return false;
  const CaseVelocity& v = *from.velocity;
  const double needed = properties.mass_per_length * v.along * v.along;
  return v.translation.isZero(0) && v.rotation.isZero(0) && std::abs(from.tension - needed) <= near * needed;
}

// A thrust needs a beam that bends, and a curved axis under tension is in no equilibrium as drawn.
void add_tension(const ResolvedCase& resolved, const CaseBeam& from, const ReferenceCurve& drawn,
                 BeamProperties& properties, Findings& findings) {
  if (from.tension == 0) return;
  const std::string path = from.path + ".tension";
  try {
    properties.set_drawn_tension(from.tension);
  } catch (const std::invalid_argument& problem) {
    findings.error(path, problem.what());
  }
  if (from.tension < 0 && properties.bending_stiffness == 0)
    findings.error(path,
                   "is " + text_of(from.tension) +
                       " N of a beam without bending stiffness, which no thrust can be in; give a positive "
                       "\"tension\", or the section a second moment");
  const CaseAnalysis& analysis = resolved.analysis;
  if (is_curved(drawn) && !runs_in_its_shape(from, drawn, properties) &&
      analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium)
    findings.warn(path,
                  "is " + text_of(from.tension) +
                      " N in an axis that is drawn curved, which is no equilibrium: the motion starts with a "
                      "jerk; start with \"initial\": \"equilibrium\"");
}

// What is drawn much shorter than it is unstressed snaps as soon as it may move: no step follows that.
void check_thrust(const ResolvedCase& resolved, const CaseBeam& from, const ReferenceCurve& drawn,
                  const BeamProperties& properties, Findings& findings) {
  constexpr double least_strain = 1e-6, many = 100;  // supports inside a beam keep it from buckling for long
  const CaseAnalysis& analysis = resolved.analysis;
  if (analysis.type != CaseAnalysis::Type::dynamic || analysis.start_from_equilibrium || drawn.closed())
    return;
  const double strain = properties.free_strain.constant + properties.free_strain.of_tension,
               thrust = strain * properties.axial_stiffness,
               stretch = std::sqrt(1 + 2 * properties.free_strain.constant),
               buckling = stretch * properties.bending_stiffness * std::pow(2 * M_PI / drawn.length(), 2);
  if (strain < least_strain || thrust < many * buckling) return;
  findings.warn(
      from.path + (from.tension < 0 ? ".tension" : ".unstressed_length"),
      "presses the beam as it is drawn with " + text_of(thrust, 4) + " N, while " + text_of(buckling, 4) +
          " N buckle it where its ends are clamped: the motion starts with a snap, which asks for very "
          "short steps; start with \"initial\": \"equilibrium\", or give a \"tolerance\"");
}

std::optional<BeamVelocity> initial_velocity(const CaseBeam& from, const ModelFrame& frame) {
  if (!from.velocity) return {};
  return BeamVelocity{frame.direction_to_local(from.velocity->translation),
                      frame.moment_to_local(from.velocity->rotation), frame.to_local(from.velocity->about),
                      from.velocity->along};
}

// A beam without elements yet.
Beam beam_of(const ResolvedCase& resolved, const CaseBeam& from, const ReferenceCurve& curve,
             const BeamSection& drawn, const ModelFrame& frame, Findings& findings) {
  const CaseSection& section = drawn.section;
  if (from.metric == Metric::label) check_without_metric(from, resolved.sliding_joints, findings);
  const Section sizes{.area = section.area,
                      .second_moment = section.second_moment,
                      .radius = section.radius,
                      .bore = section.bore,
                      .extreme_fibre = section.radius           ? section.radius
                                       : section.second_moments ? std::nullopt
                                                                : section.extreme_fibre};
  const Material material{.youngs_modulus = from.material.youngs_modulus,
                          .density = from.material.density,
                          .damping = from.material.damping,
                          .mass_damping = from.material.mass_damping,
                          .stiffness_damping = from.material.stiffness_damping};
  BeamProperties properties(sizes, material, from.curvature);
  properties.axial_strain = from.axial_strain;
  properties.law = from.material.law.value_or(GreenLaw());
  properties.compression = from.material.compression;
  std::optional<SectionStresses> stresses;
  if (from.torsion) {
    if (const auto section_of_beam = torsion_section(from, curve.length(), drawn, findings)) {
      properties.sections = section_of_beam->stiffness;
      stresses = section_of_beam->stresses;
    }
  }
  if (const double stretch = free_stretch(from, curve, findings); stretch != 1)
    properties = properties.with_free_stretch(stretch);
  add_temperature(from, properties);
  add_tension(resolved, from, curve, properties, findings);
  check_thrust(resolved, from, curve, properties, findings);
  const ReferenceCurve stress_free = is_straight(from, curve, findings) ? curve.straightened() : curve;
  return {.name = from.name,
          .curve = oriented(resolved, from, stress_free, frame, findings),
          .properties = properties,
          .section = sizes,
          .material = material,
          .stresses = stresses,
          .weights = from.element == ElementKind::ale_ancf ? WeightRule::ones : from.weights,
          .merge = from.merge,
          .form = from.form,
          .velocity = initial_velocity(from, frame),
          .home = {}};
}

double mass_of(const BeamModel& model) {
  double mass = 0;
  for (const Beam& beam : model.beams) mass += beam.properties.mass_per_length * beam.curve.length();
  for (const Body& body : model.bodies) mass += body.mass;
  for (const Force& force : model.forces)
    if (const auto* lump = std::get_if<PlaceMass>(&force); lump && lump->weighs) mass += lump->mass;
  return mass;
}

bool bears_moment(const ResolvedCase& resolved, const CaseBeam& beam) {
  return std::any_of(
      resolved.loads.begin(), resolved.loads.end(),
      [&](const CaseLoad& load) { return load.kind == CaseLoad::Kind::moment && load.beam == beam.name; });
}

// Whether something turns sections of a beam: a support, or a connector that resists any turn.
bool is_turned(const ResolvedCase& resolved, const CaseBeam& beam) {
  return std::ranges::any_of(
             resolved.supports,
             [&](const CaseSupport& support) { return support.rotation && support.beam == beam.name; }) ||
         std::ranges::any_of(
             resolved.rotational_connectors,
             [&](const CaseConnector& connector) {
               return std::ranges::any_of(
                   connector.ends, [&](const CaseConnectorEnd& end) { return end.beam == beam.name; });
             });
}

// Whether a beam that does not say gets torsion: one that is curved as drawn in space would else have to be
// another one than drawn, what a corner or a joint holds at an angle would turn about it, a moment across it
// has a part along it where it bends, and what turns its sections turns them about it too.
bool is_given_torsion(const ResolvedCase& resolved, const CaseBeam& beam, const DrawnBeam& drawn) {
  if (!beam.torsion_by_drawing || drawn.curve.dimension() != 3) return false;
  const bool keeps_corner = beam.corners == Corners::rigid && !drawn.corners.empty();
  const auto holds_it = [&](const CaseBeamJoint& joint) {
    return joint.rigid && std::find(joint.beams.begin(), joint.beams.end(), beam.name) != joint.beams.end();
  };
  return is_curved(drawn.curve) || keeps_corner || bears_moment(resolved, beam) ||
         is_turned(resolved, beam) || std::any_of(resolved.joints.begin(), resolved.joints.end(), holds_it);
}

// Draws the beams and adds them to a model that has its frame, without supports and elements.
std::vector<DrawnBeam> add_beams(ResolvedCase& resolved, const std::vector<BeamAxis>& axes, CadFiles& files,
                                 const BuiltModel* like, BuiltModel& built, Findings& findings) {
  std::vector<DrawnBeam> beams;
  for (std::size_t b = 0; b < axes.size() && !findings.has_errors(); ++b) {
    CaseBeam& from = resolved.beams[b];
    const ReferenceCurve* curve =
        like && b < like->model.beams.size() ? &like->model.beams[b].curve : nullptr;
    const std::optional<DrawnBeam> drawn = drawn_beam(from, axes[b], built.frame, curve, findings);
    if (!drawn) break;
    if (from.rigid) {
      built.model.beams.push_back({.name = from.name,
                                   .curve = oriented(resolved, from, drawn->curve, built.frame, findings),
                                   .properties = {},
                                   .rigid = true,
                                   .home = guide_nodes(drawn->curve)});
      built.sources.push_back({axes[b].curve_name, axes[b].source});
      beams.push_back(*drawn);
      continue;
    }
    const bool asked = from.torsion;
    from.torsion = from.torsion || is_given_torsion(resolved, from, *drawn);
    const std::optional<BeamSection> section = beam_section(from, built.frame.dimension, files, findings);
    if (!section) break;
    const bool uneven = !from.torsion && section->profile && section->section.second_moments;
    from.torsion = from.torsion || uneven;
    Beam beam = beam_of(resolved, from, drawn->curve, *section, built.frame, findings);
    beam.bends = pipe_bends(from, beam, built.frame, findings);
    lengthen_for_reels(resolved, from, beam, findings);
    built.model.beams.push_back(std::move(beam));
    built.sources.push_back({axes[b].curve_name, axes[b].source});
    if (built.frame.dimension == 3)
      built.sources.back().torsion = why_torsion(
          from,
          {asked, uneven, is_curved(drawn->curve), bears_moment(resolved, from), is_turned(resolved, from)});
    built.sources.back().outline = section_outline(*section);
    if (!like)
      built.sources.back().drawn_bending =
          bending_as_drawn(from, drawn->curve, built.model.beams.back(), built.frame, findings);
    if (section->profile) built.sources.back().profile = {from.section.profile->path, *section->profile};
    beams.push_back(*drawn);
  }
  return beams;
}

// Adds supports and elements. Per beam the places that need a node, in reference arc length [m].
std::vector<std::vector<double>> divide_beams(const ResolvedCase& resolved,
                                              const std::vector<DrawnBeam>& beams, const JoinedBeams& joined,
                                              BuiltModel& built, Findings& findings) {
  std::vector<std::vector<double>> places(beams.size());
  for (std::size_t b = 0; b < beams.size() && !findings.has_errors(); ++b) {
    const CaseBeam& from = resolved.beams[b];
    if (from.rigid) continue;
    std::vector<double>& held = places[b];
    held = add_supports(resolved, static_cast<int>(b), beams[b], built.frame, built.model, built.motions,
                        findings);
    held.insert(held.end(), joined.places[b].begin(), joined.places[b].end());
    const double same = same_place * beams[b].measured.length();
    std::vector<double> gripped = connector_places(resolved, static_cast<int>(b), beams[b], findings);
    const std::vector<double> joints = body_joint_places(resolved, static_cast<int>(b), beams[b], findings);
    gripped.insert(gripped.end(), joints.begin(), joints.end());
    for (const double s : gripped)
      if (std::none_of(held.begin(), held.end(), [&](double t) { return std::abs(t - s) <= same; }))
        held.push_back(s);
    built.model.beams[b].home = with_stored_nodes(
        divide_beam(from, beams[b], held, resolved.sliding_bodies(from.name), built.frame, findings),
        built.model.beams[b].curve);
  }
  return places;
}

// The elements of beams that name a tolerance instead of a number; nothing where there are none.
std::optional<AdaptedMesh> adapt_elements(const ResolvedCase& resolved, BeamModel& model,
                                          const std::function<bool()>& interrupted, Findings& findings) {
  std::vector<std::optional<double>> tolerances;
  std::string path;
  for (const CaseBeam& beam : resolved.beams) {
    tolerances.push_back(beam.elements.tolerance);
    if (beam.elements.tolerance && path.empty()) path = beam.path + ".elements.tolerance";
  }
  if (path.empty()) return {};
  const std::vector<double> factors = resolved.analysis.factors();
  const AdaptedMesh adapted =
      adapt_mesh(model, tolerances, most_elements, interrupted, factors.empty() ? 0 : factors.back());
  if (adapted.interrupted) {
    findings.error(path, "the search for the number of elements was interrupted");
    return {};
  }
  if (!adapted.from_equilibrium)
    findings.warn(
        path,
        "no static state was found that could say how many elements are needed; the curvature of the "
        "drawing decided: give \"count\" instead");
  if (!adapted.reached)
    findings.warn(path, "is not reached with at most " + std::to_string(most_elements) +
                            " elements in a beam; positions are off by about " + text_of(adapted.error) +
                            " of its length");
  return adapted;
}

// Out of its plane a planar model does not move.
void mention_plane(const ResolvedCase& resolved, int dimension, Findings& findings) {
  if (dimension != 2 || !resolved.analysis.has_modes()) return;
  const bool buckles = resolved.analysis.type == CaseAnalysis::Type::buckling;
  findings.add(Severity::note, "analysis.type",
               std::string("the model lies in a plane: ") + (buckles ? "it buckles" : "its modes are those") +
                   " in that plane; with \"torsion\": true of a beam it " + (buckles ? "buckles" : "swings") +
                   " out of it too");
}

// Nothing, with errors among the findings, where the case cannot be a model.
std::optional<BuiltModel> built_model(const CaseFile& case_file, const std::function<bool()>& interrupted,
                                      const BuiltModel* like, Findings& findings) {
  CadFiles files(interrupted);
  ResolvedCase resolved = resolve_case(case_file, files, findings);
  const std::vector<BeamAxis> axes = axes_of(resolved, files, findings);
  if (!findings.has_errors()) check_guides(resolved, findings);
  if (!findings.has_errors()) check_source(case_file.output, resolved.beams, files, findings);
  if (!findings.has_errors()) give_asked_torsion(resolved, findings);
  if (findings.has_errors()) return {};

  BuiltModel built;
  built.frame = frame_of(resolved, axes);
  built.model.dimension = built.frame.dimension;
  built.model.gravity = built.frame.direction_to_local(resolved.gravity);
  built.model.air = {resolved.air.density, built.frame.direction_to_local(resolved.air.wind)};
  built.model.accelerations = case_file.output.accelerations;
  built.model.field = mass_field(resolved, built.frame, findings);
  const std::vector<DrawnBeam> beams = add_beams(resolved, axes, files, like, built, findings);
  if (findings.has_errors()) return {};

  check_drawn_sections(case_file.output, resolved.beams, findings);
  if (!like) {
    check_softness(resolved.beams, built.model, findings);
    check_sizes(resolved, built.model, built.frame, built.sources, findings);
  }
  if (findings.has_errors()) return {};
  const JoinedBeams joined = join_beams(resolved, beams, built.frame, findings);
  const std::vector<std::vector<double>> held = divide_beams(resolved, beams, joined, built, findings);
  if (findings.has_errors()) return {};
  check_joined_supports(resolved, beams, joined, findings);
  if (findings.has_errors()) return {};
  built.model.constraints.insert(built.model.constraints.end(), joined.joints.begin(), joined.joints.end());
  built.loads.resize(case_file.loads.size() + case_file.body_loads.size());
  add_loads(resolved, beams, built.frame, built.model, built.loads, findings);
  place_fixed_bodies(resolved, beams, built.frame, built.model, findings);
  add_bodies(resolved, built.frame, built.model, findings);
  add_sliding_joints(resolved, beams, joined, built.frame, built.model, built.motions, findings);
  if (!findings.has_errors()) place_body_points(resolved, built.frame, built.model, findings);
  if (!findings.has_errors()) add_body_joints(resolved, beams, built.frame, built.model, findings);
  if (!findings.has_errors()) add_body_loads(resolved, built.frame, built.model, built.loads, findings);
  if (!findings.has_errors()) add_eyelets(resolved, beams, built.frame, built.model, findings);
  if (!findings.has_errors()) add_reels(resolved, beams, held, built.frame, built.model, findings);
  add_connectors(resolved, beams, built.frame, built.model, findings);
  add_rotational_connectors(resolved, beams, built.frame, built.model, findings);
  if (!findings.has_errors())
    built.collectors = add_collectors(resolved, beams, built.frame, built.model, findings);
  if (!findings.has_errors()) add_stops(resolved, beams, built.model, findings);
  if (!findings.has_errors()) start_bodies(resolved, built.model, findings);
  if (!findings.has_errors() && !like) check_ways_to_eyelets(resolved, built.model, findings);
  if (findings.has_errors()) return {};
  mark_held_nodes(built.model);
  set_flows(resolved, built.model, findings);
  warn_of_blows(resolved, built.model, findings);
  built.slopes = decide_slopes(resolved, beams, held, joined, built.frame, interrupted,
                               like ? &like->slopes : nullptr, built.model, findings);
  if (findings.has_errors()) return {};
  do {
    built.adapted = adapt_elements(resolved, built.model, interrupted, findings);
    if (findings.has_errors()) return {};
  } while (built.adapted && smooth_fine_kinks(built.model, built.slopes));
  find_lengths_without(built.collectors, interrupted, built.model, findings);
  if (findings.has_errors()) return {};
  check_freedom(resolved, built.model, findings);
  if (findings.has_errors()) return {};
  check_turns(resolved.beams, built.model, built.frame, findings);
  check_polynomial_elements(resolved.beams, built.model, built.frame, findings);
  mention_plane(resolved, built.frame.dimension, findings);
  if (resolved.analysis.type == CaseAnalysis::Type::dynamic)
    mention_damping(resolved.beams, built.model, findings);
  built.frame.gravity_energy = -mass_of(built.model) * resolved.gravity.dot(built.frame.origin);
  for (const CaseProbe& probe : resolved.probes) {
    const int b = resolved.beam_index(probe.beam);
    const double s = place_on(beams[b], probe.at, probe.path, findings);
    built.probes.push_back({probe.name, b, beams[b].material_coordinate(s), probe.side});
  }
  add_measures(resolved, beams, built.frame, files, built.model, findings);
  for (const CaseLaw& law : resolved.laws) built.laws.push_back(law_points(law, resolved, beams, findings));
  built.inputs = files.inputs();
  built.import_seconds = files.seconds();
  if (findings.has_errors()) return {};
  return built;
}

}  // namespace

BuildReport build_model(const CaseFile& case_file, const std::function<bool()>& interrupted,
                        const BuiltModel* like) {
  Findings findings(case_file.path.string());
  BuildReport report;
  report.value = built_model(case_file, interrupted, like, findings);
  report.diagnostics = joined_warnings(findings.take());
  return report;
}

}  // namespace nurbeam
