#include "fem/motion/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "fem/motion/crossing.h"
#include "fem/motion/meshed_state.h"
#include "fem/motion/record_frame.h"
#include "fem/motion/resting_place.h"
#include "fem/motion/run_events.h"
#include "fem/motion/sliding_bodies.h"
#include "nurbs/number_text.h"
#include "solver/consistent.h"

namespace nurbeam {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

const char* reason_of(StepStatus status) {
  switch (status) {
    case StepStatus::not_converged:
      return "Newton's iteration does not converge";
    case StepStatus::singular_matrix:
      return "the iteration matrix is singular";
    case StepStatus::inadmissible:
      return "an element would turn inside out";
    case StepStatus::converged:
      break;
  }
  return "converged";
}

// Whether a beam's end is held, by a support or by another beam.
bool is_held(const BeamModel& model, const Crossing& end) {
  const int beam = model.joints[end.joint].beam;
  return std::any_of(model.supports.begin(), model.supports.end(),
                     [&](const Support& support) { return support.beam == beam && support.s == end.s; }) ||
         std::any_of(model.beam_joints.begin(), model.beam_joints.end(), [&](const BeamJoint& other) {
           return (other.beam_a == beam && other.s_a == end.s) ||
                  (other.beam_b == beam && other.s_b == end.s);
         });
}

template <int D>
class Simulation {
 public:
  Simulation(const BeamModel& model, const std::vector<ProbePlace>& probes, const SimulationOptions& options,
             const SimulationObserver& observer)
      : model_(model), probes_(probes), options_(options), observer_(observer) {}

  SimulationReport resume(const RestartPoint& from) {
    go_on_from(from);
    move(from.frames);
    return report_up_to_now();
  }

  SimulationReport run() {
    at_ = as_drawn<D>(model_);
    step_ = options_.step.value_or(step_);
    if (options_.statics)
      rest();
    else if (start_motion())
      begin_motion();
    return report_up_to_now();
  }

 private:
  SimulationReport report_up_to_now() const {
    SimulationReport report = report_;
    report.time = at_.state.t;
    report.motion_seconds = seconds_before_ + seconds_since(start_) - report_.length_control_seconds;
    return report;
  }

  void rest() {
    find_rest(at_, options_.length_control, observer_.interrupted, report_);
    if (report_.status == SimulationStatus::done) write_frame();
  }

  // --- Motion
  // --------------------------------------------------------------------------------------------------

  bool start_motion() {
    if (!check_bodies_apart(*at_.system, at_.state, report_)) return false;
    if (options_.start_from_equilibrium) {
      if (!find_held_equilibrium(at_, report_)) return false;
      at_.system = std::make_unique<BeamSystem<D>>(model_, at_.system->mesh().plan);
      at_.state.lambda = Eigen::VectorXd::Zero(at_.system->constraint_count());
    }
    at_.system->start_joints(at_.state);
    Eigen::VectorXd impulse;
    if (!project_velocities(*at_.system, at_.state, impulse)) {
      report_.fail(SimulationStatus::not_converged,
                   "the initial velocities cannot be made consistent with the supports");
      return false;
    }
    return restart();
  }

  // --- Restart points
  // -----------------------------------------------------------------------------------------------

  void hand_over(std::size_t frames) const {
    if (!observer_.restart_point) return;
    RestartPoint point;
    point.frames = frames;
    point.plan = at_.system->mesh().plan;
    point.state = at_.state;
    if (const auto* method = dynamic_cast<const GeneralizedAlphaIntegrator*>(integrator_.get()))
      point.history = method->history();
    point.next_step = step_;
    point.last_step = last_step_;
    point.dissipated = dissipated_;
    point.start_energy = start_energy_;
    point.iterations_in_frames = iterations_written_;
    point.steps = steps_;
    point.report = report_up_to_now();
    observer_.restart_point(point);
  }

  void go_on_from(const RestartPoint& point) {
    at_ = {std::make_unique<BeamSystem<D>>(model_, point.plan), point.state};
    integrator_ = start_integrator(options_.integrator, *at_.system, at_.state);
    if (auto* method = dynamic_cast<GeneralizedAlphaIntegrator*>(integrator_.get()))
      method->restore(point.history);
    step_ = point.next_step;
    last_step_ = point.last_step;
    dissipated_ = point.dissipated;
    start_energy_ = point.start_energy;
    iterations_written_ = point.iterations_in_frames;
    steps_ = point.steps;
    report_ = point.report;
    seconds_before_ = report_.motion_seconds + report_.length_control_seconds;
  }

  // New integrator from at_.state, with consistent accelerations.
  bool restart() {
    const bool stiff = std::holds_alternative<GeneralizedAlpha>(options_.integrator);
    if (!(stiff ? make_accelerations_smooth(*at_.system, step_, at_.state)
                : make_accelerations_consistent(*at_.system, at_.state))) {
      report_.fail(SimulationStatus::not_converged,
                   "the mass matrix is singular at t = " + text_of(at_.state.t, 8) + " s");
      return false;
    }
    integrator_ = start_integrator(options_.integrator, *at_.system, at_.state);
    return true;
  }

