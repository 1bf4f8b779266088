#include "pipelines/case/case_connector.h"

#include <algorithm>

#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

// Whether no length of a spring carries anything.
bool carries_nothing(const CaseConnector& connector) { return connector.stiffness == 0 && !connector.rows; }

// A rod has a length and nothing else; the others need a stiffness.
void check_stiffness(const Json& json, const std::string& path, const CaseConnector& connector,
                     Findings& findings) {
  if (connector.type == ConnectorType::rod) {
    for (const char* key : {"stiffness", "damping", "force"})
      if (json.contains(key))
        findings.error(child(path, key),
                       "is not for a rod, which keeps its length; leave it out, or use \"spring\"");
    return;
  }
  if (!json.contains("stiffness"))
    findings.error(path, "\"stiffness\" is missing; all connectors but rods need it");
  if (has(json, "force") && carries_nothing(connector))
    findings.error(child(path, "force"),
                   "is " + text_of(connector.force) +
                       " N, but the stiffness is 0, with which no length gives a force; give a stiffness");
  const bool pulls = connector.type == ConnectorType::tension_only;
  if ((pulls && connector.force < 0) ||
      (connector.type == ConnectorType::compression_only && connector.force > 0))
    findings.error(child(path, "force"),
                   "is " + text_of(connector.force) + " N, a " + (pulls ? "push" : "pull") + ", but " +
                       (pulls ? "\"tension-only\" pulls" : "\"compression-only\" pushes") +
                       "; turn the sign, or use \"spring\"");
}

}  // namespace

namespace {

// What one kind of connector has and the others have not.
void check_keys_of_kind(const Json& json, const std::string& path, const CaseConnector& connector,
                        Findings& findings) {
  const auto refuse = [&](std::initializer_list<const char*> keys, const std::string& why) {
    for (const char* key : keys)
      if (json.contains(key)) findings.error(child(path, key), why);
  };
  if (!connector.rotational)
    return refuse({"axis", "angle", "moment"},
                  "is of the type \"rotational\"; give that, or leave it out" +
                      std::string(json.contains("axis") ? " (a spring acts along a \"direction\")" : ""));
  refuse({"length", "force", "direction", "end_masses"},
         "is of connectors along a line, and this one is \"rotational\": it has \"axis\", \"angle\" and "
         "\"moment\"; leave it out");
  if (connector.rows)
    findings.error(child(path, "stiffness"),
                   "has rows, but the type \"rotational\" has one number in N m/rad");
  if (connector.axis && connector.axis->norm() == 0)
    findings.error(child(path, "axis"), "is [0, 0, 0]; give the direction of the axis");
}

}  // namespace

CaseConnector read_connector(const Json& json, const std::string& path, Findings& findings) {
  CaseConnector connector;
  connector.path = path;
  connector_fields().read(json, path, connector, findings);
  for (const auto& [key, i] : {std::pair{"from", 0}, std::pair{"to", 1}}) {
    connector.ends[i].path = child(path, key);
    if (has(part(json, key), "beam") && !part(json, key).contains("at"))
      findings.error(connector.ends[i].path, "\"beam\" needs \"at\" beside it: the place on the beam");
  }
  if (connector.direction && connector.direction->norm() == 0)
    findings.error(child(path, "direction"), "is [0, 0, 0]; give the direction along which it acts");
  check_keys_of_kind(json, path, connector, findings);
  if (!connector.rotational || !json.contains("stiffness")) check_stiffness(json, path, connector, findings);
  return connector;
}

