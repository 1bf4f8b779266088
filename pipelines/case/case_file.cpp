#include "pipelines/case/case_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "cad_import/files/cad_format.h"
#include "nurbs/number_text.h"
#include "pipelines/case/case_json.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

using Kind = Shape::Kind;

// ---- checked JSON to the structs ----

/// Whether a usable value stands under the key.
bool has(const Json& object, const char* key) { return object.contains(key) && !object[key].is_null(); }

double number(const Json& object, const char* key,
              double otherwise = std::numeric_limits<double>::quiet_NaN()) {
  return has(object, key) ? object[key].get<double>() : otherwise;
}
std::optional<double> optional_number(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<double>()) : std::nullopt;
}
std::optional<int> optional_integer(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<int>()) : std::nullopt;
}
std::string text(const Json& object, const char* key, const std::string& otherwise = {}) {
  return has(object, key) ? object[key].get<std::string>() : otherwise;
}
std::optional<std::string> optional_text(const Json& object, const char* key) {
  return has(object, key) ? std::optional(object[key].get<std::string>()) : std::nullopt;
}
bool flag(const Json& object, const char* key) { return has(object, key) && object[key].get<bool>(); }

const Json& part(const Json& object, const char* key) {
  static const Json none = Json::object();
  return has(object, key) ? object[key] : none;
}

Eigen::Vector3d to_vector(const Json& value) {
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}
Eigen::Vector3d vector(
    const Json& object, const char* key,
    const Eigen::Vector3d& otherwise = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN())) {
  return has(object, key) ? to_vector(object[key]) : otherwise;
}

std::vector<Eigen::Vector3d> points(const Json& object, const char* key) {
  std::vector<Eigen::Vector3d> points;
  for (const Json& item : part(object, key)) {
    if (!item.is_null()) {
      points.push_back(to_vector(item));
    }
  }
  return points;
}

std::vector<double> numbers(const Json& object, const char* key) {
  std::vector<double> numbers;
  for (const Json& item : part(object, key)) {
    if (!item.is_null()) {
      numbers.push_back(item.get<double>());
    }
  }
  return numbers;
}

TimeTable time_table(const Json& object, const char* key) {
  TimeTable table;
  for (const Json& row : part(object, key)) {
    table.emplace_back(row[0].get<double>(), row[1].get<double>());
  }
  return table;
}

/// The enumerator whose text stands under the key; the first one if there is none.
template <class Enum>
Enum chosen(const Json& object, const char* key, const std::vector<std::pair<const char*, Enum>>& values) {
  for (const auto& [name, value] : values) {
    if (text(object, key) == name) {
      return value;
    }
  }
  return values.front().second;
}

Place read_place(const Json& object) {
  Place place;
  const Json& at = part(object, "at");
  if (at.is_string()) {
    place.kind = at == "end" ? Place::Kind::end : Place::Kind::start;
  } else if (has(at, "length")) {
    place = {.kind = Place::Kind::length, .value = number(at, "length")};
  } else if (has(at, "fraction")) {
    place = {.kind = Place::Kind::fraction, .value = number(at, "fraction")};
  } else if (has(at, "near")) {
    place = {.kind = Place::Kind::near, .point = vector(at, "near"), .within = optional_number(at, "within")};
  }
  return place;
}

/// Calls read(item, path) for every usable item of an array.
template <class Read>
void for_each_item(const Json& object, const char* key, const std::string& path, Read read) {
  std::size_t index = 0;
  for (const Json& item : part(object, key)) {
    const std::string item_path = child(child(path, key), index++);
    if (!item.is_null()) {
      read(item, item_path);
    }
  }
}

std::vector<std::string> cad_files_in(const std::filesystem::path& directory) {
  static const std::set<std::string> extensions = {".step", ".stp", ".iges", ".igs",
                                                   ".STEP", ".STP", ".IGES", ".IGS"};
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(directory, ignored)) {
    if (extensions.contains(entry.path().extension().string())) {
      names.push_back(entry.path().filename().string());
    }
  }
  return names;
}

