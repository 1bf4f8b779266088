#include "pipelines/simulation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "pipelines/record_frame.h"
#include "solver/consistent.h"

namespace nurbeam {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::string text(double x) {
  std::ostringstream stream;
  stream.precision(8);
  stream << x;
  return stream.str();
}

const char* kind_of(MeshChange change) {
  switch (change) {
    case MeshChange::split:
      return "split";
    case MeshChange::merge:
      return "merge";
    case MeshChange::becomes_point:
      return "carried as a point";
    case MeshChange::becomes_node:
      return "carried as a node";
    case MeshChange::none:
      break;
  }
  return "none";
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
    plan_ = initial_plan(model_);
    step_ = options_.step.value_or(step_);
    if (options_.statics)
      find_rest();
    else if (start_motion())
      begin_motion();
    return report_up_to_now();
  }

 private:
  const std::string& body_name(int joint) const { return model_.bodies[model_.joints[joint].body].name; }
  const ReferenceCurve& curve_of(int joint) const { return model_.beams[model_.joints[joint].beam].curve; }
  double beam_length_of(int joint) const { return model_.beams[model_.joints[joint].beam].curve.length(); }

  SimulationReport report_up_to_now() const {
    SimulationReport report = report_;
    report.time = state_.t;
    report.motion_seconds = seconds_before_ + seconds_since(start_) - report_.length_control_seconds;
    return report;
  }

  void fail(SimulationStatus status, std::string message) {
    report_.status = status;
    report_.message = std::move(message);
  }

  // --- Statics
  // -------------------------------------------------------------------------------------------------

  // Equilibrium of the present plan with the given joints held, from state_; the state is kept on failure.
  StaticReport find_equilibrium(const std::vector<bool>& held) {
    system_ = std::make_unique<BeamSystem<D>>(model_, plan_, held);
    state_.lambda = Eigen::VectorXd::Zero(system_->constraint_count());
    state_.v = state_.a = Eigen::VectorXd::Zero(system_->coordinate_count());
    const StaticReport found = find_static_equilibrium(
        StaticEquilibrium{}, *system_, [this](double factor) { system_->set_load_factor(factor); }, state_);
    report_.newton_iterations += found.newton_iterations;
    report_.steps += found.load_steps;
    return found;
  }

  bool solve_statics(const std::vector<bool>& held) {
    const StaticReport found = find_equilibrium(held);
    if (found.status == StaticStatus::converged) return true;
    fail(SimulationStatus::not_converged, std::string("no static equilibrium was found: ") +
                                              (found.status == StaticStatus::singular_matrix
                                                   ? "the tangent is singular (is the model held everywhere?)"
                                                   : "the solver does not converge") +
                                              "; load factor reached " + text(found.load_factor));
    return false;
  }

  // Moves held joints by ds, with the curve as it stands, and carries length control along: never past a node
  // at once.
  void move_places(std::vector<double> ds) {
    const auto left = [](double rest) { return rest != 0; };
    while (std::any_of(ds.begin(), ds.end(), left)) {
      for (std::size_t j = 0; j < ds.size(); ++j) {
        const double part = std::clamp(ds[j], -room_to_move(j, -1), room_to_move(j, 1));
        move_place(j, part);
        ds[j] -= part;
      }
      settle_mesh(false);
      if (report_.status != SimulationStatus::done) return;
    }
    for (std::size_t j = 0; j < ds.size(); ++j)
      if (const auto s = system_->place(state_, static_cast<int>(j))) plan_.places[j] = *s;
    state_.v.setZero();
  }

  // How far a joint can move in a direction while its elements keep a fifth of their length [m].
  double room_to_move(std::size_t joint, int direction) const {
    const MeshJoint& at = system_->mesh().joints[joint];
    if (at.node < 0) return std::numeric_limits<double>::infinity();
    const int beam = model_.joints[joint].beam, first = system_->mesh().first_element[beam];
    const int count = system_->mesh().first_element[beam + 1] - first;
    const int index = direction > 0 ? at.node : (at.node + count - 1) % count;
    const MeshElement<D>& e = system_->mesh().elements[first + index];
    return 0.8 * (end_of<D>(e, state_.q) - start_of<D>(e, state_.q));
  }

