#pragma once
#include <functional>
#include <optional>

#include "fem/motion/record/loaded_between.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A state under its loading.
struct LoadedState {
  State state;
  Loading loading;
};

/// Whether an equilibrium lies on the branch of another one, from which loads have led to it: nothing where
/// loads in between move the model smoothly, else those under which the branch ends (a snap-through) or
/// divides (buckling), to a thousandth of the way. The interval is halved where the tangents at its ends do
/// not lead from one to the other. What is under a fiftieth of the way from no load is left alone: what hangs
/// loosely finds its shape there. Loading 0 where what acts besides loads (tension, the lengths of
/// connectors) buckles what is drawn, and loads could not have bent it so far. Nothing as well where
/// equilibria in between are not found. Sections that turn in their places alone are left out. `from` need
/// not be in equilibrium. Throws Interruption where `interrupted` says so.
std::optional<Loading> find_snap(const BeamSystem& system, const LoadedState& from, const LoadedState& to,
                                 const std::function<bool()>& interrupted);

}  // namespace nurbeam
