#pragma once
#include <functional>
#include <optional>

#include "fem/motion/record/loaded_between.h"
#include "fem/system/beam_system.h"

namespace nurbeam {

/// A state and its loading.
struct LoadedState {
  State state;
  Loading loading;
};

/// Whether an equilibrium lies on the branch of another one, from which loads have led to it. Nothing where
/// the loads in between move the model smoothly. Else the loading under which the branch ends (a
/// snap-through) or divides (buckling), to a thousandth of the way. An interval of loadings is halved where
/// the tangents at its ends do not lead from one to the other.
///
/// The first fiftieth of the way from no load is left out, as parts that hang loosely find their shape there.
/// Loading 0 means that effects other than loads (tension, lengths of connectors) buckle the drawing, and
/// loads could not have bent it so far.
///
/// Nothing also where equilibria in between are not found for twice what the answer `to` has cost
/// (`cost`, in Newton iterations). Sections that only turn in their places are left out. `from` need not be
/// in equilibrium. Throws Interruption where `interrupted` returns true.
std::optional<Loading> find_snap(const BeamSystem& system, const LoadedState& from, const LoadedState& to,
                                 int cost, const std::function<bool()>& interrupted);

}  // namespace nurbeam
