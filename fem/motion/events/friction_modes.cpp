#include "fem/motion/events/friction_modes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fem/forces/memory.h"
#include "fem/motion/events/taut_connectors.h"
#include "fem/motion/remesh/mesh_rules.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

// What swings on the spring of a rider's friction [kg]: its body; of a ring, which has no mass, what turns
// with the beam, and an element of that.
double swinging_mass(const BeamModel& model, const Rider& rider) {
  if (const double mass = model.body_of(rider).mass; mass > 0) return mass;
  const Beam& beam = model.beam_of(rider);
  return rider.turning_inertia +
         beam.properties.mass_per_length * beam.curve.length() / beam.home_intervals();
}

// A body with friction that is slower is at rest [m/s]: it would swing on the spring of its friction by less
// than places are known.
double rest_speed(const BeamModel& model, int rider) {
  const Rider& of = model.riders[rider];
  constexpr double round_off = 1e-12;
  return round_off * model.beam_of(of).curve.length() *
         std::sqrt(model.stick_stiffness(of) / swinging_mass(model, of));
}

// Memory of a body that slides one way, with the spring stretched up to the bound, which follows the forces.
FrictionMemory sliding(const BeamModel& model, int rider, double s, int way, double bound) {
  return {way * bound / model.stick_stiffness(model.riders[rider]), s, way};
}

// Opens contacts of bodies that are held and need no stop.
void open_held_contacts(const BeamModel& model, const std::vector<bool>& held, MeshPlan& plan) {
  for (std::size_t i = 0; i < plan.closed.size(); ++i) {
    const Stop& stop = model.stops[i];
    if (held[stop.rider] && (stop.other < 0 || held[stop.other])) plan.closed[i] = false;
  }
}

// The state and forces when some riders are held.
struct HeldMoment {
  BeamSystem system;
  State state;
};

std::optional<HeldMoment> hold(const MeshedState& at, const std::vector<int>& riders, double step) {
  std::vector<bool> held(at.system->model().riders.size(), false);
  for (const int j : riders) held[j] = true;
  MeshPlan plan = present_plan(*at.system, at.state);
  open_held_contacts(at.system->model(), held, plan);
  HeldMoment moment{BeamSystem(at.system->shared_model(), std::move(plan), held), at.state};
  moment.state.lambda = Eigen::VectorXd::Zero(moment.system.constraint_count());
  for (const int j : riders) {
    moment.state.v[moment.system.mesh().riders[j].place] = 0;
    set_friction_memory(at.system->mesh().memory, moment.state.memory, j,
                        {0, *place(*at.system, at.state, j), 0});
  }
  if (make_accelerations_smooth(moment.system, step, moment.state) != ConsistencyStatus::done) return {};
  return moment;
}

// As many of the riders as can be held at once. Where a rod ties a body to another one that is held, its own
// place needs no hold.
std::vector<int> independent(const MeshedState& at, const std::vector<int>& riders, double step) {
  if (hold(at, riders, step)) return riders;
  std::vector<int> chosen;
  for (const int j : riders) {
    chosen.push_back(j);
    if (!hold(at, chosen, step)) chosen.pop_back();
  }
  return chosen;
}

// Riders with friction whose bodies touch a rider's body, directly or through others: when it comes to rest,
// so do they.
std::vector<int> come_to_rest_with(const BeamSystem& system, int rider) {
  const BeamModel& model = system.model();
  std::vector<bool> together(model.riders.size(), false);
  together[rider] = true;
  for (bool more = true; more;) {
    more = false;
    for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
      const Stop& stop = model.stops[i];
      if (!system.mesh().plan.is_closed(i) || stop.other < 0) continue;
      if (together[stop.rider] == together[stop.other]) continue;
      together[stop.rider] = together[stop.other] = more = true;
    }
  }
  std::vector<int> riders = joints_with_friction(system);
  std::erase_if(riders, [&](int j) { return !together[j]; });
  return riders;
}

// A body that was held by its friction slides, the way that it is pulled.
void break_loose(MeshedState& at, int rider) {
  const FrictionForce friction = *sliding_friction(*at.system, at.state, rider);
  set_friction_memory(at.system->mesh().memory, at.state.memory, rider,
                      sliding(at.system->model(), rider, *place(*at.system, at.state, rider),
                              friction.trial > 0 ? 1 : -1, friction.bound));
}

// A body that has come to rest, and would slide on the same way, sticks at the bound. Only round-off makes it
// slide on, where friction is just enough to hold it: it would come to rest again for ever.
void stick_at_bound(MeshedState& at, int rider, int way) {
  const BeamModel& model = at.system->model();
  const double bound = sliding_friction(*at.system, at.state, rider)->bound;
  set_friction_memory(
      at.system->mesh().memory, at.state.memory, rider,
      {way * bound / model.stick_stiffness(model.riders[rider]), *place(*at.system, at.state, rider), 0});
}

}  // namespace

