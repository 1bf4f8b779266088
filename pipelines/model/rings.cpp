#include "pipelines/model/rings.h"

#include <algorithm>
#include <utility>

#include "fem/mesh/drawn_coordinates.h"
#include "nurbs/number_text.h"

namespace nurbeam {

void Rings::put_carrier(int carrier, const Eigen::Vector3d& drawn) {
  const std::string& name = model_.bodies[carrier].name;
  const bool slides = std::ranges::any_of(resolved_.sliding_joints,
                                          [&](const CaseSlidingJoint& joint) { return joint.body == name; });
  if (slides || resolved_.bodies[carrier].position || !put_.insert(carrier).second) return;
  model_.bodies[carrier].position = drawn;
}

Rings::Place Rings::place_of(const Said& said, const Eigen::Vector3d& drawn) {
  if (!said.on.empty()) {
    const int carrier = resolved_.body_index(said.on);
    put_carrier(carrier, drawn);
    return {drawn_place(model_, Grip::on_body(carrier)), {}, carrier};
  }
  if (said.position) return {frame_.to_local(*said.position), {}};
  if (said.path.empty()) return {drawn, {}};
  std::vector<DisplacementTable::Row> rows;
  for (const auto& [time, place] : said.path) rows.emplace_back(time, frame_.to_local(place));
  const Eigen::Vector3d position = DisplacementTable(rows).at(0).value;
  for (auto& [time, place] : rows) place -= position;
  return {position, DisplacementTable(std::move(rows))};
}

void Rings::add(const std::string& name, const Eigen::Vector3d& drawn, Place place) {
  const int ring = static_cast<int>(model_.bodies.size());
  model_.bodies.push_back({.name = name, .mass = 0, .position = drawn});
  if (place.carrier >= 0)
    model_.constraints.push_back(CarriedBody{ring, place.carrier});
  else
    model_.constraints.push_back(HeldBody{ring, place.position, std::move(place.motion)});
}

std::optional<Friction> ring_friction(std::optional<Friction> said, const CaseAnalysis& analysis,
                                      const Beam& beam) {
  if (!said || analysis.has_modes()) return {};
  if (!said->stick_stiffness)
    said->stick_stiffness = beam.properties.axial_stiffness * beam.home_intervals() / beam.curve.length();
  return said;
}

std::optional<Eigen::Vector3d> sleeve_direction(const std::optional<Eigen::Vector3d>& said,
                                                const std::string& path, const ReferenceCurve& curve,
                                                double s, const ModelFrame& frame, Findings& findings) {
  if (!said) return {};
  constexpr double least_cosine = 0.5;
  const Eigen::Vector3d own = frame.direction_to_local(*said), drawn = curve.tangent(s).normalized();
  if (own.norm() > 0 && own.normalized().dot(drawn) >= least_cosine) return own;
  findings.error(path + ".direction",
                 "is " + text_of(*said) +
                     "; must be within 60 degrees of the beam as drawn there, towards its end: " +
                     text_of(frame.direction_to_world(drawn)));
  return {};
}

}  // namespace nurbeam
