// Long because it is the course of one run: its start, steps, landings and events share what they know of it.
#include "fem/motion/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "fem/forces/memory.h"
#include "fem/motion/crossing.h"
#include "fem/motion/free_lengths.h"
#include "fem/motion/kinks.h"
#include "fem/motion/meshed_state.h"
#include "fem/motion/recentring.h"
#include "fem/motion/resting_place.h"
#include "fem/motion/run_events.h"
#include "fem/motion/sliding_bodies.h"
#include "fem/motion/step_events.h"
#include "fem/system/initial_state.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "solver/consistent.h"

namespace nurbeam {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double neighbours_accuracy =
    1e-14;  // of kept energy, where differences are taken of what comes out

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

struct Simulation::Implementation {
 public:
  Implementation(std::shared_ptr<const BeamModel> model, std::vector<ProbePlace> probes,
                 SimulationOptions options, SimulationObserver observer, const Checkpoint* from)
      : model_(std::move(model)),
        probes_(std::move(probes)),
        options_(std::move(options)),
        observer_(std::move(observer)),
        kinks_(kink_times(*model_)),
        has_events_(no_memory(*model_).size() > 0 ||
                    std::any_of(model_->beams.begin(), model_->beams.end(),
                                [](const Beam& beam) { return beam.rigid; })) {
    if (from) {
      go_on_from(*from);
      next_output_ = from->snapshots;
    } else {
      at_ = MeshedState::drawn(model_);
      if (observer_.follower) observer_.follower->begins(at_);
      report_.strain_noise = strain_noise();
      step_ = options_.step.value_or(step_);
    }
  }

  bool advance() {
    call_ = Clock::now();
    try {
      go_on();
    } catch (...) {
      stop_clock();
      if (phase_ != Phase::motion) {
        report_.status = SimulationStatus::interrupted;
        phase_ = Phase::ended;
      }
      throw;
    }
    stop_clock();
    return phase_ != Phase::ended;
  }

  const MeshedState& at() const { return at_; }

  SimulationReport report_up_to_now() const {
    SimulationReport report = report_;
    report.time = at_.state.t;
    report.motion_seconds = seconds_ + (call_ ? seconds_since(*call_) : 0) - report_.length_control_seconds;
    return report;
  }

  Snapshot present() const {
    Snapshot snapshot = record_snapshot(*at_.system, recorded_state(), probes_);
    snapshot.steps = steps_;
    snapshot.energy.dissipated = dissipated_;
    snapshot.energy.input = input_;
    snapshot.energy.total += dissipated_ - input_;
    snapshot.step = last_step_;
    snapshot.newton_iterations = static_cast<int>(report_.newton_iterations - iterations_written_);
    return snapshot;
  }

  Checkpoint checkpoint() const {
    if (!integrator_) throw std::invalid_argument("a checkpoint is one of a motion that has begun");
    Checkpoint point;
    point.snapshots = next_output_;
    point.plan = at_.system->mesh().plan;
    point.state = at_.state;
    point.history = integrator_->history();
    point.next_step = step_;
    point.last_step = last_step_;
    point.restarted = restarted_;
    point.dissipated = dissipated_;
    point.input = input_;
    point.start_energy = start_energy_;
    for (const Connector& connector : model_->connectors) point.connector_lengths.push_back(connector.length);
    point.iterations_in_snapshots = iterations_written_;
    point.steps = steps_;
    point.report = report_up_to_now();
    return point;
  }

  bool change_forces(const std::function<void(std::vector<Force>&)>& change) {
    auto changed = std::make_shared<BeamModel>(*model_);
    change(changed->forces);
    model_ = std::move(changed);
    kinks_ = kink_times(*model_);
    at_.system = std::make_unique<BeamSystem>(model_, present_plan(*at_.system, at_.state));
    return phase_ != Phase::motion || restart();
  }

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
    if (options_.statics)
      rest();
    else if (!integrator_ && !(start_motion() && begin_motion()))
      phase_ = Phase::ended;
    else
      begin_moving();
  }

  // At the next of the output times.
  void rest() {
    const auto& asked = observer_.interrupted;
    const std::vector<double>& times = options_.output_times;
    if (phase_ == Phase::start && !times.empty()) at_.state.t = times.front();
    const bool found = phase_ == Phase::start
                           ? find_lengths() && book(find_rest(at_, options_.length_control, asked))
                           : book(find_next_rest(at_, times[next_output_], options_.length_control, asked));
    if (found && observer_.follower) observer_.follower->rests(at_);
    if (found) take_snapshot();
    ++next_output_;
    phase_ = found && next_output_ < times.size() ? Phase::rest : Phase::ended;
  }

