#pragma once
#include <array>
#include <optional>

#include "fem/forces/energy.h"
#include "fem/forces/friction_law.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

SystemEnergy energy(const BeamSystem& system, const State& state);
/// Energy of another state of the system, to round-off, from `known`, the energy of a first state. Elements
/// that move alike in both states are not computed again.
SystemEnergy carried_energy(const SystemEnergy& known, const BeamSystem& system, const State& first,
                            const State& other);
/// Work of all forces without weight between two states of the system [J]: by the mean force, of second order
/// in the time between them, exact for dead forces that stay at their place.
double load_work(const BeamSystem& system, const State& from, const State& to);
/// Work of all prescribed motions between two states of the system [J].
double motion_work(const BeamSystem& system, const State& from, const State& to);
/// Power of prescribed motions in a state [W]: lambda . dg/dt.
double motion_power(const BeamSystem& system, const State& state);
/// Energy lost to friction and the air between two states of the system [J]: by the mean force.
double lost_energy(const BeamSystem& system, const State& from, const State& to);
/// Linear momentum [N s] of beams and bodies.
Eigen::Vector3d momentum(const BeamSystem& system, const State& state);
/// Sums over all elements of a motion.
struct MotionSums {
  SystemEnergy energy;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< from momentum() [N s]
  double length = 0;                                   ///< deformed length of one beam [m]
};
MotionSums motion_sums(const BeamSystem& system, const State& state, int beam);
/// Sums of a motion `next` on another mesh, from the sums of (from, state). Elements that are in both meshes
/// and move alike are not computed again. The differences of the others give the new sums to round-off.
MotionSums carried_sums(const MotionSums& sums, const BeamSystem& from, const State& state,
                        const BeamSystem& to, const State& next, int beam);
/// Change of the mechanical energy from (from, state) to (to, next), computed as carried_sums() is [J].
double energy_change(const BeamSystem& from, const State& state, const BeamSystem& to, const State& next);
/// The vector at coordinates first, ... of y, in space, z = 0 in the plane.
Eigen::Vector3d vector_at(const BeamSystem& system, const Eigen::VectorXd& y, int first);
/// Deformed length of a beam [m].
double beam_length(const BeamSystem& system, const State& state, int beam);

/// Force of the beams on the body of a rider: m (a - g) less all other forces on it [N].
Eigen::Vector3d joint_force(const BeamSystem& system, const State& state, int rider);
/// The row of the multiplier of a held or prescribed rider; empty where its place is free.
std::optional<int> row_of_place(const BeamSystem& system, int rider);
/// The force along the beam [N] that keeps a rider in its place: the negative of the multiplier of its place,
/// or the force of the hard stops against which it rests.
double holding_force(const BeamSystem& system, const State& state, int rider);
/// The force of a hard stop on the body that rests against it, or between two bodies that rest against each
/// other [N]; 0 without such a contact.
double contact_force(const BeamSystem& system, const State& state, int stop);
/// The friction of a rider's body; empty where it has none, has left or is held.
std::optional<FrictionForce> sliding_friction(const BeamSystem& system, const State& state, int rider);
/// Length of a connector [m], or its part along its direction, and its pull [N].
std::pair<double, double> length_and_force(const BeamSystem& system, const State& state, int connector);
/// Angle of a rotational connector [rad], and the moment by which it turns its ends back together [N m].
std::pair<double, double> angle_and_moment(const BeamSystem& system, const State& state, int connector);
/// The row of the multiplier of a rod; empty for other connectors.
std::optional<int> row_of_rod(const BeamSystem& system, int connector);
/// Position of a grip [m]. Throws std::invalid_argument where the mesh has no node there; the message begins
/// with `what`.
Eigen::Vector3d grip_place(const BeamSystem& system, const State& state, const Grip& grip,
                           const std::string& what);
/// Positions of the ends of a connector [m].
std::array<Eigen::Vector3d, 2> connector_ends(const BeamSystem& system, const State& state, int connector);
/// s of a rider's body [m], on a ring with the turns since the start; empty when it flies free.
std::optional<double> place(const BeamSystem& system, const State& state, int rider);
double place_rate(const BeamSystem& system, const State& state, int rider);

/// Force and couple of a support on its beam, or of the second of two joined beams on the first: [N], [N m].
struct Reaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();
};
/// The reaction of constraint i of the model; impulses [N s], [N m s] where `multipliers` (of the state or of
/// a projection of velocities) are impulses. Without torsion there is no couple along the beam.
Reaction reaction(const BeamSystem& system, const State& state, const Eigen::VectorXd& multipliers,
                  int constraint);
/// The moment about its axis by which constraint i of the model, whose rotation is prescribed, turns what it
/// holds [N m].
double drive_moment(const BeamSystem& system, const State& state, int constraint);

}  // namespace nurbeam
