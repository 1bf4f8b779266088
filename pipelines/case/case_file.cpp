#include "pipelines/case/case_file.h"

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/case/case_analysis.h"
#include "pipelines/case/case_beam.h"
#include "pipelines/case/case_check.h"
#include "pipelines/case/case_collector.h"
#include "pipelines/case/case_connector.h"
#include "pipelines/case/case_output.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/case/case_references.h"
#include "pipelines/case/host_keys.h"
#include "pipelines/case/rigid_bodies.h"
#include "pipelines/case/table_files.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

// The rows of an item, which has been checked against their shape.
template <class Item>
Item read_item(const Fields<Item>& fields, const Json& json, const std::string& path, Findings& findings) {
  Item item;
  item.path = path;
  fields.read(json, path, item, findings);
  return item;
}

// The direction of a hinge's axis, which only the type `with` has.
void check_axis(const std::optional<Eigen::Vector3d>& axis, const Json& json, const std::string& path,
                const char* with, Findings& findings) {
  if (!axis) return;
  if (text(json, "type") != with)
    findings.error(child(path, "axis"), "is that of a hinge, for the type " + in_quotes(with) + " only");
  if (axis->norm() == 0) findings.error(child(path, "axis"), "is [0, 0, 0]; give the direction of the hinge");
}

CaseLoad read_load(const Json& json, const std::string& path, Findings& findings) {
  for (const char* key : {"force", "moment", "follower"})
    if (json.contains(key) && !json.contains("at"))
      findings.error(path, in_quotes(key) + " needs \"at\" beside it");
  return read_item(load_fields(), json, path, findings);
}

// What turns must hold something that turns.
void check_rotation(const CaseSupport& support, Findings& findings) {
  const CaseRotation& rotation = *support.rotation;
  if (rotation.axis.norm() == 0)
    findings.error(child(rotation.path, "axis"), "is [0, 0, 0]; give the direction of the axis");
  if (support.type == CaseSupport::Type::guided)
    findings.error(rotation.path,
                   "is of \"clamped\", \"fork\" and \"pinned\" supports; a \"clamped\" or \"fork\" with a "
                   "\"direction\" slides and turns");
  if (support.type == CaseSupport::Type::pinned && !support.axis && !rotation.about)
    findings.error(
        rotation.path,
        "turns nothing: \"pinned\" holds a place alone; give a point \"about\" which it goes round, "
        "an \"axis\" of the hinge, or use \"clamped\" or \"fork\"");
  const Eigen::Vector3d u = rotation.axis.stableNormalized();
  if (support.direction && support.force != 0 && support.direction->stableNormalized().cross(u).norm() > 1e-9)
    findings.error(child(support.path, "force"),
                   "pulls along \"direction\", which turns with the support; let the rotation's \"axis\" be "
                   "along it, or leave the force out");
}

CaseSupport read_support(const Json& json, const std::string& path, Findings& findings) {
  if (!json.contains("at")) findings.error(path, "\"at\" is missing (where)");
  CaseSupport support = read_item(support_fields(), json, path, findings);
  check_axis(support.axis, json, path, "pinned", findings);
  if (support.rotation) check_rotation(support, findings);
  const bool guided = support.type == CaseSupport::Type::guided;
  if (guided && !json.contains("direction"))
    findings.error(path, "\"guided\" needs the \"direction\" along which the support is free");
  if (!support.direction) return support;
  if (support.type == CaseSupport::Type::pinned)
    findings.error(
        child(path, "direction"),
        "is of supports that slide, and \"pinned\" holds its place; use \"guided\", or a \"clamped\" "
        "or \"fork\" that slides");
  if (support.direction->norm() == 0)
    findings.error(child(path, "direction"),
                   "is [0, 0, 0]; give the direction along which the support is free");
  return support;
}

