#include "pipelines/model/connectors.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "fem/mesh/drawn_coordinates.h"
#include "nurbs/number_text.h"
#include "pipelines/diagnostics/closest_name.h"

namespace nurbeam {

namespace {

Grip end_of(const CaseConnectorEnd& from, const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
            const BeamModel& model, const ModelFrame& frame, Findings& findings) {
  if (from.point) return Grip::at_point(frame.to_local(*from.point));
  if (!from.body.empty()) return Grip::on_body(resolved.body_index(from.body));
  const int b = resolved.beam_index(from.beam);
  const double s = place_on(beams[b], from.at, from.path, findings);
  if (model.beams[b].rigid) return Grip::at_point(beams[b].curve.position(s));
  return Grip::on_beam(b, beams[b].material_coordinate(s));
}

// Whether a support keeps the end where it is drawn.
bool is_held(const Grip& end, const BeamModel& model) {
  return std::any_of(
      model.constraints.begin(), model.constraints.end(),
      [&](const Constraint& constraint) {
        const auto* support = std::get_if<Support>(&constraint);
        return support && !support->guide && support->beam == end.beam &&
               std::abs(support->s - end.s) <= same_place * model.beams[end.beam].curve.length();
      });
}

// The drawing must have what the connector needs of it.
void check_drawing(const CaseConnector& from, const Connector& connector, double drawn, Findings& findings) {
  const bool needs_direction = connector.type == ConnectorType::rod || connector.length > 0 ||
                               connector.length_rule != ConnectorLength::given;
  if (drawn == 0 && needs_direction && !connector.direction)
    findings.error(
        from.path,
        "has both ends in one place as drawn, which gives it no direction; give a \"direction\", or "
        "move an end");
  if (connector.type == ConnectorType::rod && connector.length == 0 && drawn > 0 && !connector.direction)
    findings.error(from.path + ".length",
                   "is 0 m, with which a rod has no direction; must be above 0 m, or give a \"direction\"");
  const auto& [a, b] = connector.ends;
  if (a.is_point() && b.is_point())
    findings.error(from.path,
                   "joins two places of rigid guides or points, which stay where they are; give a "
                   "\"body\" or an elastic \"beam\" as one end");
  if (a.beam >= 0 && a.beam == b.beam && a.s == b.s)
    findings.error(from.path, "joins a place of beam " + in_quotes(from.ends[0].beam) +
                                  " to itself, at s = " + text_of(a.s) + " m");
}

// The mass of an end is that of its body, or a lump of its beam.
void add_mass(double mass, const Grip& end, BeamModel& model) {
  if (!(mass > 0)) return;
  if (end.body >= 0)
    model.bodies[end.body].mass += mass;
  else
    model.forces.push_back(PlaceMass{.beam = end.beam, .s = end.s, .mass = mass});
}

}  // namespace

std::vector<double> connector_places(const ResolvedCase& resolved, int b, const DrawnBeam& beam,
                                     Findings& findings) {
  std::vector<double> places;
  for (const auto* connectors : {&resolved.connectors, &resolved.rotational_connectors})
    for (const CaseConnector& connector : *connectors)
      for (const CaseConnectorEnd& end : connector.ends)
        if (!end.beam.empty() && resolved.beam_index(end.beam) == b)
          places.push_back(place_on(beam, end.at, end.path, findings));
  return places;
}

void add_connectors(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                    const ModelFrame& frame, BeamModel& model, Findings& findings) {
  for (const CaseConnector& from : resolved.connectors) {
    Connector connector{.name = from.name,
                        .ends = {end_of(from.ends[0], resolved, beams, model, frame, findings),
                                 end_of(from.ends[1], resolved, beams, model, frame, findings)},
                        .type = from.type,
                        .stiffness = from.stiffness,
                        .rows = from.rows,
                        .damping = from.damping,
                        .length_rule = from.length_rule,
                        .force = from.force};
    if (from.direction) connector.direction = frame.direction_to_local(from.direction->stableNormalized());
    const Eigen::Vector3d d = drawn_place(model, connector.ends[1]) - drawn_place(model, connector.ends[0]);
    const double drawn = connector.direction ? connector.direction->dot(d) : d.norm();
    connector.length = from.length.value_or(drawn);
    check_drawing(from, connector, drawn, findings);
    const CaseAnalysis& analysis = resolved.analysis;
    const bool starts_drawn = analysis.has_modes() ? !analysis.modes.about_equilibrium
                                                   : analysis.type == CaseAnalysis::Type::dynamic &&
                                                         !analysis.start_from_equilibrium;
    if (connector.type == ConnectorType::rod && starts_drawn &&
        std::abs(connector.length - drawn) > 1e-9 * std::abs(drawn))
      findings.error(
          from.path + ".length",
          "is " + text_of(connector.length) + " m, but the ends of the rod are " + text_of(drawn) +
              " m apart as drawn, where it is to start; leave \"length\" out, move an end, or say " +
              (analysis.has_modes() ? "\"about\"" : "\"initial\"") + ": \"equilibrium\"");
    if (connector.length_rule == ConnectorLength::force && starts_drawn) {
      connector.length_rule = ConnectorLength::given;
      connector.length = drawn - connector.stretch_under(from.force);
    }
    if (connector.length_rule == ConnectorLength::as_drawn && is_held(connector.ends[0], model))
      findings.error(from.path + ".length",
                     "is \"as-drawn\", but a support holds its first end where it is drawn anyway; exchange "
                     "\"from\" and \"to\", or leave \"length\" out");
    for (const int end : {0, 1}) add_mass(from.end_masses[end], connector.ends[end], model);
    model.connectors.push_back(std::move(connector));
  }
}

namespace {

// What a rotational connector needs of its ends and of their beams.
void check_turned_ends(const CaseConnector& from, const RotationalConnector& connector,
                       const BeamModel& model, Findings& findings) {
  const auto& [a, b] = connector.ends;
  if (a.is_point() && b.is_point())
    findings.error(
        from.path,
        "joins space to space, as rigid guides and points do not turn; give an elastic \"beam\" or a rigid \"body\" as one end");
  if (a.beam >= 0 && a.beam == b.beam && a.s == b.s)
    findings.error(from.path, "joins a place of beam " + in_quotes(from.ends[0].beam) +
                                  " to itself, at s = " + text_of(a.s) + " m");
  for (const int i : {0, 1})
    if (const Grip& end = connector.ends[i];
        end.beam >= 0 && connector.ends[1 - i].body >= 0 && !model.beams[end.beam].has_torsion())
      findings.error(from.ends[i].path, "is beam " + in_quotes(from.ends[i].beam) +
                                            ", which has no torsion and so no axes across it, and the other "
                                            "end is a rigid body: give the beam \"torsion\": true");
  if (connector.axis || model.dimension == 2) {
    for (const int i : {0, 1}) {
      const Grip& end = connector.ends[i];
      if (end.beam < 0 || model.dimension == 2 || model.beams[end.beam].has_torsion()) continue;
      const Eigen::Vector3d t = model.beams[end.beam].curve.tangent(end.s).normalized();
      if (t.cross(*connector.axis).norm() < 1e-6)
        findings.error(
            from.path + ".axis",
            "is along beam " + in_quotes(from.ends[i].beam) +
                ", which has no torsion and so no angle about itself: give it \"torsion\": true, or "
                "another axis");
    }
    return;
  }
  for (const int i : {0, 1})
    if (const Grip& end = connector.ends[i]; end.beam >= 0 && !model.beams[end.beam].has_torsion())
      findings.error(from.path, "has no \"axis\", which it needs on beam " + in_quotes(from.ends[i].beam) +
                                    ", as that has no torsion; give one, or the beam \"torsion\": true");
  for (const auto& [key, value] : {std::pair{".angle", from.angle}, std::pair{".moment", from.moment}})
    if (value != 0)
      findings.error(from.path + key, "is about an \"axis\", and there is none; give one, or leave this out");
}

}  // namespace

void add_rotational_connectors(const ResolvedCase& resolved, const std::vector<DrawnBeam>& beams,
                               const ModelFrame& frame, BeamModel& model, Findings& findings) {
  for (const CaseConnector& from : resolved.rotational_connectors) {
    RotationalConnector connector{.name = from.name,
                                  .ends = {end_of(from.ends[0], resolved, beams, model, frame, findings),
                                           end_of(from.ends[1], resolved, beams, model, frame, findings)},
                                  .stiffness = from.stiffness,
                                  .damping = from.damping,
                                  .angle = from.angle,
                                  .moment = from.moment};
    if (from.axis) connector.axis = frame.moment_to_local(from.axis->stableNormalized()).normalized();
    check_turned_ends(from, connector, model, findings);
    model.rotational_connectors.push_back(std::move(connector));
  }
}

}  // namespace nurbeam
