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

/// A model with another value of a parameter, and its places to be recorded.
struct Neighbour {
  std::shared_ptr<const BeamModel> model;
  std::vector<ProbePlace> probes;
};

/// A parameter, by the models in which it is greater and less by a step.
struct NeighbourPair {
  Neighbour more, less;
  double step;  ///< in the parameter's own unit
};

/// Derivatives of a motion, or of a rest, by parameters of its model, carried along with the run: a tangent
/// for each parameter, all at once. If many parameters and few quantities are asked for, adjoints go back
/// from the quantities instead.
///
///   - At rest: K dq + G'dlambda = -dR, G dq = -dg. In statics each neighbour goes from there to its own
///     equilibrium; or RestAdjoint is used, where only quantities of rests are asked for. Forces in stiff
///     beams are small differences of large numbers. At an equilibrium they are as small as the loads, so
///     that neighbours may be further apart than round-off reaches.
///   - Over a step of generalized-alpha: StepTangent, with the matrix of the step's end; or StepAdjoint.
///     Steps whose length does not depend on the state are kept until another event, at which the tangents go
///     over all of them. From the end of the run adjoints go back over the remaining steps, to the tangents
///     at their start.
///   - Over a transfer to another mesh: TransferTangent, where it can be linearised.
///   - Where an integrator starts, accelerations and multipliers follow from q and v: StartTangent.
///   - Over all other changes, such as a change of the mesh or an impact: half the difference of the same
///     change applied to the states q +- step dq/dp of the neighbours.
///   - A step that lands on an event is longer by dh, so that the event stays where it is: beyond(end + dh
///     d(end)/dh) = 0. Later times are later by dh, and later steps shorter, so that the next time of the run
///     is met again.
///   - A step that the system's step limit has shortened is longer as the limit is.
///
/// dR is half the difference of the residual of the neighbours at the state of the run, where they differ,
/// with riders at corresponding places. If a curve has become longer before a moving element, the same place
/// in metres would strain the element much. The cube of its strain would count, which K does not contain.
/// Decisions of the run (steps of its error control, times of changes of the mesh) hold for the neighbours
/// too: derivatives are those of the discrete motion with these decisions.
class Sensitivities final : public RunFollower {
 public:
  /// Throws std::invalid_argument for an integrator other than generalized-alpha, and for models with parts
  /// that have no tangent: friction, buffers, connectors whose length is found. `probes`: probes of the run
  /// itself; neighbours are recorded on the same elements. `by_adjoint`: tangents of rests, in statics, and
  /// of the last stretch of steps are left out; through_states supplies their effect.
  Sensitivities(const SimulationOptions& options, std::vector<ProbePlace> probes,
                std::vector<NeighbourPair> parameters, bool by_adjoint = false);
  ~Sensitivities() override;

  /// Derivatives of the time of each event of the run, in order, by each parameter [s]; NaN where steps
  /// decide the time, as for changes of the mesh.
  const std::vector<std::vector<double>>& event_times() const { return event_times_; }

  /// The cost of derivatives, apart from changes of the mesh.
  struct Work {
    long tangents = 0;     ///< number taken and factorised: one for each step
    long solves = 0;       ///< number of solutions with tangents
    double residuals = 0;  ///< number of residuals of whole systems
  };
  const Work& work() const { return work_; }

  /// The request to a run: quantities that depend on these records, counted from 0, with these contents, and
  /// on no more than these parts of beams.
  struct Asked {
    std::vector<std::size_t> records;
    std::size_t quantities;
    SnapshotContents contents;
    std::vector<BeamPart> of_beams;
  };
  /// States the request; called after the run. Tangents then go over the remaining steps where this is less
  /// work than adjoints, and where many places share extremes, which adjoints cannot follow.
  void ask(Asked asked);
  /// Snapshots of the two neighbours of one parameter.
  struct Neighbours {
    Snapshot more, less;
  };
  /// Snapshots at the time of a record, of the models in which each parameter is greater and less: in states
  /// step dq/dp away, in statics in their equilibria there. Throws std::runtime_error where these have no
  /// accelerations, or are not found.
  std::vector<Neighbours> neighbours(std::size_t record) const;
  /// The quantities when one record has another snapshot.
  using Quantities = std::function<Eigen::VectorXd(std::size_t record, const Snapshot& snapshot)>;
  /// (quantities x parameters) Derivatives of the quantities by adjoints: their change as the records change,
  /// without the differences between the records' neighbours.
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
  std::optional<ResidualDifferences> differences_;  // of the present systems of the parameters
  MotionTangents tangents_;
  MotionTangents::Matrix dynamics_, constraints_;  // derivatives of the residual by each parameter
  std::shared_ptr<const BeamSystem> system_;
  State state_;                       // state of the run
  std::unique_ptr<Stretch> stretch_;  // steps over which tangents_ have not been taken yet
  Work work_;
  std::vector<std::vector<double>> event_times_;
  std::deque<Record> records_;
  std::shared_ptr<const Meshes> meshes_;  // meshes of the neighbours since the last change
  Asked asked_ = {};
  std::shared_ptr<const Rest> rest_;                // the last rest, for its adjoint
  std::shared_ptr<const EquilibratedKkt> factors_;  // factors of its tangent, for its neighbours
  std::unique_ptr<Ahead> ahead_;  // steps ahead with the present system; they use the other members
};

}  // namespace nurbeam
