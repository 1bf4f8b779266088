#include "pipelines/command/route.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <ostream>

#include "cad_import/export_curves.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/print_diagnostics.h"
#include "pipelines/diagnostics/readable_quantity.h"
#include "pipelines/route/route_file.h"
#include "pipelines/run/signals.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity and no NaN.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json vector(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json json_of(const Route& route) {
  return {{"name", route.name},
          {"length [m]", route.length},
          {"drawn_length [m]", route.drawn_length},
          {"distance [m]", route.distance},
          {"least_radius [m]", number(route.least_radius)},
          {"least_radius_s [m]", number(route.least_radius_s)},
          {"largest_tension [N]", route.largest_tension},
          {"largest_thrust [N]", route.largest_thrust},
          {"sag [m]", number(route.sag)},
          {"from_force [N]", vector(route.from_force)},
          {"to_force [N]", vector(route.to_force)},
          {"elements", route.elements},
          {"control_points", route.curve.knots().control_point_count()}};
}

std::string line_of(const Route& route) {
  const auto quantity = [](double value, const char* unit) {
    return std::isfinite(value) ? readable(value, unit) : std::string("none");
  };
  return route.name + ": length " + quantity(route.length, "m") + ", sag " + quantity(route.sag, "m") +
         ", least bend radius " + quantity(route.least_radius, "m") +
         " (s = " + text_of(route.least_radius_s, 4) + " m), tension " +
         quantity(route.largest_tension, "N") + ", thrust " + quantity(route.largest_thrust, "N");
}

void print(const std::vector<Route>& routes, bool as_json, std::ostream& out) {
  if (!as_json) {
    for (const Route& route : routes) out << line_of(route) << '\n';
    return;
  }
  Json list = Json::array();
  for (const Route& route : routes) list.push_back(json_of(route));
  out << Json{{"cables", list}}.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
}

RouteOptions options_of(const Arguments& arguments) {
  RouteOptions options;
  const double limit =
      quantity_argument("--time-limit", arguments.value("--time-limit", "3"), Dimension::time);
  if (!(limit > 0))
    throw UsageError("--time-limit: is " + arguments.value("--time-limit", "") + "; must be greater than 0");
  options.time_limit = std::chrono::duration<double>(limit);
  options.tolerance =
      quantity_argument("--tolerance", arguments.value("--tolerance", "1e-6"), Dimension::number);
  return options;
}

int write(const std::filesystem::path& file, const std::vector<Route>& routes, const Arguments& arguments,
          Streams streams) {
  const LengthUnit unit = parse_length_unit(arguments.value("--unit", "mm"));
  std::vector<NamedCurve> curves;
  for (const Route& route : routes) curves.push_back({route.name, route.curve});
  std::vector<Diagnostic> found;
  if (arguments.has("--solid")) {
    const double radius = quantity_argument("--solid", arguments.value("--solid", ""), Dimension::length);
    std::vector<NamedPipe> pipes;
    for (const NamedCurve& curve : curves) pipes.push_back({curve, radius});
    found = export_solids(file, pipes, unit);
  } else {
    found = export_curves(file, curves, unit);
  }
  print_diagnostics(streams.err, found);
  return has_errors(found) ? exit_not_written : exit_done;
}

}  // namespace

int route_command(const Arguments& arguments, Streams streams) {
  const InterruptGuard guard;
  RouteOptions options = options_of(arguments);
  options.interrupted = [&] { return guard.interrupted(); };
  const std::string to = arguments.value("--to", "");
  if (!to.empty()) written_format(to);  // an ending that is none is told before the search
  const RouteFile file = read_route_file(arguments.positional[0]);
  print_diagnostics(streams.err, file.diagnostics);
  if (has_errors(file.diagnostics)) return exit_bad_input;
  std::vector<Route> routes;
  int code = exit_done;
  for (const RouteRequest& cable : file.cables) {
    RouteReport found = find_route(cable, options);
    if (guard.interrupted()) return exit_interrupted;
    print_diagnostics(streams.err, found.diagnostics);
    if (found.value)
      routes.push_back(std::move(*found.value));
    else if (code != exit_bad_input)
      code = found.unsolved ? exit_not_converged : exit_bad_input;
  }
  print(routes, arguments.has("--json"), streams.out);
  if (!to.empty() && !routes.empty())
    if (const int written = write(to, routes, arguments, streams); written != exit_done) return written;
  return code;
}

}  // namespace nurbeam