  // The free lengths of connectors that the equilibrium gives; whether the run goes on.
  bool find_lengths() {
    if (!asks_for_lengths(*model_)) return true;
    const bool found = book(find_free_lengths(at_, observer_.interrupted));
    model_ = at_.system->shared_model();
    return found;
  }

  // Takes over what a search for rest came to; whether the run goes on.
  bool book(RestReport rest) {
    report_.newton_iterations += rest.newton_iterations;
    report_.steps += rest.load_steps;
    report_.length_control_seconds += rest.length_control_seconds;
    if (rest.interrupted) report_.status = SimulationStatus::interrupted;
    return !rest.interrupted && goes_on(std::move(rest.failure));
  }

  bool goes_on(std::optional<Failure> failure) {
    if (!failure) return true;
    report_.fail(std::move(*failure));
    return false;
  }
  bool fail(Failure::Kind kind) { return goes_on(Failure{.kind = kind, .time = at_.state.t}); }
  bool interrupted() const { return observer_.interrupted && observer_.interrupted(); }

  // --- Motion

  bool start_motion() {
    if (!goes_on(meeting_bodies(at_))) return false;
    if (options_.start_from_equilibrium) {
      if (!find_lengths()) return false;
      if (!book(find_start(at_, options_.length_control, observer_.interrupted))) return false;
      if (observer_.follower) observer_.follower->rests(at_);
      change(&replan);
    }
    if (!change(&take_first_velocities)) return fail(Failure::Kind::initial_velocities);
    if (no_memory(*model_).size() > 0 &&
        !(start_memory(at_, shortest_time()) && start_contacts(at_, shortest_time())))
      return fail(Failure::Kind::mass_matrix);
    return restart();
  }

  // --- Checkpoints

  void hand_over() const {
    if (observer_.checkpoint) observer_.checkpoint(checkpoint());
  }

  void go_on_from(const Checkpoint& point) {
    model_ = with_lengths(*model_, point.connector_lengths);
    at_ = {std::make_unique<BeamSystem>(model_, point.plan), point.state};
    integrator_ = start_integrator(options_.integrator, *at_.system, at_.state);
    integrator_->restore(point.state, point.history);
    step_ = point.next_step;
    last_step_ = point.last_step;
    restarted_ = point.restarted;
    dissipated_ = point.dissipated;
    input_ = point.input;
    start_energy_ = point.start_energy;
    iterations_written_ = point.iterations_in_snapshots;
    steps_ = point.steps;
    report_ = point.report;
    report_.strain_noise = strain_noise();
    seconds_ = report_.motion_seconds + report_.length_control_seconds;
  }

  // --- What happens to a state, and to those of neighbouring models that follow

  template <class Change>
  bool change(const Change& change) {
    const bool done = change(at_);
    follow(change);
    return done;
  }
  // What has led to the present state.
  template <class Change>
  void follow(const Change& change) const {
    if (observer_.follower) observer_.follower->changes(at_, change);
  }
  static bool replan(MeshedState& at) {
    at.system = std::make_unique<BeamSystem>(at.system->shared_model(), present_plan(*at.system, at.state));
    at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
    return true;
  }
  static bool take_first_velocities(MeshedState& at) {
    start_moving(*at.system, at.state);
    return project_velocities(*at.system, at.state).status == ConsistencyStatus::done;
  }

  // Shorter than this nothing is followed: the steps of a method for stiff systems.
  double shortest_time() const {
    return std::holds_alternative<GeneralizedAlpha>(options_.integrator) ? step_ : 0;
  }

  // New integrator from at_.state, with consistent accelerations.
  bool restart() {
    const bool consistent = change([time = shortest_time()](MeshedState& at) {
      return make_accelerations_smooth(*at.system, time, at.state) == ConsistencyStatus::done;
    });
    if (!consistent) return fail(Failure::Kind::mass_matrix);
    integrator_ = start_integrator(options_.integrator, *at_.system, at_.state);
    restarted_ = true;
    return true;
  }

  double total_energy() const { return energy(*at_.system, at_.state).mechanical() + dissipated_ - input_; }

  // Whether it has begun.
  bool begin_motion() {
    start_energy_ = total_energy();
    settle_mesh();
    return report_.status == SimulationStatus::done;
  }

