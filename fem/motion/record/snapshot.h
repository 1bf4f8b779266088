#pragma once
#include <Eigen/Core>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fem/system/material_points.h"

namespace nurbeam {

/// The least or the greatest value along a beam, and its place.
struct Extreme {
  double value = std::numeric_limits<double>::quiet_NaN();
  double s = std::numeric_limits<double>::quiet_NaN();  ///< reference arc length [m]
};

struct BeamRecord {
  std::vector<ElementRecord> elements;
  std::size_t handed_over = 0;  ///< elements that TakeElements has taken, which are not among these
  std::vector<Eigen::Vector3d> node_positions, node_slopes;  ///< [m], [-] (left slope at a kink)
  std::vector<double> node_s;                                ///< [m]
  double length = 0;                                         ///< deformed [m]
  /// Below the line of its ends [m]; NaN where there is none (sag.h).
  double sag = std::numeric_limits<double>::quiet_NaN();
  Extreme axial_force_min, axial_force_max;  ///< [N]
  Extreme moment_max, shear_force_max;       ///< the largest magnitude [N m], [N]
  Extreme stress_max;                        ///< likewise [Pa]; NaN where the section does not say
  Extreme displacement_max;                  ///< of a node from the drawing [m]
  /// Of a beam with torsion, the largest magnitude, else NaN [N m], [rad], [Pa].
  Extreme torque_max, twist_max, von_mises_max;
};

struct PointRecord {
  Eigen::Vector3d position, velocity;  ///< [m], [m/s]
};

/// A material point of a beam. Twist is against the start of the beam, here and in the elements of a
/// BeamRecord.
struct ProbeRecord : PointRecord {
  Eigen::Vector3d displacement = Eigen::Vector3d::Zero();  ///< from the drawing [m]
  SectionRecord section;
};

struct BodyRecord {
  PointRecord point;
  std::optional<double> s;      ///< empty after it has left its beam [m]
  Eigen::Vector3d joint_force;  ///< of the beam on the body [N]
  double holding_force = 0;     ///< along the beam, where its place is prescribed or it has stopped [N]
  /// Of its friction along the beam, positive towards the beam's end, and whether it sticks (1) or slides
  /// (0); of the drive that prescribes its place; NaN without [N], [-], [N].
  double friction_force = SectionRecord::no_number, stuck = SectionRecord::no_number,
         drive_force = SectionRecord::no_number;
};

/// What a support gives to its beam, or the second of two joined beams to the first.
struct ReactionRecord {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();                                 ///< [m]
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();  ///< [N], [N m]
};

struct ConnectorRecord {
  double length = 0;  ///< or its part along the connector's direction [m]
  double force = 0;   ///< that pulls the ends together [N]
  /// Where its ends are [m]; NaN in results of earlier versions.
  Eigen::Vector3d from = Eigen::Vector3d::Constant(SectionRecord::no_number),
                  to = Eigen::Vector3d::Constant(SectionRecord::no_number);
};

struct EnergyRecord {
  double kinetic = 0, gravity = 0, axial = 0, bending = 0;  ///< [J]; bending: and torsion
  double dissipated = 0;                                    ///< by damping and impacts, since the start [J]
  double input = 0;   ///< work of loads but weight and of prescribed motions, since the start [J]
  double total = 0;   ///< what should not change: the sum, less the input [J]
  double spring = 0;  ///< of what is elastic beside the beams [J]
};

/// One accepted step of the integrator.
struct StepRecord {
  double time = 0;            ///< at its end [s]
  double size = 0;            ///< [s]
  int newton_iterations = 0;  ///< over all attempts
  int rejected = 0;           ///< attempts thrown away
};

/// Everything that is stored at one output time, in the model's own coordinates or in those of the world.
struct Snapshot {
  double time = 0;
  std::vector<ProbeRecord> probes;
  std::vector<BodyRecord> bodies;
  std::vector<BeamRecord> beams;
  std::vector<ReactionRecord> reactions;  ///< of the model's constraints, in order
  std::vector<ConnectorRecord> connectors;
  EnergyRecord energy;
  std::vector<StepRecord> steps;  ///< since the previous frame
  double step = 0;                ///< last step size [s]
  int newton_iterations = 0;      ///< since the previous frame
};

/// A place where a snapshot records position and velocity.
struct ProbePlace {
  int beam;
  double s;       ///< [m]
  int span = -1;  ///< of the mesh, as whose element has it; that which holds it where none is given
};

/// Names in the order of the vectors of a Snapshot.
struct SnapshotNames {
  std::vector<std::string> probes, bodies, beams, reactions, connectors;
  /// Beams have torsion: what is known of their sections' own axes belongs to the results.
  bool sections = false;
  /// Bodies have friction; something is elastic beside the beams.
  bool friction = false, springs = false;
};

/// What a snapshot is taken of, besides points, bodies, reactions and connectors.
struct SnapshotContents {
  bool beams = true;
  bool probes = true;
  bool sections = true;  ///< of probes: else their SectionRecord says nothing
  bool reactions = true;
  bool energy = true;
};

/// Takes elements of a beam, in its order, those of one beam after those of the one before: some at a time,
/// where a record of all would take much room.
using TakeElements = std::function<void(int beam, std::vector<ElementRecord>& elements)>;

/// The span that holds a place; -1 on a rigid guide, which has none.
int span_of(const BeamSystem& system, const State& state, const ProbePlace& probe);

/// The twist since the drawing of what is in a span, at its start and against that of its beam [rad]; NaN
/// without torsion, but for the first.
double twist_before(const BeamSystem& system, const State& state, int span);

/// One beam of a state.
BeamRecord record_beam(const BeamSystem& system, const State& state, int beam);
/// The beams of a state. `take`: takes their elements, of which the records then have none.
std::vector<BeamRecord> record_beams(const BeamSystem& system, const State& state,
                                     const TakeElements& take = nullptr);

/// As a snapshot has it (dissipated: none).
EnergyRecord record_energy(const SystemEnergy& energy);

/// A state with its beams, bodies, probes and energies (dissipated: none), in the model's own coordinates;
/// what is known of steps is left empty, as is what is not among `contents`. `take`: as
/// record_beams has it.
Snapshot record_snapshot(const BeamSystem& system, const State& state, const std::vector<ProbePlace>& probes,
                         const SnapshotContents& contents = {}, const TakeElements& take = nullptr);

}  // namespace nurbeam
