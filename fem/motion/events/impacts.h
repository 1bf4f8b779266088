#pragma once
#include <optional>
#include <vector>

#include "fem/mesh/stop_distance.h"
#include "fem/motion/remesh/meshed_state.h"

/// Bodies that meet hard stops, and each other there.
namespace nurbeam {

inline const Stop& stop_of(const BeamSystem& system, int stop) { return system.model().stops[stop]; }
inline StopDistance distance_of(const BeamSystem& system, int stop) {
  return {system.model(), system.mesh(), stop_of(system, stop)};
}
/// How far the bodies of a stop that is in place are from it [m], and how fast that grows [m/s].
inline double distance(const BeamSystem& system, const State& state, int stop) {
  return distance_of(system, stop).value(state.q);
}
inline double opening_rate(const BeamSystem& system, const State& state, int stop) {
  return distance_of(system, stop).rate(state.q, state.v);
}
/// A body is at its stop when it is nearer than this [m].
double touching(const BeamModel& model, int rider);
/// Whether the bodies of a stop are on their beams and at it.
bool touches(const BeamSystem& system, const State& state, int stop);

/// A body that meets its stop no faster than this does not tell from one that touches it, over such a step
/// [m/s].
double unnoticed_speed(const MeshedState& at, int stop, double step);

/// Per stop: whether contact with it is kept.
std::vector<bool> closed_contacts(const BeamSystem& system);
/// The same model with other stops closed; coordinates are the same.
MeshedState with_contacts(const MeshedState& at, std::vector<bool> closed);

/// How bodies have come to a stop.
enum class Arrival {
  in_step,   ///< in which they moved there
  at_once,   ///< they are there as a step begins
  in_chain,  ///< the same, after so many events at that moment that they are taken for endlessly many
};

MeshedState with_contact(const MeshedState& at, int stop, bool kept);

/// What becomes of bodies at a hard stop: as apply() says of contacts.h. Nothing where the mass matrix is
/// singular.
std::optional<MeshedState> hit_stop(const MeshedState& at, int stop, double step, Arrival arrival);

/// What is round-off, of speeds, impulses and accelerations.
constexpr double contact_noise = 1e-13;

}  // namespace nurbeam
