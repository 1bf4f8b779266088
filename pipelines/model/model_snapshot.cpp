#include "pipelines/model/model_snapshot.h"

#include <algorithm>

#include "pipelines/diagnostics/simulation_text.h"

namespace nurbeam {

namespace {

void to_world(const ModelFrame& f, PointRecord& p) {
  p.position = f.to_world(p.position);
  p.velocity = f.direction_to_world(p.velocity);
}

// With a number behind it where others have the name.
std::string distinct(const std::string& name, const std::vector<std::string>& others) {
  std::string free = name;
  for (int i = 2; std::find(others.begin(), others.end(), free) != others.end(); ++i)
    free = name + " " + std::to_string(i);
  return free;
}

void to_world(const ModelFrame& f, std::optional<FeltRecord>& felt) {
  if (!felt) return;
  felt->acceleration = f.direction_to_world(felt->acceleration);
  if (felt->in_space) felt->load_factor = f.direction_to_world(felt->load_factor);
}

}  // namespace

void put_into_world(const ModelFrame& f, ElementRecord& e) {
  for (int i = 0; i < 4; ++i) {
    const double w = e.control_points(3, i);
    const Eigen::Vector3d p = f.to_world(e.control_points.col(i).head<3>() / w);
    e.control_points.col(i).head<3>() = w * p;
    e.drawn_points.col(i) = f.to_world(e.drawn_points.col(i));
    e.velocity.col(i) = f.direction_to_world(e.velocity.col(i));
    e.d1.col(i) = f.direction_to_world(e.d1.col(i));
    e.d2.col(i) = f.direction_to_world(e.d2.col(i));
  }
}

Snapshot to_world(const ModelFrame& f, Snapshot frame) {
  for (ProbeRecord& p : frame.probes) {
    to_world(f, p);
    p.displacement = f.direction_to_world(p.displacement);
    to_world(f, p.felt);
  }
  for (ReactionRecord& reaction : frame.reactions) {
    reaction.position = f.to_world(reaction.position);
    reaction.force = f.direction_to_world(reaction.force);
    reaction.couple = f.direction_to_world(reaction.couple);
  }
  for (ConnectorRecord& connector : frame.connectors) {
    connector.from = f.to_world(connector.from);
    connector.to = f.to_world(connector.to);
  }
  for (BodyRecord& body : frame.bodies) {
    to_world(f, body.point);
    to_world(f, body.felt);
    body.joint_force = f.direction_to_world(body.joint_force);
  }
  for (BeamRecord& beam : frame.beams) {
    for (ElementRecord& e : beam.elements) put_into_world(f, e);
    for (Eigen::Vector3d& p : beam.node_positions) p = f.to_world(p);
    for (Eigen::Vector3d& p : beam.node_slopes) p = f.direction_to_world(p);
  }
  frame.energy.gravity += f.gravity_energy;
  frame.energy.total += f.gravity_energy;
  return frame;
}

SnapshotNames snapshot_names(const BuiltModel& built) {
  SnapshotNames names;
  for (const Probe& probe : built.probes) names.probes.push_back(probe.name);
  const auto is_rigid = [](const Body& body) { return body.rigid.has_value(); };
  for (const Body& body : built.model.bodies) names.bodies.push_back(body.name);
  if (std::ranges::any_of(built.model.bodies, is_rigid))
    for (const Body& body : built.model.bodies) {
      names.rigid.push_back(is_rigid(body));
      names.felt.push_back(is_rigid(body) || body.point_of || built.model.accelerations);
    }
  else if (built.model.accelerations)
    names.felt.assign(built.model.bodies.size(), true);
  names.felt_at_probes = built.model.accelerations;
  for (const Rider& rider : built.model.riders) {
    const bool is_driven = !rider.drive_force.empty() || (rider.reel && rider.motion);
    names.friction = names.friction || rider.friction || is_driven;
    names.springs = names.springs || rider.friction || (rider.reel && rider.reel->strain_energy > 0);
  }
  for (const Stop& stop : built.model.stops) names.springs = names.springs || stop.buffer;
  names.springs =
      names.springs || !built.model.connectors.empty() || !built.model.rotational_connectors.empty();
  for (const Beam& beam : built.model.beams) {
    names.beams.push_back(beam.name);
    names.sections = names.sections || beam.has_torsion();
  }
  for (const Constraint& constraint : built.model.constraints)
    names.reactions.push_back(
        std::visit([&](const auto& of) { return distinct(of.reaction_name(built.model), names.reactions); },
                   constraint));
  for (const Connector& connector : built.model.connectors) names.connectors.push_back(connector.name);
  for (const Measure& measure : built.model.measures) names.measures.push_back(name_of(measure));
  return names;
}

std::string outcome_in_world(const SimulationReport& report, const BuiltModel& built) {
  SimulationReport in_world = report;
  if (in_world.failure && in_world.failure->loose)
    in_world.failure->loose->direction = built.frame.direction_to_world(in_world.failure->loose->direction);
  return outcome_text(in_world, built.model);
}

}  // namespace nurbeam