/// Reports a CAD file that is not there.
void check_cad_file(const std::filesystem::path& file, const std::string& path, Findings& findings) {
  std::error_code ignored;
  const std::filesystem::file_status status = std::filesystem::status(file, ignored);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
    const bool is_directory = std::filesystem::is_directory(status);
    findings.error(path, in_quotes(file.string()) + " is a " +
                             (is_directory ? "directory" : "device or pipe") +
                             "; expected a STEP or IGES file" +
                             (is_directory ? known_names("", cad_files_in(file)) : ""));
  } else if (!std::filesystem::exists(status)) {
    findings.error(path, "there is no file " + in_quotes(file.string()) +
                             known_names(file.filename().string(), cad_files_in(file.parent_path())));
  }
}

CaseAxis::File read_axis_file(const Json& axis, const std::filesystem::path& directory,
                              const std::string& path, Findings& findings) {
  CaseAxis::File file;
  file.path = (directory / text(axis, "file")).lexically_normal();
  file.chain = flag(axis, "chain");
  file.layer = optional_text(axis, "layer");
  file.colour = optional_text(axis, "colour");
  if (has(axis, "near")) file.near = vector(axis, "near");
  file.longest = flag(axis, "longest");
  file.all_chains = text(axis, "chains") == "all";
  file.gap = optional_number(axis, "gap");
  if (has(axis, "curve")) {
    const Json& curve = axis["curve"];
    if (curve.is_string()) {
      file.curve_name = curve.get<std::string>();
    } else {
      file.curve_index = curve.get<int>();
    }
  }
  check_cad_file(file.path, child(path, "file"), findings);
  return file;
}

std::optional<NurbsCurve> read_nurbs(const Json& nurbs, const std::string& path, Findings& findings) {
  const std::vector<Eigen::Vector3d> points_in = points(nurbs, "control_points");
  const std::vector<double> knots = numbers(nurbs, "knots");
  std::vector<double> weights = numbers(nurbs, "weights");
  const bool complete = has(nurbs, "degree") && points_in.size() == part(nurbs, "control_points").size() &&
                        knots.size() == part(nurbs, "knots").size() &&
                        weights.size() == part(nurbs, "weights").size();
  if (!complete || knots.empty() || points_in.empty()) {
    return {};  // what is missing has been reported
  }
  if (!has(nurbs, "weights")) {
    weights.assign(points_in.size(), 1.0);
  }
  if (weights.size() != points_in.size()) {
    findings.error(path, "has " + std::to_string(weights.size()) + " weights for " +
                             std::to_string(points_in.size()) +
                             " control points; give one per control point");
    return {};
  }
  Eigen::Matrix3Xd control_points(3, points_in.size());
  for (std::size_t i = 0; i < points_in.size(); ++i) {
    control_points.col(i) = points_in[i];
  }
  try {
    return make_nurbs_curve(KnotVector(nurbs["degree"].get<int>(), knots), control_points,
                            Eigen::Map<const Eigen::VectorXd>(weights.data(), weights.size()));
  } catch (const std::invalid_argument& error) {
    findings.error(path, error.what());
    return {};
  }
}

CaseAxis::Polyline read_polyline(const Json& axis, const std::string& path, Findings& findings) {
  const CaseAxis::Polyline polyline = points(axis, "polyline");
  for (std::size_t i = 1; i < polyline.size(); ++i) {
    if (polyline[i] == polyline[i - 1]) {
      findings.error(child(child(path, "polyline"), i), "is the same point as the one before; remove one");
    }
  }
  return polyline;
}

