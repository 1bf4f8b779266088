#include "fem/motion/run/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fem/forces/memory.h"
#include "fem/motion/events/friction_modes.h"
#include "fem/motion/events/kinks.h"
#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/motion/rest/find_loose_part.h"
#include "fem/motion/rest/free_lengths.h"
#include "fem/motion/rest/resting_place.h"
#include "fem/motion/run/run_mesh.h"
#include "fem/motion/run/run_passing.h"
#include "fem/motion/run/run_peaks.h"
#include "fem/motion/run/run_step.h"
#include "fem/motion/run/stable_step.h"
#include "fem/system/initial_state.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool replan(MeshedState& at) {
  at.system = at.system->replanned(present_plan(*at.system, at.state));
  at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
  return true;
}

bool take_first_velocities(MeshedState& at) {
  start_moving(*at.system, at.state);
  return project_velocities(*at.system, at.state).status == ConsistencyStatus::done;
}

// Derivatives know only steps that do not settle.
SimulationOptions for_follower(SimulationOptions options, const RunFollower* follower) {
  auto* settings = std::get_if<GeneralizedAlpha>(&options.integrator);
  if (follower && settings) settings->settles = false;
  return options;
}

}  // namespace

// The course of a run: its rest or its motion, and its output on the way.
struct Simulation::Implementation {
 public:
  Implementation(std::shared_ptr<const BeamModel> model, std::vector<ProbePlace> probes,
                 SimulationOptions options, SimulationObserver observer, const Checkpoint* from)
      : run_{.model = std::move(model),
             .options = for_follower(std::move(options), observer.follower),
             .observer = std::move(observer)},
        probes_(std::move(probes)),
        kinks_(kink_times(*run_.model)),
        seams_(seam_times(*run_.model)) {
    if (from) {
      go_on_from(*from);
    } else {
      run_.at = MeshedState::drawn(run_.model);
      if (run_.observer.follower) run_.observer.follower->begins(run_.at);
      run_.report.energy_noise = energy_noise(*run_.model);
      run_.step = run_.options.step.value_or(run_.options.given_step
                                                 ? run_.options.given_step(0).length
                                                 : first_step(*run_.model, run_.options.end_time));
    }
  }

  bool advance() {
    call_ = Clock::now();
    try {
      go_on();
    } catch (...) {
      stop_clock();
      if (phase_ != Phase::motion) {
        run_.report.status = SimulationStatus::interrupted;
        phase_ = Phase::ended;
      }
      throw;
    }
    stop_clock();
    return phase_ != Phase::ended;
  }

  const MeshedState& at() const { return run_.at; }

  SimulationReport report_up_to_now() const {
    SimulationReport report = run_.report;
    report.time = run_.at.state.t;
    report.motion_seconds = seconds_ + (call_ ? seconds_since(*call_) : 0) - report.length_control_seconds;
    return report;
  }

  // A snapshot of the present state. Right after a restart it has the accelerations and multipliers of the
  // moment, as an integrator may average them over its first step.
  Snapshot present(const SnapshotContents& contents, const TakeElements& take = nullptr) const {
    if (run_.restarted) {
      State state = run_.at.state;
      if (make_accelerations_consistent(*run_.at.system, state) == ConsistencyStatus::done)
        return snapshot_of(state, contents, take);
    }
    if (phase_ == Phase::motion)
      return snapshot_of(run_.at_the_moment(*run_.at.system, run_.at.state, run_.last_step), contents, take);
    return snapshot_of(run_.at.state, contents, take);
  }

  // What the observer asks for; of motions always the energies.
  SnapshotContents wanted() const {
    SnapshotContents contents = run_.observer.contents;
    contents.energy |= !run_.options.statics;
    return contents;
  }

  Snapshot snapshot_of(const State& state, const SnapshotContents& contents, const TakeElements& take) const {
    Snapshot snapshot = record_snapshot(*run_.at.system, state, probes_, contents, take);
    snapshot.steps = run_.steps;
    run_.account.enter(snapshot);
    snapshot.step = run_.last_step;
    snapshot.newton_iterations = static_cast<int>(run_.report.newton_iterations - iterations_written_);
    return snapshot;
  }

  Checkpoint checkpoint() const {
    if (!run_.integrator) throw std::invalid_argument("a checkpoint is one of a motion that has begun");
    Checkpoint point = run_.checkpoint();
    point.snapshots = next_output_;
    point.iterations_in_snapshots = iterations_written_;
    point.report = report_up_to_now();
    return point;
  }