  // A step much shorter than the others would take the round-off of positions for velocities. What is left
  // after an event just before an output time is not worth one.
  double resolution() const { return std::max(1e-12 * std::max(1.0, options_.end_time), 1e-5 * step_); }

  void write_due() {
    const auto& times = options_.output_times;
    while (next_output_ < times.size() && times[next_output_] <= at_.state.t + resolution()) {
      at_.state.t = std::max(at_.state.t, times[next_output_]);
      take_snapshot();
      ++next_output_;
    }
  }

  double next_kink() const {
    const auto kink = std::upper_bound(kinks_.begin(), kinks_.end(), at_.state.t + resolution());
    return kink != kinks_.end() ? std::min(*kink, options_.end_time) : options_.end_time;
  }

  // With the first output times behind it.
  void begin_moving() {
    phase_ = Phase::motion;
    write_due();
    end_at_end_time();
  }

  void end_at_end_time() {
    if (at_.state.t < options_.end_time - resolution()) return;
    phase_ = Phase::ended;
    hand_over();
  }

  void end_early() {
    phase_ = Phase::ended;
    if (options_.output_times.empty() || at_.state.t > last_written_) take_snapshot();
  }

  // A step towards the next output time, and what is to be told of it.
  void move() {
    if (interrupted()) {
      hand_over();
      report_.status = SimulationStatus::interrupted;
      return end_early();
    }
    const auto& times = options_.output_times;
    const double output = next_output_ < times.size() ? times[next_output_] : options_.end_time;
    // A kink that an output time cannot be told from comes first: it would be passed by.
    const double kink = next_kink(), target = kink <= output + resolution() ? kink : output;
    const double rest = target - at_.state.t;
    if (!take_step(rest / std::max(1.0, std::ceil(rest / step_ - 1e-9)), rest)) return end_early();
    if (std::abs(at_.state.t - target) < resolution()) at_.state.t = target;
    if (at_.state.t == kink && !(pass_kink() && release_bodies())) return end_early();
    write_due();
    if (!goes_on(energy_from_nowhere())) return end_early();
    if (observer_.progress) observer_.progress(last_record_);
    if (observer_.checkpoint_due && observer_.checkpoint_due()) hand_over();
    end_at_end_time();
  }

  // One accepted step, on the way to a time after `rest`, and what follows from it; `nothing_leaves` a hard
  // stop in it. Returns false when the run cannot go on.
  bool take_step(double step, double rest, bool nothing_leaves = false) {
    const State before = at_.state;
    const IntegratorHistory history = integrator_->history();
    const StepReport taken = step_keeping_energy(before, history, step);
    report_.newton_iterations += taken.newton_iterations;
    report_.rejected_steps += taken.rejected;
    if (taken.status != StepStatus::converged)
      return goes_on(Failure{
          .kind = Failure::Kind::step, .time = at_.state.t, .places = places_of(at_), .step = taken.status});
    if (!options_.step) step_ = taken.next_step;
    ++report_.steps;
    last_step_ = taken.step;
    at_.state = integrator_->state();
    const bool first = std::exchange(restarted_, false);
    const double end = at_.state.t;
    std::optional<Crossing> crossing = first_crossing(*at_.system, before, at_.state);
    if (crossing) land({before, history, at_.state, taken.step}, *crossing);
    const std::optional<StepEvent> event = land_on_event(before, history, nothing_leaves);
    if (event) crossing.reset();
    if (crossing) at_.state = carried_over(*at_.system, std::move(at_.state), taken.step, *crossing);
    const std::optional<Crossing> ending = end_passed(*at_.system, at_.state);
    if (ending) land({before, history, at_.state, at_.state.t - before.t}, *ending);
    if (!crossing && !event && !ending && !options_.step)
      land_on_change({before, history, at_.state, taken.step});
    if (event && at_.state.t == before.t) {
      if (!pass_event(*event, true)) return false;
      // What is pressed to its stop at once stays there for this step, or it would leave and come for ever.
      return !rests_by(*event) || take_step(step, rest, true);
    }
    if (observer_.follower)
      observer_.follower->steps({before, history, at_.state, at_.state.t != end, rest,
                                 distance_to(ending ? ending : crossing, event, before)});
    const double length = at_.state.t == end ? taken.step : at_.state.t - before.t;
    last_record_ = {at_.state.t, length, taken.newton_iterations, taken.rejected};
    steps_.push_back(last_record_);
    if (at_.state.t > before.t)
      dissipated_ += lost_between(before, at_.state) - (first ? unbalanced_work(before, at_.state) : 0);
    if (driven()) input_ += input_work(*at_.system, before, at_.state);
    if (ending && !end_sliding(*ending)) return false;
    note_friction(before, event);
    if (crossing && !ending && !step_over(*crossing)) return false;
    if (event && !ending && !pass_event(*event, false)) return false;
    if (!goes_on(meeting_bodies(at_))) return false;
    settle_mesh();
    return report_.status == SimulationStatus::done && recentre_sections();
  }