CaseAxis::Arc read_arc(const Json& axis, const std::string& axis_path, Findings& findings) {
  const Json& json = part(axis, "arc");
  const std::string path = child(axis_path, "arc");
  const CaseAxis::Arc arc = {vector(json, "center"), vector(json, "start"), vector(json, "end"),
                             vector(json, "normal")};
  const Eigen::Vector3d a = arc.start - arc.center, b = arc.end - arc.center;
  constexpr double relative = 1e-6;
  // Comparisons with a missing (NaN) point are false: it has been reported.
  if (arc.normal.norm() == 0) {
    findings.error(child(path, "normal"), "is [0, 0, 0]; must have a direction");
  } else if (a.norm() == 0) {
    findings.error(child(path, "start"), "is the center; must be apart from it");
  } else if (std::abs(a.norm() - b.norm()) > relative * a.norm()) {
    findings.error(path, "start is " + text_of(a.norm(), all_digits) + " m and end " +
                             text_of(b.norm(), all_digits) + " m from the center; must be the same distance");
  } else if (std::max(std::abs(a.dot(arc.normal)), std::abs(b.dot(arc.normal))) >
             relative * a.norm() * arc.normal.norm()) {
    findings.error(child(path, "normal"), "is not perpendicular to the plane of center, start and end");
  } else if ((a - b).norm() <= relative * a.norm()) {
    findings.error(path, "start and end are the same point; a full circle can be given as \"nurbs\"");
  }
  return arc;
}

CaseAxis read_axis(const Json& axis, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  if (has(axis, "file")) {
    return {read_axis_file(axis, directory, path, findings)};
  }
  if (has(axis, "nurbs")) {
    const auto curve = read_nurbs(axis["nurbs"], child(path, "nurbs"), findings);
    return curve ? CaseAxis{*curve} : CaseAxis{};
  }
  if (has(axis, "polyline")) {
    return {read_polyline(axis, path, findings)};
  }
  if (has(axis, "arc")) {
    return {read_arc(axis, path, findings)};
  }
  return {};
}

CaseSection read_section(const Json& section, const std::filesystem::path& directory, const std::string& path,
                         Findings& findings) {
  if (has(section, "profile")) {
    const Json& profile = section["profile"];
    CaseSection drawn = {.profile = CaseProfile{(directory / text(profile, "file")).lexically_normal(),
                                                text(profile, "in_plane") == "x"}};
    if (has(profile, "file")) {
      check_cad_file(drawn.profile->path, child(path, "profile.file"), findings);
    }
    return drawn;
  }
  if (has(section, "radius")) {
    const double r = number(section, "radius");
    return {.area = std::numbers::pi * r * r,
            .second_moment = std::numbers::pi * std::pow(r, 4) / 4,
            .radius = r};
  }
  if (has(section, "from")) return {.from_cad = true};
  return {.area = number(section, "area"), .second_moment = number(section, "second_moment")};
}

CaseBeam read_beam(const Json& json, const std::string& path, const std::filesystem::path& directory,
                   Findings& findings) {
  CaseBeam beam;
  beam.path = path;
  beam.name = text(json, "name");
  beam.axis = read_axis(part(json, "axis"), child(path, "axis"), directory, findings);
  beam.section = read_section(part(json, "section"), directory, child(path, "section"), findings);
  const Json& material = part(json, "material");
  beam.material = {.density = number(material, "density"),
                   .youngs_modulus = number(material, "youngs_modulus"),
                   .damping = number(material, "damping", 0)};
  const Json& elements = part(json, "elements");
  beam.elements = {.count = optional_integer(elements, "count"),
                   .max_length = optional_number(elements, "max_length"),
                   .per_segment = optional_integer(elements, "per_segment"),
                   .grading = number(elements, "grading", 0)};
  beam.approximation_tolerance = number(json, "approximation_tolerance", beam.approximation_tolerance);
  beam.ring = flag(json, "closed");
  beam.corners = chosen<Corners>(json, "corners",
                                 {{"error", Corners::error},
                                  {"smooth", Corners::smooth},
                                  {"rigid", Corners::rigid},
                                  {"hinge", Corners::hinge}});
  const double default_degrees = beam.corners == Corners::smooth ? 5 : 0;
  beam.smooth_angle = number(json, "smooth_up_to", default_degrees) * std::numbers::pi / 180;
  beam.element = chosen<ElementKind>(
      json, "element", {{"ale-rancf", ElementKind::ale_rancf}, {"ale-ancf", ElementKind::ale_ancf}});
  beam.weights = chosen<WeightRule>(json, "weights",
                                    {{"material", WeightRule::material}, {"constant", WeightRule::constant}});
  beam.merge = chosen<MergeRule>(
      json, "merge",
      {{"default", MergeRule::standard}, {"paper", MergeRule::paper}, {"ones", MergeRule::ones}});
  beam.stress_free = chosen<StressFree>(json, "stress_free",
                                        {{"", StressFree::automatic},
                                         {"as-drawn", StressFree::as_drawn},
                                         {"straight", StressFree::straight},
                                         {"as-drawn-without-torsion", StressFree::as_drawn_without_torsion}});
  beam.curvature = chosen<CurvatureMeasure>(
      json, "curvature", {{"material", CurvatureMeasure::material}, {"spatial", CurvatureMeasure::spatial}});
  beam.metric = chosen<Metric>(json, "metric", {{"reference", Metric::arc_length}, {"none", Metric::label}});
  beam.form =
      chosen<Form>(json, "form", {{"variational", Form::variational}, {"virtual-work", Form::virtual_work}});
  return beam;
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
  return load;
}

