#include "pipelines/route/route_case.h"

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

Json numbers(const Eigen::Vector3d& vector) { return {vector.x(), vector.y(), vector.z()}; }

Json inline_axis(const NurbsCurve& curve) {
  Json points = Json::array();
  for (Eigen::Index i = 0; i < curve.control_points().cols(); ++i)
    points.push_back(numbers(curve.control_points().col(i).hnormalized()));
  return {
      {"nurbs", {{"degree", curve.degree()}, {"knots", curve.knots().knots()}, {"control_points", points}}}};
}

}  // namespace

CaseFileReport route_case(const RouteRequest& request, const NurbsCurve& start, double length,
                          double tolerance) {
  const Json beam = {{"name", "cable"},
                     {"axis", inline_axis(start)},
                     {"stress_free", "straight"},
                     {"unstressed_length", length},
                     {"section", Json::parse(request.section)},
                     {"material", Json::parse(request.material)},
                     {"elements", {{"tolerance", tolerance}}}};
  const auto clamp = [](const char* at) {
    return Json{{"beam", "cable"}, {"at", at}, {"type", "clamped"}, {"name", at}};
  };
  return read_case_json({{"nurbeam", 1},
                         {"gravity", numbers(request.gravity)},
                         {"beams", Json::array({beam})},
                         {"supports", Json::array({clamp("start"), clamp("end")})},
                         {"analysis", {{"type", "static"}}}},
                        request.where);
}

std::vector<Diagnostic> in_places_of(const RouteRequest& request, std::vector<Diagnostic> findings) {
  const std::string head = request.where + ": ", beam = "beams[0].";
  for (Diagnostic& each : findings) {
    if (!each.where.starts_with(head)) continue;
    std::string place = each.where.substr(head.size());
    if (place.starts_with(beam)) place = place.substr(beam.size());
    each.where = request.where + "." + place;
  }
  return findings;
}

}  // namespace nurbeam
