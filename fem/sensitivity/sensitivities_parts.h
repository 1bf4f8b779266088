#pragma once
#include <atomic>
#include <deque>
#include <memory>
#include <optional>

#include "fem/mesh/mesh_plan.h"
#include "fem/sensitivity/sensitivities.h"
#include "solver/algebra/side_by_side.h"
#include "solver/tangents/rest_adjoint.h"

/// Parts of Sensitivities, for their own source files.
namespace nurbeam {

struct Sensitivities::Parameter {
  NeighbourPair pair;
  std::shared_ptr<const BeamSystem> more = nullptr, less = nullptr;
  /// Whether the neighbours lag: their systems have a former mesh, and differ only in elements that have
  /// outlasted all changes since. All else is as in the run's own system, at corresponding places.
  bool lags = false;

  /// Gives the neighbours the mesh of the run.
  void catch_up(const MeshedState& at);
  /// The tangent of the state that `change` makes, from the two neighbours of a state before it.
  State change(const State& from, const State& tangent, const std::function<bool(MeshedState&)>& change);
};

/// Meshes of the neighbours of all parameters, and the riders that they hold.
struct Sensitivities::Meshes {
  std::vector<std::pair<MeshPlan, MeshPlan>> plans;  ///< with more and with less of each parameter
  std::vector<bool> held;
};

struct Sensitivities::Record {
  State state;
  bool of_the_moment;
  std::vector<ProbePlace> probes = {};  ///< probes of the run, with their spans
  /// Empty where steps were kept and tangents have not gone over them.
  std::optional<MotionTangents> tangents = {};
  std::size_t position = 0;  ///< number of kept steps before it
  std::shared_ptr<const Meshes> meshes;
  std::shared_ptr<const Rest> rest;
  std::shared_ptr<const EquilibratedKkt> factors;  ///< where neighbours go to rests of their own
  std::optional<HeldExtremes> extremes = {};       ///< that the request asks for
};

/// A rest of the run, and the derivatives of its residual by each parameter, with riders at corresponding
/// places.
struct Sensitivities::Rest {
  std::unique_ptr<const BeamSystem> system;
  RestAdjoint adjoint;
  MotionTangents::Matrix dynamics, constraints;
};

/// Kept steps from the present place of the tangents.
struct Sensitivities::Stretch {
  double start;  ///< [s]
  KeptSteps steps;
  std::vector<double> by_time = {};       ///< per step: derivative of its length by t at its start
  std::vector<std::size_t> records = {};  ///< records on its way
};

/// Steps with one system that have been linearised. Tangents go over them while the run takes its next steps.
struct Sensitivities::Ahead {
  struct Step {
    StepTangent tangent;
    Eigen::RowVectorXd change = {};                          ///< derivatives of its length
    MotionTangents::Matrix dynamics = {}, constraints = {};  ///< derivatives of its residual
    std::atomic<bool> is_over = false;                       ///< tangents have reached its end
  };
  Step& next(const GeneralizedAlpha& settings, const BeamSystem& system);

  std::deque<std::unique_ptr<Step>> steps = {};  ///< in order
  std::size_t most;                              ///< largest number of steps
  Eigen::RowVectorXd times = {};                 ///< derivatives of the time at the end of the last step
  bool is_going = false;                         ///< work is going on, and tangents_ must not be read
  Alongside going = {};                          ///< the work up to the end of the last step
};

/// Derivatives by the length of a step that lands on an event: of the state, and of the distance to the
/// event.
struct Sensitivities::Longer {
  State tangent;
  double approach;
};

/// A state beside the run, with its system: that of a neighbour, or the run's own.
struct Sensitivities::Beside {
  const BeamSystem& system;
  State state;
};

/// The state at `part` of the tangents by a parameter, in places and velocities.
State moved_along(const State& at, const MotionTangents& tangents, std::size_t parameter, double part);
/// The state at `part` of a tangent.
State moved(const State& from, const State& tangent, double part);
/// Half the difference of two states over `step`.
State rate(const State& more, const State& less, double step);
/// The zero tangent (n, m).
State still(Eigen::Index coordinates, Eigen::Index constraints);

/// Tangents without the members that only steps need.
MotionTangents of_states(MotionTangents tangents);

[[noreturn]] void singular_step();
[[noreturn]] void not_alike(const char* what);

}  // namespace nurbeam
