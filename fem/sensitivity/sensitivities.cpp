#include "fem/sensitivity/sensitivities.h"

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>

#include "fem/forces/memory.h"
#include "fem/motion/free_lengths.h"
#include "fem/motion/kinks.h"
#include "fem/sensitivity/neighbouring_mesh.h"
#include "nurbs/number_text.h"
#include "solver/consistent.h"
#include "solver/equilibrated_kkt.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

// The state `part` of a tangent away.
State moved(const State& from, const State& tangent, double part) {
  State state = from;
  state.t += part * tangent.t;
  state.q += part * tangent.q;
  state.v += part * tangent.v;
  state.a += part * tangent.a;
  state.lambda += part * tangent.lambda;
  return state;
}

State rate(const State& more, const State& less, double step) {
  const double per = 1 / (2 * step);
  return {.t = per * (more.t - less.t),
          .q = per * (more.q - less.q),
          .v = per * (more.v - less.v),
          .a = per * (more.a - less.a),
          .lambda = per * (more.lambda - less.lambda)};
}

void check_tangents(const BeamModel& model) {
  if (no_memory(model).size() > 0)
    throw std::invalid_argument(
        "friction and stops have no derivative here: leave them out, or take differences of runs");
  if (asks_for_lengths(model))
    throw std::invalid_argument(
        "connectors whose length is to be found have no derivative here: give their lengths");
}

[[noreturn]] void not_alike(const char* what) {
  throw std::runtime_error(std::string("a derivative needs neighbouring models of one mesh, and ") + what +
                           " with the parameter");
}

}  // namespace

struct Sensitivities::Parameter {
  NeighbourPair pair;
  std::unique_ptr<BeamSystem> more = nullptr, less = nullptr;
  MotionTangent tangent = {};

  // What `change` makes of the neighbours of a state.
  void change(const State& from, const std::function<bool(MeshedState&)>& change) {
    MeshedState above{std::move(more), moved(from, tangent.state, pair.step)},
        below{std::move(less), moved(from, tangent.state, -pair.step)};
    if (!change(above) || !change(below))
      throw std::runtime_error(
          "a derivative cannot follow the run through an event at t = " + text_of(from.t) + " s");
    more = std::move(above.system);
    less = std::move(below.system);
    if (above.state.q.size() != below.state.q.size() ||
        above.state.lambda.size() != below.state.lambda.size())
      not_alike("what happens at an event changes");
    start_afresh(rate(above.state, below.state, pair.step));
  }

  // As an integrator does.
  void start_afresh(State tangent_state) {
    tangent.algorithmic_acceleration = tangent_state.a;
    tangent.jerk = Vector::Zero(tangent_state.q.size());
    tangent.last_step = 0;
    tangent.state = std::move(tangent_state);
  }
};

struct Sensitivities::Difference {
  Vector dynamics, constraints;
};

// Of the neighbours of all parameters; and the joints that they hold.
struct Sensitivities::Meshes {
  std::vector<std::pair<MeshPlan, MeshPlan>> plans;  // with more and with less of each parameter
  std::vector<bool> held;
};

struct Sensitivities::Record {
  State state;
  bool of_the_moment;
  std::vector<State> tangents;
  std::shared_ptr<const Meshes> meshes;
};

Sensitivities::Sensitivities(const SimulationOptions& options, std::vector<NeighbourPair> parameters)
    : begins_at_rest_(options.statics || options.start_from_equilibrium) {
  const auto* settings = std::get_if<GeneralizedAlpha>(&options.integrator);
  if (!options.statics && !settings)
    throw std::invalid_argument("derivatives of a motion need the integrator generalized-alpha");
  if (settings) settings_ = *settings;
  for (NeighbourPair& pair : parameters) {
    check_tangents(*pair.more.model);
    parameters_.push_back({.pair = std::move(pair)});
  }
}

Sensitivities::~Sensitivities() = default;

// Half the difference of the residual of the neighbours at a state whose time changes too.
Sensitivities::Difference Sensitivities::residual_change(const Parameter& parameter, const State& at,
                                                         double time) const {
  const auto residual = [&](const BeamSystem& system, double part) {
    State state = at;
    state.t += part * time;
    Difference r{Vector(at.q.size()), Vector(at.lambda.size())};
    system.residual(state, r.dynamics, r.constraints);
    return r;
  };
  const double step = parameter.pair.step;
  const Difference more = residual(*parameter.more, step), less = residual(*parameter.less, -step);
  return {(more.dynamics - less.dynamics) / (2 * step), (more.constraints - less.constraints) / (2 * step)};
}

void Sensitivities::go_on_from(const MeshedState& at) {
  system_ = at.system.get();
  state_ = at.state;
  meshes_ = nullptr;
}

void Sensitivities::begins(const MeshedState& drawn) {
  const std::vector<double> kinks = kink_times(drawn.system->model());
  for (Parameter& parameter : parameters_) {
    for (const Neighbour* each : {&parameter.pair.more, &parameter.pair.less})
      if (kink_times(*each->model) != kinks) not_alike("the times of tables or releases change");
    if (begins_at_rest_) continue;
    MeshedState more = MeshedState::drawn(parameter.pair.more.model),
                less = MeshedState::drawn(parameter.pair.less.model);
    for (const MeshedState* each : {&more, &less})
      if (!same_mesh(*drawn.system, *each->system)) not_alike("the mesh changes");
    parameter.start_afresh(rate(more.state, less.state, parameter.pair.step));
    parameter.more = std::move(more.system);
    parameter.less = std::move(less.system);
  }
  if (!begins_at_rest_) go_on_from(drawn);
}

