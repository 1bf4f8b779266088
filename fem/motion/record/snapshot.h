#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fem/system/material_points.h"

namespace nurbeam {

/// The minimum or the maximum value along a beam, and its place.
struct Extreme {
  double value = std::numeric_limits<double>::quiet_NaN();
  double s = std::numeric_limits<double>::quiet_NaN();  ///< reference arc length [m]
  /// Where the value is that of a layer of bending (BendingLayer): how far this reaches [m].
  std::optional<double> layer = {};
};

struct BeamRecord {
  std::vector<ElementRecord> elements;
  std::size_t handed_over = 0;  ///< elements that TakeElements has taken; they are not among `elements`
  std::vector<Eigen::Vector3d> node_positions, node_slopes;  ///< [m], [-] (left slope at a kink)
  std::vector<double> node_s;                                ///< [m]
  double length = 0;                                         ///< deformed length [m]
  /// Sag below the line between the ends [m]; NaN where there is none (sag.h).
  double sag = std::numeric_limits<double>::quiet_NaN();
  Extreme axial_force_min, axial_force_max;  ///< [N]
  Extreme moment_max, shear_force_max;       ///< maximum magnitude [N m], [N]
  Extreme stress_max;        ///< maximum magnitude [Pa]; NaN where the section does not give it
  Extreme displacement_max;  ///< maximum displacement of the axis from the drawing [m]
  /// The place of a kink without tension, whose moment and stress are not known [m].
  std::optional<double> slack_kink = {};
  /// Maximum magnitudes for a beam with torsion, else NaN [N m], [rad], [Pa].
  Extreme torque_max, twist_max, von_mises_max;
};

struct PointRecord {
  Eigen::Vector3d position, velocity;  ///< [m], [m/s]
};

/// What is felt at a point.
struct FeltRecord {
  Eigen::Vector3d acceleration;  ///< in a frame that turns against the frame [m/s^2]
  /// Acceleration less that of gravity and of the frame over the standard one, 9.80665 m/s^2 [-]: of a rigid
  /// body along its own axes; on a beam along its tangent, to the left and up, by its section or else by
  /// gravity, NaN where these do not say; of another body along the axes of space.
  Eigen::Vector3d load_factor;
  bool in_space = false;  ///< `load_factor` is along the axes of space
};

/// A material point of a beam. Twist is against the start of the beam, here and in the elements of a
/// BeamRecord.
struct ProbeRecord : PointRecord {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< from the drawing [m]
  SectionRecord section;
  std::optional<FeltRecord> felt = {};  ///< where BeamModel::accelerations asks for it
};

/// How a rigid body turns.
struct TurnRecord {
  Eigen::Vector4d attitude;  ///< quaternion (w, x, y, z) of the turn from the drawing [-]
  Eigen::Vector3d spin;      ///< along the axes of the model [rad/s]
};

struct BodyRecord {
  PointRecord point;
  std::optional<double> s;      ///< empty after it has left its beam [m]
  Eigen::Vector3d joint_force;  ///< of the beam on the body [N]
  double holding_force = 0;     ///< along the beam, where its place is prescribed or it has stopped [N]
  /// Friction force along the beam, positive towards the beam's end; whether the body sticks (1) or slides
  /// (0); force of the drive that prescribes its place. NaN without friction or drive [N], [-], [N].
  double friction_force = SectionRecord::no_number, stuck = SectionRecord::no_number,
         drive_force = SectionRecord::no_number;
  bool adrift = false;                  ///< it has left its beam, or hangs on a body that has (bodies_adrift)
  std::optional<TurnRecord> turn = {};  ///< of a rigid body
  /// Of a rigid body and of a place of one; of point masses where BeamModel::accelerations asks for it.
  std::optional<FeltRecord> felt = {};
};

/// Force and couple of a support on its beam, or of the second of two joined beams on the first.
struct ReactionRecord {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();                                 ///< [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();  ///< [N], [N m]
};

struct ConnectorRecord {
  double length = 0;  ///< length, or its part along the connector's direction [m]
  double force = 0;   ///< force that pulls the ends together [N]
  /// Positions of the ends [m]; NaN in results of earlier versions.
  Eigen::Vector3d from = Eigen::Vector3d::Constant(SectionRecord::no_number),
                  to = Eigen::Vector3d::Constant(SectionRecord::no_number);
};

struct EnergyRecord {
  double kinetic = 0, gravity = 0, axial = 0, bending = 0;  ///< [J]; bending includes torsion
  double dissipated = 0;                                    ///< by damping and impacts, since the start [J]
  double input = 0;   ///< work of prescribed motions and of loads without weight, since the start [J]
  double total = 0;   ///< conserved total: the sum of energies, less the input [J]
  double spring = 0;  ///< energy of elastic parts other than beams [J]
  double adrift = 0;  ///< part of the kinetic energy: of bodies that are adrift [J]
};

/// One accepted step of the integrator.
struct StepRecord {
  double time = 0;            ///< at the end of the step [s]
  double size = 0;            ///< [s]
  int newton_iterations = 0;  ///< over all attempts
  int rejected = 0;           ///< attempts thrown away
};

/// All that is stored at one output time, in the model's own coordinates or in those of the world.
struct Snapshot {
  double time = 0;
  std::vector<ProbeRecord> probes;
  std::vector<BodyRecord> bodies;
  std::vector<BeamRecord> beams;
  std::vector<ReactionRecord> reactions;  ///< of the model's constraints, in order
  std::vector<ConnectorRecord> connectors;
  std::vector<Extreme> measures;  ///< of the model's measures, in order; each with its place [m]
  EnergyRecord energy;
  std::vector<StepRecord> steps;  ///< since the previous frame
  double step = 0;                ///< last step size [s]
  int newton_iterations = 0;      ///< since the previous frame
};

/// A place where a snapshot records position and velocity.
struct ProbePlace {
  enum class Side { before, after };
  int beam;
  double s;                 ///< [m]
  int span = -1;            ///< span of the mesh whose element holds the place; -1: the span that holds s
  Side side = Side::after;  ///< where forces or slopes jump at s, up to 1e-9 of the beam's length
};

/// Names in the order of the vectors of a Snapshot.
struct SnapshotNames {
  std::vector<std::string> probes, bodies, beams, reactions, connectors;
  std::vector<std::string> measures;  ///< with their quantity: "cable.sag_1", "ground.clearance"
  /// Whether beams have torsion, so that results include the sections' own axes.
  bool sections = false;
  /// Per body: whether it is a rigid body, and whether what it feels is told; empty: of none.
  std::vector<bool> rigid = {}, felt = {};
  bool felt_at_probes = false;
  /// Whether bodies have friction; whether the model has elastic parts other than beams.
  bool friction = false, springs = false;
};

/// The contents of a snapshot, besides points, bodies, reactions and connectors.
struct SnapshotContents {
  bool beams = true;
  bool probes = true;
  bool sections = true;  ///< sections of probes; without them their SectionRecord is empty
  bool reactions = true;
  bool energy = true;
  bool measures = true;
};

/// Takes elements of beams in their order, some at a time, beam after beam: a record of all would take much
/// memory.
using TakeElements = std::function<void(int beam, std::vector<ElementRecord>& elements)>;

/// The span that holds a place; -1 on a rigid guide, which has none.
int span_of(const BeamSystem& system, const State& state, const ProbePlace& probe);

/// The twist since the drawing that a span has at its start, against the start of its beam [rad]; NaN without
/// torsion, except for the first span.
double twist_before(const BeamSystem& system, const State& state, int span);

/// One beam of a state.
BeamRecord record_beam(const BeamSystem& system, const State& state, int beam);
/// Records of the beams of a state. `take`: takes over their elements, so that the records have none.
std::vector<BeamRecord> record_beams(const BeamSystem& system, const State& state,
                                     const TakeElements& take = nullptr);

/// The energies of a snapshot, without dissipation.
EnergyRecord record_energy(const SystemEnergy& energy);

/// A snapshot of a state with its beams, bodies, probes and energies, without dissipation, in the model's own
/// coordinates. Records of steps are left empty, and all that `contents` leaves out. `take`: see
/// record_beams.
Snapshot record_snapshot(const BeamSystem& system, const State& state, const std::vector<ProbePlace>& probes,
                         const SnapshotContents& contents = {}, const TakeElements& take = nullptr);

}  // namespace nurbeam
