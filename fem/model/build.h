#pragma once
#include <string>
#include <vector>

#include "fem/model/beam_model.h"

namespace nurbeam {

/// The division of a beam into `elements` in all. They are spread in proportion to length between breaks of
/// the drawing, supports and riders.
struct Division {
  int elements = 20;
};

/// Makes a model part by part, so that its parts fit: nodes where breaks, supports and riders are, indices
/// that exist, places on their beams. Places are reference arc lengths [m]; a place beyond a beam's end is
/// moved to the end.
///
/// All functions throw std::invalid_argument, with the value and the rule, for impossible values.
class ModelBuilder {
 public:
  /// An empty model in the plane (2) or in space (3), with gravity [m/s^2].
  explicit ModelBuilder(int dimension, const Eigen::Vector3d& gravity = {0, 0, 0});

  /// Adds a beam and returns its number in the model. With BeamProperties::sections it has torsion; a curve
  /// without sections then gets those of an Orientation{}.
  int add_beam(ReferenceCurve curve, const Section& section, const Material& material,
               Division division = {});
  int add_beam(ReferenceCurve curve, const BeamProperties& properties, Division division = {});
  /// Adds a beam unchanged, with its home nodes.
  int add_beam(Beam beam);
  /// Adds a rigid guide: bodies slide along the drawn curve itself.
  int add_guide(ReferenceCurve curve);
  /// Gives access to a beam's name and rules before build().
  Beam& beam(int i);

  /// Holds the position.
  ModelBuilder& pin(int beam, double s);
  /// Holds position and direction.
  ModelBuilder& clamp(int beam, double s);
  /// Holds the position across a direction, along which it is free.
  ModelBuilder& guide(int beam, double s, const Eigen::Vector3d& along);
  /// Holds position and roll of a beam with torsion.
  ModelBuilder& fork(int beam, double s);
  /// Joins two beams; a rigid joint keeps their angle, and with torsion the relative orientation of their
  /// sections.
  ModelBuilder& join(int beam_a, double s_a, int beam_b, double s_b, bool rigid = false);

  /// Adds a body and returns its number.
  int add_body(std::string name, double mass);
  /// Adds a body that no rider places.
  int add_body(std::string name, double mass, const Eigen::Vector3d& position,
               const Eigen::Vector3d& velocity = {0, 0, 0});
  /// Adds a rigid body that no rider places, with its inertia about its centre of mass [kg m^2], which is at
  /// `position`; its own axes are those of the model as drawn.
  int add_rigid_body(std::string name, double mass, const Eigen::Matrix3d& inertia,
                     const Eigen::Vector3d& position);
  /// Adds a place of a rigid body, at `position` as drawn, and returns the number of the body that it is.
  int add_point(std::string name, int body, const Eigen::Vector3d& position);
  /// Gives access to a body before build().
  Body& body(int i);
  /// Puts a body on a beam, to slide along it; returns the rider, so that its settings can be changed.
  Rider& slide(int body, int beam, double s, double speed = 0);

  /// Leads a beam through an eyelet: a ring that stands at a point, without mass and friction. Returns the
  /// rider, so that its settings can be changed.
  Rider& lead_through(std::string name, const Eigen::Vector3d& position, int beam, double s);

  /// Leads a beam through an eyelet on a body that no rider places: a pulley, where the body is.
  Rider& lead_through(std::string name, int body, int beam, double s);

  /// Puts the part of a beam before a place, or else behind it, on a reel that stands where the beam is drawn
  /// at the place. Returns the rider that is the mouth of the reel, so that its settings can be changed.
  Rider& wind_up(std::string name, int beam, double s, bool at_start);

  /// Connects two ends with a connector as long as drawn; bodies must have their riders before. Returns the
  /// connector, so that its settings can be changed.
  Connector& connect(const Grip& from, const Grip& to, ConnectorType type, double stiffness = 0);

  /// A dead force [N] or moment [N m] at a place.
  ModelBuilder& force(int beam, double s, const Eigen::Vector3d& value);
  ModelBuilder& moment(int beam, double s, const Eigen::Vector3d& value);
  ModelBuilder& add(Force force);
  ModelBuilder& add(Constraint constraint);

  /// The model so far.
  BeamModel build() const;

 private:
  struct Part {
    bool divided;  // whether the home nodes have been made
    Division division;
  };
  double place(int beam, double s) const;
  double elastic_place(int beam, double s) const;
  const Beam& checked_beam(int i) const;
  int add_beam(Beam beam, Part part);
  int add_ring(std::string name, const Eigen::Vector3d& position);
  Rider& ring_on(int ring, int beam, double s);

  BeamModel model_;
  std::vector<Part> parts_;
};

/// Marks the home nodes of a model with what its supports, riders, connectors and masses hold there, as
/// build() does. Throws std::invalid_argument where a
/// place has no node.
void mark_held_nodes(BeamModel& model);

}  // namespace nurbeam