  double total_energy() const {
    const SystemEnergy e = at_.system->energy(at_.state);
    return e.mechanical() + dissipated_;
  }

  void begin_motion() {
    start_energy_ = total_energy();
    settle_mesh();
    if (report_.status == SimulationStatus::done) move(0);
  }

  // From at_.state to the end, with the first output times behind it.
  void move(std::size_t next_output) {
    const auto& times = options_.output_times;
    const double resolution = 1e-12 * std::max(1.0, options_.end_time);
    const auto write_due = [&] {
      while (next_output < times.size() && times[next_output] <= at_.state.t + resolution) {
        write_frame();
        ++next_output;
      }
    };
    write_due();
    bool complete = true;
    while (at_.state.t < options_.end_time - resolution) {
      if (observer_.interrupted()) {
        hand_over(next_output);
        report_.fail(SimulationStatus::interrupted, "interrupted at t = " + text_of(at_.state.t, 8) + " s");
        complete = false;
        break;
      }
      const double target = next_output < times.size() ? times[next_output] : options_.end_time;
      const double rest = target - at_.state.t;
      const double step = rest / std::max(1.0, std::ceil(rest / step_ - 1e-9));
      if (!advance(step)) {
        complete = false;
        break;
      }
      if (std::abs(at_.state.t - target) < resolution) at_.state.t = target;
      write_due();
      observer_.progress(last_record_);
      if (observer_.restart_point_due && observer_.restart_point_due()) hand_over(next_output);
    }
    if (complete) hand_over(next_output);
    if (!complete && (times.empty() || at_.state.t > last_written_)) write_frame();
  }

  // One accepted step and what follows from it. Returns false when the run cannot go on.
  bool advance(double step) {
    const State before = at_.state;
    const Eigen::VectorXd algorithmic = algorithmic_acceleration(*integrator_);
    const StepReport taken = integrator_->advance(step);
    report_.newton_iterations += taken.newton_iterations;
    report_.rejected_steps += taken.rejected;
    if (taken.status != StepStatus::converged) {
      report_.fail(SimulationStatus::not_converged,
                   "the step from t = " + text_of(at_.state.t, 8) + " s failed, and shorter ones too: " +
                       reason_of(taken.status) + places_text(*at_.system, at_.state) +
                       "; a shorter \"step\" from the start, or a \"tolerance\", may help");
      return false;
    }
    if (!options_.step) step_ = taken.next_step;
    ++report_.steps;
    last_step_ = taken.step;
    last_record_ = {at_.state.t + taken.step, taken.step, taken.newton_iterations, taken.rejected};
    steps_.push_back(last_record_);
    at_.state = integrator_->state();
    const std::optional<Crossing> crossing = first_crossing(*at_.system, before, at_.state);
    if (crossing) {
      land(before, algorithmic, taken.step, *crossing);
      at_.state = carried_over(*at_.system, std::move(at_.state), taken.step, *crossing);
    }
    const std::optional<Crossing> ending = end_passed(*at_.system, at_.state);
    if (ending) land(before, algorithmic, at_.state.t - before.t, *ending);
    if (damped()) dissipated_ += dissipated_between(before, at_.state);
    if (ending && !end_sliding(*ending)) return false;
    if (crossing && !ending && !step_over(*crossing)) return false;
    if (!check_bodies_apart(*at_.system, at_.state, report_)) return false;
    settle_mesh();
    return report_.status == SimulationStatus::done;
  }

  // Repeats the last step so that it ends just before a place.
  void land(const State& before, const Eigen::VectorXd& algorithmic, double step, const Crossing& crossing) {
    at_.state = landed(*at_.system, options_.integrator, before, algorithmic, at_.state, step, crossing);
  }

  // Midpoint rule with the mean rates of the step: what a transient shorter than the step does not falsify.
  double dissipated_between(const State& from, const State& to) const {
    State middle = from;
    const double h = to.t - from.t;
    middle.q = (from.q + to.q) / 2;
    middle.v = (to.q - from.q) / h;
    return h * at_.system->energy(middle).dissipation;
  }

  bool damped() const {
    return std::any_of(model_.beams.begin(), model_.beams.end(),
                       [](const Beam& beam) { return beam.properties.damping > 0; });
  }

  // Goes on beyond a place that a joint has landed at: a point in the next element.
  bool step_over(const Crossing& crossing) {
    const double beyond = landing_tolerance(model_, crossing.joint);
    at_.state.q[at_.system->mesh().joints[crossing.joint].place] =
        crossing.s + (crossing.forward ? beyond : -beyond);
    at_.system = std::make_unique<BeamSystem<D>>(model_, present_plan<D>(*at_.system, at_.state));
    return restart();
  }

