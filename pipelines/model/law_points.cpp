#include "pipelines/model/law_points.h"

#include <algorithm>

#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

std::vector<Grip> law_points(const CaseLaw& law, const ResolvedCase& resolved,
                             const std::vector<DrawnBeam>& beams, Findings& findings) {
  std::vector<Grip> points;
  for (const CaseLawPoint& point : law.points) {
    const bool on_body = !point.body.empty();
    const std::vector<std::string> known = on_body ? names_of(resolved.bodies) : names_of(resolved.beams);
    const std::string& name = on_body ? point.body : point.beam;
    const auto found = std::find(known.begin(), known.end(), name);
    const int i = static_cast<int>(found - known.begin());
    if (found == known.end())
      findings.error(point.path + (on_body ? ".body" : ".beam"),
                     std::string("there is no ") + (on_body ? "body " : "beam ") + in_quotes(name) +
                         known_names(name, known));
    else if (on_body)
      points.push_back(Grip::on_body(i));
    else
      points.push_back(
          Grip::on_beam(i, beams[i].material_coordinate(place_on(beams[i], point.at, point.path, findings))));
  }
  return points;
}

}  // namespace nurbeam
