#include "pipelines/case/rigid_bodies.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Type = CaseBodyJoint::Type;

std::string direction_text(const Eigen::Vector3d& v) {
  return "[" + text_of(v.x()) + ", " + text_of(v.y()) + ", " + text_of(v.z()) + "]";
}

// What stands beside a support or a load.
CaseGrip grip_beside(const Json& json, const std::string& path, Findings& findings) {
  CaseGrip grip{.path = path};
  grip_fields().read(json, path, grip, findings);
  return grip;
}

std::optional<Eigen::Vector3d> axis_under(const Json& json, const char* key, const std::string& path,
                                          Findings& findings) {
  if (!has(json, key)) return {};
  const Eigen::Vector3d axis = vector(json, key);
  if (axis.norm() == 0) findings.error(child(path, key), "is [0, 0, 0]; give the direction of the axis");
  return axis;
}

void need_axis(const CaseBodyJoint& joint, const std::string& type, const char* key, Findings& findings) {
  if (!joint.axis)
    findings.error(joint.path,
                   in_quotes(type) + " needs " + in_quotes(key) + ", the direction along which it is free");
}

// The axes of a universal joint, which stay square.
void read_axes(const Json& json, CaseBodyJoint& joint, Findings& findings) {
  const std::string path = child(joint.path, "axes");
  if (!has(json, "axes")) {
    findings.error(joint.path,
                   "\"universal\" needs \"axes\": one of the first body and one of the second, square "
                   "to each other as drawn");
    return;
  }
  for (std::size_t i = 0; i < 2 && i < json["axes"].size(); ++i)
    if (!json["axes"][i].is_null()) joint.axes[i] = to_vector(json["axes"][i]);
  const auto& [u, v] = joint.axes;
  if (u.norm() == 0 || v.norm() == 0 || std::abs(u.dot(v)) > 1e-6 * u.norm() * v.norm())
    findings.error(path, "are " + direction_text(u) + " and " + direction_text(v) +
                             ", which are not square to each other as drawn, and of some length");
}

// What turns a support of a body.
void read_rotation(const Json& json, CaseBodyJoint& joint, Findings& findings) {
  if (!has(json, "rotation")) return;
  CaseRotation& rotation = joint.rotation.emplace();
  rotation.path = child(joint.path, "rotation");
  rotation_fields().read(json["rotation"], rotation.path, rotation, findings);
  if (rotation.axis.norm() == 0)
    findings.error(child(rotation.path, "axis"), "is [0, 0, 0]; give the direction of the axis");
  if (joint.type == Type::line)
    findings.error(rotation.path, "is of \"clamped\" and \"pinned\" supports of bodies; use one of these");
  if (joint.type == Type::ball && !rotation.about)
    findings.error(rotation.path,
                   "turns nothing: \"pinned\" holds a place alone; use \"clamped\", or give a point "
                   "\"about\" which it goes round");
  if (joint.type == Type::hinge && !rotation.about &&
      joint.axis->stableNormalized().cross(rotation.axis.stableNormalized()).norm() < 1e-9)
    findings.error(rotation.path,
                   "turns nothing: the pin leaves a turn about its \"axis\" free; use \"clamped\", which "
                   "turns the body");
}

// What drives a hinge.
void read_drive(const Json& json, CaseBodyJoint& joint, Findings& findings) {
  if (!has(json, "drive")) return;
  CaseDrive& drive = joint.drive.emplace();
  drive.path = child(joint.path, "drive");
  drive_fields().read(json["drive"], drive.path, drive, findings);
  if (joint.type != Type::hinge)
    findings.error(drive.path, "is of a joint that turns about one axis; use \"hinged\" with an \"axis\"");
}

}  // namespace

