#include "fem/model/build.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fem/mesh/drawn_coordinates.h"
#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument(message); }

// Calls visit(beam, s, mark) for every place of a beam that keeps a node: mark(home node) says why.
template <class Visit>
void for_each_kept_place(const BeamModel& model, Visit&& visit) {
  const auto ask = [&](const auto& part) {
    if constexpr (requires { part.for_each_node(visit); }) part.for_each_node(visit);
  };
  for (const Constraint& constraint : model.constraints) std::visit(ask, constraint);
  for (const Force& force : model.forces) std::visit(ask, force);
  std::for_each(model.connectors.begin(), model.connectors.end(), ask);
  std::for_each(model.rotational_connectors.begin(), model.rotational_connectors.end(), ask);
}

std::vector<HomeNode> divided(const BeamModel& model, int b, const Division& division) {
  const ReferenceCurve& curve = model.beams[b].curve;
  std::vector<double> held;
  for_each_kept_place(model, [&](int beam, double s, const auto&) {
    if (beam == b) held.push_back(s);
  });
  const std::vector<double> fixed = fixed_places(curve, held);
  std::vector<HomeNode> home = home_nodes(fixed, spread_elements(fixed, division.elements));
  if (curve.closed())
    home.front().permanent = home.back().permanent = true;  // the seam is a break of the drawing
  return home;
}

// A load across a taut string makes a kink, rounded within the reach sqrt(EI/S) of bending. Where elements
// are much longer than this reach, a continuous slope would be the coarser model.
void allow_kinks(BeamModel& model, int b) {
  constexpr double short_reach = 0.02;  // part of an element's length
  Beam& beam = model.beams[b];
  const double tension = beam.properties.drawn_tension();
  const bool slides = std::any_of(model.riders.begin(), model.riders.end(),
                                  [b](const Rider& joint) { return joint.beam == b; });
  if (!(tension > 0) || slides || beam.has_torsion()) return;
  for (int h = 1; h < beam.home_intervals(); ++h) {
    const double l = std::min(beam.home[h].s - beam.home[h - 1].s, beam.home[h + 1].s - beam.home[h].s);
    const bool is_string = beam.properties.bends_within(short_reach * l, tension);
    if (beam.home[h].kept && is_string) beam.home[h].kind = NodeKind::kink;
  }
}

}  // namespace

void mark_held_nodes(BeamModel& model) {
  for_each_kept_place(
      model,
      [&](int b, double s, const auto& mark) {
        Beam& beam = model.beams[b];
        const int h = beam.home_at(s);
        if (h < 0)
          refuse("what is held at s = " + text_of(s) + " m of beam \"" + beam.name + "\" needs a node there");
        mark(beam.home[h]);
        if (beam.is_ring() && h == 0) mark(beam.home.back());  // the seam
      });
}

ModelBuilder::ModelBuilder(int dimension, const Eigen::Vector3d& gravity) {
  if (dimension != 2 && dimension != 3)
    refuse("a model has dimension 2 or 3, got " + std::to_string(dimension));
  model_.dimension = dimension;
  model_.gravity = gravity;
}

int ModelBuilder::add_beam(Beam beam, Part part) {
  if (beam.curve.dimension() != model_.dimension)
    refuse("a curve of dimension " + std::to_string(beam.curve.dimension()) + " in a model of dimension " +
           std::to_string(model_.dimension));
  if (!beam.rigid && !(beam.properties.mass_per_length > 0))
    refuse("mass_per_length " + text_of(beam.properties.mass_per_length) + " kg/m is not positive");
  if (beam.has_torsion() && model_.dimension != 3) refuse("a beam in the plane has no torsion");
  if (beam.has_torsion() && !beam.curve.has_sections()) beam.curve = beam.curve.oriented({});
  if (beam.name.empty()) beam.name = "beam " + std::to_string(model_.beams.size() + 1);
  model_.beams.push_back(std::move(beam));
  parts_.push_back(part);
  return static_cast<int>(model_.beams.size()) - 1;
}

int ModelBuilder::add_beam(ReferenceCurve curve, const Section& section, const Material& material,
                           Division division) {
  return add_beam(Beam{.name = {},
                       .curve = std::move(curve),
                       .properties = BeamProperties(section, material),
                       .section = section,
                       .material = material,
                       .home = {}},
                  Part{false, division});
}

