#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <functional>
#include <sstream>

#include "pipelines/case/case_check.h"
#include "pipelines/case/case_overrides.h"
#include "pipelines/case/case_schema.h"
#include "pipelines/case/host_keys.h"
#include "pipelines/case/quantity.h"
#include "pipelines/model/model_summary.h"
#include "pipelines/run/motion_mesh.h"
#include "python/bindings.h"
#include "python/built_case.h"
#include "python/interrupts.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

// (the case as JSON, findings).
std::pair<std::string, PlainFindings> case_json(const std::filesystem::path& file,
                                                const std::vector<std::string>& overrides) {
  const CaseTextReport report = case_text(file, overrides);
  return {report.json, plain(report.diagnostics)};
}

// What is wrong with the value at a place of a case and below it, by the place in the case: (findings).
PlainFindings wrong_at(const std::string& place, Json json) {
  Findings findings("case");
  check_part(host_keys(), json, findings);
  std::vector<Diagnostic> wrong;
  const std::string prefix = findings.where(place);
  for (Diagnostic& each : findings.take()) {
    if (each.severity != Severity::error || !each.where.starts_with(prefix)) continue;
    const std::string below = each.where.substr(prefix.size());
    if (!below.empty() && below[0] != '.' && below[0] != '[') continue;
    each.where = place + below;
    wrong.push_back(std::move(each));
  }
  return plain(wrong);
}

// (the case as JSON, the place where items are numbers, the problem or "", what is wrong with the value).
std::tuple<std::string, std::string, std::string, PlainFindings> with_value(const std::string& text,
                                                                            const std::string& path,
                                                                            const std::string& value) {
  Json json = Json::parse(text);
  const AppliedOverride applied = set_value(json, path, Json::parse(value));
  if (!applied.problem.empty()) return {json.dump(), applied.path, applied.problem, {}};
  return {json.dump(), applied.path, applied.problem, wrong_at(applied.path, json)};
}

// The shape of an object or of the items of an array.
const Shape& object_in(const Shape& shape) {
  if (shape.kind == Shape::Kind::array) return object_in(shape.items[0]);
  if (shape.kind == Shape::Kind::either) return object_in(shape.items[1]);
  return shape;
}

// What is wrong with a part of a case, which may become whole later. `place`: keys from the case on,
// "beams.section": (findings).
PlainFindings check_part_at(const std::string& place, const std::string& text) {
  const Shape* shape = &host_keys();
  std::istringstream keys(place);
  for (std::string key; std::getline(keys, key, '.');) shape = &object_in(find_key(*shape, key)->shape);
  Findings findings(place);
  Json json = Json::parse(text);
  check_part(*shape, json, findings);
  return plain(findings.take());
}

// A length [m]; ValueError for a text that is none.
double length_of(const std::string& text) {
  const ParsedQuantity length = parse_quantity(text, Dimension::length);
  if (!length.value) throw py::value_error(length.error);
  return *length.value;
}

// (the case or nothing, findings).
using Built = std::pair<std::shared_ptr<BuiltCase>, PlainFindings>;

Built built(const std::string& text, const std::filesystem::path& file,
            const std::function<bool()>& interrupted) {
  CaseFileReport read = read_case_text(text, file);
  PlainFindings findings = plain(read.diagnostics);
  if (!read.value) return {nullptr, findings};
  auto made = std::make_shared<BuiltCase>();
  made->case_file = std::move(*read.value);
  made->report = build_model(made->case_file, interrupted);
  for (auto& finding : plain(made->report.diagnostics)) findings.push_back(std::move(finding));
  return {made->report.value ? made : nullptr, findings};
}

Built build(const std::string& text, const std::filesystem::path& file) {
  Interrupts interrupts;
  Built result;
  {
    const WithoutLock others_go_on;
    result = built(text, file, [&] { return interrupts.pending(); });
  }
  interrupts.rethrow();
  return result;
}

// Gives beams the elements that a tolerance over the motion asks for: (findings). Functions of the model are
// not in the runs that look for them.
PlainFindings divide_for_motion_of(BuiltCase& c, bool has_functions) {
  Interrupts interrupts;
  std::vector<Diagnostic> found;
  {
    const WithoutLock others_go_on;
    found = divide_for_motion(c.case_file, *c.report.value, [&] { return interrupts.pending(); });
  }
  interrupts.rethrow();
  if (has_functions && !found.empty())
    found.push_back({Severity::warning, c.case_file.path.string() + ": beams",
                     "the elements are those of the motion without the functions of the model"});
  return plain(found);
}

}  // namespace

void bind_cases(py::module_& module) {
  module.def("case_json", &case_json, py::arg("file"), py::arg("overrides"));
  module.def("with_value", &with_value, py::arg("text"), py::arg("path"), py::arg("value"));
  module.def("check_part", &check_part_at, py::arg("place"), py::arg("text"));
  module.def("length_of", &length_of, py::arg("text"));
  module.def("build", &build, py::arg("text"), py::arg("file"));
  module.def("schema", &case_file_schema);
  py::class_<BuiltCase, std::shared_ptr<BuiltCase>>(module, "BuiltCase", "A case and its model.")
      .def_property_readonly("name", [](const BuiltCase& c) { return c.case_file.name; })
      .def_property_readonly("analysis",
                             [](const BuiltCase& c) { return name_of(c.case_file.analysis.type); })
      .def_property_readonly("end_time", [](const BuiltCase& c) { return c.case_file.analysis.end_time; })
      .def("divide_for_motion", &divide_for_motion_of, py::arg("has_functions"))
      .def("summary", [](const BuiltCase& c) { return model_summary(c.case_file, c.built()); });
}

}  // namespace nurbeam::python