CaseBodyJoint read_body_support(const Json& json, const std::string& path, Findings& findings) {
  CaseBodyJoint joint{.path = path, .name = text(json, "name")};
  joint.is_support = true;
  joint.between[0] = grip_beside(json, path, findings);
  const std::string type = text(json, "type");
  joint.axis = axis_under(json, type == "guided" ? "direction" : "axis", path, findings);
  if (type == "pinned")
    joint.type = joint.axis ? Type::hinge : Type::ball;
  else if (type == "clamped")
    joint.type = Type::rigid;
  else if (type == "guided")
    joint.type = Type::line;
  else
    findings.error(child(path, "type"),
                   "is \"fork\", which is for beams with torsion; of a body use \"pinned\", with "
                   "an \"axis\" as a pin, \"clamped\" or \"guided\"");
  if (joint.type == Type::line) need_axis(joint, "guided", "direction", findings);
  for (const char* key : {"force", "mass", "slope", "interpolation"})
    if (has(json, key)) findings.error(child(path, key), "is of the support of a beam; leave it out");
  if (has(json, "motion")) take(json["motion"], joint.motion);
  read_rotation(json, joint, findings);
  return joint;
}

CaseBodyJoint read_body_joint(const Json& json, const std::string& path, Findings& findings) {
  CaseBodyJoint joint{.path = path, .name = text(json, "name")};
  for (std::size_t i = 0; i < 2 && i < json["between"].size(); ++i) {
    joint.between[i].path = child(child(path, "between"), i);
    if (!json["between"][i].is_null())
      grip_fields().read(json["between"][i], joint.between[i].path, joint.between[i], findings);
  }
  for (const char* key : {"at", "slope"})
    if (has(json, key))
      findings.error(child(path, key), "is of joints of \"beams\"; say where in \"between\"");
  const std::string type = text(json, "type");
  joint.axis = axis_under(json, "axis", path, findings);
  joint.type = type == "rigid"       ? Type::rigid
               : type == "universal" ? Type::universal
               : type == "cylinder"  ? Type::cylinder
               : type == "slide"     ? Type::slide
               : joint.axis          ? Type::hinge
                                     : Type::ball;
  if (joint.type == Type::cylinder || joint.type == Type::slide) need_axis(joint, type, "axis", findings);
  if (joint.type == Type::universal) read_axes(json, joint, findings);
  read_drive(json, joint, findings);
  if (!joint.between[0].is_on_body())
    std::swap(joint.between[0], joint.between[1]), std::swap(joint.axes[0], joint.axes[1]);
  if (!joint.between[0].is_on_body())
    findings.error(child(path, "between"), "names no body; beams alone are joined by \"beams\"");
  return joint;
}

CaseBodyLoad read_body_load(const Json& json, const std::string& path, Findings& findings) {
  CaseBodyLoad load{.path = path, .on = grip_beside(json, path, findings)};
  for (const char* key :
       {"force_per_length", "force_per_projected_length", "torque_per_length", "offset", "moves", "slope"})
    if (has(json, key))
      findings.error(child(path, key), "is of a load on a beam; on a body give a \"force\" or a \"moment\"");
  load.is_moment = has(json, "moment");
  load.value = vector(json, load.is_moment ? "moment" : "force", Eigen::Vector3d::Zero());
  load.follower = flag(json, "follower");
  if (has(json, "time")) take(json["time"], load.time);
  return load;
}

void check_rigid_body(const CaseBody& body, Findings& findings) {
  if (!body.inertia) return;
  const Eigen::Vector3d J = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(*body.inertia).eigenvalues();
  const std::string path = child(body.path, "inertia");
  constexpr double round_off = 1e-9;
  if (!(J[0] > 0))
    findings.error(
        path, "has a principal moment of " + text_of(J[0], 4) +
                  " kg m^2; all three must be above 0 (a slender rod may have 1e-9 of the greatest about "
                  "itself)");
  else if (J[2] > (J[0] + J[1]) * (1 + round_off))
    findings.error(
        path, "has the principal moments " + text_of(J[0], 4) + ", " + text_of(J[1], 4) + " and " +
                  text_of(J[2], 4) + " kg m^2, of which the greatest is " + text_of(J[2] - J[0] - J[1], 4) +
                  " more than the sum of the others; no body has that: the third can be at most that sum");
  if (!body.fixed_to.empty() && !body.fastened_to.empty())
    findings.error(child(body.path, "fixed_to"),
                   "holds the body, and so does \"fastened\"; leave one of them out");
  if (body.roll_inertia > 0)
    findings.error(child(body.path, "roll_inertia"), "is of a point mass; a rigid body has its \"inertia\"");
  if (body.turned.axis.norm() == 0)
    findings.error(child(body.path, "turned.axis"), "is [0, 0, 0]; give the direction of the axis");
  if (body.rotor.axis.norm() == 0)
    findings.error(child(body.path, "rotor.axis"), "is [0, 0, 0]; give the direction of the axis");
}