  // Of what a step has been landed at, for states of neighbouring models too; empty where it has not.
  std::function<double(const BeamSystem&, const State&)> distance_to(const std::optional<Crossing>& crossing,
                                                                     const std::optional<StepEvent>& event,
                                                                     const State& before) const {
    if (crossing)
      return [this, crossing](const BeamSystem& system, const State& state) {
        return distance_beyond(system, state, in_model(*crossing, system.model()));
      };
    if (event)
      return [event, &before](const BeamSystem& system, const State& state) {
        return std::visit([&](const auto& e) { return beyond(system, before, state, e); }, *event);
      };
    return {};
  }

  // The same crossing in a neighbouring model.
  Crossing in_model(Crossing crossing, const BeamModel& model) const {
    const int beam = model_->joints[crossing.joint].beam;
    crossing.s = corresponding_place(model_->beams[beam], crossing.s, model.beams[beam]);
    return crossing;
  }

  // Exchanges the charts of sections that have turned far; whether the run goes on.
  bool recentre_sections() {
    if (!recentring_due(*at_.system, at_.state)) return true;
    change([](MeshedState& at) {
      at = recentred(*at.system, at.state);
      return true;
    });
    if (!restart()) return false;
    at_.state = integrator_->state();
    return true;
  }

  // A step of at most that length. Under error control one that creates energy, as a wrong root of a snap
  // does, counts as failed.
  StepReport step_keeping_energy(const State& before, const IntegratorHistory& history, double step) {
    constexpr int most_halvings = 12;
    StepReport taken = integrator_->advance(step);
    for (int i = 0; taken.status == StepStatus::converged && !options_.step; ++i) {
      if (!creates_energy(before, integrator_->state())) break;
      const StepReport refused = taken;
      integrator_->restore(before, history);
      if (i < most_halvings)
        taken = integrator_->advance(refused.step / 2);
      else
        taken.status = StepStatus::not_converged;
      taken.newton_iterations += refused.newton_iterations;
      taken.rejected += refused.rejected + 1;
    }
    return taken;
  }

  // By more than error control leaves: a part of the kinetic and strain energy, or of what gravity gave.
  bool creates_energy(const State& before, const State& after) {
    constexpr double most = 0.05, round_off = 1e-10;
    const bool known = !restarted_ && known_energy_.first == before.t;
    const SystemEnergy old = known ? known_energy_.second : energy(*at_.system, before);
    const SystemEnergy now = energy(*at_.system, after);
    known_energy_ = {after.t, now};
    double gained = now.mechanical() - old.mechanical();
    gained += lost_between(before, after) - (restarted_ ? unbalanced_work(before, after) : 0);
    if (driven()) gained -= input_work(*at_.system, before, after);
    const double strain = old.strain(), fallen = std::abs(now.gravity - old.gravity);
    const double scale = std::max({report_.peak_kinetic_energy, old.kinetic, now.kinetic, strain, fallen});
    return gained > most * scale + round_off * (scale + std::abs(old.gravity)) + report_.strain_noise;
  }

  // At a moment where the speeds of prescribed motions jump: bodies that have come to a free end and are to
  // leave it do; the others take their new speeds, as in an impact, whose work is that of the drives.
  bool pass_kink() {
    int jumping = -1;
    for (const MotionKink& kink : motion_kinks(*model_, at_.state.t)) {
      if (at_.system->mesh().plan.modes[kink.joint] == JointMode::free) continue;
      const std::optional<Crossing> end = end_reached(*at_.system, at_.state, kink.joint, kink.before > 0);
      const bool leaves = end && kink.before != 0 && model_->joints[kink.joint].leave_at_end;
      if (!leaves || is_held(*model_, *end))
        jumping = kink.joint;
      else if (!end_sliding(*end))
        return false;
    }
    if (jumping < 0) return true;
    const double before = energy(*at_.system, at_.state).mechanical();
    const bool projected = change([time = shortest_time()](MeshedState& at) {
      return project_velocities(*at.system, at.state, time).status == ConsistencyStatus::done;
    });
    if (!projected)
      return goes_on(Failure{.kind = Failure::Kind::impact, .time = at_.state.t, .joint = jumping});
    input_ += energy(*at_.system, at_.state).mechanical() - before;
    return settle(joints_with_friction(*at_.system), false) && restart();
  }