int ModelBuilder::add_beam(ReferenceCurve curve, const BeamProperties& properties, Division division) {
  return add_beam(Beam{.name = {}, .curve = std::move(curve), .properties = properties, .home = {}},
                  Part{false, division});
}

int ModelBuilder::add_beam(Beam beam) {
  if (beam.home.size() < 2) refuse("a beam that is divided has two home nodes or more");
  return add_beam(std::move(beam), Part{true, {}});
}

int ModelBuilder::add_guide(ReferenceCurve curve) {
  std::vector<HomeNode> home = guide_nodes(curve);
  return add_beam(
      Beam{.name = {}, .curve = std::move(curve), .properties = {}, .rigid = true, .home = std::move(home)},
      Part{true, {}});
}

const Beam& ModelBuilder::checked_beam(int i) const {
  if (i < 0 || i >= static_cast<int>(model_.beams.size()))
    refuse("there is no beam " + std::to_string(i) + "; the model has " +
           std::to_string(model_.beams.size()));
  return model_.beams[i];
}

Beam& ModelBuilder::beam(int i) {
  checked_beam(i);
  return model_.beams[i];
}

double ModelBuilder::place(int b, double s) const {
  if (!(s >= 0)) refuse("s = " + text_of(s) + " m is not on a beam; places start at 0");
  return std::min(s, checked_beam(b).curve.length());
}

// Place on a beam that can be held and loaded, not on a guide.
double ModelBuilder::elastic_place(int b, double s) const {
  if (checked_beam(b).rigid)
    refuse("beam \"" + model_.beams[b].name + "\" is a rigid guide: it is neither held nor loaded");
  return place(b, s);
}

ModelBuilder& ModelBuilder::pin(int beam, double s) {
  return add(Support{beam, elastic_place(beam, s), false});
}
ModelBuilder& ModelBuilder::clamp(int beam, double s) {
  return add(Support{beam, elastic_place(beam, s), true});
}
ModelBuilder& ModelBuilder::guide(int beam, double s, const Eigen::Vector3d& along) {
  if (!(along.norm() > 0)) refuse("a guided support needs the direction that it is free in");
  return add(Support{.beam = beam, .s = elastic_place(beam, s), .guide = along});
}
ModelBuilder& ModelBuilder::fork(int beam, double s) {
  if (!checked_beam(beam).has_torsion())
    refuse("a fork holds the roll of a section: it needs a beam with torsion");
  return add(Support{beam, elastic_place(beam, s), false, true});
}

ModelBuilder& ModelBuilder::join(int beam_a, double s_a, int beam_b, double s_b, bool rigid) {
  return add(BeamJoint{beam_a, elastic_place(beam_a, s_a), beam_b, elastic_place(beam_b, s_b), rigid});
}

int ModelBuilder::add_body(std::string name, double mass) {
  return add_body(std::move(name), mass, Eigen::Vector3d::Zero());
}

int ModelBuilder::add_body(std::string name, double mass, const Eigen::Vector3d& position,
                           const Eigen::Vector3d& velocity) {
  if (!(mass > 0))
    refuse("body \"" + name + "\" has a mass of " + text_of(mass) + " kg; it must be positive");
  model_.bodies.push_back({std::move(name), mass, position, velocity});
  return static_cast<int>(model_.bodies.size()) - 1;
}

int ModelBuilder::add_rigid_body(std::string name, double mass, const Eigen::Matrix3d& inertia,
                                 const Eigen::Vector3d& position) {
  if (model_.dimension != 3)
    throw std::invalid_argument("rigid body \"" + name + "\" needs a model in space");
  const int body = add_body(std::move(name), mass, position);
  model_.bodies[body].rigid = RigidBody{.inertia = inertia};
  return body;
}

int ModelBuilder::add_point(std::string name, int body, const Eigen::Vector3d& position) {
  const Body& of = this->body(body);
  if (!of.rigid) throw std::invalid_argument("body \"" + of.name + "\" is a point mass, which has no places");
  const Eigen::Vector3d arm = position - of.position, now = of.position + of.rigid->attitude * arm;
  model_.bodies.push_back({.name = std::move(name), .mass = 0, .position = now});
  model_.bodies.back().point_of = BodyPoint{body, arm};
  return static_cast<int>(model_.bodies.size()) - 1;
}