namespace {

// Finds the points of bodies that are taken hold of.
class BodyPoints {
 public:
  BodyPoints(CaseFile& file, Findings& findings) : file_(file), findings_(findings) {
    const std::size_t count = file.bodies.size();
    for (std::size_t i = 0; i < count; ++i)
      for (const auto& [name, place] : std::vector(file.bodies[i].points))
        add(file.bodies[i].name, name, place);
  }

  // A point of a body at the place of a beam that holds it.
  std::string on_beam(const CaseBody& body) {
    const std::string name = add(body.name, "fixed", Eigen::Vector3d::Zero());
    CaseBody& point = file_.bodies.back();
    point.path = child(find(point.point_of)->path, "fixed_to");
    point.drawn_on = find(point.point_of)->fixed_to;
    point.drawn_at = find(point.point_of)->fixed_at;
    return name;
  }
  // The air drags the body at one of its points.
  void drag_at_point(std::size_t i) {
    const CaseBody body = file_.bodies[i];
    const std::string path = child(body.path, "drag_at");
    const std::string name =
        body.drag_place ? at(body.name, *body.drag_place, path) : named(body.name, body.drag_point, path);
    if (name == body.name) return;  // said
    std::ranges::find(file_.bodies, name, &CaseBody::name)->drag_area = body.drag_area;
    file_.bodies[i].drag_area = 0;
  }
  // The body that a grip takes hold of, in place of the rigid body.
  void resolve(CaseGrip& grip) {
    if (!grip.is_on_body()) return;
    if (!grip.body_point.empty())
      grip.body = named(grip.body, grip.body_point, child(grip.path, "at"));
    else if (grip.body_place)
      grip.body = at(grip.body, *grip.body_place, child(grip.path, "at"));
  }
  std::string named(const std::string& body, const std::string& point, const std::string& path) {
    const CaseBody* of = find(body);
    if (!of) return body;
    std::vector<std::string> known;
    for (const auto& [name, place] : of->points) known.push_back(name);
    if (std::ranges::find(known, point) != known.end()) return body + "." + point;
    if (!of->inertia)
      findings_.error(path, "is " + in_quotes(point) + ", but body " + in_quotes(body) +
                                " is a point mass, which has no points; give it an \"inertia\"");
    else
      findings_.error(
          path, "body " + in_quotes(body) + " has no point " + in_quotes(point) + known_names(point, known));
    return body;
  }

 private:
  const CaseBody* find(const std::string& name) const {
    const auto found = std::ranges::find(file_.bodies, name, &CaseBody::name);
    return found == file_.bodies.end() ? nullptr : &*found;
  }
  std::string at(const std::string& body, const Eigen::Vector3d& place, const std::string& path) {
    const CaseBody* of = find(body);
    if (!of) return body;
    if (!of->inertia) {
      findings_.error(path,
                      "is a place of body " + in_quotes(body) +
                          ", a point mass, which has none; leave it out, or give the body an \"inertia\"");
      return body;
    }
    for (const CaseBody& other : file_.bodies)
      if (other.point_of == body && other.drawn == place) return other.name;
    int number = 1;
    while (find(body + ".at_" + std::to_string(number))) ++number;
    return add(body, "at_" + std::to_string(number), place);
  }
  std::string add(const std::string& body, const std::string& point, const Eigen::Vector3d& place) {
    const std::string name = body + "." + point;
    CaseBody added{.name = name};
    added.path = find(body)->path;
    added.point_of = body;
    added.drawn = place;
    if (find(name))
      findings_.error(added.path, "has the point " + in_quotes(point) + ", which would be called " +
                                      in_quotes(name) + ", the name of another body; names must differ");
    file_.bodies.push_back(std::move(added));
    return name;
  }