std::vector<bool> blocked_joints(const BeamSystem& system) {
  const BeamModel& model = system.model();
  std::vector<bool> blocked(model.riders.size(), false);
  for (bool more = true; more;) {
    more = false;
    for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
      const Stop& stop = model.stops[i];
      if (!system.mesh().plan.is_closed(i)) continue;
      const auto block = [&](int rider) {
        more = more || !blocked[rider];
        blocked[rider] = true;
      };
      if (stop.other < 0 || blocked[stop.other]) block(stop.rider);
      if (stop.other >= 0 && blocked[stop.rider]) block(stop.other);
    }
  }
  return blocked;
}

std::vector<int> joints_with_friction(const BeamSystem& system) {
  const MeshPlan& plan = system.mesh().plan;
  std::vector<int> riders;
  for (int j = 0; j < static_cast<int>(system.model().riders.size()); ++j) {
    const bool slides = plan.modes[j] == Carried::node || plan.modes[j] == Carried::point;
    if (system.model().riders[j].friction && slides && !plan.holds(j)) riders.push_back(j);
  }
  return riders;
}

std::optional<std::vector<LooseBody>> start_memory(MeshedState& at, double step) {
  at.state.memory = no_memory(at.system->mesh().memory);
  start_connectors(at);
  return settle_friction(at, joints_with_friction(*at.system), step, false);
}

std::optional<std::vector<LooseBody>> settle_friction(MeshedState& at, const std::vector<int>& riders,
                                                      double step, bool at_rest) {
  const BeamModel& model = at.system->model();
  const auto remember = [&](int j, const FrictionMemory& memory) {
    set_friction_memory(at.system->mesh().memory, at.state.memory, j, memory);
  };
  std::vector<int> still;
  std::vector<LooseBody> loose;
  const std::vector<bool> blocked = blocked_joints(*at.system);
  for (const int j : riders) {
    const double s = *place(*at.system, at.state, j), rate = place_rate(*at.system, at.state, j);
    const bool stands = at_rest || std::abs(rate) < rest_speed(model, j);
    if (blocked[j])
      remember(j, {0, s, 0});
    else if (stands && model.riders[j].friction->can_stick() && !model.riders[j].motion)
      still.push_back(j);
    else
      remember(j, sliding(model, j, s, stands ? 0 : rate < 0 ? -1 : 1, 0));
  }
  // A body that breaks loose changes the forces on the others.
  for (bool all_stick = still.empty(); !all_stick;) {
    const std::vector<int> holding = independent(at, still, step);
    const std::optional<HeldMoment> moment = hold(at, holding, step);
    if (!moment) return {};
    all_stick = true;
    std::vector<int> stick;
    for (const int j : still) {
      if (std::find(holding.begin(), holding.end(), j) == holding.end()) {
        remember(j, {0, *place(*at.system, at.state, j), 0});
        stick.push_back(j);
        continue;
      }
      const State& held = moment->state;
      const FrictionForce friction = *sliding_friction(moment->system, held, j);
      const double needed = holding_force(moment->system, held, j) / friction.per_along;
      const double s = *place(*at.system, at.state, j);
      if (std::abs(needed) <= friction.bound) {
        remember(j, {-needed / model.stick_stiffness(model.riders[j]), s, 0});
        stick.push_back(j);
        continue;
      }
      remember(j, sliding(model, j, s, needed < 0 ? 1 : -1, friction.bound));
      loose.push_back({j, std::abs(needed), friction.bound});
      all_stick = false;
    }
    still = std::move(stick);
    all_stick = all_stick || still.empty();
  }
  return loose;
}

bool settle_friction_after_contact(const MeshedState& before, MeshedState& at, double step) {
  const std::vector<bool> was = blocked_joints(*before.system), is = blocked_joints(*at.system);
  std::vector<int> changed = joints_with_friction(*at.system);
  std::erase_if(changed, [&](int j) {
    const double jump = place_rate(*at.system, at.state, j) - place_rate(*before.system, before.state, j);
    return was[j] == is[j] && std::abs(jump) < rest_speed(at.system->model(), j);
  });
  return settle_friction(at, changed, step, false).has_value();
}

double wrap(const BeamSystem& system, const State& state, int rider) {
  const Mesh& mesh = system.mesh();
  const int node = mesh.riders[rider].node, D = system.dimension();
  if (node < 0) return 0;
  const MeshNode& at = mesh.nodes[system.model().riders[rider].beam][node];
  if (at.slope_left == at.slope_right) return 0;
  const Eigen::VectorXd left = state.q.segment(at.slope_left, D).normalized(),
                        right = state.q.segment(at.slope_right, D).normalized();
  return 2 * std::atan2((right - left).norm(), (right + left).norm());
}

