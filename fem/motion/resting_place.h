#pragma once
#include <functional>

#include "fem/motion/meshed_state.h"

namespace nurbeam {

/// Brings a model to equilibrium with all sliding bodies held where they are; the mesh then holds them.
/// False, and the report says why, when none is found.
[[nodiscard]] bool find_held_equilibrium(MeshedState& at, SimulationReport& report);

/// Brings a model that is drawn to equilibrium, its sliding bodies where they rest. They are held, let down
/// the slope in bounded moves that halve where the force along the beam changes sign, and freed for the last
/// digits unless they rest against an end. `interrupted` is asked before each move. Where there is no such
/// place, or no mesh, the report says why.
void find_rest(MeshedState& at, const LengthControl& control, const std::function<bool()>& interrupted,
               SimulationReport& report);

}  // namespace nurbeam
