#include "pipelines/case/case_file.h"

#include <algorithm>
#include <cmath>

#include "nurbs/number_text.h"
#include "pipelines/case/case_analysis.h"
#include "pipelines/case/case_beam.h"
#include "pipelines/case/case_check.h"
#include "pipelines/case/case_connector.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/case/case_references.h"
#include "pipelines/case/host_keys.h"
#include "pipelines/case/table_files.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

std::optional<Eigen::Vector2d> read_offset(const Json& json) {
  if (!has(json, "offset")) return {};
  const std::vector<double> offset = numbers(json, "offset");
  if (offset.size() != 2) return {};  // said where the shape was checked
  return Eigen::Vector2d(offset[0], offset[1]);
}

// The direction of a hinge's axis.
std::optional<Eigen::Vector3d> read_axis(const Json& json, const std::string& path, const char* with,
                                         Findings& findings) {
  if (!has(json, "axis")) return {};
  if (text(json, "type") != with)
    findings.error(child(path, "axis"), "is that of a hinge, for the type " + in_quotes(with) + " only");
  const Eigen::Vector3d axis = vector(json, "axis");
  if (axis.norm() == 0) findings.error(child(path, "axis"), "is [0, 0, 0]; give the direction of the hinge");
  return axis;
}

CaseLoad read_load(const Json& json, const std::string& path) {
  CaseLoad load;
  load.path = path;
  load.beam = text(json, "beam");
  load.at = read_place(json);
  load.follower = flag(json, "follower");
  load.moving_speed = optional_number(part(json, "moves"), "speed");
  load.time = time_table(json, "time");
  for (const auto& [key, kind] : {std::pair{"force", CaseLoad::Kind::force},
                                  {"moment", CaseLoad::Kind::moment},
                                  {"force_per_length", CaseLoad::Kind::force_per_length}}) {
    if (has(json, key)) {
      load.kind = kind;
      load.value = vector(json, key);
    }
  }
  load.offset = read_offset(json);
  if (has(json, "torque_per_length")) {
    load.kind = CaseLoad::Kind::torque_per_length;
    load.torque = number(json, "torque_per_length", 0);
  }
  return load;
}

// Where a guided support is free.
std::optional<Eigen::Vector3d> read_guide(const Json& json, const std::string& path, Findings& findings) {
  const bool guided = text(json, "type") == "guided";
  if (guided && !json.contains("direction"))
    findings.error(path, "\"guided\" needs the \"direction\" along which the support is free");
  if (!has(json, "direction")) return {};
  if (!guided) findings.error(child(path, "direction"), "is for the type \"guided\" only");
  const Eigen::Vector3d direction = vector(json, "direction");
  if (direction.norm() == 0)
    findings.error(child(path, "direction"),
                   "is [0, 0, 0]; give the direction along which the support is free");
  return direction;
}

CaseSupport read_support(const Json& json, const std::string& path, Findings& findings) {
  return {.type = chosen<CaseSupport::Type>(json, "type",
                                            {{"clamped", CaseSupport::Type::clamped},
                                             {"pinned", CaseSupport::Type::pinned},
                                             {"fork", CaseSupport::Type::fork},
                                             {"guided", CaseSupport::Type::guided}}),
          .name = text(json, "name"),
          .path = path,
          .beam = text(json, "beam"),
          .at = read_place(json),
          .motion = vector_table(json, "motion"),
          .axis = read_axis(json, path, "pinned", findings),
          .direction = read_guide(json, path, findings),
          .force = number(json, "force", 0),
          .mass = number(json, "mass", 0),
          .motion_law = optional_integer(json, "motion_law")};
}

