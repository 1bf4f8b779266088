#include "pipelines/diagnostics/print_diagnostics.h"
#include "python/bindings.h"
#include "python/interpreter_lock.h"
#include "python/routes.h"

namespace nurbeam::python {

PlainFindings plain(const std::vector<Diagnostic>& diagnostics) {
  PlainFindings findings;
  for (const Diagnostic& d : diagnostics)
    findings.emplace_back(severity_name(d.severity), d.where, d.message);
  return findings;
}

}  // namespace nurbeam::python

PYBIND11_MODULE(_core, module) {
  module.doc() = "What nurbeam's Python modules are made of; use the package nurbeam.";
  module.attr("version") = NURBEAM_VERSION;
  nurbeam::python::watch_the_interpreters_end();
  nurbeam::python::bind_curves(module);
  nurbeam::python::bind_cad_files(module);
  nurbeam::python::bind_cases(module);
  nurbeam::python::bind_recordings(module);
  nurbeam::python::bind_routes(module);
  nurbeam::python::bind_simulations(module);
  nurbeam::python::bind_systems(module);
}
