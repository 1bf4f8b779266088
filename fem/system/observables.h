#pragma once
#include <array>
#include <optional>

#include "fem/forces/energy.h"
#include "fem/forces/friction_law.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

SystemEnergy energy(const BeamSystem& system, const State& state);
/// That of another state of the system, from `known`, that of a first one: to round-off, and of elements that
/// move alike in both nothing is found anew.
SystemEnergy carried_energy(const SystemEnergy& known, const BeamSystem& system, const State& first,
                            const State& other);
/// Work of all forces but weight between two states of the system [J]: by the mean force, of second order in
/// the time between them, exact for dead forces that stay at their place.
double load_work(const BeamSystem& system, const State& from, const State& to);
/// The same of all prescribed motions.
double motion_work(const BeamSystem& system, const State& from, const State& to);
/// What prescribed motions do in a state [W]: lambda . dg/dt.
double motion_power(const BeamSystem& system, const State& state);
/// Energy that friction and the air take between two states of the system [J]: by the mean force.
double lost_energy(const BeamSystem& system, const State& from, const State& to);
/// Linear momentum [N s] of beams and bodies.
Eigen::Vector3d momentum(const BeamSystem& system, const State& state);
/// Sums over all elements of a motion.
struct MotionSums {
  SystemEnergy energy;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();  ///< as momentum() has it [N s]
  double length = 0;                                   ///< of one beam, deformed [m]
};
MotionSums motion_sums(const BeamSystem& system, const State& state, int beam);
/// Those of a motion `next` on another mesh, from those of (from, state): of the elements that are in both
/// and move alike nothing is found anew. Sums of the others from both sides are to round-off those of all.
MotionSums carried_sums(const MotionSums& sums, const BeamSystem& from, const State& state,
                        const BeamSystem& to, const State& next, int beam);
/// Of the mechanical energy, from (from, state) to (to, next), found alike [J].
double energy_change(const BeamSystem& from, const State& state, const BeamSystem& to, const State& next);
/// y(first), ... as a vector in space, z = 0 in the plane.
Eigen::Vector3d vector_at(const BeamSystem& system, const Eigen::VectorXd& y, int first);
/// Deformed length of a beam [m].
double beam_length(const BeamSystem& system, const State& state, int beam);

/// Force of the beams on the body of a rider, m (a - g) less what all else gives to it [N].
Eigen::Vector3d joint_force(const BeamSystem& system, const State& state, int rider);
/// The row of the multiplier of a held or prescribed rider; empty where its place is free.
std::optional<int> row_of_place(const BeamSystem& system, int rider);
/// The force along the beam [N] that keeps a rider in its place: the negative of that multiplier, or what the
/// hard stops against which it rests give it.
double holding_force(const BeamSystem& system, const State& state, int rider);
/// The force of a hard stop on the body that rests against it, or between two that rest against each other
/// [N]; 0 where none does.
double contact_force(const BeamSystem& system, const State& state, int stop);
/// What the friction of a rider's body does; empty where it has none, has left or is held.
std::optional<FrictionForce> sliding_friction(const BeamSystem& system, const State& state, int rider);
/// Length of a connector [m], or its part along its direction, and its pull [N].
std::pair<double, double> length_and_force(const BeamSystem& system, const State& state, int connector);
/// The row of the multiplier of a rod; empty where a connector is none.
std::optional<int> row_of_rod(const BeamSystem& system, int connector);
/// Where a grip is [m]; std::invalid_argument, with `what` takes hold, where the mesh has no node there.
Eigen::Vector3d grip_place(const BeamSystem& system, const State& state, const Grip& grip,
                           const std::string& what);
/// Where the ends of a connector are [m].
std::array<Eigen::Vector3d, 2> connector_ends(const BeamSystem& system, const State& state, int connector);
/// s of a rider's body [m], on a ring with the turns since the start; empty when it flies free.
std::optional<double> place(const BeamSystem& system, const State& state, int rider);
double place_rate(const BeamSystem& system, const State& state, int rider);

/// What a support gives to its beam, or the second of two joined beams to the first: [N], [N m].
struct Reaction {
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), couple = Eigen::Vector3d::Zero();
};
/// That of constraint i of the model; impulses [N s], [N m s] where `multipliers` (those of the state or of a
/// projection of velocities) are. Without torsion there is no couple along the beam.
Reaction reaction(const BeamSystem& system, const State& state, const Eigen::VectorXd& multipliers,
                  int constraint);

}  // namespace nurbeam
