#include "pipelines/model/sliding_joints.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "nurbs/number_text.h"
#include "pipelines/model/place_motions.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

namespace {

// A discontinuous slope is a hinge that moves with the body. Where bending reaches further along the beam
// than an element, sqrt(EI/T) > l, the beam resists the kink.
void warn_of_stiff_hinge(const CaseSlidingJoint& from, const Rider& joint, const BeamModel& model,
                         Findings& findings) {
  const Beam& beam = model.beam_of(joint);
  const double mass = model.bodies[joint.body].mass + beam.properties.mass_per_length * beam.curve.length();
  const double weight = mass * model.gravity.norm(), l = beam.curve.length() / beam.home_intervals();
  if (joint.continuous_slope || weight == 0 || beam.properties.bending_stiffness <= weight * l * l) return;
  findings.warn(
      from.path + ".slope",
      "\"discontinuous\" makes a hinge that moves with the body, but beam \"" + from.beam +
          "\" is stiff: EI = " + text_of(beam.properties.bending_stiffness, 3) +
          " N m^2 is more than its and the body's weight times the square of an element's length, " +
          text_of(weight * l * l, 3) + " N m^2; use \"continuous\"");
}

// A kink has two sections.
void check_following(const CaseSlidingJoint& joint, Findings& findings) {
  if (joint.follows_section && joint.slope == SlopeRule::discontinuous)
    findings.error(joint.path + ".follows_section",
                   "is true, but the slope is \"discontinuous\" where body \"" + joint.body +
                       "\" is, and a kink has a section on either side; use \"continuous\"");
  if (joint.offset && !joint.follows_section)
    findings.error(joint.path + ".offset", "needs \"follows_section\": true, which turns it with the beam");
}

// What of a rigid body's attitude goes with the section.
void set_follows(const CaseSlidingJoint& joint, const ResolvedCase& resolved, const BeamModel& model,
                 const ModelFrame& frame, Rider& rider, Findings& findings) {
  const CaseBody& of = resolved.bodies[resolved.body_index(joint.body)];
  const bool is_rigid = of.inertia || !of.point_of.empty();
  const Follows follows = joint.follows_section && is_rigid ? Follows::section : joint.follows;
  if (follows == Follows::nothing) return;
  const std::string path = joint.path + ".follows";
  if (!is_rigid)
    return findings.error(path,
                          "is of a rigid body, but body \"" + joint.body +
                              "\" is a point mass, which has no attitude; give it an \"inertia\", or use "
                              "\"follows_section\"");
  if (follows == Follows::axis && (!joint.axis || joint.axis->norm() == 0))
    return findings.error(
        path, "is \"axis\", which needs the \"axis\" of the body that keeps its direction in the section");
  const CaseBeam& from = resolved.beams[resolved.beam_index(joint.beam)];
  if (!from.rigid && !from.torsion)
    return findings.error(path, "needs the sections of beam \"" + joint.beam +
                                    "\", which has no torsion; give it \"torsion\": true");
  rider.follows = follows;
  rider.follows_section = false;
  if (!joint.axis) return;
  const int carrier = resolved.body_index(of.inertia ? of.name : of.point_of);
  rider.follow_axis =
      model.bodies[carrier].rigid->attitude * frame.direction_to_local(*joint.axis).normalized();
}

// Small vibrations have no friction.
void check_friction(const CaseSlidingJoint& joint, const CaseAnalysis& analysis, Findings& findings) {
  if (!joint.friction) return;
  if (analysis.has_modes()) findings.warn(joint.path + ".friction", "has no effect on modes and buckling");
}

// Nothing is let go where nothing moves on.
void check_release(const CaseSlidingJoint& joint, const CaseAnalysis& analysis, Findings& findings) {
  if (!joint.release || analysis.type == CaseAnalysis::Type::dynamic) return;
  findings.warn(joint.path + ".release", analysis.has_modes()
                                             ? "has no effect on modes and buckling"
                                             : "has no effect in a static analysis: bodies come to rest");
}

// Nothing on a beam runs faster than the waves along it.
void warn_of_speed(const CaseSlidingJoint& from, const Rider& joint, const BeamModel& model,
                   Findings& findings) {
  if (model.beam_of(joint).rigid) return;
  const BeamProperties& p = model.beam_of(joint).properties;
  const double waves = std::sqrt(p.axial_stiffness / p.mass_per_length);
  double fastest = std::abs(joint.speed);
  if (joint.motion) fastest = std::max(fastest, joint.motion->rows()->steepest());
  if (fastest > waves)
    findings.warn(from.path + (joint.motion ? ".motion" : ".speed"),
                  "moves body \"" + from.body + "\" at " + text_of(fastest, 6) +
                      " m/s, faster than waves run along beam \"" + from.beam + "\", " + text_of(waves, 6) +
                      " m/s: is the unit right? Such a motion is not followed with any accuracy");
}

// Two bodies on one beam must be apart: contact between them is not modelled.
void check_apart(const std::vector<CaseSlidingJoint>& from, const BeamModel& model, Findings& findings) {
  for (std::size_t j = 0; j < model.riders.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Rider &a = model.riders[i], &b = model.riders[j];
      if (a.beam != b.beam) continue;
      const Beam& beam = model.beam_of(b);
      const double least =
          (beam.rigid ? touching_distance : meeting_distance) * beam.curve.length() / beam.home_intervals();
      const double apart = std::abs(beam.curve.unrolled(a.s, b.s) - b.s);
      if (apart <= least)
        findings.error(from[j].path + ".at", "puts body \"" + from[j].body + "\" " + text_of(apart) +
                                                 " m from body \"" + from[i].body + "\" on beam \"" +
                                                 from[j].beam + "\"; bodies must be more than " +
                                                 text_of(least) + " m apart");
    }
}

// The beams that one body slides on cross where it starts.
void check_together(const std::vector<CaseSlidingJoint>& from, const BeamModel& model, Findings& findings) {
  constexpr double apart = 1e-6;  // of the length
  for (std::size_t j = 0; j < model.riders.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const Rider &a = model.riders[i], &b = model.riders[j];
      if (a.body != b.body) continue;
      const ReferenceCurve &one = model.beam_of(a).curve, &other = model.beam_of(b).curve;
      const double distance = (one.position(a.s) - other.position(b.s)).norm();
      if (distance > apart * std::max(one.length(), other.length()))
        findings.error(from[j].path + ".at", "puts body \"" + from[j].body + "\" " + text_of(distance) +
                                                 " m from where " + from[i].path +
                                                 " puts it; a body slides on two beams where they cross");
    }
}

// Of the beam's material as it starts.
Eigen::Vector3d material_velocity(const Rider& joint, const BeamModel& model) {
  const Beam& beam = model.beam_of(joint);
  if (!beam.velocity) return Eigen::Vector3d::Zero();
  const BeamVelocity& v = *beam.velocity;
  return v.translation + v.rotation.cross(beam.curve.position(joint.s) - v.about) +
         v.along * beam.curve.tangent(joint.s);
}

// Of a joint's body as the joint starts it, with what it is driven at.
Eigen::Vector3d body_velocity(const Rider& joint, const BeamModel& model) {
  const double speed = joint.motion ? joint.motion->at(0).speed : joint.speed;
  return material_velocity(joint, model) + speed * model.beam_of(joint).curve.tangent(joint.s);
}

std::string velocity_text(const Eigen::Vector3d& local, const ModelFrame& frame) {
  const Eigen::Vector3d v = frame.direction_to_world(local);
  return "[" + text_of(v.x(), 4) + ", " + text_of(v.y(), 4) + ", " + text_of(v.z(), 4) + "] m/s";
}

// A body on two beams starts with what one of its joints says: along the other beam it runs as fast as that
// takes it.
void share_speeds(const std::vector<CaseSlidingJoint>& from, const ModelFrame& frame, BeamModel& model,
                  Findings& findings) {
  const auto share = [&](std::size_t i, std::size_t j) {
    Rider& joint = model.riders[j];
    const Eigen::Vector3d along = body_velocity(model.riders[i], model) - material_velocity(joint, model);
    if (from[i].says_speed() && !from[j].says_speed())
      joint.speed = along.dot(model.beam_of(joint).curve.tangent(joint.s));
  };
  for (std::size_t j = 0; j < model.riders.size(); ++j)
    for (std::size_t i = 0; i < j; ++i) {
      const bool by_program = from[i].motion_law || from[j].motion_law;  // whose speeds are not known here
      if (model.riders[i].body != model.riders[j].body || by_program) continue;
      share(i, j);
      share(j, i);
      const Eigen::Vector3d here = body_velocity(model.riders[j], model),
                            there = body_velocity(model.riders[i], model);
      const bool driven = model.riders[i].motion || model.riders[j].motion;  // which may begin with a blow
      if (driven || (here - there).norm() <= 1e-6 * std::max(here.norm(), there.norm())) continue;
      findings.error(
          from[j].path + ".speed",
          "body \"" + from[j].body + "\" starts at " + velocity_text(there, frame) + " by " + from[i].path +
              " on beam \"" + from[i].beam + "\", but at " + velocity_text(here, frame) +
              " by this on beam \"" + from[j].beam +
              "\": give the beams an \"initial\" \"velocity\" that takes the place where they cross "
              "along, and leave the \"speed\" on one of them out, or start at rest");
    }
}

}  // namespace

