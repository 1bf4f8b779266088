#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "cad_import/export_curves.h"
#include "cad_import/files/companion_program.h"
#include "cad_import/import_curves.h"
#include "python/bindings.h"
#include "python/interrupts.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

py::dict facts(const ImportedCurve& curve) {
  using namespace py::literals;
  return py::dict("name"_a = curve.name, "entity"_a = curve.entity, "layer"_a = curve.layer,
                  "colour"_a = curve.colour, "part"_a = curve.part, "free"_a = curve.free,
                  "hidden"_a = curve.hidden, "exact"_a = curve.exact, "deviation"_a = curve.deviation,
                  "pipe_radius"_a = curve.pipe_radius, "bore_radius"_a = curve.bore_radius,
                  "bar_width"_a = curve.bar.width, "bar_height"_a = curve.bar.height,
                  "bar_area"_a = curve.bar.area);
}

// (curves with their facts, the file's unit, findings).
py::tuple read_curves(const std::filesystem::path& file) {
  ImportReport report;
  Interrupts interrupts;
  {
    const WithoutLock others_go_on;
    report = import_curves(file, {.interrupted = [&] { return interrupts.pending(); }});
  }
  interrupts.rethrow();
  py::list curves;
  for (const ImportedCurve& curve : report.curves) curves.append(py::make_tuple(curve.curve, facts(curve)));
  return py::make_tuple(curves, report.unit, plain(report.diagnostics));
}

PlainFindings write_curves(const std::filesystem::path& file,
                           const std::vector<std::pair<std::string, NurbsCurve>>& named,
                           const std::string& unit, const std::string& schema) {
  std::vector<NamedCurve> curves;
  for (const auto& [name, curve] : named) curves.push_back({name, curve});
  const LengthUnit in = parse_length_unit(unit);
  const StepSchema as = schema == "ap242" ? StepSchema::ap242 : StepSchema::ap214;
  const WithoutLock others_go_on;
  return plain(export_curves(file, curves, in, as));
}

}  // namespace

void bind_cad_files(py::module_& module) {
  module.def("read_curves", &read_curves, py::arg("file"));
  module.def("write_curves", &write_curves, py::arg("file"), py::arg("curves"), py::arg("unit"),
             py::arg("schema"));
  module.def("study_program", &study_program);
}

}  // namespace nurbeam::python