void Sensitivities::rests(const MeshedState& at) {
  const int n = at.system->coordinate_count(), m = at.system->constraint_count();
  Eigen::SparseMatrix<double> stiffness = at.system->tangent_pattern();
  at.system->tangent(at.state, {.stiffness = 1}, stiffness);
  const EquilibratedKkt kkt(stiffness, n);
  if (!kkt.regular())
    throw std::runtime_error("an equilibrium has no derivative where its tangent is singular");
  for (Parameter& parameter : parameters_) {
    parameter.more = at_rest_like(at, parameter.pair.more.model);
    parameter.less = at_rest_like(at, parameter.pair.less.model);
    for (const BeamSystem* each : {parameter.more.get(), parameter.less.get()})
      if (!same_mesh(*at.system, *each)) not_alike("where bodies rest changes");
    const Difference change = residual_change(parameter, at.state, 0);
    Vector rhs(n + m);
    rhs << -change.dynamics, -change.constraints;
    const Vector x = kkt.solve(rhs);
    parameter.start_afresh(
        {.t = 0, .q = x.head(n), .v = Vector::Zero(n), .a = Vector::Zero(n), .lambda = x.tail(m)});
  }
  go_on_from(at);
}

void Sensitivities::steps(const FollowedStep& step) {
  const double h = step.after.t - step.before.t;
  const StepTangent tangent(settings_, *system_, step.before, step.history, step.after, step.repeated);
  if (!tangent.regular())
    throw std::runtime_error("a derivative cannot follow a step whose matrix is singular");
  const double shift = 1e-4;  // of the step, for derivatives by time
  MotionTangent longer;       // by the step's length
  double approach = 0;
  const auto beyond = [&](const BeamSystem& system, const State& along, double part) {
    return step.beyond(system, moved(step.after, along, part));
  };
  if (step.beyond) {
    const int n = system_->coordinate_count(), m = system_->constraint_count();
    State later = step.after, sooner = step.after;
    later.t += shift * h;
    sooner.t -= shift * h;
    Vector more(n), less(n), more_constraints(m), less_constraints(m);
    system_->residual(later, more, more_constraints);
    system_->residual(sooner, less, less_constraints);
    longer = tangent.end(MotionTangent::zero(n, m), 1, (more - less) / (2 * shift * h),
                         (more_constraints - less_constraints) / (2 * shift * h));
    approach = (beyond(*system_, longer.state, shift * h) - beyond(*system_, longer.state, -shift * h)) /
               (2 * shift * h);
  }
  for (Parameter& parameter : parameters_) {
    const MotionTangent& start = parameter.tangent;
    const double change = step.beyond ? 0 : -start.state.t * h / step.rest;  // of the step's length
    const Difference residual = residual_change(parameter, step.after, start.state.t + change);
    MotionTangent end = tangent.end(start, change, residual.dynamics, residual.constraints);
    if (step.beyond) {
      const double p = parameter.pair.step;
      const double late = -(beyond(*parameter.more, end.state, p) - beyond(*parameter.less, end.state, -p)) /
                          (2 * p) / approach;
      end.state = moved(end.state, longer.state, late);
    }
    parameter.tangent = std::move(end);
  }
  state_ = step.after;
}

void Sensitivities::changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) {
  for (Parameter& parameter : parameters_) {
    parameter.change(state_, change);
    if (!same_mesh(*at.system, *parameter.more)) not_alike("what happens at an event changes");
  }
  go_on_from(at);
}

void Sensitivities::happens(const RunEvent& event) {
  const bool of_mesh = event.kind <= EventKind::becomes_node;
  std::vector<double> rates;
  for (const Parameter& parameter : parameters_)
    rates.push_back(of_mesh ? std::numeric_limits<double>::quiet_NaN() : parameter.tangent.state.t);
  event_times_.push_back(std::move(rates));
}

void Sensitivities::records(const MeshedState& at, bool of_the_moment) {
  if (!meshes_) {
    auto meshes = std::make_shared<Meshes>();
    for (const Parameter& parameter : parameters_)
      meshes->plans.emplace_back(parameter.more->mesh().plan, parameter.less->mesh().plan);
    meshes->held = held_joints(*at.system);
    meshes_ = std::move(meshes);
  }
  Record record{at.state, of_the_moment, {}, meshes_};
  for (const Parameter& parameter : parameters_) record.tangents.push_back(parameter.tangent.state);
  records_.push_back(std::move(record));
}

std::pair<Snapshot, Snapshot> Sensitivities::neighbours(std::size_t record, std::size_t parameter) const {
  const Record& of = records_[record];
  const NeighbourPair& pair = parameters_[parameter].pair;
  const bool present = of.meshes == meshes_;
  const auto snapshot = [&](const Neighbour& neighbour, const BeamSystem* now, const MeshPlan& plan,
                            double part) {
    std::optional<BeamSystem> then;
    const BeamSystem& system = present ? *now : then.emplace(neighbour.model, plan, of.meshes->held);
    State state = moved(of.state, of.tangents[parameter], part);
    if (of.of_the_moment && make_accelerations_consistent(system, state) != ConsistencyStatus::done)
      throw std::runtime_error("a derivative needs accelerations, and the mass matrix is singular");
    return record_snapshot(system, state, neighbour.probes);
  };
  const auto& [plan_of_more, plan_of_less] = of.meshes->plans[parameter];
  const Parameter& at_end = parameters_[parameter];
  return {snapshot(pair.more, at_end.more.get(), plan_of_more, pair.step),
          snapshot(pair.less, at_end.less.get(), plan_of_less, -pair.step)};
}

}  // namespace nurbeam
