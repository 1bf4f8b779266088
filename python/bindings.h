#pragma once
#include <pybind11/pybind11.h>

#include <string>
#include <tuple>
#include <vector>

#include "cad_import/report/diagnostic.h"

/// The parts of the module nurbeam._core: what Python's own modules in python/nurbeam are made of. It takes
/// and gives plain numbers, texts and arrays; what a user sees is written in Python.
namespace nurbeam::python {

void bind_curves(pybind11::module_& module);
void bind_cad_files(pybind11::module_& module);
void bind_cases(pybind11::module_& module);
void bind_recordings(pybind11::module_& module);
void bind_simulations(pybind11::module_& module);
void bind_systems(pybind11::module_& module);

/// (severity, where, message) each.
using PlainFindings = std::vector<std::tuple<std::string, std::string, std::string>>;
PlainFindings plain(const std::vector<Diagnostic>& diagnostics);

}  // namespace nurbeam::python