  CaseFile& file_;
  Findings& findings_;
};

// Joins a body to a beam rigidly.
void fix_to_beam(const CaseBody& body, BodyPoints& points, CaseFile& file) {
  CaseBodyJoint joint{.type = Type::rigid, .path = child(body.path, "fixed_to"), .name = {}};
  joint.says_type = false;
  joint.between[0].path = joint.between[1].path = joint.path;
  joint.between[0].body = points.on_beam(body);
  joint.between[1].beam = body.fixed_to;
  joint.between[1].at = body.fixed_at;
  file.body_joints.push_back(std::move(joint));
}

}  // namespace

void add_body_points(CaseFile& file, Findings& findings) {
  BodyPoints points(file, findings);
  for (std::size_t i = 0; i < file.bodies.size(); ++i) {
    if (!file.bodies[i].fixed_to.empty()) fix_to_beam(CaseBody(file.bodies[i]), points, file);
    if (!file.bodies[i].drag_point.empty() || file.bodies[i].drag_place) points.drag_at_point(i);
  }
  for (CaseSlidingJoint& joint : file.sliding_joints)
    if (!joint.point.empty()) joint.body = points.named(joint.body, joint.point, child(joint.path, "point"));
  for (CaseConnector& connector : file.connectors)
    for (CaseConnectorEnd& end : connector.ends) points.resolve(end);
  for (CaseBodyJoint& joint : file.body_joints)
    for (CaseGrip& grip : joint.between) points.resolve(grip);
  for (CaseBodyLoad& load : file.body_loads) points.resolve(load.on);
}

namespace {

const CaseBody* named_body(const CaseFile& file, const std::string& name) {
  const auto found = std::ranges::find(file.bodies, name, &CaseBody::name);
  return found == file.bodies.end() ? nullptr : &*found;
}

// Where a probe of a rigid body is drawn; nothing with errors.
std::optional<Eigen::Vector3d> probed_place(const CaseProbe& probe, const CaseBody& body,
                                            const CaseFile& file, Findings& findings) {
  if (!body.point_of.empty()) return body.drawn;
  if (!body.inertia) {
    findings.error(child(probe.path, "body"),
                   "is " + in_quotes(probe.body) +
                       ", a point mass, whose columns stand under its own name; leave the probe out "
                       "(\"output\": { \"accelerations\": true } adds what it feels)");
    return {};
  }
  if (probe.body_place) return probe.body_place;
  if (probe.body_point.empty()) {
    if (!body.position)
      findings.error(probe.path,
                     "\"at\" is missing: the name of a point of the body, or a point as drawn; the "
                     "columns of the centre of mass stand under " +
                         in_quotes(probe.body));
    return body.position;
  }
  if (const CaseBody* point = named_body(file, probe.body + "." + probe.body_point)) return point->drawn;
  std::vector<std::string> known;
  for (const auto& [name, place] : body.points) known.push_back(name);
  findings.error(child(probe.path, "at"), "body " + in_quotes(probe.body) + " has no point " +
                                              in_quotes(probe.body_point) +
                                              known_names(probe.body_point, known));
  return {};
}

}  // namespace

void add_body_probes(CaseFile& file, Findings& findings) {
  for (const CaseProbe& probe : file.output.probes) {
    const CaseBody* body = named_body(file, probe.body);
    if (probe.body.empty() || !body) continue;  // a name that is none is said elsewhere
    const std::optional<Eigen::Vector3d> drawn = probed_place(probe, *body, file, findings);
    if (!drawn) continue;
    CaseBody point{.name = probe.name};
    point.path = probe.path;
    point.point_of = body->point_of.empty() ? body->name : body->point_of;
    point.drawn = *drawn;
    file.bodies.push_back(std::move(point));
  }
  std::erase_if(file.output.probes, [](const CaseProbe& probe) { return !probe.body.empty(); });
}

}  // namespace nurbeam