std::optional<Failure> excess_of_wrap(const MeshedState& at) {
  const BeamModel& model = at.system->model();
  for (int j = 0; j < static_cast<int>(model.riders.size()); ++j) {
    const std::optional<Friction>& friction = model.riders[j].friction;
    if (!friction || friction->law != Friction::Law::coulomb || friction->sticking_coefficient() == 0)
      continue;
    if (const double angle = wrap(*at.system, at.state, j); angle > most_wrap_of_coulomb)
      return Failure{.kind = Failure::Kind::wrap, .time = at.state.t, .rider = j, .wrap = angle};
  }
  return {};
}

double holding_capacity(const BeamSystem& system, const State& state, int rider, bool sticking) {
  State asked = state;
  asked.memory = no_memory(system.mesh().memory);
  set_friction_memory(system.mesh().memory, asked.memory, rider,
                      {0, *place(system, state, rider), sticking ? 0 : 1});
  const std::optional<FrictionForce> friction = sliding_friction(system, asked, rider);
  return friction ? friction->bound * friction->per_along : 0;
}

void hold_by_friction(MeshedState& at, const std::vector<bool>& except) {
  const std::vector<int> riders = joints_with_friction(*at.system);
  if (riders.empty()) return;
  State held = at.state;
  held.memory = no_memory(at.system->mesh().memory);
  for (const int j : riders) {
    const double s = *place(*at.system, at.state, j);
    set_friction_memory(at.system->mesh().memory, held.memory, j, {0, s, 0});
    if (except[j] || at.system->model().riders[j].motion) continue;
    const double along =
        holding_force(*at.system, at.state, j) / sliding_friction(*at.system, held, j)->per_along;
    set_friction_memory(at.system->mesh().memory, held.memory, j,
                        {-along / at.system->model().stick_stiffness(at.system->model().riders[j]), s, 0});
  }
  at.state.memory = held.memory;
}

double beyond(const BeamSystem& system, const State& before, const State& state,
              const FrictionChange& change) {
  const int way = sliding_way(system, before, change.rider);
  if (change.turns) return -way * place_rate(system, state, change.rider);
  State in_step = state;
  in_step.memory = before.memory;
  const FrictionForce friction = *sliding_friction(system, in_step, change.rider);
  return std::abs(friction.trial) - friction.bound;
}

double tolerance(const BeamSystem& system, const State& before, const FrictionChange& change) {
  if (change.turns) return rest_speed(system.model(), change.rider);
  return 1e-9 * sliding_friction(system, before, change.rider)->bound;
}

std::optional<FrictionChange> first_friction_change(const BeamSystem& system, const State& before,
                                                    const State& after, bool nothing_turns) {
  std::optional<FrictionChange> first;
  const std::vector<bool> blocked = blocked_joints(system);
  for (const int j : joints_with_friction(system)) {
    const Rider& rider = system.model().riders[j];
    if (blocked[j] || rider.motion || !rider.friction->can_stick()) continue;
    FrictionChange change{j, sliding_way(system, before, j) != 0, 0};
    const double from = beyond(system, before, before, change), to = beyond(system, before, after, change),
                 near = tolerance(system, before, change);
    const bool in_step = from < -near && to > 0,
               as_it_begins = change.turns && !nothing_turns && from >= -near && to > near;
    if (!in_step && !as_it_begins) continue;
    change.part = in_step ? from / (from - to) : 0;
    if (!first || change.part < first->part) first = change;
  }
  return first;
}

std::optional<EventKind> apply(MeshedState& at, const FrictionChange& change, double step) {
  const int way = sliding_way(*at.system, at.state, change.rider);
  if (!change.turns)
    break_loose(at, change.rider);
  else if (!settle_friction(at, come_to_rest_with(*at.system, change.rider), step, true))
    return {};
  if (change.turns && sliding_way(*at.system, at.state, change.rider) == way)
    stick_at_bound(at, change.rider, way);
  return sliding_way(*at.system, at.state, change.rider) == 0 ? EventKind::sticks : EventKind::slides;
}

std::vector<int> changed_ways(const BeamSystem& system, const State& before, const State& after) {
  std::vector<int> riders = joints_with_friction(system);
  const std::vector<bool> blocked = blocked_joints(system);
  std::erase_if(riders, [&](int j) {
    return blocked[j] || sliding_way(system, before, j) == sliding_way(system, after, j) ||
           !system.model().riders[j].friction->can_stick();
  });
  return riders;
}

int sliding_way(const BeamSystem& system, const State& state, int rider) {
  return friction_memory(system.mesh().memory, state.memory, rider).slides;
}

}  // namespace nurbeam