  // Those that are held until now.
  bool release_bodies() {
    MeshPlan plan = present_plan(*at_.system, at_.state);
    std::vector<RunEvent> events;
    std::vector<int> released;
    for (int j = 0; j < static_cast<int>(model_->joints.size()); ++j)
      if (plan.holds(j) && *model_->joints[j].release <= at_.state.t) {
        plan.held[j] = false;
        if (model_->joints[j].friction) released.push_back(j);
        events.push_back(event_before(at_, EventKind::released, j));
      }
    if (events.empty()) return true;
    change([&plan](MeshedState& at) {
      at.system =
          std::make_unique<BeamSystem>(at.system->shared_model(), plan_like(plan, *at.system, at.state));
      at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
      return true;
    });
    if (!settle(released, true) || !restart()) return false;
    for (RunEvent& event : events) {
      finish_event(at_, event);
      note(std::move(event));
    }
    return true;
  }

  // Writes an event down.
  void note(RunEvent event) {
    if (observer_.follower) observer_.follower->happens(event);
    report_.events.push_back(std::move(event));
  }

  // Repeats the step that was taken so that it ends just before a place.
  void land(const StepTaken& taken, const Crossing& crossing) {
    State landing = landed(*at_.system, *integrator_, taken, crossing);
    at_.state = std::move(landing);
  }

  // Repeats a step in which an event happens so that it ends there.
  std::optional<StepEvent> land_on_event(const State& before, const IntegratorHistory& history,
                                         bool nothing_leaves) {
    std::optional<StepEvent> found;
    if (!has_events_) return found;
    const std::size_t most = model_->joints.size() + model_->stops.size() +
                             model_->connectors.size();  // the first found need not come first
    for (std::size_t i = 0; i <= most && at_.state.t > before.t; ++i) {
      const std::optional<StepEvent> event = first_event(*at_.system, before, at_.state, nothing_leaves);
      if (!event) break;
      const State after = at_.state;
      at_.state = landed(*at_.system, *integrator_, {before, history, after, after.t - before.t}, *event);
      found = event;
    }
    return found;
  }

  // Whether the event has closed a hard stop.
  bool rests_by(const StepEvent& event) const {
    const auto* contact = std::get_if<ContactEvent>(&event);
    return contact && contact->kind == ContactEvent::Kind::hits &&
           at_.system->mesh().plan.is_closed(contact->stop);
  }

  // What the event that a step has ended at does; `at_once`: that the step would begin with. What it takes
  // from the energy is lost.
  bool pass_event(const StepEvent& event, bool at_once) {
    const auto* contact = std::get_if<ContactEvent>(&event);
    if (contact && contact->kind == ContactEvent::Kind::bodies_meet)
      return goes_on(
          Failure{.kind = Failure::Kind::bodies_meet, .time = at_.state.t, .places = places_of(at_)});
    if (const auto* taut = std::get_if<TautEvent>(&event)) {
      apply(at_, *taut);
      follow([&](MeshedState& at) {
        apply(at, *taut);
        return true;
      });
      return restart();
    }
    RunEvent happened = event_before(at_, EventKind::slides, joint_of(*model_, event));
    const auto pass = [&](MeshedState& at) {
      return contact ? apply(at, *contact, shortest_time(), at_once)
                     : apply(at, std::get<FrictionChange>(event), shortest_time(), at_once);
    };
    const std::optional<EventKind> kind = pass(at_);
    if (!kind) return fail(Failure::Kind::mass_matrix);
    follow([&](MeshedState& at) { return pass(at) == kind; });
    happened.kind = *kind;
    dissipated_ += happened.energy_before - energy(*at_.system, at_.state).mechanical();
    if (!restart()) return false;
    finish_event(at_, happened);
    // A follower has been told that it left.
    if (at_once && happened.kind == EventKind::rests_at_stop && has_just_left(happened) &&
        !observer_.follower)
      report_.events.pop_back();
    else
      note(std::move(happened));
    return true;
  }

  // Whether the last event was that the body left its stop at that moment.
  bool has_just_left(const RunEvent& event) const {
    return !report_.events.empty() && report_.events.back().kind == EventKind::leaves_stop &&
           report_.events.back().time == event.time && report_.events.back().body == event.body;
  }