std::optional<Friction> read_friction(const Json& joint, const std::string& path, Findings& findings) {
  if (!has(joint, "friction")) return {};
  const Json& json = joint["friction"];
  const std::string where = child(path, "friction");
  Friction friction{.coefficient = number(json, "coefficient", 0),
                    .static_coefficient = optional_number(json, "static"),
                    .law = text(json, "law") == "capstan" ? Friction::Law::capstan : Friction::Law::coulomb,
                    .viscous = number(json, "viscous", 0),
                    .stick_stiffness = optional_number(json, "stick_stiffness")};
  if (has(json, "force"))
    friction.force =
        json["force"].is_array() ? time_table(json, "force") : TimeTable{{0, number(json, "force")}};
  if (friction.static_coefficient && *friction.static_coefficient < friction.coefficient)
    findings.error(child(where, "static"),
                   "is " + text_of(*friction.static_coefficient) + ", less than \"coefficient\", " +
                       text_of(friction.coefficient) + "; a body that sticks is held at least as well");
  const auto is_given = [&](const char* key) { return json.contains(key); };  // be it wrong
  if (!is_given("coefficient") && !is_given("static") && !is_given("force") && !is_given("viscous"))
    findings.error(where, "resists nothing; give \"coefficient\", \"static\", \"force\" or \"viscous\"");
  if (friction.law == Friction::Law::capstan && text(joint, "slope") != "discontinuous")
    findings.error(child(where, "law"),
                   "is \"capstan\", for the kink of a discontinuous slope, but the slope is continuous: "
                   "\"slope\": \"discontinuous\", or leave it out");
  return friction;
}

CaseSlidingJoint read_sliding_joint(const Json& json, const std::string& path, Findings& findings) {
  const Json& motion = part(json, "motion");
  return {.path = path,
          .body = text(json, "body"),
          .beam = text(json, "beam"),
          .at = read_place(json),
          .speed = optional_number(json, "speed"),
          .motion_speed = optional_number(motion, "speed"),
          .motion_table = time_table(motion, "table"),
          .release = optional_number(json, "release"),
          .continuous_slope = text(json, "slope") != "discontinuous",
          .leave_at_end = text(json, "at_beam_end") != "stop",
          .follows_section = flag(json, "follows_section"),
          .offset = read_offset(json),
          .rest = chosen<StaticPlace>(
              json, "equilibrium",
              {{"", StaticPlace::automatic}, {"held", StaticPlace::held}, {"free", StaticPlace::free}}),
          .friction = read_friction(json, path, findings),
          .motion_law = optional_integer(json, "motion_law"),
          .as_point = text(json, "carried_as") == "point"};
}

CaseEyelet read_eyelet(const Json& json, const std::string& path, Findings&) {
  CaseEyelet eyelet{.path = path,
                    .name = text(json, "name"),
                    .beam = text(json, "beam"),
                    .at = read_place(json),
                    .continuous_slope = text(json, "slope") == "continuous",
                    .rest = text(json, "equilibrium") == "held" ? StaticPlace::held : StaticPlace::free,
                    .leave_at_end = text(json, "at_beam_end") != "stop"};
  if (has(json, "position")) eyelet.position = vector(json, "position");
  return eyelet;
}

CaseStop read_stop(const Json& json, const std::string& path, Findings& findings) {
  CaseStop stop{.path = path,
                .beam = text(json, "beam"),
                .at = has(json, "at") ? std::optional(read_place(json)) : std::nullopt,
                .bodies = {},
                .side = chosen<CaseStop::Side>(json, "side",
                                               {{"both", CaseStop::Side::both},
                                                {"before", CaseStop::Side::before},
                                                {"after", CaseStop::Side::after}}),
                .restitution = number(json, "restitution", 0),
                .gap = number(json, "gap", 0)};
  for (const Json& name : part(json, "bodies"))
    if (!name.is_null()) stop.bodies.push_back(name.get<std::string>());
  if (has(json, "stiffness")) stop.buffer = Buffer{number(json, "stiffness"), number(json, "damping", 0)};
  if (!stop.at && stop.bodies.size() != 2)
    findings.error(path, "stands nowhere: give \"at\", or the two \"bodies\" that it keeps apart");
  return stop;
}

CaseBeamJoint read_beam_joint(const Json& json, const std::string& path, Findings& findings) {
  CaseBeamJoint joint{.name = text(json, "name"),
                      .path = path,
                      .beams = {},
                      .rigid = text(json, "type") == "rigid",
                      .near = {},
                      .axis = read_axis(json, path, "hinged", findings)};
  for (const Json& name : part(json, "beams"))
    if (!name.is_null()) joint.beams.push_back(name.get<std::string>());
  if (has(part(json, "at"), "near")) joint.near = vector(json["at"], "near");
  return joint;
}