  void move_place(std::size_t joint, double ds) {
    const MeshJoint& at = system_->mesh().joints[joint];
    if (at.place < 0 || ds == 0) return;
    const double s = state_.q[at.place] + ds;
    const int beam = model_.joints[joint].beam;
    const auto& e = system_->mesh().elements[find_element<D>(model_, system_->mesh(), state_.q, beam, s)];
    const MaterialPoint<D> p = material_point<D>(e, state_.q, state_.v, s);
    state_.q.template segment<D>(at.r) = p.r;
    if (at.node >= 0)
      for (int slope : {system_->mesh().nodes[beam][at.node].slope_left,
                        system_->mesh().nodes[beam][at.node].slope_right})
        state_.q.template segment<D>(slope) = p.rs;
    state_.q[at.place] = s;
    state_.v[at.place] = ds;  // length control looks at the direction
  }

  double home_spacing(int joint) const {
    return beam_length_of(joint) /
           (static_cast<double>(model_.beams[model_.joints[joint].beam].home.size()) - 1);
  }

  // From one body to the nearest other one on its beam [m].
  double distance_to_others(int joint) const {
    double distance = std::numeric_limits<double>::infinity();
    for (int other = 0; other < static_cast<int>(model_.joints.size()); ++other) {
      const auto s = system_->place(state_, other);
      if (other == joint || !s || model_.joints[other].beam != model_.joints[joint].beam) continue;
      const double here = *system_->place(state_, joint);
      distance = std::min(distance, std::abs(curve_of(joint).unrolled(*s, here) - here));
    }
    return distance;
  }

  // Sliding bodies come to rest: they are held, let down the slope in bounded moves that halve where the
  // force along the beam changes sign, and freed for the last digits unless they rest against an end.
  void find_rest() {
    system_ = std::make_unique<BeamSystem<D>>(model_, plan_);
    state_ = system_->drawn_state();
    const std::size_t n = model_.joints.size();
    const std::vector<bool> held(n, true);
    if (!separate_bodies() || !solve_statics(held)) return;
    std::vector<double> move(n), force(n);
    std::vector<bool> at_end(n, false);
    for (std::size_t j = 0; j < n; ++j)
      move[j] = model_.joints[j].motion ? 0 : home_spacing(static_cast<int>(j)) / 4;
    const auto still_far = [&] {
      for (std::size_t j = 0; j < n; ++j)
        if (move[j] > 1e-6 * home_spacing(static_cast<int>(j))) return true;
      return false;
    };
    for (int guard = 0; still_far(); ++guard) {
      if (guard > 2000) return fail(SimulationStatus::not_converged, "a sliding body finds no resting place");
      if (observer_.interrupted()) return fail(SimulationStatus::interrupted, "interrupted");
      std::vector<double> ds(n);
      for (std::size_t j = 0; j < n; ++j) {
        const int joint = static_cast<int>(j);
        if (move[j] == 0) continue;
        const double now =
            system_->holding_force(state_, joint);  // what keeps it: it wants to go the other way
        if (force[j] * now < 0) move[j] /= 2;
        force[j] = now;
        const double s = *system_->place(state_, joint), L = beam_length_of(joint);
        const double room = 0.4 * distance_to_others(joint);
        ds[j] = std::clamp(now < 0 ? move[j] : -move[j], -room, room);
        if (!curve_of(joint).closed()) ds[j] = std::clamp(ds[j], -s, L - s);
        at_end[j] = ds[j] == 0;
        if (now == 0) ds[j] = 0;
        if (ds[j] == 0) move[j] = 0;
      }
      move_places(ds);
      if (report_.status != SimulationStatus::done) return;
      if (!separate_bodies() || !solve_statics(held)) return;
    }
    free_bodies(at_end);
    write_frame();
  }

