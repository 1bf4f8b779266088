#pragma once
#include <vector>

#include "fem/system/beam_system.h"

namespace nurbeam {

/// Of each body, whether it is adrift: it has left its beam, or hangs by connectors on bodies that have, and
/// nothing else holds it.
std::vector<bool> bodies_adrift(const BeamSystem& system, const State& state);

/// Kinetic energy of the bodies that are adrift [J].
double kinetic_energy_adrift(const BeamSystem& system, const State& state, const std::vector<bool>& adrift);

}  // namespace nurbeam