  // Of bodies that stick or slide though their step did not end there.
  void note_friction(const State& before, const std::optional<StepEvent>& located) {
    if (before.memory.size() == 0) return;
    for (const int j : changed_ways(*at_.system, before, at_.state)) {
      if (located && std::holds_alternative<FrictionChange>(*located) && joint_of(*model_, *located) == j)
        continue;
      const bool sticks = sliding_way(*at_.system, at_.state, j) == 0;
      RunEvent event = event_before(at_, sticks ? EventKind::sticks : EventKind::slides, j);
      finish_event(at_, event);
      note(std::move(event));
    }
  }

  // Bodies with friction stick or slide as forces and velocities now are; what sticks stored is lost.
  bool settle(const std::vector<int>& joints, bool at_rest) {
    if (joints.empty()) return true;
    const double before = energy(*at_.system, at_.state).mechanical();
    if (!settle_friction(at_, joints, shortest_time(), at_rest)) return fail(Failure::Kind::mass_matrix);
    dissipated_ += before - energy(*at_.system, at_.state).mechanical();
    return true;
  }

  // Under error control: repeats a step at whose end a change of the mesh is due so that it ends where it
  // falls due. Else when it comes would depend on the steps, and with it how the mesh goes on.
  void land_on_change(const StepTaken& taken) {
    const auto due = [&](const State& state) {
      return next_plan(*at_.system, state, options_.length_control).change != MeshChange::none;
    };
    if (!due(taken.after)) return;
    double before = 0, after = 1;  // in parts of the step
    while (after - before > 1e-9) {
      const double middle = (before + after) / 2;
      (due(between(taken.before, taken.after, middle)) ? after : before) = middle;
    }
    constexpr double shortest = 1e-3;
    if (after < shortest || after > 1 - shortest) return;
    const IntegratorHistory whole = integrator_->history();
    // A repeated step misses what was interpolated by a little.
    for (double miss = 1e-8; miss < 1e-2; miss *= 10) {
      const double length = (after + miss) * taken.length;
      if (integrator_->repeat(taken.before, taken.history, length).status != StepStatus::converged) break;
      if (!due(integrator_->state())) continue;
      at_.state = integrator_->state();
      return;
    }
    integrator_->restore(at_.state, whole);
  }

  // Midpoint rule with the mean rates of the step: what a transient shorter than the step does not falsify.
  double dissipated_between(const State& from, const State& to) const {
    State middle = from;
    const double h = to.t - from.t;
    middle.q = (from.q + to.q) / 2;
    middle.v = (to.q - from.q) / h;
    return h * energy(*at_.system, middle).dissipation;
  }

  double lost_between(const State& from, const State& to) const {
    return (damped() ? dissipated_between(from, to) : 0) + lost_energy(*at_.system, from, to);
  }

  // Of what the accelerations of a restart leave out of balance (make_accelerations_smooth), where damping
  // ends it: transients that the step does not follow, of which the trapezoidal rule takes half.
  double unbalanced_work(const State& from, const State& to) const {
    const auto& stops = model_->stops;
    const auto& connectors = model_->connectors;
    const bool in_buffers = std::any_of(
        stops.begin(), stops.end(), [](const Stop& stop) { return stop.buffer && stop.buffer->damping > 0; });
    const bool in_connectors =
        std::any_of(connectors.begin(), connectors.end(), [](const Connector& c) { return c.damping > 0; });
    if (!damped() && !in_buffers && !in_connectors) return 0;
    Eigen::VectorXd dynamics(at_.system->coordinate_count()), closed(at_.system->constraint_count());
    at_.system->residual(from, dynamics, closed);
    return dynamics.dot(to.q - from.q) / 2;
  }

  double strain_noise() const {
    double stiffness = 0;
    for (const Beam& beam : model_->beams) stiffness += beam.properties.axial_stiffness * beam.curve.length();
    return stiffness * 1e-22 / 2;
  }

  bool damped() const {
    return std::any_of(
        model_->beams.begin(), model_->beams.end(),
        [](const Beam& beam) { return beam.properties.is_damped(); });
  }

  bool driven() const {
    const auto& m = *model_;
    return !m.forces.empty() || !m.air.wind.isZero() ||
           std::any_of(m.joints.begin(), m.joints.end(),
                       [](const auto& joint) { return joint.motion.has_value(); }) ||
           std::any_of(m.beams.begin(), m.beams.end(),
                       [](const Beam& beam) { return !beam.properties.free_strain.thermal.empty(); }) ||
           std::any_of(m.constraints.begin(), m.constraints.end(), [](const Constraint& constraint) {
             const auto* support = std::get_if<Support>(&constraint);
             return support && support->motion;
           });
  }