CaseSupport read_support(const Json& json, const std::string& path) {
  return {.type = chosen<CaseSupport::Type>(
              json, "type", {{"clamped", CaseSupport::Type::clamped}, {"pinned", CaseSupport::Type::pinned}}),
          .path = path,
          .beam = text(json, "beam"),
          .at = read_place(json)};
}

CaseSlidingJoint read_sliding_joint(const Json& json, const std::string& path) {
  const Json& motion = part(json, "motion");
  return {.path = path,
          .body = text(json, "body"),
          .beam = text(json, "beam"),
          .at = read_place(json),
          .speed = number(json, "speed", 0),
          .motion_speed = optional_number(motion, "speed"),
          .motion_table = time_table(motion, "table"),
          .continuous_slope = text(json, "slope") != "discontinuous",
          .leave_at_end = text(json, "at_beam_end") != "stop"};
}

CaseBeamJoint read_beam_joint(const Json& json, const std::string& path) {
  CaseBeamJoint joint{.path = path, .beams = {}, .rigid = text(json, "type") == "rigid", .near = {}};
  for (const Json& name : part(json, "beams"))
    if (!name.is_null()) joint.beams.push_back(name.get<std::string>());
  if (has(part(json, "at"), "near")) joint.near = vector(json["at"], "near");
  return joint;
}

CaseAnalysis read_analysis(const Json& json, Findings& findings) {
  CaseAnalysis analysis;
  analysis.type = chosen<CaseAnalysis::Type>(
      json, "type", {{"dynamic", CaseAnalysis::Type::dynamic}, {"static", CaseAnalysis::Type::statics}});
  analysis.start_from_equilibrium = text(json, "initial") == "equilibrium";
  using Method = CaseAnalysis::Method;
  const Json& integrator = part(json, "integrator");
  analysis.method = chosen<Method>(
      integrator, "type",
      {{"generalized-alpha", Method::generalized_alpha}, {"ida", Method::ida}, {"rk4", Method::rk4}});
  analysis.rho_infinity = number(integrator, "rho_infinity", analysis.rho_infinity);
  if (analysis.method != Method::generalized_alpha && has(integrator, "rho_infinity"))
    findings.add(Severity::warning, "analysis.integrator.rho_infinity",
                 "has an effect with \"generalized-alpha\" only");
  const Json& control = part(json, "length_control");
  analysis.length_control_min = number(control, "min", analysis.length_control_min);
  analysis.length_control_max = number(control, "max", analysis.length_control_max);
  if (analysis.type == CaseAnalysis::Type::statics) {
    for (const char* key : {"end_time", "step", "tolerance", "initial"}) {
      if (has(json, key)) {
        findings.add(Severity::warning, child("analysis", key), "has no effect in a static analysis");
      }
    }
    return analysis;
  }
  const double default_tolerance = analysis.method == Method::ida ? 1e-8 : 1e-4;
  analysis.end_time = number(json, "end_time", 0);
  analysis.step = optional_number(json, "step");
  analysis.tolerance = optional_number(json, "tolerance");
  if (!analysis.step && !analysis.tolerance) {
    analysis.tolerance = default_tolerance;
  }
  if (analysis.method == Method::rk4 && !analysis.step)
    findings.error("analysis.step", "is missing; the explicit method \"rk4\" needs a fixed step");
  return analysis;
}