Body& ModelBuilder::body(int i) {
  if (i < 0 || i >= static_cast<int>(model_.bodies.size()))
    throw std::invalid_argument("there is no body " + std::to_string(i));
  return model_.bodies[i];
}

Rider& ModelBuilder::slide(int body, int beam, double s, double speed) {
  if (body < 0 || body >= static_cast<int>(model_.bodies.size()))
    refuse("there is no body " + std::to_string(body) + "; the model has " +
           std::to_string(model_.bodies.size()));
  checked_beam(beam);
  model_.riders.push_back({.body = body, .beam = beam, .s = place(beam, s), .speed = speed, .motion = {}});
  return model_.riders.back();
}

Rider& ModelBuilder::lead_through(std::string name, const Eigen::Vector3d& position, int beam, double s) {
  const int ring = add_ring(std::move(name), position);
  add(HeldBody{ring, position});
  return ring_on(ring, beam, s);
}

Rider& ModelBuilder::lead_through(std::string name, int body, int beam, double s) {
  const int ring = add_ring(std::move(name), model_.bodies.at(body).position);
  add(CarriedBody{ring, body});
  return ring_on(ring, beam, s);
}

Rider& ModelBuilder::wind_up(std::string name, int beam, double s, bool at_start) {
  const Beam& wound = checked_beam(beam);
  if (wound.is_ring() || wound.has_torsion())
    refuse("beam \"" + wound.name + "\" is a ring or has torsion: no reel takes it in");
  Rider& mouth = lead_through(std::move(name), wound.curve.position(s), beam, s);
  mouth.continuous_slope = true;
  mouth.rest = StaticPlace::held;
  mouth.reel = Reel{.at_start = at_start};
  return mouth;
}

int ModelBuilder::add_ring(std::string name, const Eigen::Vector3d& position) {
  model_.bodies.push_back({.name = std::move(name), .mass = 0, .position = position});
  return static_cast<int>(model_.bodies.size()) - 1;
}

Rider& ModelBuilder::ring_on(int ring, int beam, double s) {
  if (checked_beam(beam).rigid)
    refuse("beam \"" + model_.beams[beam].name + "\" is a rigid guide: it runs through nothing");
  Rider& rider = slide(ring, beam, s);
  rider.continuous_slope = false;
  rider.rest = StaticPlace::free_or_held;
  return rider;
}

ModelBuilder& ModelBuilder::force(int beam, double s, const Eigen::Vector3d& value) {
  return add(PointLoad{{.beam = beam, .s = elastic_place(beam, s), .value = value}});
}

ModelBuilder& ModelBuilder::moment(int beam, double s, const Eigen::Vector3d& value) {
  return add(Moment{{.beam = beam, .s = elastic_place(beam, s), .value = value}});
}

Connector& ModelBuilder::connect(const Grip& from, const Grip& to, ConnectorType type, double stiffness) {
  if (type != ConnectorType::rod && !(stiffness >= 0))
    refuse("a connector with a stiffness of " + text_of(stiffness) + " N/m; it must not be negative");
  if (from.is_point() && to.is_point()) refuse("a connector between two points moves nothing");
  Connector connector{.name = "connector " + std::to_string(model_.connectors.size() + 1),
                      .ends = {from, to},
                      .type = type,
                      .stiffness = stiffness};
  for (Grip& end : connector.ends)
    if (end.beam >= 0) end.s = place(end.beam, end.s);
  connector.length = (drawn_place(model_, connector.ends[1]) - drawn_place(model_, connector.ends[0])).norm();
  model_.connectors.push_back(std::move(connector));
  return model_.connectors.back();
}

ModelBuilder& ModelBuilder::add(Force force) {
  model_.forces.push_back(std::move(force));
  return *this;
}

ModelBuilder& ModelBuilder::add(Constraint constraint) {
  model_.constraints.push_back(std::move(constraint));
  return *this;
}

BeamModel ModelBuilder::build() const {
  BeamModel model = model_;
  for (const Rider& joint : model.riders)
    if (const Beam& beam = model.beam_of(joint);
        joint.follows_section && !(beam.has_torsion() && joint.continuous_slope))
      refuse("a body follows the section of a beam with torsion, where its slope is continuous: \"" +
             beam.name + "\" has not both");
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b)
    if (!parts_[b].divided) model.beams[b].home = divided(model, b, parts_[b].division);
  mark_held_nodes(model);
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b) allow_kinks(model, b);
  return model;
}

}  // namespace nurbeam
