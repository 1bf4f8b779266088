#pragma once
#include <functional>
#include <optional>
#include <vector>

#include "fem/motion/record/loaded_between.h"
#include "fem/motion/record/simulation_report.h"
#include "fem/motion/remesh/meshed_state.h"

namespace nurbeam {

/// The outcome of a search for rest, and its cost.
struct RestReport {
  std::optional<Failure> failure = {};  ///< nothing where rest was found, or the search interrupted
  bool interrupted = false;
  /// Whether bodies that rest neither at an end or a stop nor by friction are free to slide in the state
  /// found. False: they are held, as no equilibrium with free bodies was found nearby.
  bool freed = true;
  bool diverges = false;             ///< StaticReport::diverges of one of the equilibria
  std::optional<Loading> snap = {};  ///< loading under which the model snaps through or buckles on the way
  /// Bodies that were to rest where they are free to slide, and are held, as there is no such rest; with the
  /// forces that hold them.
  std::vector<LooseBody> held_instead = {};
  long load_steps = 0, newton_iterations = 0;
  double length_control_seconds = 0;
};

/// Brings a model to equilibrium with all sliding bodies held where they are; the mesh then holds them.
/// `interrupted` is asked at every Newton iteration, here and below. An interrupted search leaves a state
/// that is no equilibrium.
[[nodiscard]] RestReport find_held_equilibrium(MeshedState& at,
                                               const std::function<bool()>& interrupted = {});

/// Brings a drawn model to the equilibrium in which its motion starts: sliding bodies are held where they
/// are, except those that look for their resting place (StaticPlace). Where they find none, those that may be
/// held are.
[[nodiscard]] RestReport find_start(MeshedState& at, const LengthControl& control,
                                    const std::function<bool()>& interrupted);

/// Brings a drawn model to equilibrium with its sliding bodies where they rest, except those that are to be
/// held (StaticPlace). Bodies are held and descend in bounded moves, halved where the force along the beam
/// changes sign. For the last digits they are freed, unless they rest against an end.
[[nodiscard]] RestReport find_rest(MeshedState& at, const LengthControl& control,
                                   const std::function<bool()>& interrupted);

/// Brings a model from rest to rest under its loads at time t, following the loads from those of State::t.
/// Where it fails, the state is the last equilibrium on the way.
[[nodiscard]] RestReport find_next_rest(MeshedState& at, double t, const LengthControl& control,
                                        const std::function<bool()>& interrupted);

}  // namespace nurbeam