  bool change_forces(const std::function<void(std::vector<Force>&)>& change) {
    auto changed = std::make_shared<BeamModel>(*run_.model);
    change(changed->forces);
    run_.model = std::move(changed);
    kinks_ = kink_times(*run_.model);
    seams_ = seam_times(*run_.model);
    MeshedState& at = run_.at;
    at.system =
        std::make_unique<BeamSystem>(run_.model, present_plan(*at.system, at.state), at.system->held());
    leave_former_peaks(run_);
    return phase_ != Phase::motion || run_.restart();
  }

  std::vector<Snapshot> peaks() const { return snapshots_of_peaks(run_); }

 private:
  enum class Phase { start, rest, motion, ended };

  void go_on() {
    switch (phase_) {
      case Phase::start:
        return begin();
      case Phase::rest:
        return rest();
      case Phase::motion:
        return move();
      case Phase::ended:
        return;
    }
  }
  void stop_clock() {
    seconds_ += seconds_since(*call_);
    call_.reset();
  }

  void begin() {
    if (run_.options.statics)
      rest();
    else if (!run_.integrator && !(start_motion() && begin_motion()))
      phase_ = Phase::ended;
    else
      begin_moving();
  }

  // Finds the rest at the next output time.
  void rest() {
    const auto& asked = run_.observer.interrupted;
    const std::vector<double>& times = run_.options.output_times;
    const LengthControl& control = run_.options.length_control;
    const bool found = phase_ == Phase::start
                           ? start_rest() && book(find_rest(run_.at, control, asked))
                           : book(find_next_rest(run_.at, times[next_output_], control, asked));
    if (found && !run_.goes_on(excess_of_wrap(run_.at))) {
      phase_ = Phase::ended;
      return;
    }
    if (found && run_.observer.follower) run_.observer.follower->rests(run_.at);
    if (found) take_snapshot();
    ++next_output_;
    phase_ = found && next_output_ < times.size() ? Phase::rest : Phase::ended;
    if (found && phase_ == Phase::ended) see_what_is_loose();
  }

  // Finds out whether the last rest is one of many.
  void see_what_is_loose() {
    try {
      run_.report.loose = find_loose_part(run_.at, run_.observer.interrupted);
    } catch (const Interruption&) {
      run_.report.status = SimulationStatus::interrupted;
    }
  }

  // Starts statics at the first output time, with the free lengths of connectors that the whole loads give:
  // the structure must not depend on the load steps.
  bool start_rest() {
    const std::vector<double>& times = run_.options.output_times;
    const double first = times.empty() ? run_.at.state.t : times.front();
    const bool whole = times.size() <= 1 && first == 1;
    if (!whole && asks_for_lengths(*run_.model)) {
      run_.at.state.t = 1;
      if (!find_lengths()) return false;
      run_.at = MeshedState::drawn(run_.model);
    }
    run_.at.state.t = first;
    return find_lengths();
  }

  // Finds the free lengths of connectors that the equilibrium gives; returns whether the run goes on.
  bool find_lengths() {
    if (!asks_for_lengths(*run_.model)) return true;
    const bool found = book(find_free_lengths(run_.at, run_.observer.interrupted));
    run_.model = run_.at.system->shared_model();
    return found;
  }

  // Adds the report of a search for rest; returns whether the run goes on.
  bool book(RestReport rest) {
    run_.report.newton_iterations += rest.newton_iterations;
    if (run_.options.statics) run_.report.steps += rest.load_steps;
    run_.report.length_control_seconds += rest.length_control_seconds;
    run_.report.diverges = run_.report.diverges || rest.diverges;
    if (rest.snap && !run_.report.snap) run_.report.snap = rest.snap;
    if (rest.interrupted) run_.report.status = SimulationStatus::interrupted;
    return !rest.interrupted && run_.goes_on(std::move(rest.failure));
  }

  // --- Motion

  bool start_motion() {
    if (!run_.goes_on(meeting_bodies(run_.at))) return false;
    if (run_.options.start_from_equilibrium) {
      if (!find_lengths()) return false;
      RestReport rest = find_start(run_.at, run_.options.length_control, run_.observer.interrupted);
      run_.report.loose_bodies = std::move(rest.held_instead);
      if (!book(std::move(rest))) return false;
      if (run_.observer.follower) run_.observer.follower->rests(run_.at);
      run_.change(&replan);
    }
    if (!run_.change(&take_first_velocities)) return run_.fail(Failure::Kind::initial_velocities);
    if (MemoryPlaces(*run_.model).size > 0) {
      std::optional<std::vector<LooseBody>> loose = start_memory(run_.at, run_.shortest_time());
      if (!loose || !start_contacts(run_.at, run_.shortest_time()))
        return run_.fail(Failure::Kind::mass_matrix);
      if (run_.options.start_from_equilibrium)
        run_.report.loose_bodies.insert(run_.report.loose_bodies.end(), loose->begin(), loose->end());
    }
    return run_.goes_on(excess_of_wrap(run_.at)) && pass_first_impacts(run_) && run_.restart();
  }

