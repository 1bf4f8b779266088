#include "fem/model/build.h"

#include <algorithm>
#include <stdexcept>

#include "nurbs/number_text.h"

namespace nurbeam {

namespace {

[[noreturn]] void refuse(const std::string& message) { throw std::invalid_argument(message); }

// Calls visit(beam, s, hold) for every place of a beam that a constraint holds or joins.
template <class Visit>
void for_each_held_place(const BeamModel& model, Visit&& visit) {
  for (const Constraint& constraint : model.constraints) {
    if (const auto* support = std::get_if<Support>(&constraint))
      visit(support->beam, support->s, support->clamped ? Hold::clamp : Hold::position);
    if (const auto* joint = std::get_if<BeamJoint>(&constraint)) {
      visit(joint->beam_a, joint->s_a, Hold::nothing);
      visit(joint->beam_b, joint->s_b, Hold::nothing);
    }
  }
}

std::vector<HomeNode> divided(const BeamModel& model, int b, const Division& division) {
  const ReferenceCurve& curve = model.beams[b].curve;
  std::vector<double> held;
  for_each_held_place(model, [&](int beam, double s, Hold) {
    if (beam == b) held.push_back(s);
  });
  const std::vector<double> fixed = fixed_places(curve, held);
  std::vector<HomeNode> home = home_nodes(fixed, spread_elements(fixed, division.elements));
  if (curve.closed())
    home.front().permanent = home.back().permanent = true;  // the seam is a break of the drawing
  return home;
}

}  // namespace

void mark_held_nodes(BeamModel& model) {
  for_each_held_place(
      model,
      [&](int b, double s, Hold hold) {
        Beam& beam = model.beams[b];
        const int h = beam.home_at(s);
        if (h < 0)
          refuse("a constraint at s = " + text_of(s) + " m of beam \"" + beam.name + "\" needs a node there");
        const auto mark = [&](HomeNode& node) {
          if (hold == Hold::nothing) node.joined = true;
          node.hold = std::max(node.hold, hold);
        };
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
  if (!(beam.properties.mass_per_length > 0))
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

ModelBuilder& ModelBuilder::pin(int beam, double s) { return add(Support{beam, place(beam, s), false}); }
ModelBuilder& ModelBuilder::clamp(int beam, double s) { return add(Support{beam, place(beam, s), true}); }
ModelBuilder& ModelBuilder::fork(int beam, double s) {
  if (!checked_beam(beam).has_torsion())
    refuse("a fork holds the roll of a section: it needs a beam with torsion");
  return add(Support{beam, place(beam, s), false, true});
}

ModelBuilder& ModelBuilder::join(int beam_a, double s_a, int beam_b, double s_b, bool rigid) {
  return add(BeamJoint{beam_a, place(beam_a, s_a), beam_b, place(beam_b, s_b), rigid});
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

SlidingJoint& ModelBuilder::slide(int body, int beam, double s, double speed) {
  if (body < 0 || body >= static_cast<int>(model_.bodies.size()))
    refuse("there is no body " + std::to_string(body) + "; the model has " +
           std::to_string(model_.bodies.size()));
  checked_beam(beam);
  model_.joints.push_back({.body = body, .beam = beam, .s = place(beam, s), .speed = speed, .motion = {}});
  return model_.joints.back();
}

ModelBuilder& ModelBuilder::force(int beam, double s, const Eigen::Vector3d& value) {
  return add(PointLoad{{.beam = beam, .s = place(beam, s), .value = value}});
}

ModelBuilder& ModelBuilder::moment(int beam, double s, const Eigen::Vector3d& value) {
  return add(Moment{{.beam = beam, .s = place(beam, s), .value = value}});
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
  for (const SlidingJoint& joint : model.joints)
    if (const Beam& beam = model.beam_of(joint);
        joint.follows_section && !(beam.has_torsion() && joint.continuous_slope))
      refuse("a body follows the section of a beam with torsion, where its slope is continuous: \"" +
             beam.name + "\" has not both");
  for (int b = 0; b < static_cast<int>(model.beams.size()); ++b)
    if (!parts_[b].divided) model.beams[b].home = divided(model, b, parts_[b].division);
  mark_held_nodes(model);
  return model;
}

}  // namespace nurbeam
