#include "pipelines/model/model_summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pipelines/model/inertia_box.h"

namespace nurbeam {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Eigen::Vector3d& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json to_json(const TimeTable& table) {
  Json rows = Json::array();
  for (const auto& [time, value] : table) rows.push_back({time, value});
  return rows;
}

Json to_json(const SectionOutline& outline) {
  constexpr double digits = 1e6;  // of its size
  double size = 0;
  for (const auto& polygon : outline)
    for (const Eigen::Vector2d& p : polygon) size = std::max(size, p.norm());
  const double unit = std::pow(10, std::floor(std::log10(size))) / digits;
  Json json = Json::array();
  for (const auto& polygon : outline) {
    Json& points = json.emplace_back(Json::array());
    for (const Eigen::Vector2d& p : polygon)
      points.push_back({std::round(p.x() / unit) * unit, std::round(p.y() / unit) * unit});
  }
  return json;
}

std::string name_of(WeightRule rule) {
  switch (rule) {
    case WeightRule::material:
      return "ALE-RANCF, material weights";
    case WeightRule::constant:
      return "ALE-RANCF, constant weights";
    case WeightRule::ones:
      return "ALE-ANCF";
  }
  return {};
}

Json law_of(const BeamProperties& p) {
  if (const auto* table = std::get_if<ForceOverStretch>(&p.law)) return to_json(table->rows().rows());
  return std::holds_alternative<HookeLaw>(p.law) ? "hooke" : "green";
}

// Where it carries no axial force; null of what is tighter than any strain of it says.
Json unstressed_length(const Beam& beam) {
  const FreeStrain& strain = beam.properties.free_strain;
  const double stretch_squared = 1 + 2 * (strain.constant + strain.of_tension);
  return stretch_squared > 0 ? Json(beam.curve.length() * std::sqrt(stretch_squared)) : Json();
}

// Of largest magnitude over time.
double largest_expansion(const FreeStrain& strain) {
  double largest = 0;
  for (const auto& [time, expansion] : strain.thermal)
    if (std::abs(expansion) > std::abs(largest)) largest = expansion;
  return largest;
}

Json to_json(const Beam& beam, const BeamSource& source) {
  const BeamProperties& p = beam.properties;
  const double stretch =
      std::sqrt(1 + 2 * p.free_strain.constant);  // of the unstressed over the drawn length
  Json json = {{"name", beam.name},
               {"curve", source.curve_name},
               {"length [m]", beam.curve.length()},
               {"unstressed length [m]", unstressed_length(beam)},
               {"mass [kg]", beam.curve.length() * p.mass_per_length},
               {"elements", beam.rigid ? 0 : beam.home.size() - 1},
               {"CAD segments", beam.curve.segment_count()},
               {"element", beam.rigid ? "none: a rigid guide" : name_of(beam.weights)},
               {"stress-free", beam.curve.straight() ? "straight" : "as drawn"},
               {"rigid", beam.rigid},
               {"bending as drawn [J]", source.drawn_bending},
               {"EA [N]", p.free_axial_stiffness()},
               {"EI [N m^2]", p.bending_stiffness * stretch},
               {"axial law", beam.rigid ? Json() : law_of(p)},
               {"damping [s]", p.damping},
               {"mass damping [1/s]", p.mass_damping},
               {"tension as drawn [N]", p.drawn_tension()}};
  if (!p.free_strain.thermal.empty()) json["thermal strain at most"] = largest_expansion(p.free_strain);
  if (p.sections) {
    json.erase("EI [N m^2]");
    json["torsion"] = source.torsion;
    json.update({{"EI1 [N m^2]", p.sections->bending_1 * stretch},
                 {"EI2 [N m^2]", p.sections->bending_2 * stretch},
                 {"EI12 [N m^2]", p.sections->bending_product * stretch},
                 {"GJ [N m^2]", p.sections->torsion * stretch}});
    json["section outline [m]"] = to_json(source.outline);
  }
  return json;
}

/// Away from the beam at its ends, else up.
Eigen::Vector3d outward(const BeamModel& model, const Support& support) {
  const ReferenceCurve& curve = model.beams[support.beam].curve;
  if (support.s <= 0) return -curve.tangent(0);
  if (support.s >= curve.end()) return curve.tangent(curve.end(), true);
  return -model.gravity.stableNormalized();
}

Json to_json(const Support& support, const BuiltModel& built) {
  const Beam& beam = built.model.beams[support.beam];
  return {{"beam", beam.name},
          {"type", support.clamped ? "clamped"
                   : support.fork  ? "fork"
                   : support.guide ? "guided"
                                   : "pinned"},
          {"turns", support.turn.has_value()},
          {"s [m]", support.s},
          {"position [m]", to_json(built.frame.to_world(beam.curve.position(support.s)))},
          {"outward", to_json(built.frame.direction_to_world(outward(built.model, support)))}};
}

// A rigid body with the box of its mass and inertia, of which the axes are those of the drawing.
Json to_json(const Body& body, const ModelFrame& frame) {
  Json json = {{"name", body.name}, {"mass [kg]", body.mass}, {"roll inertia [kg m^2]", body.roll_inertia}};
  if (!body.rigid) return json;
  const InertiaBox box = inertia_box(body);
  Json sides = Json::array(), directions = Json::array();
  for (int k = 0; k < 3; ++k) {
    sides.push_back(box.sides[k]);
    directions.push_back(to_json(Eigen::Vector3d(frame.direction_to_world(box.axes.col(k)))));
  }
  json["principal inertia [kg m^2]"] = to_json(box.principal);
  json["box [m]"] = std::move(sides);
  json["box axes"] = std::move(directions);
  return json;
}

Json to_json(const Rider& joint, const BeamModel& model) {
  return {{"body", model.bodies[joint.body].name},
          {"beam", model.beams[joint.beam].name},
          {"s at start [m]", joint.s},
          {"speed at start [m/s]", joint.speed},
          {"motion", joint.motion ? "prescribed" : "free"},
          {"slope", joint.continuous_slope ? "continuous" : "discontinuous"},
          {"carried as", joint.as_point ? "point" : "node"},
          {"follows section", joint.follows_section},
          {"offset [m]", {joint.offset[0], joint.offset[1]}},
          {"at beam end", joint.leave_at_end ? "leaves" : "stops"}};
}

template <class Number>
Json or_null(const std::optional<Number>& number) {
  return number ? Json(*number) : Json();
}

Json to_json(const SlopeDecision& slope, const BeamModel& model) {
  return {{"of", slope.path},
          {"beam", model.beams[slope.beam].name},
          {"s [m]", slope.s},
          {"slope", slope.discontinuous ? "discontinuous" : "continuous"},
          {"why", slope.why},
          {"tension [N]", or_null(slope.tension)},
          {"bending reaches [m]", or_null(slope.reach)},
          {"shorter element [m]", or_null(slope.element)}};
}

std::string name_of(ConnectorType type) {
  switch (type) {
    case ConnectorType::spring:
      return "spring";
    case ConnectorType::tension_only:
      return "tension-only";
    case ConnectorType::compression_only:
      return "compression-only";
    case ConnectorType::rod:
      return "rod";
  }
  return {};
}

Json to_json(const Grip& end, const BuiltModel& built) {
  if (end.beam >= 0) return {{"beam", built.model.beams[end.beam].name}, {"s [m]", end.s}};
  if (end.body >= 0) return {{"body", built.model.bodies[end.body].name}};
  return {{"point [m]", to_json(built.frame.to_world(end.point))}};
}

Json to_json(const Connector& connector, const BuiltModel& built) {
  Json json = {{"name", connector.name},
               {"type", name_of(connector.type)},
               {"from", to_json(connector.ends[0], built)},
               {"to", to_json(connector.ends[1], built)}};
  if (connector.type != ConnectorType::rod)
    json.update(
        {{"stiffness [N/m]", connector.rows ? to_json(connector.rows->rows()) : Json(connector.stiffness)},
         {"damping [N s/m]", connector.damping}});
  if (connector.length_rule == ConnectorLength::given) json["length [m]"] = connector.length;
  if (connector.length_rule == ConnectorLength::as_drawn) json["length [m]"] = "as drawn";
  if (connector.length_rule == ConnectorLength::force) json["force at the start [N]"] = connector.force;
  return json;
}

Json to_json(const RotationalConnector& connector, const BuiltModel& built) {
  Json json = {{"name", connector.name},
               {"type", "rotational"},
               {"from", to_json(connector.ends[0], built)},
               {"to", to_json(connector.ends[1], built)},
               {"stiffness [N m/rad]", connector.stiffness},
               {"damping [N m s/rad]", connector.damping}};
  if (connector.axis)
    json.update({{"axis", to_json(built.frame.direction_to_world(*connector.axis))},
                 {"free angle [rad]", connector.angle},
                 {"moment [N m]", connector.moment}});
  return json;
}

Json load_json(const char* kind, int beam, const Eigen::Vector3d& value, const TimeTable& time,
               const BuiltModel& built) {
  return {{"beam", built.model.beams[beam].name},
          {"kind", kind},
          {"value", to_json(built.frame.direction_to_world(value))},
          {"in time", time.empty() ? "constant" : "table"},
          {"factor", to_json(time)}};
}

Json load_json(const char* kind, const LoadAtPlace& load, const BuiltModel& built) {
  Json json = load_json(kind, load.beam, load.value, load.time, built);
  json.update({{"direction", load.follower ? "turns with the beam" : "fixed"},
               {"s [m]", load.s},
               {"place speed [m/s]", load.speed}});
  return json;
}

Json to_json(const PointLoad& load, const BuiltModel& built) { return load_json("force [N]", load, built); }
Json to_json(const Moment& load, const BuiltModel& built) { return load_json("moment [N m]", load, built); }
Json to_json(const LineLoad& load, const BuiltModel& built) {
  Json json = load_json("force per length [N/m]", load.beam, load.value, load.time, built);
  json.update({{"direction", "fixed"}, {"place speed [m/s]", 0}});
  if (load.even != 1) json["part that is seen"] = load.even;
  return json;
}

Json to_json(const LineTorque& load, const BuiltModel& built) {
  return {{"beam", built.model.beams[load.beam].name},
          {"kind", "torque per length [N m/m]"},
          {"value", load.value},
          {"in time", load.time.empty() ? "constant" : "table"},
          {"factor", to_json(load.time)},
          {"direction", "turns with the beam"},
          {"place speed [m/s]", 0}};
}

}  // namespace

