#pragma once
#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/run_follower.h"
#include "fem/motion/simulation.h"
#include "fem/sensitivity/residual_differences.h"
#include "solver/step_tangent.h"

/// Derivatives of a run by parameters of its model.
namespace nurbeam {

/// A model with another value of a parameter, and where it is to be recorded.
struct Neighbour {
  std::shared_ptr<const BeamModel> model;
  std::vector<ProbePlace> probes;
};

/// A parameter: the models in which it is greater and less by a step.
struct NeighbourPair {
  Neighbour more, less;
  double step;  ///< of the parameter's own unit
};

/// Carries the derivatives of a motion, or of a rest, by parameters of its model along with the run: a
/// tangent for each, of all at once.
///
///   - At rest: K dq + G'dlambda = -dR, G dq = -dg; or RestAdjoint, where nothing but quantities of rests is
///     asked for.
///   - Over a step of generalized-alpha: StepTangent, with the matrix of the step's end.
///   - Over all else, as a change of the mesh or an impact: half the difference of what the same does to the
///     states q +- step dq/dp of the neighbours.
///   - A step that lands on an event is longer by dh, for which the event stays where it is: beyond(end + dh
///     d(end)/dh) = 0; times of what comes after are later by as much, and later steps shorter, so that the
///     next time of the run is met again.
///   - A step that the system's step limit has shortened is longer as this is.
///
/// dR is half the difference of the residual of the neighbours at the state of the run, where they differ,
/// and with the places of joints where they correspond: at the same place in metres of a curve that has
/// become longer before it, a moving element is strained so far that the cube of its strain counts, which K
/// knows nothing of. What a run decides - steps of its error control, when the mesh changes - is the same for
/// the neighbours: derivatives are those of the discrete motion with these decisions.
class Sensitivities final : public RunFollower {
 public:
  /// Throws std::invalid_argument for an integrator other than generalized-alpha, and for models that hold
  /// what has no tangent: friction, buffers, connectors whose length is found.
  /// `by_adjoint`, of statics alone: the tangents of the rests are left out, and through_rest has what they
  /// would do.
  Sensitivities(const SimulationOptions& options, std::vector<NeighbourPair> parameters,
                bool by_adjoint = false);
  ~Sensitivities() override;

  /// Derivatives of the time of each event of the run, in order, by each parameter [s]; NaN where steps
  /// decide when: of changes of the mesh.
  const std::vector<std::vector<double>>& event_times() const { return event_times_; }

  /// What derivatives have cost, apart from changes of the mesh.
  struct Work {
    long tangents = 0;     ///< taken and factorised: one for each step
    long solves = 0;       ///< with them
    double residuals = 0;  ///< of whole systems
  };
  const Work& work() const { return work_; }

  /// At the time of snapshot `record` of the run, counted from 0, those of the models in which a parameter is
  /// greater and less, of states step dq/dp away, with these contents. Throws std::runtime_error where these
  /// have no accelerations.
  std::pair<Snapshot, Snapshot> neighbours(std::size_t record, std::size_t parameter,
                                           const SnapshotContents& contents) const;
  /// Of quantities of snapshot `record` (quantities x parameters), by the adjoint of that rest: how they
  /// change with it. What is left is how they differ between its neighbours. `probes`: of the run itself.
  Eigen::MatrixXd through_rest(std::size_t record, const std::vector<ProbePlace>& probes,
                               const SnapshotContents& contents,
                               const std::function<Eigen::VectorXd(const Snapshot&)>& quantities) const;

  void begins(const MeshedState& drawn) override;
  void rests(const MeshedState& at) override;
  void steps(const FollowedStep& step) override;
  void changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) override;
  void happens(const RunEvent& event) override;
  void records(const MeshedState& at, bool of_the_moment) override;

 private:
  struct Parameter;
  struct Meshes;
  struct Record;
  struct Longer;
  struct Rest;
  using Shifts = std::vector<std::vector<ResidualDifferences::Shift>>;

  void start_afresh(const MeshedState& at, const std::vector<State>& tangents);
  void go_on_from(const MeshedState& at);
  void solve_at_rest(const MeshedState& at, const Eigen::SparseMatrix<double>& stiffness);
  void keep_for_adjoint(const MeshedState& at, const Eigen::SparseMatrix<double>& stiffness);
  Shifts find_residual_changes(const State& at, const Eigen::RowVectorXd& time);
  void take_off(const Shifts& shifts, const Eigen::SparseMatrix<double>& stiffness);
  Eigen::RowVectorXd changes_of_length(const FollowedStep& step) const;
  Longer by_length(const FollowedStep& step, const StepTangent& tangent) const;

  GeneralizedAlpha settings_;
  bool begins_at_rest_, by_adjoint_;
  std::vector<Parameter> parameters_;
  std::optional<ResidualDifferences> differences_;  // of their present systems
  std::optional<StepTangent> step_;                 // with the present system
  MotionTangents tangents_;
  MotionTangents::Matrix dynamics_, constraints_;  // change of the residual, by each parameter
  const BeamSystem* system_ = nullptr;
  State state_;  // of the run
  Work work_;
  std::vector<std::vector<double>> event_times_;
  std::vector<Record> records_;
  std::shared_ptr<const Meshes> meshes_;  // of the neighbours, since the last change
  std::shared_ptr<const Rest> rest_;      // the last one, for its adjoint
};

}  // namespace nurbeam