  // Starts the account and the mesh of a motion; returns whether it has begun.
  bool begin_motion() {
    run_.account.begin(*run_.at.system, run_.at.state);
    settle_mesh(run_);
    return run_.report.status == SimulationStatus::done;
  }

  // Begins the motion by writing the first output times.
  void begin_moving() {
    phase_ = Phase::motion;
    write_due();
    if (!pass_jump()) return end_early();
    end_at_end_time();
  }

  void go_on_from(const Checkpoint& point) {
    run_.go_on_from(point);
    iterations_written_ = point.iterations_in_snapshots;
    next_output_ = next_output_after(point);
    seconds_ = run_.report.motion_seconds + run_.report.length_control_seconds;
  }

  // The next output time. The checkpoint knows it, if output times are those of its run.
  std::size_t next_output_after(const Checkpoint& point) const {
    const auto& times = run_.options.output_times;
    const double t = point.state.t, near = 1e-12 * std::abs(t);
    const std::size_t next = point.snapshots;
    const bool same = next <= times.size() && (next == 0 || times[next - 1] <= t + near) &&
                      (next == times.size() || times[next] >= t - near);
    return same ? next
                : static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t + near) -
                                           times.begin());
  }

  // Takes a step towards the next output time, and reports it.
  void move() {
    if (run_.observer.interrupted && run_.observer.interrupted()) {
      hand_over();
      run_.report.status = SimulationStatus::interrupted;
      return end_early();
    }
    double& time = run_.at.state.t;
    const auto& times = run_.options.output_times;
    const double output = next_output_ < times.size() ? times[next_output_] : run_.options.end_time;
    // A kink very close to an output time comes first, or it would be passed by.
    const double kink = next_kink(), end = std::min(output, next_seam());
    const double target = kink <= end + run_.resolution() ? kink : end;
    const double rest = target - time;
    if (!take_step(run_, next_step(rest), rest)) return end_early();
    if (std::abs(time - target) < run_.resolution()) time = target;
    if (time == kink && !(pass_kink(run_) && release_bodies(run_))) return end_early();
    if (is_over()) run_.integrator->rest();  // no later step needs its matrix
    write_due();
    // In steps: an instability makes all its energy out of nothing within a few times as many.
    constexpr long watch = 16;
    // Between outputs, light bodies on beams at rest make a little energy for a moment.
    if (time == last_written_ && !run_.goes_on(energy_from_nowhere(0))) return end_early();
    if (run_.report.steps % watch == 0 && !run_.goes_on(energy_from_nowhere(slight_bending(*run_.model))))
      return end_early();
    if (time == kink && !pass_jump()) return end_early();
    leave_former_peaks(run_);
    if (run_.observer.progress) run_.observer.progress(run_.last_record);
    if (run_.observer.checkpoint_due && run_.observer.checkpoint_due()) hand_over();
    end_at_end_time();
  }

  // The length of the next step, where at most `rest` is left of the time to go.
  double next_step(double rest) {
    if (!run_.options.given_step) return rest / std::max(1.0, std::ceil(rest / run_.step - 1e-9));
    const GivenStep given = run_.options.given_step(run_.at.state.t);
    run_.step = given.length;
    return std::min(rest, given.end - run_.at.state.t);
  }

  // Jumps over a jump of tables or of a force, which no step can resolve: the motion goes on after it.
  bool pass_jump() {
    const double after = end_of_jump(kinks_, run_.at.state.t, run_.resolution());
    if (is_over()) return true;
    if (after == run_.at.state.t) return !has_passed_ramp() || run_.restart();
    run_.change([after](MeshedState& at) {
      at.state.t = after;
      return true;
    });
    return pass_kink(run_) && release_bodies(run_) && run_.restart();
  }

  // Whether the last step was a small part of the fixed ones, over a ramp that they do not resolve. It leaves
  // accelerations of motions that are too fast for them.
  bool has_passed_ramp() const {
    constexpr double small = 0.25;
    return run_.options.step && run_.last_step > 0 && run_.last_step < small * *run_.options.step;
  }

  double next_kink() const {
    const double end = run_.options.end_time;
    const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), run_.at.state.t + run_.resolution());
    return kink != kinks_.end() ? std::min(*kink, end) : end;
  }

  // The next seam that is at least a step away: nearer ones, of tables with many rows, are not worth a step.
  double next_seam() const {
    const auto seam = std::lower_bound(seams_.begin(), seams_.end(),
                                       run_.at.state.t + std::max(run_.step, run_.resolution()));
    return seam != seams_.end() ? *seam : run_.options.end_time;
  }

  std::optional<Failure> energy_from_nowhere(double slight) const {
    const std::optional<double> created =
        run_.account.from_nowhere(*run_.at.system, run_.at.state, run_.report, slight);
    if (!created) return {};
    return Failure{.kind = Failure::Kind::energy,
                   .time = run_.at.state.t,
                   .places = places_of(run_.at),
                   .energy = *created};
  }

  bool is_over() const { return run_.at.state.t >= run_.options.end_time - run_.resolution(); }

  void end_at_end_time() {
    if (!is_over()) return;
    phase_ = Phase::ended;
    hand_over();
    show_peaks();
  }

  void show_peaks() const {
    for (Snapshot& snapshot : peaks()) run_.observer.peak(std::move(snapshot));
  }

  void end_early() {
    phase_ = Phase::ended;
    show_peaks();
    if (run_.options.output_times.empty() || run_.at.state.t > last_written_) take_snapshot();
    if (run_.report.failure) look_behind(*run_.report.failure);
  }

  // Looks for the reason behind a failed step or energy from nowhere: both may have one, a step that is too
  // long.
  void look_behind(Failure& failure) {
    if (failure.kind != Failure::Kind::step && failure.kind != Failure::Kind::energy) return;
    if (const auto created = energy_from_nowhere(0)) failure = *created;
    if (!std::holds_alternative<ExplicitRungeKutta>(run_.options.integrator) || !run_.options.step) return;
    const MeshedState drawn = MeshedState::drawn(run_.model);
    const double stable = longest_explicit_step(*drawn.system, drawn.state);
    if (*run_.options.step > stable) failure.stable_step = stable;
  }

  // --- Output

  void hand_over() const {
    if (run_.observer.checkpoint) run_.observer.checkpoint(checkpoint());
  }

  void write_due() {
    const auto& times = run_.options.output_times;
    double& time = run_.at.state.t;
    while (next_output_ < times.size() && times[next_output_] <= time + run_.resolution()) {
      time = std::max(time, times[next_output_]);
      take_snapshot();
      ++next_output_;
    }
  }

  void take_snapshot() {
    const auto& elements = run_.observer.elements;
    const double time = run_.at.state.t;
    Snapshot snapshot = present(
        wanted(), elements ? [&](int beam, auto& some) { elements(time, beam, some); } : TakeElements());
    run_.steps.clear();
    iterations_written_ = run_.report.newton_iterations;
    if (!run_.options.statics) run_.account.record(snapshot, run_.report);
    last_written_ = run_.at.state.t;
    run_.peaks.record();
    if (run_.observer.snapshot) run_.observer.snapshot(std::move(snapshot));
    if (run_.observer.follower) run_.observer.follower->records(run_.at, run_.restarted);
  }

  Run run_;
  const std::vector<ProbePlace> probes_;
  std::vector<double> kinks_;  // kinks of tables, where steps end
  std::vector<double> seams_;  // rows of smooth motions
  Phase phase_ = Phase::start;
  std::size_t next_output_ = 0;
  long iterations_written_ = 0;
  double last_written_ = -1;               // time of the last snapshot
  double seconds_ = 0;                     // of the calls so far, and of the interrupted run
  std::optional<Clock::time_point> call_;  // start of the present call
};

