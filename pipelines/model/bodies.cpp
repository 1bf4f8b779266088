#include "pipelines/model/bodies.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>
#include <string>

#include "fem/mesh/drawn_coordinates.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/prescribed_angle.h"

namespace nurbeam {

namespace {

RigidBody rigid_body(const CaseBody& from, const ModelFrame& frame) {
  const Eigen::Vector3d none = Eigen::Vector3d::Zero();
  const Eigen::Matrix3d axes = frame.rotation * from.axes;
  RigidBody rigid{.inertia = axes * *from.inertia * axes.transpose(),
                  .spin = frame.direction_to_local(from.angular_velocity.value_or(none)),
                  .axes = axes};
  if (from.turned.angle != 0)
    rigid.attitude = Eigen::AngleAxisd(from.turned.angle * std::numbers::pi / 180,
                                       frame.direction_to_local(from.turned.axis).normalized());
  if (from.rotor.inertia > 0)
    rigid.rotor =
        from.rotor.inertia * from.rotor.speed * frame.direction_to_local(from.rotor.axis).normalized();
  return rigid;
}

// Where a turn about a point takes the centre of mass.
Eigen::Vector3d turned_position(const CaseBody& from, const RigidBody& rigid, const ModelFrame& frame) {
  const Eigen::Vector3d drawn = frame.to_local(*from.position);
  if (!from.turned.about) return drawn;
  const Eigen::Vector3d about = frame.to_local(*from.turned.about);
  return about + rigid.attitude * (drawn - about);
}

// The centre of mass of a rigid body as it is drawn.
Eigen::Vector3d drawn_centre(const ResolvedCase& resolved, int body, const ModelFrame& frame,
                             const BeamModel& model) {
  const CaseBody& from = resolved.bodies[body];
  return from.position ? frame.to_local(*from.position) : drawn_place(model, Grip::on_body(body));
}

// Where a body, or a point of one, is drawn.
Eigen::Vector3d drawn_at(const ResolvedCase& resolved, int body, const ModelFrame& frame,
                         const BeamModel& model) {
  const CaseBody& from = resolved.bodies[body];
  return from.point_of.empty() ? drawn_centre(resolved, body, frame, model) : frame.to_local(from.drawn);
}

bool follows_section(const ResolvedCase& resolved, const std::string& body) {
  return std::ranges::any_of(
      resolved.sliding_joints,
      [&](const CaseSlidingJoint& joint) { return joint.body == body && joint.follows_section; });
}

}  // namespace

void place_fixed_bodies(ResolvedCase& resolved, const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                        const BeamModel& model, Findings& findings) {
  for (CaseBody& point : resolved.bodies) {
    if (point.drawn_on.empty()) continue;
    const int b = resolved.beam_index(point.drawn_on);
    const double s = place_on(beams[b], point.drawn_at, point.path, findings);
    point.drawn = frame.to_world(model.beams[b].curve.position(beams[b].material_coordinate(s)));
    CaseBody& carrier = resolved.bodies[resolved.body_index(point.point_of)];
    if (!carrier.position) carrier.position = point.drawn;
  }
}

void add_bodies(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model, Findings& findings) {
  for (const CaseBody& from : resolved.bodies) {
    Body body{
        .name = from.name,
        .mass = from.mass,
        .position = from.position ? frame.to_local(*from.position) : Eigen::Vector3d(Eigen::Vector3d::Zero()),
        .velocity = frame.direction_to_local(from.velocity.value_or(Eigen::Vector3d::Zero())),
        .roll_inertia = from.roll_inertia,
        .drag_area = from.drag_area};
    if (from.inertia) {
      body.rigid = rigid_body(from, frame);
      if (from.position) body.position = turned_position(from, *body.rigid, frame);
      if (from.rotor.inertia > 0 && resolved.analysis.type == CaseAnalysis::Type::buckling)
        findings.error(from.path + ".rotor",
                       "turns, and buckling is of what stands; leave it out, or find \"modes\"");
    }
    model.bodies.push_back(std::move(body));
    if (from.roll_inertia > 0 && !follows_section(resolved, from.name))
      findings.error("bodies",
                     "body \"" + from.name +
                         "\" has a \"roll_inertia\", but follows no section: give its sliding joint "
                         "\"follows_section\": true");
  }
}

void place_body_points(const ResolvedCase& resolved, const ModelFrame& frame, BeamModel& model,
                       Findings& findings) {
  for (std::size_t i = 0; i < resolved.bodies.size(); ++i) {
    const CaseBody& from = resolved.bodies[i];
    if (from.point_of.empty()) continue;
    const int carrier = resolved.body_index(from.point_of);
    const Eigen::Vector3d arm = frame.to_local(from.drawn) - drawn_centre(resolved, carrier, frame, model),
                          at = drawn_place(model, Grip::on_body(carrier)) +
                               model.bodies[carrier].rigid->attitude * arm;
    model.bodies[i].point_of = BodyPoint{carrier, arm};
    model.bodies[i].position = at;
    const double away = (drawn_place(model, Grip::on_body(static_cast<int>(i))) - at).norm();
    constexpr double near = 1e-6;  // [m]
    if (away > near)
      findings.error("sliding_joints",
                     "point " + in_quotes(from.name) + " is at " + text_of(frame.to_world(at)) + ", " +
                         text_of(away, 4) +
                         " m from the place of the beam that it is to slide on; move the body or "
                         "the point, or change \"at\"");
  }
}

std::vector<double> body_joint_places(const ResolvedCase& resolved, int b, const DrawnBeam& beam,
                                      Findings& findings) {
  std::vector<double> places;
  for (const CaseBodyJoint& joint : resolved.body_joints)
    if (const CaseGrip& to = joint.between[1]; !to.beam.empty() && resolved.beam_index(to.beam) == b)
      places.push_back(place_on(beam, to.at, to.path, findings));
  return places;
}

namespace {

// The pairs of axes that a joint holds.
std::vector<AxisPair> pairs_of(const CaseBodyJoint& joint, const ModelFrame& frame) {
  using Type = CaseBodyJoint::Type;
  switch (joint.type) {
    case Type::ball:
    case Type::line:
      return {};
    case Type::hinge:
      if (joint.drive && joint.drive->motion) return rigid_pairs();
      [[fallthrough]];
    case Type::cylinder:
      return hinge_pairs(frame.direction_to_local(*joint.axis));
    case Type::rigid:
    case Type::slide:
      return rigid_pairs();
    case Type::universal:
      return {{frame.direction_to_local(joint.axes[0]).normalized(),
               frame.direction_to_local(joint.axes[1]).normalized()}};
  }
  return {};
}

// What holds the body.
Grip holder(const CaseBodyJoint& from, const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
            const Eigen::Vector3d& drawn, const ModelFrame& frame, const BeamModel& model,
            Findings& findings) {
  const CaseGrip& to = from.between[1];
  if (from.is_support) return Grip::at_point(drawn);
  if (to.point) return Grip::at_point(frame.to_local(*to.point));
  if (to.is_on_body()) {
    const int body = resolved.body_index(to.body);
    return Grip::on_body(model.bodies[body].point_of ? model.bodies[body].point_of->body : body);
  }
  const int b = resolved.beam_index(to.beam);
  const double s = place_on(beams[b], to.at, to.path, findings);
  if (model.beams[b].rigid) return Grip::at_point(beams[b].curve.position(s));
  return Grip::on_beam(b, beams[b].material_coordinate(s));
}

// Whether what stays where it is keeps its axes: a rigid guide is a part of space.
void check_axes(const CaseBodyJoint& from, const BodyJoint& joint, const BeamModel& model,
                Findings& findings) {
  if (joint.pairs.empty()) return;
  const Body& body = model.bodies[joint.turning_body(model)];
  if (!body.rigid)
    findings.error(from.type_path(), "holds the attitude of body " + in_quotes(body.name) +
                                         ", a point mass, which has none; give it an \"inertia\", or use "
                                         "\"hinged\" without an \"axis\"");
  if (joint.to.body >= 0 && !model.bodies[joint.to.body].rigid)
    findings.error(from.type_path(), "holds the attitude against body " +
                                         in_quotes(model.bodies[joint.to.body].name) +
                                         ", a point mass, which has none; give it an \"inertia\", or use "
                                         "\"hinged\" without an \"axis\"");
  if (joint.to.beam >= 0 && !model.beams[joint.to.beam].has_torsion())
    findings.error(from.type_path(), "holds the attitude against beam " +
                                         in_quotes(model.beams[joint.to.beam].name) +
                                         ", which has no torsion and so no axes across it; give the beam "
                                         "\"torsion\": true, or use \"hinged\" without an \"axis\"");
}

// What turns a support, or drives a hinge at a place as drawn.
std::optional<AxisTurn> turn_of_joint(const CaseBodyJoint& from, const Eigen::Vector3d& drawn,
                                      const CaseAnalysis& analysis, const ModelFrame& frame,
                                      Findings& findings) {
  if (from.drive && from.drive->motion)
    return AxisTurn{frame.moment_to_local(from.axis->stableNormalized()).normalized(), drawn,
                    prescribed_angle(*from.drive->motion, analysis, findings)};
  if (!from.rotation) return {};
  const CaseRotation& rotation = *from.rotation;
  return AxisTurn{frame.moment_to_local(rotation.axis.stableNormalized()).normalized(),
                  rotation.about ? frame.to_local(*rotation.about) : drawn,
                  prescribed_angle(rotation, analysis, findings)};
}

// The moment that drives a hinge turns with both bodies, about the axis that they share.
void add_drive_moment(const CaseBodyJoint& from, const BodyJoint& joint, const ModelFrame& frame,
                      BeamModel& model, Findings& findings) {
  if (!from.drive || from.drive->moment.empty()) return;
  if (joint.to.beam >= 0) {
    findings.error(from.drive->path + ".moment",
                   "acts on beam " + in_quotes(model.beams[joint.to.beam].name) +
                       " too, which a drive does not; give a \"motion\", or the moment to both by \"loads\"");
    return;
  }
  const Eigen::Vector3d axis = frame.moment_to_local(from.axis->stableNormalized()).normalized();
  const auto add = [&](int body, double sign) {
    model.forces.push_back(BodyLoad{.body = body,
                                    .turns = body,
                                    .is_moment = true,
                                    .value = sign * axis,
                                    .follower = true,
                                    .time = from.drive->moment});
  };
  add(joint.turning_body(model), 1);
  if (joint.to.body >= 0) add(joint.to.body, -1);
}

// What is joined is drawn together.
void check_together(const CaseBodyJoint& from, double apart, Findings& findings) {
  constexpr double near = 1e-6;  // [m]
  if (apart > near)
    findings.error(from.path + ".between",
                   "joins two places that are " + text_of(apart, 4) +
                       " m apart as drawn; they must be one place: move the body, or say "
                       "\"at\"");
}

}  // namespace

void add_body_joints(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                     const ModelFrame& frame, BeamModel& model, Findings& findings) {
  using Type = CaseBodyJoint::Type;
  for (const CaseBodyJoint& from : resolved.body_joints) {
    const int point = resolved.body_index(from.between[0].body);
    const Eigen::Vector3d drawn = drawn_at(resolved, point, frame, model);
    BodyJoint joint{.name = from.name,
                    .point = point,
                    .to = holder(from, resolved, beams, drawn, frame, model, findings),
                    .pairs = pairs_of(from, frame),
                    .turn = turn_of_joint(from, drawn, resolved.analysis, frame, findings)};
    const bool slides = from.type == Type::cylinder || from.type == Type::slide || from.type == Type::line;
    if (slides) joint.slide = frame.direction_to_local(*from.axis).normalized();
    Eigen::Vector3d there = joint.to.is_point() ? joint.to.point : drawn_place(model, joint.to);
    if (joint.to.body >= 0) {
      there = drawn_at(resolved, resolved.body_index(from.between[1].body), frame, model);
      if (model.bodies[joint.to.body].rigid)
        joint.arm = there - drawn_centre(resolved, joint.to.body, frame, model);
    }
    Eigen::Vector3d apart = there - drawn;
    if (joint.slide) apart -= apart.dot(*joint.slide) * *joint.slide;
    check_together(from, apart.norm(), findings);
    check_axes(from, joint, model, findings);
    if (!from.motion.empty()) {
      std::vector<DisplacementTable::Row> rows;
      for (const auto& [time, displacement] : from.motion)
        rows.emplace_back(time, frame.direction_to_local(displacement));
      joint.motion = DisplacementTable(rows);
    }
    if (!findings.has_errors()) add_drive_moment(from, joint, frame, model, findings);
    model.constraints.push_back(std::move(joint));
  }
}

}  // namespace nurbeam