  bool end_sliding(const Crossing& ending) {
    const int joint = ending.joint;
    const bool leaves = model_.joints[joint].leave_at_end && !is_held(model_, ending);
    RunEvent event = event_before(at_, leaves ? "left the beam" : "stopped at the end", joint);
    MeshPlan plan = present_plan<D>(*at_.system, at_.state);
    plan.places[joint] = ending.s;
    plan.modes[joint] = leaves ? JointMode::free : JointMode::stopped;
    auto next = std::make_unique<BeamSystem<D>>(model_, std::move(plan));
    std::optional<State> moved = transfer<D>(*at_.system, at_.state, *next, true);
    if (!leaves) {
      moved->q[next->mesh().joints[joint].place] = ending.s;
      Eigen::VectorXd impulse;
      if (!project_velocities(*next, *moved, impulse)) {
        report_.fail(SimulationStatus::not_converged,
                     "the impact of \"" + body_name(model_, joint) + "\" at the end is singular");
        return false;
      }
    }
    at_ = {std::move(next), std::move(*moved)};
    if (!restart()) return false;
    finish_event(at_, event);
    report_.events.push_back(std::move(event));
    return true;
  }

  // --- Length control
  // ------------------------------------------------------------------------------------------

  // Applies the changes of the mesh that are due.
  void settle_mesh() {
    for (std::size_t count = 1; change_due_mesh(); ++count)
      if (!check_changes(at_, count, report_)) return;
  }

  // Applies one change of the mesh if one is due; the integrator is restarted and the event recorded.
  bool change_due_mesh() {
    const auto start = Clock::now();
    const NextPlan next = next_plan<D>(*at_.system, at_.state, options_.length_control);
    if (next.change == MeshChange::none) return false;
    RunEvent event = event_before(at_, kind_of(next.change), next.joint);
    const bool observed = static_cast<bool>(observer_.mesh_changed);
    const std::vector<BeamRecord> before =
        observed ? record_beams<D>(*at_.system, at_.state) : std::vector<BeamRecord>{};
    Eigen::VectorXd impulse;
    if (!change_mesh(at_, next, false, impulse, report_) || !restart()) return false;
    at_.state = integrator_->state();
    event.support_impulse = support_impulse<D>(model_, impulse);
    finish_event(at_, event);
    report_.events.push_back(std::move(event));
    if (observed)
      observer_.mesh_changed(report_.events.back(), before, record_beams<D>(*at_.system, at_.state));
    report_.length_control_seconds += seconds_since(start);
    return true;
  }

  // --- Output
  // --------------------------------------------------------------------------------------------------

  void write_frame() {
    Frame frame = record_frame<D>(*at_.system, at_.state, probes_);
    frame.steps = std::exchange(steps_, {});
    frame.energy.dissipated = dissipated_;
    frame.energy.total += dissipated_;
    frame.step = last_step_;
    frame.newton_iterations = static_cast<int>(report_.newton_iterations - iterations_written_);
    iterations_written_ = report_.newton_iterations;
    if (!options_.statics) {
      double drift = frame.energy.total - start_energy_;
      report_.energy_drift = std::max(report_.energy_drift, std::abs(drift));
      for (const RunEvent& event : report_.events) drift -= event.energy_after - event.energy_before;
      report_.integration_error = std::max(report_.integration_error, std::abs(drift));
      report_.peak_kinetic_energy = std::max(report_.peak_kinetic_energy, frame.energy.kinetic);
    }
    last_written_ = at_.state.t;
    observer_.frame(frame);
  }

  const BeamModel& model_;
  const std::vector<ProbePlace>& probes_;
  const SimulationOptions& options_;
  const SimulationObserver& observer_;
  const Clock::time_point start_ = Clock::now();
  double seconds_before_ = 0;  // of the run that was interrupted
  SimulationReport report_;
  MeshedState<D> at_;
  std::unique_ptr<Integrator> integrator_;
  double step_ = 1e-4;  // asked for next: fixed, or what error control suggests [s]
  StepRecord last_record_;
  std::vector<StepRecord> steps_;  // since the last frame
  double dissipated_ = 0, start_energy_ = 0, last_step_ = 0, last_written_ = -1;
  long iterations_written_ = 0;
};

}  // namespace

SimulationReport simulate(const BeamModel& model, const std::vector<ProbePlace>& probes,
                          const SimulationOptions& options, const SimulationObserver& observer,
                          const RestartPoint* from) {
  const auto play = [&](auto simulation) { return from ? simulation.resume(*from) : simulation.run(); };
  if (model.dimension == 2) return play(Simulation<2>(model, probes, options, observer));
  return play(Simulation<3>(model, probes, options, observer));
}

}  // namespace nurbeam