void add_sliding_joints(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                        const JoinedBeams& joined, const ModelFrame& frame, BeamModel& model,
                        std::vector<LawOfMotion>& motions, Findings& findings) {
  if (resolved.analysis.is_explicit() && !resolved.sliding_joints.empty())
    findings.error("analysis.integrator.type",
                   "\"rk4\" is for models without sliding joints; use \"generalized-alpha\" or \"radau\"");
  for (const CaseSlidingJoint& joint : resolved.sliding_joints) {
    const int b = resolved.beam_index(joint.beam);
    const ReferenceCurve& curve = beams[b].curve;
    const CaseAnalysis& analysis = resolved.analysis;
    Rider added{.body = 0,
                .beam = b,
                .s = place_on(beams[b], joint.at, joint.path, findings),
                .speed = joint.speed.value_or(0),
                .motion = {},
                .release = analysis.type == CaseAnalysis::Type::dynamic ? joint.release : std::nullopt,
                .continuous_slope = joint.slope != SlopeRule::discontinuous,
                .leave_at_end = joint.leave_at_end,
                .follows_section = joint.follows_section,
                .offset = joint.offset.value_or(Eigen::Vector2d::Zero()),
                .rest = joint.rest,
                .friction = analysis.has_modes() ? std::nullopt : joint.friction,
                .as_point = joint.as_point,
                .turning_inertia = joint.rolling_mass};
    if (joint.as_point && joint.slope == SlopeRule::discontinuous)
      findings.error(
          joint.path + ".carried_as",
          "is \"point\", but the slope is \"discontinuous\", and inside an element there is no kink; use "
          "\"node\", or \"slope\": \"continuous\"");
    check_following(joint, findings);
    set_follows(joint, resolved, model, frame, added, findings);
    check_friction(joint, analysis, findings);
    check_release(joint, analysis, findings);
    for (std::size_t i = 0; i < resolved.bodies.size(); ++i)
      if (resolved.bodies[i].name == joint.body) added.body = static_cast<int>(i);
    added.motion =
        place_motion_of(joint.motion, {.path = joint.path, .beam = joint.beam, .curve = &curve, .s = added.s},
                        analysis, findings);
    if (!joint.motion.table.empty()) added.s = added.motion->at(0).s;
    warn_of_stiff_hinge(joint, added, model, findings);
    if (analysis.type == CaseAnalysis::Type::dynamic) warn_of_speed(joint, added, model, findings);
    if (joint.motion_law)
      motions.push_back({.path = joint.path,
                         .function = *joint.motion_law,
                         .rider = static_cast<int>(model.riders.size())});
    model.riders.push_back(std::move(added));
  }
  check_apart(resolved.sliding_joints, model, findings);
  check_together(resolved.sliding_joints, model, findings);
  if (resolved.analysis.type == CaseAnalysis::Type::dynamic)
    share_speeds(resolved.sliding_joints, frame, model, findings);
}

}  // namespace nurbeam
