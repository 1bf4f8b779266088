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

std::vector<LawOfMotion> laws_of_motion(const ResolvedCase& resolved, const BeamModel& model) {
  std::vector<LawOfMotion> motions;
  for (std::size_t j = 0; j < resolved.sliding_joints.size(); ++j)
    if (const CaseSlidingJoint& joint = resolved.sliding_joints[j]; joint.motion_law)
      motions.push_back({joint.path, *joint.motion_law, static_cast<int>(j), -1});
  int constraint = 0;  // supports come first, those of the first beam before those of the second
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    for (const CaseSupport& support : resolved.supports) {
      if (resolved.beam_index(support.beam) != static_cast<int>(b)) continue;
      if (support.motion_law) motions.push_back({support.path, *support.motion_law, -1, constraint});
      ++constraint;
    }
  return motions;
}

}  // namespace nurbeam
