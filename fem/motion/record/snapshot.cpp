#include "fem/motion/record/snapshot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/mesh/attitude.h"
#include "fem/motion/record/adrift.h"
#include "fem/motion/record/element_peaks.h"
#include "fem/motion/record/felt.h"
#include "fem/motion/record/measures.h"
#include "fem/motion/record/sag.h"
#include "fem/system/bending_layers.h"
#include "fem/system/observables.h"
#include "fem/time_table.h"

namespace nurbeam {

namespace {

constexpr int at_once = 4096;  ///< elements that are handed over together

// Looks for extremes in the layers of bending besides.
void find_extremes(const BendingLayers& bent, BeamRecord& record) {
  for (const LayerRecord& layer : bent.layers) {
    const auto look = [&](Extreme& extreme, double value) {
      keep(extreme, value, layer.s, ElementExtreme::magnitude, layer.reach);
    };
    if (std::isnan(layer.reach)) record.slack_kink = layer.s;
    look(record.moment_max, layer.moment);
    look(record.stress_max, layer.stress);
    look(record.von_mises_max, layer.von_mises);
  }
}

// The reference arc length of a node [m].
double place_of(const ReferenceCurve& curve, const MeshNode& node, const State& state) {
  return node.place >= 0 ? curve.wrapped(state.q[node.place]) : node.s;
}

// The record of a guide, which stays as drawn: its segments, with zero strains and forces.
BeamRecord record_guide(const ReferenceCurve& curve, const Eigen::Vector3d& gravity) {
  BeamRecord record;
  for (int j = 0; j < curve.segment_count(); ++j) {
    ElementRecord& element = record.elements.emplace_back();
    element.control_points = curve.segment(j).points();
    element.drawn_points = element.control_points.colwise().hnormalized();
    element.s_start = curve.breaks()[j];
    element.s_end = curve.breaks()[j + 1];
    element.strain = element.axial_force = element.bending_moment = Eigen::Vector4d::Zero();
    element.stress = Eigen::Vector4d::Constant(SectionRecord::no_number);
    element.velocity.setZero();
    for (int i = 0; i < 4; ++i) element.curvature[i] = curve.geometry(j, i / 3.0).curvature[0];
  }
  for (int j = 0; j < curve.segment_count() + (curve.closed() ? 0 : 1); ++j) {
    record.node_s.push_back(curve.breaks()[j]);
    record.node_positions.push_back(curve.position(curve.breaks()[j]));
    record.node_slopes.push_back(curve.tangent(curve.breaks()[j], true));
  }
  record.length = curve.length();
  record.sag = sag(record.elements, gravity);
  for (Extreme BeamRecord::*zero :
       {&BeamRecord::axial_force_min, &BeamRecord::axial_force_max, &BeamRecord::moment_max,
        &BeamRecord::shear_force_max, &BeamRecord::displacement_max})
    record.*zero = {0, 0};
  return record;
}

// Records the elements of spans that follow one another. `twisted`: twist since the start of the beam, at the
// end of the span before; it is moved on.
void record_spans(const CarriedBySpans& carried, const BendingLayers& bent, const BeamSystem& system,
                  const State& state, int first, int end, double& twisted,
                  std::vector<ElementRecord>& elements) {
  elements.reserve(static_cast<std::size_t>(end - first));
  for (int i = first; i < end; ++i) {
    ElementRecord& element = elements.emplace_back(record_element(system, state, i, carried[i]));
    element.twist.array() += twisted;
    twisted = element.twist[3];
    if (std::binary_search(bent.unseen.begin(), bent.unseen.end(), i)) blank_bending(element);
  }
}

void hand_over(int beam, const TakeElements& take, BeamRecord& record) {
  record.handed_over += record.elements.size();
  take(beam, record.elements);
  record.elements.clear();
}

// Hands the elements over in stretches; their extremes and the sag stay in the record.
void record_in_stretches(const CarriedBySpans& carried, const BendingLayers& bent, const BeamSystem& system,
                         const State& state, int b, const TakeElements& take, BeamRecord& record) {
  const int first = system.mesh().first_span[b], end = system.mesh().first_span[b + 1];
  Chord chord(span_control_points(system, state, first), span_control_points(system, state, end - 1),
              system.model().gravity);
  double twisted = 0;
  BeamExtremes extremes(system, state, carried, b);
  for (int i = first; i < end; i += at_once) {
    record_spans(carried, bent, system, state, i, std::min(i + at_once, end), twisted, record.elements);
    extremes.look_at(record.elements, i);
    for (const ElementRecord& element : record.elements) chord.look_at(element.control_points);
    hand_over(b, take, record);
  }
  extremes.finish(record);
  record.sag = sag_near(system, state, b, first + chord.lowest()).depth;
}

BeamRecord record_with(const CarriedBySpans& carried, const BeamSystem& system, const State& state, int b,
                       const TakeElements& take = nullptr) {
  const Mesh& mesh = system.mesh();
  const ReferenceCurve& curve = system.model().beams[b].curve;
  if (system.model().beams[b].rigid) {
    BeamRecord record = record_guide(curve, system.model().gravity);
    if (take) hand_over(b, take, record);
    return record;
  }
  BeamRecord record;
  const BendingLayers bent = bending_layers(system, state, carried, b);
  if (take) {
    record_in_stretches(carried, bent, system, state, b, take, record);
  } else {
    double twisted = 0;
    record_spans(carried, bent, system, state, mesh.first_span[b], mesh.first_span[b + 1], twisted,
                 record.elements);
    BeamExtremes extremes(system, state, carried, b);
    extremes.look_at(record.elements, mesh.first_span[b]);
    extremes.finish(record);
    record.sag = sag(record.elements, system.model().gravity);
  }
  find_extremes(bent, record);
  for (auto* each : {&record.node_positions, &record.node_slopes}) each->reserve(mesh.nodes[b].size());
  record.node_s.reserve(mesh.nodes[b].size());
  for (const MeshNode& node : mesh.nodes[b]) {
    record.node_positions.push_back(vector_at(system, state.q, node.r));
    record.node_slopes.push_back(vector_at(system, state.q, node.slope_left));
    record.node_s.push_back(place_of(curve, node, state));
  }
  record.length = beam_length(system, state, b);
  return record;
}

// A place within this part of the beam's length is the same place.
constexpr double same_place = 1e-9;

double moved_to_side(const BeamSystem& system, const ProbePlace& probe, double from) {
  const double little = same_place * system.model().beams[probe.beam].curve.length();
  return probe.side == ProbePlace::Side::after ? from + little : from - little;
}

// Where the section of a probe is: on its side of what acts there.
double section_place(const BeamSystem& system, const ProbePlace& probe, const SpanResultants& carried) {
  const double little = same_place * system.model().beams[probe.beam].curve.length();
  for (const SpanResultants::Inside& point : carried.inside())
    if (std::abs(probe.s - point.action.s) <= little) return moved_to_side(system, probe, point.action.s);
  return probe.s;
}

// Whether a place of a beam is on a reel, where it has no element.
bool is_stored(const BeamSystem& system, const State& state, const ProbePlace& probe) {
  if (system.model().beams[probe.beam].rigid || system.model().beams[probe.beam].is_ring()) return false;
  const Mesh& mesh = system.mesh();
  const int first = mesh.first_span[probe.beam], last = mesh.first_span[probe.beam + 1] - 1;
  const double little = same_place * system.model().beams[probe.beam].curve.length();
  return probe.s < mesh.spans[first].start(state.q) - little ||
         probe.s > mesh.spans[last].end(state.q) + little;
}

ProbeRecord empty_probe(bool felt) {
  ProbeRecord record;
  record.position = record.velocity = record.displacement =
      Eigen::Vector3d::Constant(SectionRecord::no_number);
  if (felt) record.felt = FeltRecord{record.position, record.position};
  for (const auto value : {&SectionRecord::axial_force, &SectionRecord::bending_moment,
                           &SectionRecord::torque, &SectionRecord::shear_force, &SectionRecord::stress})
    record.section.*value = SectionRecord::no_number;
  return record;
}

// The record of a place without its section.
ProbeRecord record_place(const BeamSystem& system, const State& state, const ProbePlace& probe) {
  const MaterialPoint<3> p = probe.span < 0 ? material_point(system, state, probe.beam, probe.s)
                                            : material_point_in(system, state, probe.span, probe.s);
  ProbeRecord record;
  record.position = p.r;
  record.velocity = p.velocity;
  record.felt = felt_at(system, state, probe.beam, probe.s);
  if (system.model().beams[probe.beam].rigid) {
    record.section.curvature = p.rss.norm();
    record.section.stress = SectionRecord::no_number;
  } else {
    record.displacement = p.r - system.model().beams[probe.beam].curve.position(probe.s);
  }
  return record;
}

ProbeRecord record_probe(const BeamSystem& system, const State& state, const ProbePlace& probe) {
  ProbeRecord record = record_place(system, state, probe);
  if (system.model().beams[probe.beam].rigid) return record;
  const int span = probe.span < 0 ? span_of(system, state, probe) : probe.span;
  const CarriedBySpans carried(system, state);
  const SpanResultants in_span = carried[span];
  const double s = section_place(system, probe, in_span);
  record.section =
      with_layers(system.model().beams[probe.beam], bending_layers(system, state, carried, probe.beam, span),
                  span, s, section_at(system, state, span, in_span, s));
  record.section.twist += twist_before(system, state, span);
  return record;
}

ReactionRecord record_reaction(const BeamSystem& system, const State& state, int i) {
  const Constraint& constraint = system.model().constraints[i];
  const Grip at = std::visit([](const auto& c) { return c.place(); }, constraint);
  Reaction given = reaction(system, state, state.lambda, i);
  for (int j = 0; j < static_cast<int>(system.model().riders.size()); ++j)
    if (const Rider& rider = system.model().riders[j]; rider.reel && rider.body == at.body)
      given.force = joint_force(system, state, j);  // of the beam on the reel, without what is stored
  const Eigen::Vector3d r = at.body >= 0 ? vector_at(system, state.q, system.mesh().bodies[at.body])
                                         : material_point(system, state, at.beam, at.s).r;
  return {r, given.force, given.couple};
}

std::optional<TurnRecord> record_turn(const BeamSystem& system, const State& state, int body) {
  const int p = system.mesh().attitudes[body];
  if (p < 0) return {};
  const Eigen::Vector4d attitude = state.q.segment<4>(p);
  return TurnRecord{attitude, attitude::spin(attitude, state.v.segment<4>(p))};
}

PointRecord record_body(const BeamSystem& system, const State& state, int body) {
  const int r = system.mesh().bodies[body];
  return {vector_at(system, state.q, r), vector_at(system, state.v, r)};
}

}  // namespace

int span_of(const BeamSystem& system, const State& state, const ProbePlace& probe) {
  if (system.model().beams[probe.beam].rigid) return -1;
  return find_span(system.model(), system.mesh(), state.q, probe.beam, moved_to_side(system, probe, probe.s));
}

double twist_before(const BeamSystem& system, const State& state, int span) {
  const Mesh& mesh = system.mesh();
  double twist = 0;
  for (int i = mesh.first_span[mesh.spans[span].beam]; i < span; ++i) twist += span_twist(system, state, i);
  return twist;
}

BeamRecord record_beam(const BeamSystem& system, const State& state, int beam) {
  return record_with(CarriedBySpans(system, state), system, state, beam);
}

std::vector<BeamRecord> record_beams(const BeamSystem& system, const State& state, const TakeElements& take) {
  const CarriedBySpans carried(system, state);
  std::vector<BeamRecord> records;
  for (int b = 0; b < static_cast<int>(system.model().beams.size()); ++b)
    records.push_back(record_with(carried, system, state, b, take));
  return records;
}

EnergyRecord record_energy(const SystemEnergy& energy) {
  return {.kinetic = energy.kinetic,
          .gravity = energy.gravity,
          .axial = energy.axial,
          .bending = energy.bending + energy.torsion,
          .total = energy.mechanical(),
          .spring = energy.spring};
}

Snapshot record_snapshot(const BeamSystem& system, const State& state, const std::vector<ProbePlace>& probes,
                         const SnapshotContents& contents, const TakeElements& take) {
  const BeamModel& model = system.model();
  Snapshot snapshot;
  snapshot.time = state.t;
  if (contents.beams) snapshot.beams = record_beams(system, state, take);
  for (std::size_t i = 0; contents.probes && i < probes.size(); ++i)
    snapshot.probes.push_back(is_stored(system, state, probes[i]) ? empty_probe(model.accelerations)
                              : contents.sections                 ? record_probe(system, state, probes[i])
                                                                  : record_place(system, state, probes[i]));
  for (int body = 0; body < static_cast<int>(model.bodies.size()); ++body) {
    snapshot.bodies.push_back({record_body(system, state, body), std::nullopt, Eigen::Vector3d::Zero()});
    snapshot.bodies.back().turn = record_turn(system, state, body);
    snapshot.bodies.back().felt = felt_by(system, state, body);
  }
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    BodyRecord& body = snapshot.bodies[model.riders[j].body];
    if (const auto s = place(system, state, j)) body.s = model.beam_of(model.riders[j]).curve.wrapped(*s);
    body.joint_force = joint_force(system, state, j);
    body.holding_force = holding_force(system, state, j);
    if (const std::optional<FrictionForce> friction = sliding_friction(system, state, j)) {
      body.friction_force = friction->along;
      body.stuck = friction->memory.slides == 0 ? 1 : 0;
    }
    const Rider& rider = model.riders[j];
    if (!body.s) continue;
    if (rider.motion) body.drive_force = body.holding_force;
    if (!rider.drive_force.empty()) body.drive_force = value_and_slope(rider.drive_force, state.t).first;
    if (rider.reel) body.drive_force *= rider.reel->sense();  // positive where it takes in
  }
  for (int i = 0; contents.reactions && i < static_cast<int>(model.constraints.size()); ++i)
    snapshot.reactions.push_back(record_reaction(system, state, i));
  for (int i = 0; i < static_cast<int>(model.connectors.size()); ++i) {
    const auto [length, force] = length_and_force(system, state, i);
    const auto [from, to] = connector_ends(system, state, i);
    snapshot.connectors.push_back({length, force, from, to});
  }
  for (std::size_t i = 0; contents.measures && i < model.measures.size(); ++i)
    snapshot.measures.push_back(record_measure(system, state, model.measures[i]));
  if (contents.energy) snapshot.energy = record_energy(energy(system, state));
  const std::vector<bool> adrift = bodies_adrift(system, state);
  for (std::size_t i = 0; i < adrift.size(); ++i) snapshot.bodies[i].adrift = adrift[i];
  if (contents.energy) snapshot.energy.adrift = kinetic_energy_adrift(system, state, adrift);
  return snapshot;
}

}  // namespace nurbeam