  // Goes on beyond a place that a joint has landed at: a point in the next element.
  bool step_over(const Crossing& crossing) {
    const bool follows_section = model_->joints[crossing.joint].follows_section;
    const auto go_over = [&](MeshedState& at) {
      const double beyond = landing_tolerance(*model_, crossing.joint);
      at.state.q[at.system->mesh().joints[crossing.joint].place] =
          in_model(crossing, at.system->model()).s + (crossing.forward ? beyond : -beyond);
      auto next = std::make_unique<BeamSystem>(at.system->shared_model(), present_plan(*at.system, at.state));
      if (!follows_section) {
        // Over the seam of a ring the joint's node is the first instead of the last, or the other way round.
        State moved = interpolated(*at.system, at.state, *next);
        at = {std::move(next), std::move(moved)};
        return true;
      }
      // Curvature and twist jump from element to element, and with them the motion of a body that follows the
      // section: an impact.
      const double accuracy = &at == &at_ ? kept_energy : neighbours_accuracy;
      std::optional<Transferred> moved = projected(*at.system, at.state, *next, accuracy);
      if (!moved) return false;
      at = {std::move(next), std::move(moved->state)};
      return true;
    };
    const double before = follows_section ? energy(*at_.system, at_.state).mechanical() : 0;
    if (!change(go_over))
      return goes_on(Failure{.kind = Failure::Kind::impact, .time = at_.state.t, .joint = crossing.joint});
    if (follows_section) dissipated_ += before - energy(*at_.system, at_.state).mechanical();
    return restart();
  }

  bool end_sliding(const Crossing& ending) {
    const int joint = ending.joint;
    const bool leaves = model_->joints[joint].leave_at_end && !is_held(*model_, ending);
    RunEvent event = event_before(at_, leaves ? EventKind::left_beam : EventKind::stopped_at_end, joint);
    const bool ended = change(
        [&](MeshedState& at) { return end_sliding(at, in_model(ending, at.system->model()), leaves); });
    if (!ended) return goes_on(Failure{.kind = Failure::Kind::impact, .time = at_.state.t, .joint = joint});
    if (!restart()) return false;
    finish_event(at_, event);
    // In the impact, or what friction stored.
    if (!leaves || model_->joints[joint].friction) dissipated_ += event.energy_before - event.energy_after;
    note(std::move(event));
    return true;
  }
  bool end_sliding(MeshedState& at, const Crossing& ending, bool leaves) const {
    const int joint = ending.joint;
    MeshPlan plan = present_plan(*at.system, at.state);
    plan.places[joint] = ending.s;
    plan.modes[joint] = leaves ? JointMode::free : JointMode::stopped;
    if (leaves) {
      plan.spins.resize(model_->joints.size());
      plan.spins[joint] = body_motions(*at.system, at.state).spins[joint];
    }
    auto next = std::make_unique<BeamSystem>(at.system->shared_model(), std::move(plan));
    State moved = interpolated(*at.system, at.state, *next);
    if (!leaves) {
      moved.q[next->mesh().joints[joint].place] = ending.s;
      if (project_velocities(*next, moved, shortest_time()).status != ConsistencyStatus::done) return false;
    }
    at = {std::move(next), std::move(moved)};
    return true;
  }

  // --- Length control

  // Applies the changes of the mesh that are due.
  void settle_mesh() {
    for (std::size_t count = 1; change_due_mesh(); ++count)
      if (!goes_on(excess_of_changes(at_, count))) return;
  }

  // Applies one change of the mesh if one is due; the integrator is restarted and the event recorded.
  bool change_due_mesh() {
    const auto start = Clock::now();
    const NextPlan next = next_plan(*at_.system, at_.state, options_.length_control);
    if (next.change == MeshChange::none) return false;
    RunEvent event = event_before(at_, kind_of(next.change), next.joint);
    const bool observed = static_cast<bool>(observer_.mesh_changed);
    const std::vector<BeamRecord> before =
        observed ? record_beams(*at_.system, at_.state) : std::vector<BeamRecord>{};
    const MeshPlan plan = at_.system->mesh().plan;
    const State state = at_.state;
    const MeshChangeReport changed = change_mesh(at_, next, false);
    if (!goes_on(changed.failure)) return false;
    follow([&next](MeshedState& at) {
      const NextPlan same{next.change, next.joint, plan_like(next.plan, *at.system, at.state)};
      return !change_mesh(at, same, false, neighbours_accuracy).failure;
    });
    if (!restart()) return false;
    at_.state = integrator_->state();
    event.support_impulse = support_impulse(at_, changed.impulse);
    finish_event(at_, event);
    if (!goes_on(energy_of_change(event, next.joint))) {
      at_ = {std::make_unique<BeamSystem>(model_, plan), state};
      return false;
    }
    note(std::move(event));
    if (observed) observer_.mesh_changed(report_.events.back(), before, record_beams(*at_.system, at_.state));
    report_.length_control_seconds += seconds_since(start);
    return true;
  }

