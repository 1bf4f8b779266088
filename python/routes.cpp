#include "python/routes.h"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "pipelines/route/route_file.h"
#include "python/bindings.h"
#include "python/interrupts.h"

namespace nurbeam::python {

namespace {

namespace py = pybind11;

py::dict facts(const Route& route) {
  using namespace py::literals;
  return py::dict("name"_a = route.name, "length"_a = route.length, "drawn_length"_a = route.drawn_length,
                  "distance"_a = route.distance, "least_radius"_a = route.least_radius,
                  "least_radius_s"_a = route.least_radius_s, "largest_tension"_a = route.largest_tension,
                  "largest_thrust"_a = route.largest_thrust, "sag"_a = route.sag,
                  "from_force"_a = route.from_force, "to_force"_a = route.to_force,
                  "elements"_a = route.elements);
}

// Of every cable of the text: (curve, facts), or None where it has none; findings; whether all are found.
py::tuple routes(const std::string& text, const std::filesystem::path& file, double time_limit,
                 double tolerance) {
  Interrupts interrupts;
  std::vector<std::optional<Route>> found;
  std::vector<Diagnostic> diagnostics;
  {
    const WithoutLock others_go_on;
    const RouteFile read = read_route_text(text, file);
    diagnostics = read.diagnostics;
    RouteOptions options;
    options.time_limit = std::chrono::duration<double>(time_limit);
    options.tolerance = tolerance;
    options.interrupted = [&] { return interrupts.pending(); };
    for (const RouteRequest& cable : read.cables) {
      RouteReport report = find_route(cable, options);
      diagnostics.insert(diagnostics.end(), report.diagnostics.begin(), report.diagnostics.end());
      found.push_back(std::move(report.value));
    }
  }
  interrupts.rethrow();
  py::list list;
  for (const std::optional<Route>& route : found)
    list.append(route ? py::object(py::make_tuple(route->curve, facts(*route))) : py::object(py::none()));
  return py::make_tuple(list, plain(diagnostics));
}

}  // namespace

void bind_routes(py::module_& module) {
  module.def("routes", &routes, py::arg("text"), py::arg("file"), py::arg("time_limit"),
             py::arg("tolerance"));
}

}  // namespace nurbeam::python
