#pragma once
#include <atomic>
#include <deque>
#include <memory>
#include <optional>

#include "fem/mesh/mesh_plan.h"
#include "fem/sensitivity/sensitivities.h"
#include "solver/algebra/side_by_side.h"
#include "solver/tangents/rest_adjoint.h"

/// What Sensitivities are made of, for their own source files.
namespace nurbeam {

struct Sensitivities::Parameter {
  NeighbourPair pair;
  std::shared_ptr<const BeamSystem> more = nullptr, less = nullptr;
  /// Whether their mesh is one of before, where they differ in nothing but elements that have outlasted all
  /// changes since: all else is as in the run's own system, at the places that correspond.
  bool lags = false;

  /// Gives them the mesh of the run.
  void catch_up(const MeshedState& at);
  /// The tangent after what `change` makes of the neighbours of a state.
  State change(const State& from, const State& tangent, const std::function<bool(MeshedState&)>& change);
};

/// Of the neighbours of all parameters; and the riders that they hold.
struct Sensitivities::Meshes {
  std::vector<std::pair<MeshPlan, MeshPlan>> plans;  ///< with more and with less of each parameter
  std::vector<bool> held;
};

struct Sensitivities::Record {
  State state;
  bool of_the_moment;
  std::vector<ProbePlace> probes = {};          ///< of the run, with their spans
  std::optional<MotionTangents> tangents = {};  ///< empty where steps have been kept and not gone over
  std::size_t position = 0;                     ///< after so many of them
  std::shared_ptr<const Meshes> meshes;
  std::shared_ptr<const Rest> rest;
  std::shared_ptr<const EquilibratedKkt> factors;  ///< where neighbours go to rests of their own
  std::optional<HeldExtremes> extremes = {};       ///< that are asked for
};

/// A rest of the run, and how its residual changes by each parameter where places of riders correspond.
struct Sensitivities::Rest {
  std::unique_ptr<const BeamSystem> system;
  RestAdjoint adjoint;
  MotionTangents::Matrix dynamics, constraints;
};

/// Steps from where the tangents are.
struct Sensitivities::Stretch {
  double start;  ///< [s]
  KeptSteps steps;
  std::vector<double> by_time = {};       ///< of each, how its length changes with t at its start
  std::vector<std::size_t> records = {};  ///< behind its steps
};

/// Steps with one system that have been linearised, over which tangents go while the run takes the next ones.
struct Sensitivities::Ahead {
  struct Step {
    StepTangent tangent;
    Eigen::RowVectorXd change = {};                          ///< of its length
    MotionTangents::Matrix dynamics = {}, constraints = {};  ///< how its residual changes
    std::atomic<bool> is_over = false;                       ///< tangents are at its end
  };
  Step& next(const GeneralizedAlpha& settings, const BeamSystem& system);

  std::deque<std::unique_ptr<Step>> steps = {};  ///< in their order
  std::size_t most;                              ///< of them
  Eigen::RowVectorXd times = {};                 ///< derivatives of the time at the end of the last
  bool is_going = false;                         ///< and tangents_ are not to be looked at
  Alongside going = {};                          ///< to the end of the last
};

/// By the length of a step that lands on an event: the tangent, and of the distance to it.
struct Sensitivities::Longer {
  State tangent;
  double approach;
};

/// A system of a neighbour, or the run's own, and a state of it.
struct Sensitivities::Beside {
  const BeamSystem& system;
  State state;
};

/// The places and velocities `part` of the tangents by a parameter away.
State moved_along(const State& at, const MotionTangents& tangents, std::size_t parameter, double part);
/// The state `part` of a tangent away.
State moved(const State& from, const State& tangent, double part);
/// Half the difference over `step`.
State rate(const State& more, const State& less, double step);
/// (n, m) zero.
State still(Eigen::Index coordinates, Eigen::Index constraints);

/// Without what only steps need.
MotionTangents of_states(MotionTangents tangents);

[[noreturn]] void singular_step();
[[noreturn]] void not_alike(const char* what);

}  // namespace nurbeam