  // A change of the mesh that changes the energy by too much is undone and ends the run: what came after it
  // would be another motion. The elements and rules of the papers, which are there for comparison, do as they
  // do.
  std::optional<Failure> energy_of_change(const RunEvent& event, int joint) const {
    constexpr double most = 1e-3, round_off = 1e-10;
    const Beam& beam = model_->beams[event.beam];
    if (beam.merge != MergeRule::standard || beam.properties.axial_strain == AxialStrain::pointwise)
      return {};
    const SystemEnergy now = energy(*at_.system, at_.state);
    const double jump = event.energy_after - event.energy_before;
    const double moves = std::max(now.kinetic, now.strain());
    if (std::abs(jump) <= most * moves + round_off * (moves + std::abs(now.gravity)) + report_.strain_noise)
      return {};
    return Failure{.kind = Failure::Kind::mesh_energy,
                   .time = at_.state.t,
                   .places = places_of(at_),
                   .joint = joint,
                   .energy = jump};
  }

  // --- Output

  // The present state; right after a restart with the accelerations and multipliers of the moment, of which
  // an integrator may have taken means over its first step.
  State recorded_state() const {
    State state = at_.state;
    if (restarted_ && make_accelerations_consistent(*at_.system, state) == ConsistencyStatus::done)
      return state;
    return at_.state;
  }

  // Where all that moves has come from nowhere, what would follow means nothing.
  std::optional<Failure> energy_from_nowhere() const {
    if (created_ <= report_.energy_scale() + report_.energy_round_off()) return {};
    return Failure{
        .kind = Failure::Kind::energy, .time = at_.state.t, .places = places_of(at_), .energy = created_};
  }

  void take_snapshot() {
    const Snapshot snapshot = present();
    steps_.clear();
    iterations_written_ = report_.newton_iterations;
    if (!options_.statics) {
      double drift = snapshot.energy.total - start_energy_;
      report_.energy_drift = std::max(report_.energy_drift, std::abs(drift));
      for (const RunEvent& event : report_.events)
        if (!is_booked(event.kind)) drift -= event.energy_after - event.energy_before;
      report_.integration_error = std::max(report_.integration_error, std::abs(drift));
      created_ = drift;
      report_.peak_kinetic_energy = std::max(report_.peak_kinetic_energy, snapshot.energy.kinetic);
      report_.strain_energy.add(snapshot.energy.axial + snapshot.energy.bending + snapshot.energy.spring);
      report_.gravity_energy.add(snapshot.energy.gravity);
    }
    last_written_ = at_.state.t;
    if (observer_.snapshot) observer_.snapshot(snapshot);
    if (observer_.follower) observer_.follower->records(at_, restarted_);
  }

  std::shared_ptr<const BeamModel> model_;
  const std::vector<ProbePlace> probes_;
  const SimulationOptions options_;
  const SimulationObserver observer_;
  Phase phase_ = Phase::start;
  std::size_t next_output_ = 0;
  double seconds_ = 0;                     // of the calls so far, and of the run that was interrupted
  std::optional<Clock::time_point> call_;  // when the present one began
  std::vector<double> kinks_;              // of tables: steps end there
  const bool has_events_;                  // of friction, stops and connectors, or of bodies on guides
  SimulationReport report_;
  MeshedState at_;
  std::unique_ptr<Integrator> integrator_;
  double step_ = 1e-4;      // asked for next: fixed, or what error control suggests [s]
  bool restarted_ = false;  // and no step since
  std::pair<double, SystemEnergy> known_energy_{-1, {}};  // at a time, since the last restart
  StepRecord last_record_;
  std::vector<StepRecord> steps_;  // since the last frame
  double dissipated_ = 0, input_ = 0, start_energy_ = 0, last_step_ = 0, last_written_ = -1;
  double created_ = 0;  // energy in the last frame, less what events gave [J]
  long iterations_written_ = 0;
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
Snapshot Simulation::present() const { return implementation_->present(); }
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
