#pragma once
#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "fem/motion/record/held_extremes.h"
#include "fem/motion/run/run_follower.h"
#include "fem/motion/run/simulation.h"
#include "fem/sensitivity/residual_differences.h"
#include "fem/sensitivity/transfer_tangent.h"
#include "solver/algebra/equilibrated_kkt.h"
#include "solver/steps/kept_steps.h"
#include "solver/tangents/step_tangent.h"

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
/// tangent for each, of all at once. Or, where many parameters are asked what they do to few quantities, back
/// from these by adjoints.
///
///   - At rest: K dq + G'dlambda = -dR, G dq = -dg, from where in statics each neighbour goes to its own
///     equilibrium; or RestAdjoint, where nothing but quantities of rests is asked for. Forces are small
///     differences of great numbers in stiff beams: at an equilibrium they are as small as the loads, so that
///     neighbours may be further apart than round-off reaches.
///   - Over a step of generalized-alpha: StepTangent, with the matrix of the step's end; or StepAdjoint:
///   steps
///     whose length does not depend on the state are kept until something else happens, which takes the
///     tangents over all of them. Back over those that are left at the end of the run go adjoints, to the
///     tangents where they begin.
///   - Over a transfer to another mesh: TransferTangent, where it can be linearised.
///   - Where an integrator starts, accelerations and multipliers are those of q and v: StartTangent.
///   - Over all else, as a change of the mesh or an impact: half the difference of what the same does to the
///     states q +- step dq/dp of the neighbours.
///   - A step that lands on an event is longer by dh, for which the event stays where it is: beyond(end + dh
///     d(end)/dh) = 0; times of what comes after are later by as much, and later steps shorter, so that the
///     next time of the run is met again.
///   - A step that the system's step limit has shortened is longer as this is.
///
/// dR is half the difference of the residual of the neighbours at the state of the run, where they differ,
/// and with the places of riders where they correspond: at the same place in metres of a curve that has
/// become longer before it, a moving element is strained so far that the cube of its strain counts, which K
/// knows nothing of. What a run decides - steps of its error control, when the mesh changes - is the same for
/// the neighbours: derivatives are those of the discrete motion with these decisions.
class Sensitivities final : public RunFollower {
 public:
  /// Throws std::invalid_argument for an integrator other than generalized-alpha, and for models that hold
  /// what has no tangent: friction, buffers, connectors whose length is found.
  /// `probes`: of the run itself, where neighbours are recorded on the same elements.
  /// `by_adjoint`: tangents of rests, in statics, and of the last stretch of steps are left out, and
  /// through_states has what they would do.
  Sensitivities(const SimulationOptions& options, std::vector<ProbePlace> probes,
                std::vector<NeighbourPair> parameters, bool by_adjoint = false);
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

  /// What is asked of a run: quantities that look at these records, counted from 0, and there at these
  /// contents, of beams at no more than these parts.
  struct Asked {
    std::vector<std::size_t> records;
    std::size_t quantities;
    SnapshotContents contents;
    std::vector<BeamPart> of_beams;
  };
  /// After the run, before what follows: takes tangents over what steps are left where that is less work than
  /// to go back, and where many places share extremes, which then cannot be followed back.
  void ask(Asked asked);
  /// Of one parameter.
  struct Neighbours {
    Snapshot more, less;
  };
  /// At the time of such a record, snapshots of the models in which each parameter is greater and less, of
  /// states step dq/dp away, in statics of their equilibria there. Throws std::runtime_error where these have
  /// no accelerations, or are not found.
  std::vector<Neighbours> neighbours(std::size_t record) const;
  /// What quantities are where one record has another snapshot.
  using Quantities = std::function<Eigen::VectorXd(std::size_t record, const Snapshot& snapshot)>;
  /// Of the quantities (quantities x parameters), by adjoints: what they change by as the records do, but for
  /// how their neighbours differ.
  MotionTangents::Matrix through_states(const Quantities& quantities);

