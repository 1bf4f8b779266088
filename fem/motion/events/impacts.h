#pragma once
#include <optional>
#include <vector>

#include "fem/mesh/stop_distance.h"
#include "fem/motion/remesh/meshed_state.h"

/// Impacts of bodies at hard stops, and of bodies on each other there.
namespace nurbeam {

inline const Stop& stop_of(const BeamSystem& system, int stop) { return system.model().stops[stop]; }
inline StopDistance distance_of(const BeamSystem& system, int stop) {
  return {system.model(), system.mesh(), stop_of(system, stop)};
}
/// Distance of the bodies of a stop that is in place [m], and its rate [m/s].
inline double distance(const BeamSystem& system, const State& state, int stop) {
  return distance_of(system, stop).value(state.q);
}
inline double opening_rate(const BeamSystem& system, const State& state, int stop) {
  return distance_of(system, stop).rate(state.q, state.v);
}
/// Distance from its stop within which a body is at it [m].
double touching(const BeamModel& model, int rider);
/// Whether the bodies of a stop are on their beams and at it.
bool touches(const BeamSystem& system, const State& state, int stop);

/// The speed up to which a body that meets its stop cannot be told from a body that touches it, over such a
/// step [m/s].
double unnoticed_speed(const MeshedState& at, int stop, double step);

/// Per stop: whether contact with it is kept.
std::vector<bool> closed_contacts(const BeamSystem& system);
/// The model with other stops closed; coordinates are the same.
MeshedState with_contacts(const MeshedState& at, std::vector<bool> closed);

/// The way in which bodies have come to a stop.
enum class Arrival {
  in_step,   ///< the bodies moved there in the step
  at_once,   ///< the bodies are there as a step begins
  in_chain,  ///< as at_once, after so many events at one moment that they count as endlessly many
};

MeshedState with_contact(const MeshedState& at, int stop, bool kept);

/// The state after bodies meet a hard stop, by the rules of apply() in contacts.h. Nothing where the mass
/// matrix is singular.
std::optional<MeshedState> hit_stop(const MeshedState& at, int stop, double step, Arrival arrival);

/// Relative round-off of speeds, impulses and accelerations.
constexpr double contact_noise = 1e-13;

}  // namespace nurbeam
