#include "pipelines/route/route_file.h"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "cad_import/import_curves.h"
#include "nurbs/number_text.h"
#include "pipelines/case/case_check.h"
#include "pipelines/case/shapes.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/axis_selection.h"

namespace nurbeam {

namespace {

constexpr JsonFileKind route_file_kind{"file of cables", "nurbeam_route", "nurbeam route",
                                       R"("nurbeam_route": 1 and "cables")"};

// What a case takes there.
const Key& beam_key(const std::string& name) {
  return *find_key(find_key(case_keys(), "beams")->shape.items[0], name);
}

Shape end_shape() {
  using namespace shapes;
  return object(
      {{"point", point(), "where it is clamped"},
       {"direction", vector(Dimension::number), "the way in which it leaves that point", false, "point"},
       {"file", any_text(), "CAD file, relative to this one"},
       {"curve", either(any_text(), integer(from(1))),
        "name or index (from 1) of a curve as nurbeam inspect prints them", false, "file"},
       {"part", any_text(), "only curves of this part: its name, or the end of its path", false, "file"},
       {"at", choice({"start", "end", "centre"}), "place of the curve; end when omitted", false, "file"},
       {"flip", boolean(), "the other way", false}},
      {{{"point", "file"}, required}});
}

Shape cable_shape() {
  using namespace shapes;
  return object(
      {{"name", name(), "name of the curve", required},
       {"from", end_shape(), "one end", required},
       {"to", end_shape(), "the other end", required},
       {"length", quantity(Dimension::length, positive()), "unstressed length"},
       {"slack", quantity(Dimension::number, positive()), "length over the distance of the ends, less 1"},
       {"least_bend_radius", quantity(Dimension::length, positive()),
        "the shortest length that keeps it is taken"},
       {"section", beam_key("section").shape, "cross-section", required},
       {"material", beam_key("material").shape, "material", required}},
      {{{"length", "slack", "least_bend_radius"}, required}});
}

const Shape& route_keys() {
  using namespace shapes;
  static const Shape shape =
      object({{"nurbeam_route", integer({.lower = 1, .upper = 1}), "version of the format", required},
              {"gravity", vector(Dimension::acceleration), "[0, 0, -9.81] when omitted"},
              {"cables", array(cable_shape(), 1), "the cables", required}});
  return shape;
}

Eigen::Vector3d vector_of(const Json& json) {
  return {json[0].get<double>(), json[1].get<double>(), json[2].get<double>()};
}

// Reads every CAD file once.
class CadFiles {
 public:
  CadFiles(std::filesystem::path folder, Findings& findings)
      : folder_(std::move(folder)), findings_(findings) {}

  const ImportReport& of(const std::string& name) {
    const std::filesystem::path file = folder_ / name;
    const auto [found, is_new] = reports_.try_emplace(file);
    if (is_new) {
      found->second = import_curves(file);
      std::vector<Diagnostic> told = found->second.diagnostics;
      std::erase_if(told, [](const Diagnostic& each) { return each.severity == Severity::note; });
      findings_.append(told);
    }
    return found->second;
  }