CaseOutput read_output(const Json& json, const CaseAnalysis& analysis) {
  CaseOutput output;
  constexpr int default_frames = 100;
  if (analysis.type == CaseAnalysis::Type::dynamic)
    output.every =
        number(json, "every", std::max(analysis.end_time / default_frames, analysis.step.value_or(0)));
  if (has(json, "cad")) {
    const Json& cad = json["cad"];
    output.cad_formats = {"step"};
    output.cad_times = {analysis.end_time};
    output.cad_unit = text(cad, "unit", output.cad_unit);
    output.cad_schema =
        chosen<StepSchema>(cad, "schema", {{"ap214", StepSchema::ap214}, {"ap242", StepSchema::ap242}});
    output.cad_parameter = chosen<CurveParameter>(
        cad, "parameter", {{"free", CurveParameter::free}, {"material", CurveParameter::material}});
    if (has(cad, "formats")) {
      output.cad_formats.clear();
      for_each_item(cad, "formats", "", [&](const Json& format, const std::string&) {
        output.cad_formats.push_back(format.get<std::string>());
      });
    }
    if (has(cad, "times") && cad["times"].is_string()) {
      output.cad_at_all_times = true;
      output.cad_times.clear();
    } else if (has(cad, "times")) {
      output.cad_times = numbers(cad, "times");
    }
  }
  for_each_item(json, "probes", "output", [&](const Json& probe, const std::string& path) {
    output.probes.push_back(
        {.name = text(probe, "name"), .beam = text(probe, "beam"), .path = path, .at = read_place(probe)});
  });
  output.paraview = flag(json, "paraview");
  output.report = !has(json, "report") || flag(json, "report");
  return output;
}

CaseFile read_case(const Json& json, const std::filesystem::path& file, Findings& findings) {
  CaseFile result;
  result.path = file;
  result.name = text(json, "name", file.stem().string());
  result.gravity = vector(json, "gravity", result.gravity);
  result.air = {number(part(json, "air"), "density", 0),
                vector(part(json, "air"), "wind", Eigen::Vector3d::Zero())};
  const std::filesystem::path directory = std::filesystem::absolute(file).parent_path();
  for_each_item(json, "beams", "", [&](const Json& beam, const std::string& path) {
    result.beams.push_back(read_beam(beam, path, directory, findings));
  });
  for_each_item(
      json, "bodies", "",
      [&](const Json& body, const std::string& path) {
        if (has(body, "drag_area") && !has(json, "air"))
          findings.error(child(path, "drag_area"),
                         "needs the \"air\" that drags; at sea level it has a \"density\" of 1.225");
        result.bodies.push_back({.name = text(body, "name"),
                                 .mass = number(body, "mass"),
                                 .roll_inertia = number(body, "roll_inertia", 0),
                                 .drag_area = number(body, "drag_area", 0),
                                 .path = path,
                                 .velocity = vector(body, "velocity", Eigen::Vector3d::Zero())});
        if (has(body, "position")) result.bodies.back().position = vector(body, "position");
      });
  for_each_item(
      json, "loads", "",
      [&](const Json& load, const std::string& path) { result.loads.push_back(read_load(load, path)); });
  const auto read_all = [&](const char* key, auto& list, auto read) {
    for_each_item(json, key, "", [&](const Json& item, const std::string& path) {
      list.push_back(read(item, path, findings));
    });
  };
  read_all("supports", result.supports, read_support);
  read_all("sliding_joints", result.sliding_joints, read_sliding_joint);
  read_all("eyelets", result.eyelets, read_eyelet);
  read_all("stops", result.stops, read_stop);
  read_all("joints", result.joints, read_beam_joint);
  read_all("connectors", result.connectors, read_connector);
  result.laws = read_laws(json);
  result.analysis = read_analysis(part(json, "analysis"), findings);
  if (result.analysis.type == CaseAnalysis::Type::statics) {
    result.analysis.reads_tables = has_tables(result);
    const std::vector<double> factors = result.analysis.factors();
    if (!factors.empty()) result.analysis.end_time = factors.back();
  }
  result.output = read_output(part(json, "output"), result.analysis);
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
