#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/events/crossing.h"
#include "fem/motion/record/run_event.h"
#include "fem/motion/remesh/meshed_state.h"
#include "solver/steps/integrator.h"

namespace nurbeam {

/// One step of a run as it was accepted.
struct FollowedStep {
  const State& before;
  const IntegratorHistory& history;  ///< at `before`
  const State& after;
  bool repeated;  ///< taken again by Integrator::repeat
  double asked;  ///< upper limit given to the integrator; the system's step limit may have shortened the step
                 ///< [s]
  double rest;   ///< time from `before` to the target of the run's steps [s]
  /// For a step that ends at an event: a function of a state of this or a neighbouring model that is zero at
  /// the event, up to a constant; else empty.
  std::function<double(const BeamSystem&, const State&)> beyond;
};

/// A change of the mesh by projected().
struct FollowedTransfer {
  const MeshedState& before;
  const EnergyKeeping& keeping;
  /// The mesh of a neighbouring motion after the change.
  std::function<std::unique_ptr<BeamSystem>(const MeshedState&)> replanned;
};

/// New accelerations of a state: by make_accelerations_smooth(h), or by balance_accelerations(h, around) from
/// those in `before`.
struct FollowedStart {
  double h;
  std::vector<int> around = {};
  std::optional<Eigen::VectorXd> before = {};  ///< (n)
};

/// A follower learns how each state of a run comes from the one before, so that neighbouring motions can go
/// along. All decisions of the run, such as changes of the mesh and lengths of steps, hold for them too.
class RunFollower {
 public:
  virtual ~RunFollower() = default;
  /// The run begins with the shape as it is drawn.
  virtual void begins(const MeshedState& drawn) = 0;
  /// The state is at rest, on the mesh with which the search for rest ended.
  virtual void rests(const MeshedState& at) = 0;
  /// A step has been taken on the present mesh.
  virtual void steps(const FollowedStep& step) = 0;
  /// Another change has led to `at`. `change` applies it to the state of a neighbouring model, and returns
  /// whether it succeeded. The integrator starts afresh from here.
  virtual void changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) = 0;
  /// A transfer to another mesh has led to `at`; `change` applies it to a neighbour.
  virtual void transfers(const MeshedState& at, const FollowedTransfer& transfer,
                         const std::function<bool(MeshedState&)>& change) = 0;
  /// Accelerations and multipliers of `at` have been computed from its q and v; `change` does this for a
  /// neighbour.
  virtual void starts(const MeshedState& at, const FollowedStart& start,
                      const std::function<bool(MeshedState&)>& change) = 0;
  /// An event has happened at the present time.
  virtual void happens(const RunEvent& event) = 0;
  /// A snapshot of `at` is taken. `of_the_moment`: with accelerations and multipliers of the present moment;
  /// else as the steps have them.
  virtual void records(const MeshedState& at, bool of_the_moment) = 0;
};

/// The corresponding place on a beam of a neighbouring model: home nodes correspond, and places between two
/// of them in proportion [m].
double corresponding_place(const Beam& beam, double s, const Beam& neighbour);
/// The corresponding crossing in a neighbouring model.
Crossing corresponding_crossing(Crossing crossing, const BeamModel& model, const BeamModel& neighbour);

}  // namespace nurbeam