CaseOutput read_output(const Json& json, const CaseAnalysis& analysis) {
  CaseOutput output;
  output.every = optional_number(json, "every");
  constexpr int default_frames = 100;
  if (!output.every && analysis.type == CaseAnalysis::Type::dynamic) {
    output.every = analysis.end_time / default_frames;
  }
  if (has(json, "cad")) {
    const Json& cad = json["cad"];
    output.cad_formats = {"step"};
    output.cad_times = {analysis.end_time};
    output.cad_unit = text(cad, "unit", output.cad_unit);
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
  for_each_item(json, "probes", "output", [&](const Json& probe, const std::string&) {
    output.probes.push_back(
        {.name = text(probe, "name"), .beam = text(probe, "beam"), .at = read_place(probe)});
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
  const std::filesystem::path directory = std::filesystem::absolute(file).parent_path();
  for_each_item(json, "beams", "", [&](const Json& beam, const std::string& path) {
    result.beams.push_back(read_beam(beam, path, directory, findings));
  });
  for_each_item(json, "bodies", "", [&](const Json& body, const std::string&) {
    result.bodies.push_back({.name = text(body, "name"), .mass = number(body, "mass")});
  });
  for_each_item(json, "loads", "", [&](const Json& load, const std::string& path) {
    result.loads.push_back(read_load(load, path));
  });
  for_each_item(json, "supports", "", [&](const Json& support, const std::string& path) {
    result.supports.push_back(read_support(support, path));
  });
  for_each_item(json, "sliding_joints", "", [&](const Json& joint, const std::string& path) {
    result.sliding_joints.push_back(read_sliding_joint(joint, path));
  });
  for_each_item(json, "joints", "", [&](const Json& joint, const std::string& path) {
    result.joints.push_back(read_beam_joint(joint, path));
  });
  result.analysis = read_analysis(part(json, "analysis"), findings);
  result.output = read_output(part(json, "output"), result.analysis);
  return result;
}

// ---- checks across the file ----

/// Reports names that occur twice. An empty name has been reported.
void check_unique(const std::vector<std::pair<std::string, std::string>>& names_and_paths,
                  Findings& findings) {
  std::map<std::string, std::string> first;
  for (const auto& [name, path] : names_and_paths) {
    const auto [other, is_new] = first.emplace(name, path);
    if (!is_new && !name.empty()) {
      findings.error(path,
                     in_quotes(name) + " is already the name of " + other->second + "; names must differ");
    }
  }
}

void check_names(const Json& json, Findings& findings) {
  const auto collect = [](const Json& holder, const char* key, const std::string& path) {
    std::vector<std::pair<std::string, std::string>> names;
    for_each_item(holder, key, path, [&](const Json& item, const std::string& item_path) {
      names.emplace_back(text(item, "name"), child(item_path, "name"));
    });
    return names;
  };
  check_unique(collect(json, "beams", ""), findings);
  auto columns = collect(json, "bodies", "");  // bodies and probes head columns of the same table
  const auto probes = collect(part(json, "output"), "probes", "output");
  columns.insert(columns.end(), probes.begin(), probes.end());
  check_unique(columns, findings);
}

/// The names of the items under the key; nothing when one of them is unusable.
std::optional<std::vector<std::string>> names_under(const Json& json, const char* key) {
  std::vector<std::string> names;
  if (json.contains(key) && json[key].is_null()) {
    return {};
  }
  for (const Json& item : part(json, key)) {
    names.push_back(item.is_null() ? "" : text(item, "name"));
    if (names.back().empty()) {
      return {};
    }
  }
  return names;
}

bool is_one_of(const std::string& name, const std::vector<std::string>& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Whether it is "net 3", where the beam "net" takes every chain of its file: how many there are, the file
/// will tell.
bool is_beam_of_chain(const std::string& name, const Json& json) {
  const std::size_t space = name.rfind(' ');
  if (space == std::string::npos || name.find_first_not_of("0123456789", space + 1) != std::string::npos)
    return false;
  bool found = false;
  for_each_item(json, "beams", "", [&](const Json& beam, const std::string&) {
    found = found || (text(beam, "name") == name.substr(0, space) && has(part(beam, "axis"), "chains"));
  });
  return found;
}

/// Reports, for every item under the key, a name under `reference` that is not among the known ones.
void check_references(const Json& json, const Json& holder, const char* key, const std::string& path,
                      const char* reference, const std::vector<std::string>& known, Findings& findings) {
  for_each_item(holder, key, path, [&](const Json& item, const std::string& item_path) {
    const std::string name = text(item, reference);
    if (!name.empty() && !is_one_of(name, known) && !is_beam_of_chain(name, json)) {
      findings.error(child(item_path, reference), "there is no " + std::string(reference) + " " +
                                                      in_quotes(name) + known_names(name, known));
    }
  });
}

void check_references(const Json& json, Findings& findings) {
  if (const auto beams = names_under(json, "beams")) {
    check_references(json, json, "loads", "", "beam", *beams, findings);
    check_references(json, json, "supports", "", "beam", *beams, findings);
    check_references(json, json, "sliding_joints", "", "beam", *beams, findings);
    check_references(json, part(json, "output"), "probes", "output", "beam", *beams, findings);
    for_each_item(json, "joints", "", [&](const Json& joint, const std::string& path) {
      for_each_item(joint, "beams", path, [&](const Json& name, const std::string& name_path) {
        if (!is_one_of(name, *beams) && !is_beam_of_chain(name, json))
          findings.error(name_path, "there is no beam " + in_quotes(name.get<std::string>()) +
                                        known_names(name.get<std::string>(), *beams));
      });
    });
  }
  if (const auto bodies = names_under(json, "bodies")) {
    check_references(json, json, "sliding_joints", "", "body", *bodies, findings);
  }
}

/// Every body is held by exactly one sliding joint.
void check_bodies(const Json& json, const CaseFile& c, Findings& findings) {
  std::map<std::string, std::vector<std::string>> holders;  // paths of the joints of each body
  for (const CaseSlidingJoint& joint : c.sliding_joints) {
    holders[joint.body].push_back(joint.path);
  }
  const std::vector<std::string> bodies = names_under(json, "bodies").value_or(std::vector<std::string>{});
  const bool all_known = std::all_of(holders.begin(), holders.end(),
                                     [&](const auto& holder) { return is_one_of(holder.first, bodies); });
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::vector<std::string>& joints = holders[bodies[i]];
    if (joints.empty() && all_known) {
      findings.error(child("bodies", i),
                     "no sliding joint holds the body " + in_quotes(bodies[i]) +
                         ", so it has no place; add one to \"sliding_joints\" or remove it");
    } else if (joints.size() > 1) {
      findings.error(joints[1], "the body " + in_quotes(bodies[i]) + " is already held by " + joints[0] +
                                    "; a body slides on one beam");
    }
  }
}

/// Reports a division of the end time into more parts than `most`.
void check_division(const char* path, const char* parts, const std::optional<double>& part,
                    const CaseAnalysis& analysis, double most, Findings& findings) {
  if (part && analysis.end_time / *part > most * (1 + 1e-9)) {
    findings.error(path, "is " + text_of(*part, all_digits) +
                             " s: " + text_of(std::ceil(analysis.end_time / *part), all_digits) + " " +
                             parts + " until analysis.end_time, " + text_of(analysis.end_time, all_digits) +
                             " s, and the limit is " + text_of(most, all_digits) + "; give at least " +
                             text_of(analysis.end_time / most, all_digits) + " s");
  }
}

void check_times(const Json& json, const CaseFile& c, Findings& findings) {
  const bool dynamic = c.analysis.type == CaseAnalysis::Type::dynamic;
  if (dynamic && has(json, "analysis") && !json["analysis"].contains("end_time")) {
    findings.error("analysis",
                   "\"end_time\" is missing; a dynamic analysis needs it (or \"type\": \"static\")");
    return;
  }
  check_division("output.every", "stored frames", c.output.every, c.analysis, most_frames, findings);
  check_division("analysis.step", "steps", c.analysis.step, c.analysis, most_steps, findings);
  for (std::size_t i = 0; dynamic && i < c.output.cad_times.size(); ++i) {
    if (c.output.cad_times[i] > c.analysis.end_time) {
      findings.error(child("output.cad.times", i), "is " + text_of(c.output.cad_times[i], all_digits) +
                                                       " s; must not be after analysis.end_time, " +
                                                       text_of(c.analysis.end_time, all_digits) + " s");
    }
  }
}

void check_solids(const CaseFile& c, Findings& findings) {
  const std::vector<std::string>& formats = c.output.cad_formats;
  const auto solid = std::find(formats.begin(), formats.end(), "step-solid");
  if (solid == formats.end()) return;
  for (const CaseBeam& beam : c.beams)
    if (!beam.section.radius && !beam.section.from_cad)
      findings.error(child("output.cad.formats", solid - formats.begin()),
                     "is \"step-solid\", but the section of the beam " + in_quotes(beam.name) +
                         " has no radius; give it one, or use \"step\" for the curve");
}

bool is_step_file(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string head(1000, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return format_of(head) == CadFormat::step;
}

void check_source(const CaseFile& c, Findings& findings) {
  const std::vector<std::string>& formats = c.output.cad_formats;
  const auto source = std::find(formats.begin(), formats.end(), "step-source");
  if (source == formats.end()) return;
  const auto* const first = std::get_if<AxisFile>(&c.beams.front().axis.source);
  for (const CaseBeam& beam : c.beams) {
    const auto* const axis = std::get_if<AxisFile>(&beam.axis.source);
    if (first && axis && axis->path == first->path && is_step_file(axis->path)) continue;
    findings.error(child("output.cad.formats", source - formats.begin()),
                   "is \"step-source\", but the axis of the beam " + in_quotes(beam.name) + " is not from " +
                       (first && axis && axis != first ? "the same" : "a") +
                       " STEP file; use \"step\" for the curve alone");
    return;
  }
}

}  // namespace

CaseFileReport read_case_file(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  Findings findings(file.string());
  auto json = read_json(file, findings);
  if (!json) {
    return {{}, findings.take()};
  }
  std::vector<Diagnostic> diagnostics;
  apply_overrides(*json, overrides, diagnostics);
  std::optional<CaseFile> value;
  if (check_shape(case_shape(), *json, findings)) {
    value = read_case(*json, file, findings);
    value->json = json->dump(-1, ' ', false, Json::error_handler_t::replace);
    check_names(*json, findings);
    check_references(*json, findings);
    check_bodies(*json, *value, findings);
    check_times(*json, *value, findings);
    check_solids(*value, findings);
    check_source(*value, findings);
  }
  if (findings.has_errors() || !diagnostics.empty()) {
    value.reset();
  }
  const std::vector<Diagnostic> found = findings.take();
  diagnostics.insert(diagnostics.end(), found.begin(), found.end());
  return {std::move(value), std::move(diagnostics)};
}

}  // namespace nurbeam
