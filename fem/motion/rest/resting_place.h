#pragma once
#include <functional>
#include <optional>

#include "fem/motion/record/loaded_between.h"
#include "fem/motion/remesh/meshed_state.h"

namespace nurbeam {

/// How a search for rest ended, and what it took.
struct RestReport {
  std::optional<Failure> failure = {};  ///< nothing where it was found, or the search interrupted
  bool interrupted = false;
  /// Whether what rests anywhere but at an end, a stop or by friction is free to slide there in the state
  /// that was found; else it is held, as nothing was found nearby with which it is free.
  bool freed = true;
  bool diverges = false;             ///< StaticReport::diverges of an equilibrium on the way
  std::optional<Loading> snap = {};  ///< what the model snaps through or buckles under, on the way
  long load_steps = 0, newton_iterations = 0;
  double length_control_seconds = 0;
};

/// Brings a model to equilibrium with all sliding bodies held where they are; the mesh then holds them.
/// `interrupted` is asked at every Newton iteration, here and below; a search that it ends leaves a state
/// that is no equilibrium.
[[nodiscard]] RestReport find_held_equilibrium(MeshedState& at,
                                               const std::function<bool()>& interrupted = {});

/// Brings a model that is drawn to the equilibrium that its motion starts from: sliding bodies are held where
/// they are, but for those that say that they look for their place (StaticPlace).
[[nodiscard]] RestReport find_start(MeshedState& at, const LengthControl& control,
                                    const std::function<bool()>& interrupted);

/// Brings a model that is drawn to equilibrium, its sliding bodies where they rest, but for those that
/// are to be held (StaticPlace). They are held, let down
/// the slope in bounded moves that halve where the force along the beam changes sign, and freed for the last
/// digits unless they rest against an end.
[[nodiscard]] RestReport find_rest(MeshedState& at, const LengthControl& control,
                                   const std::function<bool()>& interrupted);

/// Brings a model from rest to rest under its loads at time t, of which those of State::t are followed to it.
/// Where it fails the state is that of the last equilibrium on the way.
[[nodiscard]] RestReport find_next_rest(MeshedState& at, double t, const LengthControl& control,
                                        const std::function<bool()>& interrupted);

}  // namespace nurbeam
