#include "fem/sensitivity/sensitivities.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "fem/forces/memory.h"
#include "fem/motion/events/kinks.h"
#include "fem/motion/rest/free_lengths.h"
#include "fem/sensitivity/neighbouring_mesh.h"
#include "fem/sensitivity/sensitivities_parts.h"
#include "fem/system/observables.h"
#include "nurbs/number_text.h"
#include "solver/algebra/equilibrated_kkt.h"
#include "solver/algebra/side_by_side.h"
#include "solver/rest/near_equilibrium.h"
#include "solver/system/consistent.h"
#include "solver/system/tangent_matrix.h"

namespace nurbeam {

namespace {

using Vector = Eigen::VectorXd;

void check_tangents(const BeamModel& model) {
  std::string all;
  for (const std::string& each : what_remembers(model)) all += (all.empty() ? "" : ", ") + each;
  if (!all.empty())
    throw std::invalid_argument("there is no derivative here with " + all +
                                "; leave it out, or take differences of runs");
  if (asks_for_lengths(model))
    throw std::invalid_argument(
        "connectors whose length is to be found have no derivative here: give their lengths");
}

[[noreturn]] void singular_rest() {
  throw std::runtime_error("an equilibrium has no derivative where its tangent is singular");
}

}  // namespace

State moved(const State& from, const State& tangent, double part) {
  State state = from;
  state.t += part * tangent.t;
  state.q += part * tangent.q;
  state.v += part * tangent.v;
  state.a += part * tangent.a;
  state.lambda += part * tangent.lambda;
  return state;
}

State moved_along(const State& at, const MotionTangents& tangents, std::size_t parameter, double part) {
  const auto k = static_cast<Eigen::Index>(parameter);
  return {.t = at.t + part * tangents.t[k],
          .q = at.q + part * tangents.q.col(k),
          .v = at.v + part * tangents.v.col(k),
          .a = at.a,
          .lambda = {},
          .load = at.load,
          .memory = at.memory};
}

State rate(const State& more, const State& less, double step) {
  const double per = 1 / (2 * step);
  return {.t = per * (more.t - less.t),
          .q = per * (more.q - less.q),
          .v = per * (more.v - less.v),
          .a = per * (more.a - less.a),
          .lambda = per * (more.lambda - less.lambda)};
}

State still(Eigen::Index coordinates, Eigen::Index constraints) {
  const Vector none = Vector::Zero(coordinates);
  return {.t = 0, .q = none, .v = none, .a = none, .lambda = Vector::Zero(constraints)};
}

MotionTangents of_states(MotionTangents tangents) {
  for (MotionTangents::Matrix* of_steps : {&tangents.algorithmic_acceleration, &tangents.jerk})
    of_steps->resize(0, 0);
  return tangents;
}

void not_alike(const char* what) {
  throw std::runtime_error(std::string("a derivative needs neighbouring models of one mesh, and ") + what +
                           " with the parameter");
}

// The tangent of the state that `change` makes, from the two neighbours of a state before it.
State Sensitivities::Parameter::change(const State& from, const State& tangent,
                                       const std::function<bool(MeshedState&)>& change) {
  MeshedState above{std::move(more), moved(from, tangent, pair.step)},
      below{std::move(less), moved(from, tangent, -pair.step)};
  if (!change(above) || !change(below))
    throw std::runtime_error("a derivative cannot follow the run through an event at t = " + text_of(from.t) +
                             " s");
  more = std::move(above.system);
  less = std::move(below.system);
  if (above.state.q.size() != below.state.q.size() || above.state.lambda.size() != below.state.lambda.size())
    not_alike("what happens at an event changes");
  return rate(above.state, below.state, pair.step);
}

Sensitivities::Sensitivities(const SimulationOptions& options, std::vector<ProbePlace> probes,
                             std::vector<NeighbourPair> parameters, bool by_adjoint)
    : begins_at_rest_(options.statics || options.start_from_equilibrium),
      is_static_(options.statics),
      by_adjoint_(by_adjoint),
      end_time_(options.end_time),
      probes_(std::move(probes)) {
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

// Starts with these tangents, one for each parameter.
void Sensitivities::start_afresh(const MeshedState& at, const std::vector<State>& tangents) {
  tangents_ = MotionTangents::zero(at.state.q.size(), at.state.lambda.size(),
                                   static_cast<Eigen::Index>(tangents.size()));
  for (std::size_t k = 0; k < tangents.size(); ++k)
    tangents_.start_afresh(static_cast<Eigen::Index>(k), tangents[k]);
  dynamics_ = tangents_.q;
  constraints_ = tangents_.lambda;
  go_on_from(at, ResidualDifferences(pairs(), at.state));
}

void Sensitivities::go_on_from(const MeshedState& at, ResidualDifferences differences) {
  system_ = at.system;
  state_ = at.state;
  meshes_ = nullptr;
  ahead_.reset();
  differences_ = std::move(differences);
}

std::vector<ResidualDifferences::Pair> Sensitivities::pairs() const {
  std::vector<ResidualDifferences::Pair> pairs;
  for (const Parameter& parameter : parameters_)
    pairs.push_back({parameter.more.get(), parameter.less.get(), parameter.pair.step});
  return pairs;
}

Sensitivities::Shifts Sensitivities::shifts_at(const State& at) const {
  Shifts shifts;
  for (const Parameter& parameter : parameters_) {
    const auto& [more, less, step] = parameter.pair;
    shifts.push_back(shifts_of_places(*system_, at, *more.model, *less.model, step));
  }
  return shifts;
}

// Finds the derivatives of the residual into dynamics_ and constraints_, in a state whose time changes too,
// with riders at corresponding places. Returns the shifts to these places.
Sensitivities::Shifts Sensitivities::find_residual_changes(const State& at, const Eigen::RowVectorXd& time) {
  Shifts shifts = shifts_at(at);
  differences_->find(*system_, at, time, shifts, dynamics_, constraints_);
  work_.residuals += differences_->work();
  return shifts;
}

// Takes the part off the residual that the shifts alone cause.
void Sensitivities::take_off(const Shifts& shifts, const Eigen::SparseMatrix<double>& stiffness) {
  for (std::size_t k = 0; k < shifts.size(); ++k)
    for (const auto& [place, by] : shifts[k]) {
      const Vector with_place = by * stiffness.col(place);
      dynamics_.col(static_cast<Eigen::Index>(k)) -= with_place.head(dynamics_.rows());
      constraints_.col(static_cast<Eigen::Index>(k)) -= with_place.tail(constraints_.rows());
    }
}

void Sensitivities::begins(const MeshedState& drawn) {
  const auto kinks_of = [this](const BeamModel& model) {
    std::vector<double> kinks = kink_times(model);  // as the run comes to them, and seams
    for (const double seam : seam_times(model)) kinks.push_back(seam);
    std::sort(kinks.begin(), kinks.end());
    kinks.erase(std::lower_bound(kinks.begin(), kinks.end(), end_time_), kinks.end());
    return kinks;
  };
  const std::vector<double> kinks = kinks_of(drawn.system->model());
  for (Parameter& parameter : parameters_)
    for (Neighbour* each : {&parameter.pair.more, &parameter.pair.less}) {
      if (kinks_of(*each->model) != kinks) not_alike("the times of tables or releases change");
      each->model = divided_like(each->model, drawn.system->model());
    }
  if (begins_at_rest_) return;
  std::vector<State> rates(parameters_.size());
  side_by_side(static_cast<int>(parameters_.size()), [&](int k) {
    Parameter& parameter = parameters_[static_cast<std::size_t>(k)];
    const BeamSystem* like = drawn.system.get();
    MeshedState more = MeshedState::drawn(parameter.pair.more.model, like),
                less = MeshedState::drawn(parameter.pair.less.model, like);
    for (MeshedState* each : {&more, &less}) {
      if (!same_mesh(*drawn.system, *each->system)) not_alike("the mesh changes");
      stand_on_like_spans(drawn, *each);
    }
    rates[static_cast<std::size_t>(k)] = rate(more.state, less.state, parameter.pair.step);
    parameter.more = std::move(more.system);
    parameter.less = std::move(less.system);
  });
  start_afresh(drawn, rates);
}

void Sensitivities::rests(const MeshedState& at) {
  const int n = at.system->coordinate_count(), m = at.system->constraint_count();
  Eigen::SparseMatrix<double> stiffness = tangent_matrix(*at.system, at.state, {.stiffness = 1});
  ++work_.tangents;
  side_by_side(static_cast<int>(parameters_.size()), [&](int k) {
    Parameter& parameter = parameters_[static_cast<std::size_t>(k)];
    parameter.more = at_rest_like(at, parameter.pair.more.model);
    parameter.less = at_rest_like(at, parameter.pair.less.model);
    for (const BeamSystem* each : {parameter.more.get(), parameter.less.get()})
      if (!same_mesh(*at.system, *each)) not_alike("where bodies rest changes");
  });
  start_afresh(at, std::vector<State>(parameters_.size(), still(n, m)));
  if (by_adjoint_ && is_static_)
    keep_for_adjoint(at, stiffness);
  else
    solve_at_rest(at, stiffness);
}

void Sensitivities::solve_at_rest(const MeshedState& at, const Eigen::SparseMatrix<double>& stiffness) {
  const Eigen::Index n = at.state.q.size(), m = at.state.lambda.size();
  auto factors = std::make_shared<const EquilibratedKkt>(stiffness, static_cast<int>(n));
  if (!factors->regular()) singular_rest();
  take_off(find_residual_changes(at.state, tangents_.t), stiffness);
  MotionTangents::Matrix open(n + m, tangents_.parameters());
  open << dynamics_, constraints_;
  const MotionTangents::Matrix x = factors->solutions(open);
  tangents_.q = -x.topRows(n);
  tangents_.lambda = -x.bottomRows(m);
  work_.solves += tangents_.parameters();
  if (is_static_) factors_ = std::move(factors);
}

// Keeps a rest for its adjoint. Tangents are the shifts alone, which put the neighbours at corresponding
// places.
void Sensitivities::keep_for_adjoint(const MeshedState& at, const Eigen::SparseMatrix<double>& stiffness) {
  RestAdjoint adjoint(at.state, at.system->coordinate_scale(), stiffness);
  if (!adjoint.regular()) singular_rest();
  const Shifts shifts = find_residual_changes(at.state, tangents_.t);
  for (std::size_t k = 0; k < shifts.size(); ++k)
    for (const auto& [place, by] : shifts[k]) tangents_.q(place, static_cast<Eigen::Index>(k)) = by;
  rest_ = std::make_shared<const Rest>(
      Rest{at_rest_like(at, at.system->shared_model()), std::move(adjoint), dynamics_, constraints_});
}

void Sensitivities::changes(const MeshedState& at, const std::function<bool(MeshedState&)>& change) {
  carry();
  catch_up();
  std::vector<State> tangents;
  for (std::size_t k = 0; k < parameters_.size(); ++k) {
    tangents.push_back(parameters_[k].change(state_, tangents_.of(static_cast<Eigen::Index>(k)), change));
    if (!same_mesh(*at.system, *parameters_[k].more)) not_alike("what happens at an event changes");
  }
  start_afresh(at, tangents);
}

void Sensitivities::happens(const RunEvent& event) {
  carry();
  const bool of_mesh = event.kind <= EventKind::becomes_node;
  std::vector<double> rates(parameters_.size(), std::numeric_limits<double>::quiet_NaN());
  if (!of_mesh) Eigen::RowVectorXd::Map(rates.data(), tangents_.parameters()) = tangents_.t;
  event_times_.push_back(std::move(rates));
}

void Sensitivities::records(const MeshedState& at, bool of_the_moment) {
  if (!meshes_) {
    auto meshes = std::make_shared<Meshes>();
    const auto plan_of = [&](const Parameter& parameter, const BeamSystem& system) {
      return parameter.lags ? corresponding_plan(*system_, system.model()) : system.mesh().plan;
    };
    for (const Parameter& parameter : parameters_)
      meshes->plans.emplace_back(plan_of(parameter, *parameter.more), plan_of(parameter, *parameter.less));
    meshes->held = held_joints(*at.system);
    meshes_ = std::move(meshes);
  }
  Record record{.state = at.state,
                .of_the_moment = of_the_moment,
                .probes = probes_,
                .meshes = meshes_,
                .rest = rest_,
                .factors = factors_};
  for (ProbePlace& probe : record.probes) probe.span = span_of(*at.system, at.state, probe);
  if (stretch_) {
    record.position = stretch_->steps.size();
    stretch_->records.push_back(records_.size());
    records_.push_back(std::move(record));
  } else {
    keep_tangents(records_.emplace_back(std::move(record)));
  }
}

// A neighbour's system at the time of a record.
std::shared_ptr<const BeamSystem> Sensitivities::neighbour_at(const Record& record, std::size_t parameter,
                                                              bool more) const {
  const Parameter& of = parameters_[parameter];
  const auto& [plan_of_more, plan_of_less] = record.meshes->plans[parameter];
  const MeshPlan& plan = more ? plan_of_more : plan_of_less;
  if (record.meshes != meshes_)
    return std::make_shared<BeamSystem>((more ? of.pair.more : of.pair.less).model, plan,
                                        record.meshes->held);
  const std::shared_ptr<const BeamSystem>& now = more ? of.more : of.less;
  return of.lags ? now->replanned(plan, record.meshes->held, system_.get()) : now;
}

// Finds the extremes that are asked for in a record. On a former mesh the run's own system is gone, and a
// neighbour's is used.
void Sensitivities::hold_extremes(Record& record) {
  if (asked_.of_beams.empty() || record.extremes || parameters_.empty()) return;
  if (record.meshes == meshes_)
    record.extremes.emplace(*system_, record.state, asked_.of_beams);
  else
    record.extremes.emplace(*neighbour_at(record, 0, true),
                            moved(record.state, record.tangents->of(0), parameters_[0].pair.step),
                            asked_.of_beams);
}

// The snapshot of a record without energies; its extremes stay where the run has them.
Snapshot Sensitivities::snapshot(const Record& record, const BeamSystem& system, const State& state,
                                 const std::vector<ProbePlace>& probes) const {
  SnapshotContents contents = asked_.contents;
  contents.beams = contents.energy = false;
  Snapshot snapshot = record_snapshot(system, state, probes, contents);
  if (record.extremes) snapshot.beams = record.extremes->at(system, state);
  return snapshot;
}

std::vector<Sensitivities::Neighbours> Sensitivities::neighbours(std::size_t record) const {
  const Record& of = records_[record];
  struct Side {
    std::shared_ptr<const BeamSystem> system;
    State state;
  };
  const auto side_of = [&](std::size_t k, bool more) {
    const State tangent = of.tangents ? of.tangents->of(static_cast<Eigen::Index>(k))
                                      : still(of.state.q.size(), of.state.lambda.size());
    const double step = parameters_[k].pair.step;
    return Side{neighbour_at(of, k, more), moved(of.state, tangent, more ? step : -step)};
  };
  const auto of_sides = [&](const auto& work) {  // more and less of each parameter
    side_by_side(static_cast<int>(2 * parameters_.size()), [&](int i) {
      const auto k = static_cast<std::size_t>(i);
      work(k / 2, k % 2 == 0, k);
    });
  };
  // All at once; without factors one by one, as the systems of former meshes take much memory.
  std::vector<Side> settled;
  if (of.factors) {
    settled.resize(2 * parameters_.size());
    of_sides([&](std::size_t k, bool more, std::size_t i) { settled[i] = side_of(k, more); });
    std::vector<NearRest> rests;
    for (Side& side : settled) rests.push_back({side.system.get(), &side.state});
    if (!settle_near(rests, *of.factors))
      throw std::runtime_error("a derivative finds no equilibrium beside that of the run");
  }
  std::vector<Neighbours> found(parameters_.size());
  of_sides([&](std::size_t k, bool more, std::size_t i) {
    Side side = of.factors ? std::move(settled[i]) : side_of(k, more);
    if (of.of_the_moment &&
        make_accelerations_consistent(*side.system, side.state) != ConsistencyStatus::done)
      throw std::runtime_error("a derivative needs accelerations, and the mass matrix is singular");
    const NeighbourPair& pair = parameters_[k].pair;
    std::vector<ProbePlace> probes = (more ? pair.more : pair.less).probes;
    for (std::size_t j = 0; j < probes.size(); ++j) probes[j].span = of.probes[j].span;
    Snapshot& own = more ? found[k].more : found[k].less;
    own = snapshot(of, *side.system, side.state, probes);
    if (asked_.contents.energy) own.energy = record_energy(energy(*side.system, side.state));
  });
  return found;
}

}  // namespace nurbeam