void check_friction(const Friction& friction, const Json& json, const std::string& path, Findings& findings) {
  if (friction.static_coefficient && *friction.static_coefficient < friction.coefficient)
    findings.error(child(path, "static"),
                   "is " + text_of(*friction.static_coefficient) + ", less than \"coefficient\", " +
                       text_of(friction.coefficient) + "; a body that sticks is held at least as well");
  const auto is_given = [&](const char* key) { return json.contains(key); };  // be it wrong
  if (!is_given("coefficient") && !is_given("static") && !is_given("force") && !is_given("force_over") &&
      !is_given("viscous") && !is_given("quadratic"))
    findings.error(path,
                   "resists nothing; give \"coefficient\", \"static\", \"force\", \"force_over\", "
                   "\"viscous\" or \"quadratic\"");
}

CaseSlidingJoint read_sliding_joint(const Json& json, const std::string& path, Findings& findings) {
  CaseSlidingJoint joint = read_item(sliding_joint_fields(), json, path, findings);
  if (!joint.friction) return joint;
  check_friction(*joint.friction, json["friction"], child(path, "friction"), findings);
  if (joint.friction->law == Friction::Law::capstan && joint.slope == SlopeRule::continuous)
    findings.error(child(path, "friction.law"),
                   "is \"capstan\", for the kink of a discontinuous slope, but the slope is continuous: "
                   "\"slope\": \"discontinuous\", or leave it out");
  return joint;
}

// A body that is fastened to a beam slides on it and does not move along.
void add_fastenings(CaseFile& file) {
  for (const CaseBody& body : file.bodies)
    if (!body.fastened_to.empty())
      file.sliding_joints.push_back({.path = child(body.path, "fastened"),
                                     .body = body.name,
                                     .beam = body.fastened_to,
                                     .at = body.fastened_at,
                                     .motion = {.speed = 0}});
}

CaseEyelet read_eyelet(const Json& json, const std::string& path, Findings& findings) {
  CaseEyelet eyelet = read_item(eyelet_fields(), json, path, findings);
  if (eyelet.friction) check_friction(*eyelet.friction, json["friction"], child(path, "friction"), findings);
  return eyelet;
}

CaseReel read_reel(const Json& json, const std::string& path, Findings& findings) {
  CaseReel reel = read_item(reel_fields(), json, path, findings);
  if (reel.friction) {
    check_friction(*reel.friction, json["friction"], child(path, "friction"), findings);
    if (reel.friction->law != Friction::Law::bearing)
      findings.error(child(path, "friction.law"),
                     "is not \"bearing\", the only law for a reel, over which nothing wraps; leave it out");
  }
  const bool is_spool = reel.feed == Reel::Feed::spool;
  if (reel.pickup && !is_spool)
    findings.error(child(path, "pickup"), "is of a spool; give \"feed\": \"spool\", or leave it out");
  if (is_spool && reel.inertia > 0)
    findings.error(child(path, "inertia"),
                   "is of a drum, and a spool does not turn; give \"feed\": \"drum\", or leave it out");
  const auto takes_in = [&](const auto& row) { return row.second < 0; };
  if (is_spool && ((reel.motion.speed && *reel.motion.speed < 0) ||
                   std::adjacent_find(reel.motion.table.begin(), reel.motion.table.end(),
                                      [](const auto& a, const auto& b) { return b.second < a.second; }) !=
                       reel.motion.table.end() ||
                   std::any_of(reel.motion.table.begin(), reel.motion.table.end(), takes_in)))
    findings.error(child(path, "motion"),
                   "takes rope in, which a spool cannot; pay out alone, or give \"feed\": \"drum\"");
  if (is_spool && std::ranges::any_of(reel.force, [](const auto& row) { return row.second > 0; }))
    findings.error(child(path, "force"),
                   "takes rope in, which a spool cannot; let \"friction\" hold it back, or give \"feed\": "
                   "\"drum\"");
  return reel;
}

CaseStop read_stop(const Json& json, const std::string& path, Findings& findings) {
  CaseStop stop = read_item(stop_fields(), json, path, findings);
  if (!stop.at && stop.bodies.size() != 2)
    findings.error(path, "stands nowhere: give \"at\", or the two \"bodies\" that it keeps apart");
  return stop;
}

