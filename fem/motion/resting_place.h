#pragma once
#include <functional>

#include "fem/motion/length_control.h"
#include "fem/motion/meshed_state.h"
#include "fem/motion/simulation_report.h"

namespace nurbeam {

/// Brings a model to equilibrium with all sliding bodies held where they are; the mesh then holds them.
/// False, and the report says why, when none is found.
template <int D>
bool find_held_equilibrium(MeshedState<D>& at, SimulationReport& report);

/// Brings a model that is drawn to equilibrium, its sliding bodies where they rest. They are held, let down
/// the slope in bounded moves that halve where the force along the beam changes sign, and freed for the last
/// digits unless they rest against an end. `interrupted` is asked before each move. Where there is no such
/// place, or no mesh, the report says why.
template <int D>
void find_rest(MeshedState<D>& at, const LengthControl& control, const std::function<bool()>& interrupted,
               SimulationReport& report);

extern template bool find_held_equilibrium<2>(MeshedState<2>&, SimulationReport&);
extern template bool find_held_equilibrium<3>(MeshedState<3>&, SimulationReport&);
extern template void find_rest<2>(MeshedState<2>&, const LengthControl&, const std::function<bool()>&,
                                  SimulationReport&);
extern template void find_rest<3>(MeshedState<3>&, const LengthControl&, const std::function<bool()>&,
                                  SimulationReport&);

}  // namespace nurbeam
