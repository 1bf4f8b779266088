#pragma once
#include <pybind11/pybind11.h>

namespace nurbeam::python {

/// Cables of a given length: functions that take and give plain values.
void bind_routes(pybind11::module_& module);

}  // namespace nurbeam::python