CaseBeamJoint read_beam_joint(const Json& json, const std::string& path, Findings& findings) {
  CaseBeamJoint joint = read_item(beam_joint_fields(), json, path, findings);
  if (const std::string type = text(json, "type"); type != "hinged" && type != "rigid")
    findings.error(child(path, "type"),
                   "is " + in_quotes(type) +
                       ", which joins a rigid body to something, by \"between\"; beams are "
                       "joined \"hinged\" or \"rigid\"");
  check_axis(joint.axis, json, path, "hinged", findings);
  return joint;
}

CaseBody read_body(const Json& json, const std::string& path, bool has_air, Findings& findings) {
  if (has(json, "drag_area") && !has_air)
    findings.error(child(path, "drag_area"),
                   "needs the \"air\" that drags; at sea level it has a \"density\" of 1.225");
  CaseBody body = read_item(body_fields(), json, path, findings);
  check_rigid_body(body, findings);
  return body;
}

// Whether gravity pulls towards a point.
bool has_attraction(const Json& json) { return has(json, "gravity") && json["gravity"].is_object(); }

// What acts on mass besides even gravity.
std::optional<MassField> read_field(const Json& json, Findings& findings) {
  const Json &frame = part(json, "frame"), &gravity = part(json, "gravity");
  if (!has(json, "frame") && !has_attraction(json)) return {};
  MassField field;
  field.rate = vector(frame, "rate", field.rate);
  field.about = vector(frame, "about", field.about);
  if (has_attraction(json)) {
    field.attraction = number(gravity, "mu", 0);
    field.centre = vector(gravity, "centre", field.centre);
  }
  if (!has(frame, "gravity_gradient")) return field;
  const std::string path = "frame.gravity_gradient";
  const Eigen::Vector3d radial = vector(part(frame, "gravity_gradient"), "radial", Eigen::Vector3d::Zero());
  if (!(radial.norm() > 0) || std::abs(radial.normalized().dot(field.rate)) > 1e-9 * field.rate.norm())
    findings.error(path + ".radial",
                   "is " + text_of(radial) +
                       "; must be a direction across the \"rate\", as an orbit lies across its "
                       "axis");
  else
    field.radial = radial.normalized();
  if (!has(json, "gravity") || has_attraction(json) || !vector(json, "gravity", radial).isZero(0))
    findings.error(path, "has the gravity of what is orbited; give \"gravity\": [0, 0, 0] besides");
  return field;
}

CaseFile read_case(const Json& json, const std::filesystem::path& file, Findings& findings) {
  CaseFile result;
  result.path = file;
  result.name = text(json, "name", file.stem().string());
  result.gravity = has_attraction(json) ? Eigen::Vector3d(Eigen::Vector3d::Zero())
                                        : vector(json, "gravity", result.gravity);
  result.field = read_field(json, findings);
  result.air = {number(part(json, "air"), "density", 0),
                vector(part(json, "air"), "wind", Eigen::Vector3d::Zero())};
  const std::filesystem::path directory = std::filesystem::absolute(file).parent_path();
  for_each_item(
      json, "beams", "",
      [&](const Json& beam, const std::string& path) {
        result.beams.push_back(read_beam(beam, path, directory, findings));
      });
  for_each_item(
      json, "bodies", "",
      [&](const Json& body, const std::string& path) {
        result.bodies.push_back(read_body(body, path, has(json, "air"), findings));
      });
  const auto read_all = [&](const char* key, auto& list, auto read) {
    for_each_item(json, key, "", [&](const Json& item, const std::string& path) {
      list.push_back(read(item, path, findings));
    });
  };
  // Of beams, or else of bodies; loads count through both.
  const auto read_either = [&](const char* key, auto& of_beams, auto read, auto& of_bodies, const char* mark,
                               auto read_of_body) {
    for_each_item(json, key, "", [&](const Json& item, const std::string& path) {
      const auto take = [&](auto& list, auto read_one) {
        const std::size_t number = of_beams.size() + of_bodies.size();
        list.push_back(read_one(item, path, findings));
        if constexpr (requires { list.back().number; }) list.back().number = static_cast<int>(number);
      };
      if (has(item, mark))
        take(of_bodies, read_of_body);
      else
        take(of_beams, read);
    });
  };
  read_either("loads", result.loads, read_load, result.body_loads, "body", read_body_load);
  read_either("supports", result.supports, read_support, result.body_joints, "body", read_body_support);
  read_all("sliding_joints", result.sliding_joints, read_sliding_joint);
  read_all("eyelets", result.eyelets, read_eyelet);
  read_all("reels", result.reels, read_reel);
  read_all("stops", result.stops, read_stop);
  read_either("joints", result.joints, read_beam_joint, result.body_joints, "between", read_body_joint);
  read_all("connectors", result.connectors, read_connector);
  read_all("collectors", result.collectors, read_collector);
  add_fastenings(result);
  add_body_points(result, findings);
  result.laws = read_laws(json);
  const bool nothing_deforms = std::ranges::all_of(result.beams, &CaseBeam::rigid);
  result.analysis = read_analysis(part(json, "analysis"), nothing_deforms, findings);
  if (result.analysis.type == CaseAnalysis::Type::statics) {
    result.analysis.reads_tables = has_tables(result);
    const std::vector<double> factors = result.analysis.factors();
    if (!factors.empty()) result.analysis.end_time = factors.back();
  }
  result.output = read_output(part(json, "output"), result.analysis, directory, findings);
  add_body_probes(result, findings);
  if (!result.collectors.empty() && !result.output.histories_every)
    result.output.histories_at_steps = result.analysis.type == CaseAnalysis::Type::dynamic;
  return result;
}