  void begins(const MeshedState& drawn) override;
  void rests(const MeshedState& at) override;
  void steps(const FollowedStep& step) override;
  void changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) override;
  void transfers(const MeshedState& at, const FollowedTransfer& transfer,
                 const std::function<bool(MeshedState&)>& change) override;
  void starts(const MeshedState& at, const FollowedStart& start,
              const std::function<bool(MeshedState&)>& change) override;
  void happens(const RunEvent& event) override;
  void records(const MeshedState& at, bool of_the_moment) override;

 private:
  struct Parameter;
  struct Meshes;
  struct Record;
  struct Longer;
  struct Rest;
  struct Stretch;
  struct Ahead;
  struct Beside;
  using Shifts = std::vector<std::vector<ResidualDifferences::Shift>>;

  void start_afresh(const MeshedState& at, const std::vector<State>& tangents);
  void go_on_from(const MeshedState& at, ResidualDifferences differences);
  std::vector<bool> let_lag(const MeshedState& before, const BeamSystem& behind,
                            const std::vector<int>& kept);
  std::vector<TransferTangent::Neighbours> go_over(const MeshedState& at, const FollowedTransfer& transfer);
  Eigen::RowVectorXd energies_of_lagging(const State& at, const Eigen::RowVectorXd& before) const;
  void shift_lagging(const State& at, double part);
  void catch_up();
  Beside beside(std::size_t parameter, const State& at, bool more) const;
  void solve_at_rest(const MeshedState& at, const Eigen::SparseMatrix<double>& stiffness);
  void keep_for_adjoint(const MeshedState& at, const Eigen::SparseMatrix<double>& stiffness);
  std::vector<ResidualDifferences::Pair> pairs() const;
  Shifts shifts_at(const State& at) const;
  Shifts find_residual_changes(const State& at, const Eigen::RowVectorXd& time);
  void take_off(const Shifts& shifts, const Eigen::SparseMatrix<double>& stiffness);
  MotionTangents::Matrix curvature_changes(const State& at) const;
  MotionTangents::Matrix residual_changes(const State& at, const MotionTangents::Matrix& q,
                                          const std::vector<int>& rows);
  std::shared_ptr<const BeamSystem> neighbour_at(const Record& record, std::size_t parameter,
                                                 bool more) const;
  void hold_extremes(Record& record);
  Snapshot snapshot(const Record& record, const BeamSystem& system, const State& state,
                    const std::vector<ProbePlace>& probes) const;
  bool has_own_length(const FollowedStep& step) const;
  Eigen::RowVectorXd changes_of_length(const FollowedStep& step) const;
  Longer by_length(const FollowedStep& step) const;
  Eigen::VectorXd rates_with_time(const State& at, double h) const;
  void keep(const FollowedStep& step);
  void carry();
  void arrive();
  Eigen::RowVectorXd times() const;
  void carry_over(const KeptSteps::Step& step, const Eigen::RowVectorXd& change);
  void keep_tangents(Record& record);
  void add_through_steps(const std::vector<std::size_t>& records,
                         const std::function<Eigen::MatrixXd(std::size_t)>& by_state,
                         MotionTangents::Matrix& sum);

  GeneralizedAlpha settings_;
  bool begins_at_rest_, is_static_, by_adjoint_;
  double end_time_;
  std::vector<ProbePlace> probes_;
  std::vector<Parameter> parameters_;
  std::optional<ResidualDifferences> differences_;  // of their present systems
  MotionTangents tangents_;
  MotionTangents::Matrix dynamics_, constraints_;  // change of the residual, by each parameter
  std::shared_ptr<const BeamSystem> system_;
  State state_;                       // of the run
  std::unique_ptr<Stretch> stretch_;  // that tangents_ have not been taken over
  Work work_;
  std::vector<std::vector<double>> event_times_;
  std::deque<Record> records_;
  std::shared_ptr<const Meshes> meshes_;  // of the neighbours, since the last change
  Asked asked_ = {};
  std::shared_ptr<const Rest> rest_;                // the last one, for its adjoint
  std::shared_ptr<const EquilibratedKkt> factors_;  // or of its tangent, for its neighbours
  std::unique_ptr<Ahead> ahead_;  // with the present system; what goes on there looks at the others
};

}  // namespace nurbeam