Simulation::Simulation(std::shared_ptr<const BeamModel> model, std::vector<ProbePlace> probes,
                       SimulationOptions options, SimulationObserver observer, const Checkpoint* from)
    : implementation_(std::make_unique<Implementation>(std::move(model), std::move(probes),
                                                       std::move(options), std::move(observer), from)) {}
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation::~Simulation() = default;

bool Simulation::advance() { return implementation_->advance(); }
bool Simulation::change_forces(const std::function<void(std::vector<Force>&)>& change) {
  return implementation_->change_forces(change);
}
const BeamSystem& Simulation::system() const { return *implementation_->at().system; }
const State& Simulation::state() const { return implementation_->at().state; }
Snapshot Simulation::present() const { return implementation_->present(implementation_->wanted()); }
Snapshot Simulation::present(const SnapshotContents& contents) const {
  return implementation_->present(contents);
}
std::vector<Snapshot> Simulation::peaks() const { return implementation_->peaks(); }
SimulationReport Simulation::report() const { return implementation_->report_up_to_now(); }
Checkpoint Simulation::checkpoint() const { return implementation_->checkpoint(); }

SimulationReport simulate(std::shared_ptr<const BeamModel> model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const Checkpoint* from) {
  Simulation simulation(std::move(model), probes, options, observer, from);
  while (simulation.advance()) {
  }
  return simulation.report();
}

SimulationReport simulate(const BeamModel& model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const Checkpoint* from) {
  return simulate(std::make_shared<const BeamModel>(model), probes, options, observer, from);
}

}  // namespace nurbeam