// All that is named by a "file", absolute.
void add_named_files(const Json& json, const std::filesystem::path& directory,
                     std::vector<std::filesystem::path>& files) {
  if (json.is_object() && json.contains("file") && json["file"].is_string())
    files.push_back(directory / json["file"].get<std::string>());
  if (json.is_structured())
    for (const Json& part : json) add_named_files(part, directory, files);
}

// The case that a JSON value is, once its shape and what it refers to have been checked; but for its text.
CaseFileReport checked_case(Json& json, const Shape& shape, const std::filesystem::path& file,
                            Findings& findings) {
  std::optional<CaseFile> value;
  const std::filesystem::path directory = std::filesystem::absolute(file).parent_path();
  std::vector<std::filesystem::path> files;
  add_named_files(json, directory, files);
  put_in_tables(shape, json, "", directory, findings);
  if (check_shape(shape, json, findings)) {
    value = read_case(json, file, findings);
    value->files = std::move(files);
    check_across(json, *value, findings);
  }
  if (findings.has_errors()) value.reset();
  return {std::move(value), findings.take()};
}

CaseFileReport with_text(CaseFileReport report, const Json& json) {
  if (report.value) report.value->json = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  return report;
}

}  // namespace

CaseFileReport read_case_file(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Findings findings(file.string());
  auto json = read_json(file, case_file_kind, findings);
  if (!json) return {{}, findings.take()};
  std::vector<Diagnostic> diagnostics;
  apply_overrides(*json, overrides, diagnostics);
  CaseFileReport report = with_text(checked_case(*json, case_keys(), file, findings), *json);
  if (!diagnostics.empty()) report.value.reset();
  report.diagnostics.insert(report.diagnostics.begin(), diagnostics.begin(), diagnostics.end());
  return report;
}

CaseFileReport read_case_text(const std::string& text, const std::filesystem::path& file) {
  Findings findings(file.string());
  auto json = parse_json(text, findings);
  if (!json) return {{}, findings.take()};
  return with_text(checked_case(*json, host_keys(), file, findings), *json);
}

CaseFileReport read_case_json(nlohmann::ordered_json json, const std::filesystem::path& file) {
  Findings findings(file.string());
  return checked_case(json, host_keys(), file, findings);
}

CaseTextReport case_text(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Findings findings(file.string());
  auto json = read_json(file, case_file_kind, findings);
  if (!json) return {{}, findings.take()};
  CaseTextReport report;
  apply_overrides(*json, overrides, report.diagnostics);
  const std::vector<Diagnostic> found = findings.take();
  report.diagnostics.insert(report.diagnostics.end(), found.begin(), found.end());
  if (!has_errors(report.diagnostics))
    report.json = json->dump(-1, ' ', false, Json::error_handler_t::replace);
  return report;
}

}  // namespace nurbeam
