#include "pipelines/model/join_beams.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <optional>
#include <string>

#include "nurbs/closest_point.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"
#include "pipelines/model/resolved_case.h"

namespace nurbeam {

namespace {

// Beams whose axes come within this part of their length of each other meet.
constexpr double same_joint = 1e-6;

// A place of one beam, in reference arc length.
struct BeamPlace {
  int beam;
  double s;
};

// The same place as places of two beams.
using Meeting = std::pair<BeamPlace, BeamPlace>;

// The place of the beam nearest to the point; an end that is near is that end.
BeamPlace nearest_place(const std::vector<DrawnBeam>& beams, int b, const Eigen::Vector3d& point) {
  const ClosestPoint found = closest_point(beams[b].axis, point);
  const double L = beams[b].measured.length(), s = beams[b].measured.arc_length(found.segment, found.u);
  const double end = beams[b].measured.closed() ? 0 : L;
  return {b, s < same_joint * L ? 0 : s > L * (1 - same_joint) ? end : s};
}

Eigen::Vector3d world_position(const std::vector<DrawnBeam>& beams, const ModelFrame& frame,
                               const BeamPlace& place) {
  return frame.to_world(beams[place.beam].measured.position(place.s));
}

// A ring has none, but its seam is a place where a joint may be.
std::vector<double> ends_of(const DrawnBeam& beam) {
  return beam.measured.closed() ? std::vector<double>{0} : std::vector<double>{0, beam.measured.length()};
}

double distance(const std::vector<DrawnBeam>& beams, const ModelFrame& frame, const Meeting& places) {
  return (world_position(beams, frame, places.first) - world_position(beams, frame, places.second)).norm();
}

// Where two beams meet: nearest to the point, or else where an end of one is nearest to the other.
Meeting meeting_place(const std::vector<DrawnBeam>& beams, const ModelFrame& frame, int a, int b,
                      const std::optional<Eigen::Vector3d>& near) {
  if (near) return {nearest_place(beams, a, *near), nearest_place(beams, b, *near)};
  std::vector<Meeting> candidates;
  for (const double s : ends_of(beams[a]))
    candidates.emplace_back(BeamPlace{a, s}, nearest_place(beams, b, world_position(beams, frame, {a, s})));
  for (const double s : ends_of(beams[b]))
    candidates.emplace_back(nearest_place(beams, a, world_position(beams, frame, {b, s})), BeamPlace{b, s});
  return *std::min_element(candidates.begin(), candidates.end(), [&](const auto& one, const auto& other) {
    return distance(beams, frame, one) < distance(beams, frame, other);
  });
}

// A body slides to an end of a beam, but over no joint.
void check_sliders(const ResolvedCase& resolved, const CaseBeamJoint& joint, const DrawnBeam& beam, double s,
                   Findings& findings) {
  const ReferenceCurve& curve = beam.measured;
  const bool at_end = !curve.closed() && (s == 0 || s == curve.length());
  for (const CaseSlidingJoint& slider : resolved.sliding_joints)
    if (slider.beam == beam.name && !at_end)
      findings.error(joint.path, "is at s = " + text_of(s) + " m of beam " + in_quotes(beam.name) +
                                     ", over which body " + in_quotes(slider.body) +
                                     " slides; a joint there must be at an end of the beam: "
                                     "divide the beam there");
}

// `"a" and "b"`.
std::string both(const std::vector<DrawnBeam>& beams, int a, int b) {
  return in_quotes(beams[a].name) + " and " + in_quotes(beams[b].name);
}

// In space, without torsion, the angle of beams in one line has no derivative.
void check_angle(const ResolvedCase& resolved, const CaseBeamJoint& joint,
                 const std::vector<DrawnBeam>& beams, const Meeting& places, Findings& findings) {
  const auto& [a, b] = places;
  if (beams[a.beam].measured.dimension() == 2) return;
  if (resolved.beams[a.beam].torsion && resolved.beams[b.beam].torsion) return;
  const Eigen::Vector3d along_a = beams[a.beam].measured.tangent(a.s),
                        along_b = beams[b.beam].measured.tangent(b.s);
  if (along_a.cross(along_b).norm() < least_sine)
    findings.error(joint.path + ".type",
                   "is \"rigid\", but " + both(beams, a.beam, b.beam) +
                       " run in one line there, and this is a spatial model: make them one beam "
                       "(\"curve\" with \"chain\"), or use \"hinged\"");
}

using Groups = std::map<std::pair<int, double>, int>;

// The group of a place, which round-off may set apart from where it was found before: as nodes are divided,
// these are one place.
Groups::const_iterator group_at(const Groups& groups, const std::vector<DrawnBeam>& beams,
                                const BeamPlace& place) {
  const double same = same_place * beams[place.beam].measured.length();
  const auto found = groups.lower_bound({place.beam, place.s - same});
  if (found == groups.end() || found->first.first != place.beam || found->first.second > place.s + same)
    return groups.end();
  return found;
}

// The same place, as it is known where it is joined already.
BeamPlace known_place(const Groups& groups, const std::vector<DrawnBeam>& beams, const BeamPlace& place) {
  const auto found = group_at(groups, beams, place);
  return found == groups.end() ? place : BeamPlace{place.beam, found->first.second};
}

// Puts both places into one group of places that are held together; false when they are in one.
bool unite(const Meeting& places, Groups& groups) {
  const auto group_of = [&](const BeamPlace& place) {
    const auto key = std::pair(place.beam, place.s);
    return groups.emplace(key, static_cast<int>(groups.size())).first->second;
  };
  const int a = group_of(places.first), b = group_of(places.second);
  for (auto& [place, group] : groups)
    if (group == b) group = a;
  return a != b;
}

void join_two(const ResolvedCase& resolved, const CaseBeamJoint& joint, int a, int b,
              const std::vector<DrawnBeam>& beams, const ModelFrame& frame, JoinedBeams& joined,
              Findings& findings) {
  const std::string names = both(beams, a, b);
  if (a == b) return findings.error(joint.path + ".beams", "joins " + names + "; give different beams");
  const Meeting found = meeting_place(beams, frame, a, b, joint.near);
  const Meeting places = {known_place(joined.groups, beams, found.first),
                          known_place(joined.groups, beams, found.second)};
  const auto& [at_a, at_b] = places;
  const double allowed = same_joint * std::max(beams[a].measured.length(), beams[b].measured.length());
  if (distance(beams, frame, places) > allowed)
    return findings.error(joint.path, names + " do not meet: they are " +
                                          text_of(distance(beams, frame, places)) + " m apart at " +
                                          text_of(world_position(beams, frame, at_a)) + " and " +
                                          text_of(world_position(beams, frame, at_b)) + "; the limit is " +
                                          text_of(allowed) + " m");
  for (const BeamPlace& place : {at_a, at_b})
    check_sliders(resolved, joint, beams[place.beam], place.s, findings);
  if (joint.rigid) check_angle(resolved, joint, beams, places, findings);
  if (!unite(places, joined.groups))
    return findings.error(joint.path, names + " are joined at " +
                                          text_of(world_position(beams, frame, at_a)) +
                                          " already; leave out one of the joints");
  for (const BeamPlace& place : {at_a, at_b}) {
    std::vector<double>& own = joined.places[place.beam];
    if (std::find(own.begin(), own.end(), place.s) == own.end()) own.push_back(place.s);
  }
  joined.joints.push_back({a,
                           beams[a].material_coordinate(at_a.s),
                           b,
                           beams[b].material_coordinate(at_b.s),
                           joint.rigid,
                           joint.name,
                           {}});
  if (joint.axis) joined.joints.back().axis = frame.direction_to_local(*joint.axis);
}

}  // namespace

JoinedBeams join_beams(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                       const ModelFrame& frame, Findings& findings) {
  JoinedBeams joined;
  joined.places.resize(beams.size());
  for (std::size_t j = 0; j < resolved.joints.size(); ++j) {
    const CaseBeamJoint& joint = resolved.joints[j];
    for (std::size_t i = 1; i < joint.beams.size(); ++i)
      join_two(resolved, joint, resolved.beam_index(joint.beams[0]), resolved.beam_index(joint.beams[i]),
               beams, frame, joined, findings);
    joined.sources.resize(joined.joints.size(), j);
  }
  if (!resolved.joints.empty() && resolved.analysis.is_explicit())
    findings.error("analysis.integrator.type",
                   "\"rk4\" is for models without joints; use \"generalized-alpha\" or \"radau\"");
  return joined;
}

void check_joined_supports(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                           const JoinedBeams& joined, Findings& findings) {
  std::map<int, std::string> first;
  for (const CaseSupport& support : resolved.supports) {
    const int b = resolved.beam_index(support.beam);
    const auto found =
        group_at(joined.groups, beams, {b, place_on(beams[b], support.at, support.path, findings)});
    if (found == joined.groups.end()) continue;
    const auto [other, is_new] = first.emplace(found->second, support.path);
    if (!is_new)
      findings.error(support.path, "holds beam " + in_quotes(support.beam) + " where " + other->second +
                                       " already holds a beam that is joined to it; keep one of them");
  }
}

}  // namespace nurbeam