 private:
  std::filesystem::path folder_;
  Findings& findings_;
  std::map<std::filesystem::path, ImportReport> reports_;
};

bool is_of_part(const ImportedCurve& curve, const std::string& part) {
  return curve.part == part || curve.part.ends_with("/" + part);
}

// The only curve of that name, or the one of that number.
const ImportedCurve& chosen_curve(const ImportReport& report, const Json& end) {
  std::vector<int> all, fitting;
  const int count = static_cast<int>(report.curves.size());
  const Json wanted = end.value("curve", Json());
  for (int i = 0; i < count; ++i) {
    if (end.contains("part") && !is_of_part(report.curves[i], end["part"])) continue;
    all.push_back(i);
    const bool is_named = wanted.is_string() && report.curves[i].name == wanted.get<std::string>();
    if (wanted.is_null() || is_named || (wanted.is_number() && wanted.get<int>() == i + 1))
      fitting.push_back(i);
  }
  if (fitting.size() == 1) return report.curves[fitting[0]];
  const std::string these = "; its curves (number and name): " + list_of_curves(report, all);
  const std::string what = wanted.is_null() ? "no curve is named" : "the curve " + wanted.dump() + " is";
  if (fitting.empty()) throw std::invalid_argument(what + (wanted.is_null() ? "" : " not there") + these);
  throw std::invalid_argument(
      (wanted.is_null() ? what : what + " there " + std::to_string(fitting.size()) + " times") +
      ", and one is needed; give its number" + these);
}

std::optional<RouteEnd> curve_end(const Json& json, const std::string& path, CadFiles& files,
                                  Findings& findings) {
  const ImportReport& report = files.of(json["file"]);
  if (!report.ok()) return {};
  try {
    return end_at(chosen_curve(report, json).curve, json.value("at", "end"));
  } catch (const std::invalid_argument& problem) {
    findings.error(child(path, "curve"), report.file + ": " + problem.what());
    return {};
  }
}

std::optional<RouteEnd> point_end(const Json& json, const std::string& path, Findings& findings) {
  if (!json.contains("direction")) {
    findings.error(path, "has a \"point\" and no \"direction\"; give the way in which the cable leaves it");
    return {};
  }
  const RouteEnd end{vector_of(json["point"]), vector_of(json["direction"])};
  if (end.outward.norm() > 0) return end;
  findings.error(child(path, "direction"), "is [0, 0, 0]; give the way in which the cable leaves the point");
  return {};
}

std::optional<RouteEnd> end_of(const Json& json, const std::string& path, CadFiles& files,
                               Findings& findings) {
  std::optional<RouteEnd> end =
      json.contains("file") ? curve_end(json, path, files, findings) : point_end(json, path, findings);
  if (end && json.value("flip", false)) end->outward = -end->outward;
  return end;
}

RouteGoal goal_of(const Json& json) {
  if (json.contains("length")) return {RouteGoal::Kind::length, json["length"].get<double>()};
  if (json.contains("slack")) return {RouteGoal::Kind::slack, json["slack"].get<double>()};
  return {RouteGoal::Kind::least_bend_radius, json["least_bend_radius"].get<double>()};
}

RouteFile cables_of(Json json, const std::filesystem::path& file, Findings& findings) {
  RouteFile read;
  const Json as_given = json;  // sections and materials are read again, as those of a case
  if (check_shape(route_keys(), json, findings) && !findings.has_errors()) {
    CadFiles files(file.parent_path(), findings);
    for (std::size_t i = 0; i < json["cables"].size(); ++i) {
      const Json& cable = json["cables"][i];
      const std::string path = child("cables", i);
      const auto from = end_of(cable["from"], child(path, "from"), files, findings);
      const auto to = end_of(cable["to"], child(path, "to"), files, findings);
      if (!from || !to) continue;
      read.cables.push_back({.name = cable["name"],
                             .where = findings.where(path),
                             .from = *from,
                             .to = *to,
                             .goal = goal_of(cable),
                             .section = as_given["cables"][i]["section"].dump(),
                             .material = as_given["cables"][i]["material"].dump()});
      if (json.contains("gravity")) read.cables.back().gravity = vector_of(json["gravity"]);
    }
  }
  if (findings.has_errors()) read.cables.clear();
  read.diagnostics = findings.take();
  return read;
}

}  // namespace

RouteFile read_route_file(const std::filesystem::path& file) {
  Findings findings(file.string());
  auto json = read_json(file, route_file_kind, findings);
  if (!json) return {{}, findings.take()};
  return cables_of(std::move(*json), file, findings);
}

RouteFile read_route_text(const std::string& text, const std::filesystem::path& file) {
  Findings findings(file.string());
  auto json = parse_json(text, findings);
  if (!json) return {{}, findings.take()};
  return cables_of(std::move(*json), file, findings);
}

}  // namespace nurbeam