std::string name_of(CaseAnalysis::Type type) {
  switch (type) {
    case CaseAnalysis::Type::dynamic:
      return "dynamic";
    case CaseAnalysis::Type::statics:
      return "static";
    case CaseAnalysis::Type::modes:
      return "modes";
    case CaseAnalysis::Type::buckling:
      return "buckling";
  }
  return {};
}

std::string model_summary(const CaseFile& case_file, const BuiltModel& built) {
  const BeamModel& model = built.model;
  Json json = {
      {"analysis", name_of(case_file.analysis.type)},
      {"dimension", model.dimension},
      {"plane_normal",
       model.dimension == 2 ? to_json(built.frame.direction_to_world(Eigen::Vector3d::UnitZ())) : Json()},
      {"gravity [m/s^2]", to_json(case_file.gravity)},
      {"beams", Json::array()},
      {"bodies", Json::array()},
      {"supports", Json::array()},
      {"joints", Json::array()},
      {"slopes", Json::array()},
      {"connectors", Json::array()},
      {"loads", Json::array()}};
  for (std::size_t b = 0; b < model.beams.size(); ++b)
    json["beams"].push_back(to_json(model.beams[b], built.sources[b]));
  for (const Body& body : model.bodies) json["bodies"].push_back(to_json(body, built.frame));
  for (const Constraint& constraint : model.constraints)
    std::visit(
        [&](const auto& c) {
          if constexpr (requires { to_json(c, built); }) json["supports"].push_back(to_json(c, built));
        },
        constraint);
  for (const Rider& joint : model.riders) json["joints"].push_back(to_json(joint, model));
  for (const SlopeDecision& slope : built.slopes) json["slopes"].push_back(to_json(slope, model));
  for (const Connector& connector : model.connectors) json["connectors"].push_back(to_json(connector, built));
  for (const RotationalConnector& connector : model.rotational_connectors)
    json["connectors"].push_back(to_json(connector, built));
  for (const Force& force : model.forces)
    std::visit(
        [&](const auto& load) {
          if constexpr (requires { to_json(load, built); }) json["loads"].push_back(to_json(load, built));
        },
        force);
  // Names from files need not be valid UTF-8: what is not is replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace nurbeam
