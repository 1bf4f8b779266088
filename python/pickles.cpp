#include "python/pickles.h"

#include "pipelines/results/checksum.h"

namespace nurbeam::python {

namespace py = pybind11;

py::tuple reduce(const char* function, const py::object& parts) {
  std::string text = py::bytes(py::module_::import("pickle").attr("dumps")(parts));
  append_checksum(text);
  return py::make_tuple(py::module_::import("nurbeam.checked").attr(function),
                        py::make_tuple(py::bytes(text)));
}

py::object parts_of(const py::bytes& pickled, const std::string& what) {
  const py::module_ pickle = py::module_::import("pickle");
  try {
    check_text(std::string(pickled), what);
  } catch (const DamagedError& problem) {
    PyErr_SetString(pickle.attr("UnpicklingError").ptr(), problem.what());
    throw py::error_already_set();
  }
  return pickle.attr("loads")(pickled);
}

}  // namespace nurbeam::python
