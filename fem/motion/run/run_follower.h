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

/// One step of a run as it has been accepted.
struct FollowedStep {
  const State& before;
  const IntegratorHistory& history;  ///< at `before`
  const State& after;
  bool repeated;  ///< as by Integrator::repeat
  double asked;   ///< at most of the integrator, which the system's step limit may have shortened [s]
  double rest;    ///< from `before` to the time of the run that steps lead to [s]
  /// Of a step that ends at an event: what is zero there but for a constant, of a state of this model or of a
  /// neighbouring one; else empty.
  std::function<double(const BeamSystem&, const State&)> beyond;
};

/// A change of the mesh by projected().
struct FollowedTransfer {
  const MeshedState& before;
  const EnergyKeeping& keeping;
  /// The mesh of a neighbouring motion behind it.
  std::function<std::unique_ptr<BeamSystem>(const MeshedState&)> replanned;
};

/// Accelerations as make_accelerations_smooth(h) finds them, or balance_accelerations(h, around) those that
/// were there before.
struct FollowedStart {
  double h;
  std::vector<int> around = {};
  std::optional<Eigen::VectorXd> before = {};  ///< (n)
};

/// Is told how each state of a run comes from the one before, so that neighbouring motions can go along: all
/// that the run decides, as when the mesh changes and for how long a step is, is decided for them too.
class RunFollower {
 public:
  virtual ~RunFollower() = default;
  /// The run begins with the shape as it is drawn.
  virtual void begins(const MeshedState& drawn) = 0;
  /// The state is at rest, on the mesh that the search for it has ended with.
  virtual void rests(const MeshedState& at) = 0;
  /// A step has been taken on the present mesh.
  virtual void steps(const FollowedStep& step) = 0;
  /// Something else has led to `at`: what does the same to the state of a neighbouring model, and returns
  /// whether it could. The integrator starts afresh from here.
  virtual void changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) = 0;
  /// It was a transfer to another mesh: `change` does the same.
  virtual void transfers(const MeshedState& at, const FollowedTransfer& transfer,
                         const std::function<bool(MeshedState&)>& change) = 0;
  /// Accelerations and multipliers of `at` have been made those of its q and v: `change` does it too.
  virtual void starts(const MeshedState& at, const FollowedStart& start,
                      const std::function<bool(MeshedState&)>& change) = 0;
  /// It is an event, at the present time.
  virtual void happens(const RunEvent& event) = 0;
  /// A snapshot is taken of `recorded`, with accelerations and multipliers `of_the_moment`, or as the steps
  /// have them.
  virtual void records(const MeshedState& at, bool of_the_moment) = 0;
};

/// The same place on a beam of a neighbouring model: home nodes correspond, and places between two of them in
/// proportion [m].
double corresponding_place(const Beam& beam, double s, const Beam& neighbour);
/// The same crossing in a neighbouring model.
Crossing corresponding_crossing(Crossing crossing, const BeamModel& model, const BeamModel& neighbour);

}  // namespace nurbeam