  // Equilibrium with the joints free that are not held, if there is one nearby; else nothing changes.
  void free_bodies(const std::vector<bool>& held) {
    const State resting = state_;
    std::unique_ptr<BeamSystem<D>> before = std::move(system_);
    bool near = find_equilibrium(held).status == StaticStatus::converged;
    for (std::size_t j = 0; near && j < held.size(); ++j) {
      const int joint = static_cast<int>(j);
      const auto s = system_->place(state_, joint);
      near = !s || std::abs(*s - *before->place(resting, joint)) < 1e-3 * home_spacing(joint);
    }
    if (near) return;
    system_ = std::move(before);
    state_ = resting;
  }

  // --- Motion
  // --------------------------------------------------------------------------------------------------

  bool start_motion() {
    system_ = std::make_unique<BeamSystem<D>>(model_, plan_);
    state_ = system_->drawn_state();
    if (!separate_bodies()) return false;
    if (options_.start_from_equilibrium) {
      if (!solve_statics(std::vector<bool>(model_.joints.size(), true))) return false;
      system_ = std::make_unique<BeamSystem<D>>(model_, plan_);
      state_.lambda = Eigen::VectorXd::Zero(system_->constraint_count());
    }
    system_->start_joints(state_);
    Eigen::VectorXd impulse;
    if (!project_velocities(*system_, state_, impulse)) {
      fail(SimulationStatus::not_converged,
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
    point.plan = system_->mesh().plan;
    point.state = state_;
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
    plan_ = point.plan;
    system_ = std::make_unique<BeamSystem<D>>(model_, plan_);
    state_ = point.state;
    integrator_ =
        std::visit([&](const auto& settings) { return start(settings, state_); }, options_.integrator);
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

  // New integrator from state_, with consistent accelerations.
  bool restart() {
    const bool stiff = std::holds_alternative<GeneralizedAlpha>(options_.integrator);
    if (!(stiff ? make_accelerations_smooth(*system_, step_, state_)
                : make_accelerations_consistent(*system_, state_))) {
      fail(SimulationStatus::not_converged, "the mass matrix is singular at t = " + text(state_.t) + " s");
      return false;
    }
    integrator_ =
        std::visit([&](const auto& settings) { return start(settings, state_); }, options_.integrator);
    return true;
  }

  std::unique_ptr<Integrator> start(const GeneralizedAlpha& settings, const State& from) const {
    return std::make_unique<GeneralizedAlphaIntegrator>(settings, *system_, from);
  }
  std::unique_ptr<Integrator> start(const Ida& settings, const State& from) const {
    return std::make_unique<IdaIntegrator>(settings, *system_, from);
  }
  std::unique_ptr<Integrator> start(const ExplicitRungeKutta& settings, const State& from) const {
    return std::make_unique<ExplicitIntegrator>(settings, *system_, from);
  }

  // What generalized-alpha keeps between steps besides the state; else empty.
  Eigen::VectorXd algorithmic_acceleration() const {
    const auto* method = dynamic_cast<const GeneralizedAlphaIntegrator*>(integrator_.get());
    return method ? method->algorithmic_acceleration() : Eigen::VectorXd();
  }

  // An integrator that repeats the step from a state with another length, in one attempt.
  std::unique_ptr<Integrator> restart_step(const State& before, const Eigen::VectorXd& algorithmic) const {
    const auto* settings = std::get_if<GeneralizedAlpha>(&options_.integrator);
    if (!settings)
      return std::visit([&](const auto& other) { return start(other, before); }, options_.integrator);
    GeneralizedAlpha one_attempt = *settings;
    one_attempt.max_halvings = 0;
    one_attempt.tolerance = 0;
    auto integrator = std::make_unique<GeneralizedAlphaIntegrator>(one_attempt, *system_, before);
    integrator->set_algorithmic_acceleration(algorithmic);
    return integrator;
  }

  double total_energy() const {
    const SystemEnergy e = system_->energy(state_);
    return e.mechanical() + dissipated_;
  }

  void begin_motion() {
    start_energy_ = total_energy();
    settle_mesh(true);
    if (report_.status == SimulationStatus::done) move(0);
  }

  // From state_ to the end, with the first output times behind it.
  void move(std::size_t next_output) {
    const auto& times = options_.output_times;
    const double resolution = 1e-12 * std::max(1.0, options_.end_time);
    const auto write_due = [&] {
      while (next_output < times.size() && times[next_output] <= state_.t + resolution) {
        write_frame();
        ++next_output;
      }
    };
    write_due();
    bool complete = true;
    while (state_.t < options_.end_time - resolution) {
      if (observer_.interrupted()) {
        hand_over(next_output);
        fail(SimulationStatus::interrupted, "interrupted at t = " + text(state_.t) + " s");
        complete = false;
        break;
      }
      const double target = next_output < times.size() ? times[next_output] : options_.end_time;
      const double rest = target - state_.t;
      const double step = rest / std::max(1.0, std::ceil(rest / step_ - 1e-9));
      if (!advance(step)) {
        complete = false;
        break;
      }
      if (std::abs(state_.t - target) < resolution) state_.t = target;
      write_due();
      observer_.progress(last_record_);
      if (observer_.restart_point_due && observer_.restart_point_due()) hand_over(next_output);
    }
    if (complete) hand_over(next_output);
    if (!complete && (times.empty() || state_.t > last_written_)) write_frame();
  }

  // One accepted step and what follows from it. Returns false when the run cannot go on.
  bool advance(double step) {
    const State before = state_;
    const Eigen::VectorXd algorithmic = algorithmic_acceleration();
    const StepReport taken = integrator_->advance(step);
    report_.newton_iterations += taken.newton_iterations;
    report_.rejected_steps += taken.rejected;
    if (taken.status != StepStatus::converged) {
      fail(SimulationStatus::not_converged,
           "the step from t = " + text(state_.t) +
               " s failed, and shorter ones too: " + reason_of(taken.status) + places_text() +
               "; a shorter \"step\" from the start, or a \"tolerance\", may help");
      return false;
    }
    if (!options_.step) step_ = taken.next_step;
    ++report_.steps;
    last_step_ = taken.step;
    last_record_ = {state_.t + taken.step, taken.step, taken.newton_iterations, taken.rejected};
    steps_.push_back(last_record_);
    state_ = integrator_->state();
    const std::optional<Crossing> crossing = first_crossing(before);
    if (crossing) {
      const auto distance = [&](const State& state) {
        const double s = *system_->place(state, crossing->joint);
        return crossing->forward ? s - crossing->s : crossing->s - s;
      };
      land(before, algorithmic, taken.step, crossing->joint, distance);
      // To the other side, in a time in which nothing else happens.
      const double gap = landing_tolerance(crossing->joint) - distance(state_);
      const double instant =
          std::clamp(gap / std::abs(system_->place_rate(state_, crossing->joint)), 0.0, 1e-6 * taken.step);
      state_.q += instant * state_.v;
      state_.t += instant;
    }
    const int ending = joint_beyond_end();
    if (ending >= 0)
      land(before, algorithmic, state_.t - before.t, ending,
           [&](const State& state) { return beyond_end(state, ending); });
    if (damped()) dissipated_ += dissipated_between(before, state_);
    if (ending >= 0 && !end_sliding(ending)) return false;
    if (crossing && ending < 0 && !step_over(*crossing)) return false;
    if (!separate_bodies()) return false;
    settle_mesh(true);
    return report_.status == SimulationStatus::done;
  }

  // Midpoint rule with the mean rates of the step: what a transient shorter than the step does not falsify.
  double dissipated_between(const State& from, const State& to) const {
    State middle = from;
    const double h = to.t - from.t;
    middle.q = (from.q + to.q) / 2;
    middle.v = (to.q - from.q) / h;
    return h * system_->energy(middle).dissipation;
  }

  bool damped() const {
    return std::any_of(model_.beams.begin(), model_.beams.end(),
                       [](const Beam& beam) { return beam.properties.damping > 0; });
  }

  std::string places_text() const {
    std::string places;
    for (std::size_t j = 0; j < model_.joints.size(); ++j)
      if (const auto s = system_->place(state_, static_cast<int>(j)))
        places += "; \"" + body_name(static_cast<int>(j)) +
                  "\" is at s = " + text(curve_of(static_cast<int>(j)).wrapped(*s)) + " m of beam \"" +
                  model_.beams[model_.joints[j].beam].name +
                  "\" with ds/dt = " + text(system_->place_rate(state_, static_cast<int>(j))) + " m/s";
    return places;
  }

  // --- The ends of a beam
  // --------------------------------------------------------------------------------------

  double beyond_end(const State& state, int joint) const {
    const double s = *system_->place(state, joint);
    return std::max(-s, s - beam_length_of(joint));
  }

  int joint_beyond_end() const {
    for (int j = 0; j < static_cast<int>(model_.joints.size()); ++j)
      if (!curve_of(j).closed() && system_->mesh().plan.modes[j] == JointMode::point &&
          beyond_end(state_, j) > 0)
        return j;
    return -1;
  }

  double landing_tolerance(int joint) const { return 1e-10 * beam_length_of(joint); }

  // Repeats the last step with a length for which the joint lands just before a place: `distance` of the
  // state from there is negative before it. Where Newton's iteration stumbles over the place the step is
  // shortened.
  template <class Distance>
  void land(const State& before, const Eigen::VectorXd& algorithmic, double step, int joint,
            const Distance& distance) {
    const double near = landing_tolerance(joint);
    const auto missed = [&](const State& state) { return distance(state) + near / 2; };
    double lo = 0, f_lo = missed(before), hi = step, f_hi = missed(state_);
    state_ = before;
    while (f_lo < -near / 2 && hi - lo > 1e-7 * step) {
      const double fraction = f_hi > 0 ? std::clamp(-f_lo / (f_hi - f_lo), 0.02, 0.98) : 0.5;
      const double trial = lo + fraction * (hi - lo);
      integrator_ = restart_step(before, algorithmic);
      if (integrator_->advance(trial).status != StepStatus::converged) {
        hi = trial;
        f_hi = 0;
        continue;
      }
      const double f = missed(integrator_->state());
      (f < near / 2 ? lo : hi) = trial;
      (f < near / 2 ? f_lo : f_hi) = f;
      if (f < near / 2) state_ = integrator_->state();
    }
  }

  struct Crossing {
    int joint;
    double s;  // of the home node
    bool forward;
  };

  // The first crossing since `before` of a hidden late node by a moving node, or of any node by a point. The
  // drawn curvature may jump there and with it the force along the beam: a step must end on the near side and
  // the next begin on the far side, or energy drifts at first order.
  std::optional<Crossing> first_crossing(const State& before) const {
    std::optional<Crossing> first;
    double earliest = 1;
    for (int j = 0; j < static_cast<int>(model_.joints.size()); ++j) {
      const auto s = system_->place(state_, j);
      if (!s) continue;
      const std::optional<double> crossed = crossed_place(j, *s);
      if (!crossed) continue;
      const double from = *system_->place(before, j), part = (*crossed - from) / (*s - from);
      if (part >= earliest) continue;
      earliest = part;
      first = Crossing{j, *crossed, *s > *crossed};
    }
    return first;
  }

  // The first place, seen from where the joint was when the mesh was made, that it has passed by now.
  std::optional<double> crossed_place(int joint, double s) const {
    const MeshPlan& plan = system_->mesh().plan;
    const Beam& beam = model_.beams[model_.joints[joint].beam];
    const bool is_point = plan.modes[joint] == JointMode::point, forward = s > plan.places[joint];
    const double beyond = s + (forward ? -2 : 2) * landing_tolerance(joint);
    const auto inside = [&](int h) { return beam.is_ring() || (h > 0 && h < beam.home_intervals()); };
    for (int h = beam.home_interval(plan.places[joint]) + (forward ? 1 : 0);
         inside(h) && (forward ? beam.home_place(h) < beyond : beam.home_place(h) > beyond);
         h += forward ? 1 : -1)
      if (is_point || beam.home[beam.home_index(h)].late) return beam.home_place(h);
    return std::nullopt;
  }

  // Goes on beyond a place that a joint has landed at: a point in the next element.
  bool step_over(const Crossing& crossing) {
    const double beyond = landing_tolerance(crossing.joint);
    state_.q[system_->mesh().joints[crossing.joint].place] =
        crossing.s + (crossing.forward ? beyond : -beyond);
    plan_ = present_plan<D>(*system_, state_);
    system_ = std::make_unique<BeamSystem<D>>(model_, plan_);
    return restart();
  }

  // By a support or by another beam.
  bool end_is_held(int joint) const {
    const bool at_end = state_.q[system_->mesh().joints[joint].place] > beam_length_of(joint) / 2;
    const double s = at_end ? beam_length_of(joint) : 0;
    const int beam = model_.joints[joint].beam;
    return std::any_of(model_.supports.begin(), model_.supports.end(),
                       [&](const Support& support) { return support.beam == beam && support.s == s; }) ||
           std::any_of(model_.beam_joints.begin(), model_.beam_joints.end(), [&](const BeamJoint& other) {
             return (other.beam_a == beam && other.s_a == s) || (other.beam_b == beam && other.s_b == s);
           });
  }

  bool end_sliding(int joint) {
    const bool leaves = model_.joints[joint].leave_at_end && !end_is_held(joint);
    RunEvent event = event_before(leaves ? "left the beam" : "stopped at the end", joint);
    plan_ = present_plan<D>(*system_, state_);
    plan_.places[joint] = plan_.places[joint] > beam_length_of(joint) / 2 ? beam_length_of(joint) : 0;
    plan_.modes[joint] = leaves ? JointMode::free : JointMode::stopped;
    auto next = std::make_unique<BeamSystem<D>>(model_, plan_);
    std::optional<State> moved = transfer<D>(*system_, state_, *next, true);
    if (!leaves) {
      moved->q[next->mesh().joints[joint].place] = plan_.places[joint];
      Eigen::VectorXd impulse;
      if (!project_velocities(*next, *moved, impulse)) {
        fail(SimulationStatus::not_converged,
             "the impact of \"" + body_name(joint) + "\" at the end is singular");
        return false;
      }
    }
    system_ = std::move(next);
    state_ = std::move(*moved);
    if (!restart()) return false;
    finish_event(event);
    return true;
  }

  // Two bodies that meet on one beam end the run.
  bool separate_bodies() {
    for (int j = 0; j < static_cast<int>(model_.joints.size()); ++j) {
      if (!system_->place(state_, j) || distance_to_others(j) > meeting_distance * home_spacing(j)) continue;
      fail(SimulationStatus::not_converged, "sliding bodies meet at t = " + text(state_.t) +
                                                " s; contact between bodies is not modelled" + places_text());
      return false;
    }
    return true;
  }

  // --- Length control
  // ------------------------------------------------------------------------------------------

  // Applies the changes of the mesh that are due; each makes the next less likely.
  void settle_mesh(bool in_motion) {
    const std::size_t most = 20 * (model_.joints.size() + 1);
    for (std::size_t i = 0; change_mesh(in_motion); ++i)
      if (i > most)
        return fail(SimulationStatus::not_converged,
                    "length control finds no mesh at t = " + text(state_.t) + " s" + places_text());
  }

  // Applies one change of the mesh if one is due. In motion the integrator is restarted and the event
  // recorded.
  bool change_mesh(bool in_motion) {
    if (report_.status != SimulationStatus::done) return false;
    const auto start = Clock::now();
    NextPlan next = next_plan<D>(*system_, state_, options_.length_control);
    if (next.change == MeshChange::none) return false;
    RunEvent event = in_motion ? event_before(kind_of(next.change), next.joint) : RunEvent{};
    const bool observed = in_motion && observer_.mesh_changed;
    const std::vector<BeamRecord> before =
        observed ? record_beams<D>(*system_, state_) : std::vector<BeamRecord>{};
    const bool keeps_velocities = next.change == MeshChange::merge &&
                                  model_.beams[model_.joints[next.joint].beam].merge != MergeRule::standard;
    const bool exact =
        next.change == MeshChange::split || next.change == MeshChange::becomes_node || keeps_velocities;
    const std::vector<bool> held(model_.joints.size(), !in_motion);
    auto to = std::make_unique<BeamSystem<D>>(model_, next.plan, held);
    Eigen::VectorXd impulse;
    std::optional<State> moved = transfer<D>(*system_, state_, *to, exact || !in_motion, &impulse);
    if (!moved) {
      fail(SimulationStatus::not_converged,
           "velocities cannot be projected at t = " + text(state_.t) + " s" + places_text());
      return false;
    }
    plan_ = std::move(next.plan);
    system_ = std::move(to);
    state_ = std::move(*moved);
    if (in_motion) {
      if (!restart()) return false;
      state_ = integrator_->state();
      event.support_impulse = support_impulse(impulse);
      finish_event(event);
      if (observed) observer_.mesh_changed(report_.events.back(), before, record_beams<D>(*system_, state_));
    }
    report_.length_control_seconds += seconds_since(start);
    return true;
  }

  // What a constraint impulse gives to the momentum through the supports' positions; the other constraints
  // (directions, bodies on the beam) give none.
  Eigen::Vector3d support_impulse(const Eigen::VectorXd& impulse) const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    if (impulse.size() == 0) return sum;
    int row = 0;
    for (const Support& support : model_.supports) {
      sum -= widened<D>(impulse, row);
      row += support.clamped ? 2 * D - 1 : D;
    }
    return sum;
  }

  RunEvent event_before(const std::string& kind, int joint) const {
    RunEvent event;
    event.time = state_.t;
    event.kind = kind;
    event.beam = model_.beams[model_.joints[joint].beam].name;
    event.body = body_name(joint);
    if (const auto s = system_->place(state_, joint)) event.s = curve_of(joint).wrapped(*s);
    event.energy_before = system_->energy(state_).mechanical();
    event.momentum_before = system_->momentum(state_);
    event.length_before = system_->beam_length(state_, model_.joints[joint].beam);
    return event;
  }

  void finish_event(RunEvent& event) {
    event.energy_after = system_->energy(state_).mechanical();
    event.momentum_after = system_->momentum(state_);
    for (std::size_t b = 0; b < model_.beams.size(); ++b)
      if (model_.beams[b].name == event.beam)
        event.length_after = system_->beam_length(state_, static_cast<int>(b));
    report_.events.push_back(std::move(event));
  }

  // --- Output
  // --------------------------------------------------------------------------------------------------

  void write_frame() {
    Frame frame = record_frame<D>(*system_, state_, probes_);
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
    last_written_ = state_.t;
    observer_.frame(frame);
  }

  const BeamModel& model_;
  const std::vector<ProbePlace>& probes_;
  const SimulationOptions& options_;
  const SimulationObserver& observer_;
  const Clock::time_point start_ = Clock::now();
  double seconds_before_ = 0;  // of the run that was interrupted
  SimulationReport report_;
  MeshPlan plan_;
  std::unique_ptr<BeamSystem<D>> system_;
  State state_;
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
