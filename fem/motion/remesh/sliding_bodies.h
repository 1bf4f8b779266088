#pragma once
#include <optional>
#include <vector>

#include "fem/motion/remesh/meshed_state.h"

/// Places of the bodies that slide on beams.
namespace nurbeam {

/// Mean length of the standard elements of a rider's beam [m].
double home_spacing(const BeamModel& model, int rider);

/// Distance from one body to another on the same beam [m], on a ring the short way; else infinity.
double distance_between(const MeshedState& at, int rider, int other);
/// Whether a stop keeps two bodies on one beam apart. On an open beam, stops of bodies that stand between
/// them count too.
bool kept_apart(const BeamModel& model, int rider, int other);

/// Distance from one body to the nearest other one on its beam [m]; infinity where it is alone.
double distance_to_others(const MeshedState& at, int rider);

/// Place of each body that a rider holds.
std::vector<BodyPlace> places_of(const MeshedState& at);

/// The failure of a run in which the bodies of two riders on one beam meet.
Failure meeting(const MeshedState& at, int rider, int other);
/// Two bodies that meet on one beam end the run; nothing where all are apart.
[[nodiscard]] std::optional<Failure> meeting_bodies(const MeshedState& at);

}  // namespace nurbeam