namespace {

const CaseBody* body_named(const std::string& name, const CaseFile& c) {
  const auto found = std::ranges::find(c.bodies, name, &CaseBody::name);
  return name.empty() || found == c.bodies.end() ? nullptr : &*found;
}
// A rigid body, or the one whose point a body is.
bool turns(const CaseBody& body) { return body.inertia || !body.point_of.empty(); }
const std::string& rigid_name(const CaseBody& body) {
  return body.point_of.empty() ? body.name : body.point_of;
}

void check_ends(const CaseConnector& connector, const CaseFile& c, Findings& findings) {
  const auto& [from, to] = connector.ends;
  for (const CaseConnectorEnd& end : connector.ends)
    if (const CaseBody* body = body_named(end.body, c); connector.rotational && body && !turns(*body))
      findings.error(end.path,
                     "is the body " + in_quotes(end.body) +
                         ", a point mass, which does not turn; give it an \"inertia\", or take hold of a "
                         "\"beam\" at a place, or of space, as a \"point\"");
  if (connector.rotational && !from.body.empty() && from.body != to.body)
    if (const CaseBody* a = body_named(from.body, c), *b = body_named(to.body, c);
        a && b && rigid_name(*a) == rigid_name(*b))
      findings.error(connector.path, "joins the body " + in_quotes(rigid_name(*a)) +
                                         " to itself, which does not turn against itself");
  if (from.point && to.point)
    findings.error(connector.path,
                   "joins two points, which both stay where they are; give a \"beam\" or a "
                   "\"body\" as one end");
  if (!from.body.empty() && from.body == to.body)
    findings.error(connector.path, "joins the body " + in_quotes(from.body) + " to itself");
  for (const int i : {0, 1})
    if (connector.end_masses[i] > 0 && connector.ends[i].point)
      findings.error(
          child(child(connector.path, "end_masses"), i),
          "is " + text_of(connector.end_masses[i]) + " kg at a point, which does not move; give 0 there");
}

// Lengths that an equilibrium gives need one.
void check_length(const CaseConnector& connector, const CaseAnalysis& analysis, Findings& findings) {
  if (connector.length_rule != ConnectorLength::as_drawn) return;
  const std::string path = child(connector.path, "length");
  if (analysis.type == CaseAnalysis::Type::dynamic && !analysis.start_from_equilibrium)
    findings.error(path,
                   "is \"as-drawn\", which is found in equilibrium, but the run starts as drawn; start with "
                   "\"initial\": \"equilibrium\", or give the length as a number");
  if (analysis.has_modes() && !analysis.modes.about_equilibrium)
    findings.error(path,
                   "is \"as-drawn\", which is found in equilibrium, but the modes are about the drawing");
  if (connector.ends[0].point)
    findings.error(path,
                   "is \"as-drawn\", but the first end is a point, which stands where it is drawn anyway; "
                   "exchange \"from\" and \"to\"");
  if (connector.type != ConnectorType::rod && carries_nothing(connector))
    findings.error(path, "is \"as-drawn\", but the stiffness is 0, with which no length carries anything");
}

// Every body is held, and placed, by sliding joints or connectors.
void check_body(const CaseBody& body, const CaseFile& c, Findings& findings) {
  if (!body.point_of.empty()) return;
  std::vector<const CaseSlidingJoint*> joints;
  for (const CaseSlidingJoint& joint : c.sliding_joints)
    if (joint.body == body.name) joints.push_back(&joint);
  const bool connected = std::any_of(
      c.connectors.begin(), c.connectors.end(),
      [&](const CaseConnector& connector) {
        return connector.ends[0].body == body.name || connector.ends[1].body == body.name;
      });
  const auto is_on_body = [&](const auto& carried) { return carried.on == body.name; };
  const bool carries_ring =
      std::ranges::any_of(c.eyelets, is_on_body) || std::ranges::any_of(c.reels, is_on_body);
  if (body.inertia && joints.empty() && !body.position && body.fixed_to.empty())
    findings.error(body.path, "nothing says where the rigid body " + in_quotes(body.name) +
                                  " is; give the \"position\" of its centre of mass as drawn");
  if (!body.inertia && joints.empty() && !connected && !carries_ring)
    findings.error(body.path, "no sliding joint and no connector holds the body " + in_quotes(body.name) +
                                  "; add one to \"sliding_joints\" or \"connectors\", or remove the body");
  else if (!body.inertia && joints.empty() && !carries_ring && !body.position)
    findings.error(body.path, "the body " + in_quotes(body.name) +
                                  " slides on no beam, so that nothing says where it starts; give its "
                                  "\"position\"");
  if (!joints.empty() && body.position)
    findings.error(child(body.path, "position"), "is given, but " + joints[0]->path +
                                                     " says where the body " + in_quotes(body.name) +
                                                     " starts; leave one of them out");
  for (std::size_t i = 1; i < joints.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (joints[i]->beam == joints[k]->beam)
        findings.error(joints[i]->path, "the body " + in_quotes(body.name) + " already slides on the beam " +
                                            in_quotes(joints[i]->beam) + " by " + joints[k]->path);
}

}  // namespace

void check_connectors(const CaseFile& c, Findings& findings) {
  for (const CaseConnector& connector : c.connectors) {
    check_ends(connector, c, findings);
    check_length(connector, c.analysis, findings);
  }
  // A name that is none has been reported; whose body it was to hold is not known.
  const auto is_known = [&](const std::string& name) {
    return std::any_of(c.bodies.begin(), c.bodies.end(),
                       [&](const CaseBody& body) { return body.name == name; });
  };
  for (const CaseSlidingJoint& joint : c.sliding_joints)
    if (!is_known(joint.body)) return;
  for (const CaseConnector& connector : c.connectors)
    for (const CaseConnectorEnd& end : connector.ends)
      if (!end.body.empty() && !is_known(end.body)) return;
  for (const CaseBody& body : c.bodies)
    if (!body.name.empty()) check_body(body, c, findings);
}

}  // namespace nurbeam
