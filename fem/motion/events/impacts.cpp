#include "fem/motion/events/impacts.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "fem/motion/events/friction_modes.h"
#include "fem/system/observables.h"
#include "solver/system/consistent.h"

namespace nurbeam {

namespace {

constexpr double shortest_rebound = 0.01;  // part of a step; a shorter rebound is not followed
constexpr double least_rebound = 1e-10;    // part of the fastest speed; a slower rebound is not followed

// The fastest speed of bodies of stops along their beams [m/s].
double fastest(const BeamSystem& system, const State& state) {
  double most = 0;
  for (const Stop& stop : system.model().stops)
    for (const int rider : {stop.rider, stop.other})
      if (const int place = rider < 0 ? -1 : system.mesh().riders[rider].place; place >= 0)
        most = std::max(most, std::abs(state.v[place]));
  return most;
}

// Whether closed contacts keep the distance of a stop already, as they do for the second of two stops in one
// place.
bool others_keep(const BeamModel& model, const std::vector<bool>& closed, int stop) {
  const int beam = static_cast<int>(model.riders.size());
  std::vector<bool> tied(model.riders.size() + 1, false);  // to the rider; the last one is the beam
  const auto other = [&](int i) { return model.stops[i].other < 0 ? beam : model.stops[i].other; };
  tied[model.stops[stop].rider] = true;
  for (bool more = true; more;) {
    more = false;
    for (int i = 0; i < static_cast<int>(closed.size()); ++i) {
      if (!closed[i] || i == stop || tied[model.stops[i].rider] == tied[other(i)]) continue;
      tied[model.stops[i].rider] = tied[other(i)] = more = true;
    }
  }
  return tied[other(stop)];
}

// Per stop: speeds and impulses across it that make no difference.
struct Unnoticed {
  std::vector<double> speed;  // [m/s]: a step cannot tell bodies this slow from bodies that touch
  std::vector<double>
      impulse;  // [N s]: impulse of this speed; the force of a kept contact restores it at once
};

Unnoticed unnoticed(const MeshedState& at, double step) {
  const BeamModel& model = at.system->model();
  Unnoticed least;
  for (int i = 0; i < static_cast<int>(model.stops.size()); ++i) {
    least.speed.push_back(unnoticed_speed(at, i, step));
    least.impulse.push_back(model.body_of(model.riders[model.stops[i].rider]).mass * least.speed[i]);
    if (at.system->mesh().plan.is_closed(i))
      least.impulse[i] += std::max(0.0, contact_force(*at.system, at.state, i)) * shortest_rebound / 2 * step;
  }
  return least;
}

// Per stop: whether impacts of others pass through it at once, as the contact is kept, or the touching bodies
// do not rebound.
std::vector<bool> passing_contacts(const MeshedState& at) {
  std::vector<bool> passing = closed_contacts(*at.system);
  for (int i = 0; i < static_cast<int>(passing.size()); ++i) {
    const Stop& of = stop_of(*at.system, i);
    passing[i] = passing[i] || (!of.buffer && of.restitution == 0 && touches(*at.system, at.state, i));
  }
  return passing;
}

// The state with velocities that do not run into the contacts `among`. These are closed where an impulse L
// keeps them: L >= 0 and W v >= 0, and one of the two is 0 in each. This is a linear complementarity problem,
// solved by Murty's method: the first contact that is wrong changes, until none is. Contacts that other stops
// or rods keep already are not closed.
std::optional<MeshedState> stopped(const MeshedState& at, std::vector<bool> among, const Unnoticed& least,
                                   double step) {
  std::vector<bool> closed = closed_contacts(*at.system);
  const int stops = static_cast<int>(closed.size());
  const int most_changes = 1 << std::min(stops, 12);  // more than it takes but for round-off
  int wrong = stops;
  for (int change = 0;; ++change) {
    MeshedState kept = with_contacts(at, closed);
    const Projection projection = project_velocities(*kept.system, kept.state, step);
    if (projection.status != ConsistencyStatus::done) {
      if (wrong == stops || !closed[wrong]) return {};
      closed[wrong] = among[wrong] = false;
      continue;
    }
    State impulse = kept.state;
    impulse.lambda = projection.impulse;
    const double none = contact_noise * projection.impulse.lpNorm<Eigen::Infinity>();
    const auto is_wrong = [&](int i) {
      if (!among[i]) return false;
      if (!closed[i] && others_keep(at.system->model(), closed, i)) return false;
      if (!closed[i]) return opening_rate(*at.system, kept.state, i) < -least.speed[i];
      return contact_force(*kept.system, impulse, i) < -none - least.impulse[i];
    };
    wrong = 0;
    while (wrong < stops && !is_wrong(wrong)) ++wrong;
    if (wrong == stops || change == most_changes) return kept;
    closed[wrong] = !closed[wrong];
  }
}

// Opens the closed contacts across which bodies still move.
MeshedState with_contacts_that_stay(const MeshedState& at, const Unnoticed& least) {
  std::vector<bool> closed = closed_contacts(*at.system);
  for (int i = 0; i < static_cast<int>(closed.size()); ++i)
    closed[i] = closed[i] && std::abs(opening_rate(*at.system, at.state, i)) <= least.speed[i];
  return with_contacts(at, std::move(closed));
}

// The state after an impact at a stop. Contacts without rebound come to rest first: a row of bodies that
// touch so is one body for the body that meets it. When impacts at one moment count as endlessly many, and
// each loses energy, this one loses all that it can.
std::optional<MeshedState> after_impact(const MeshedState& at, int stop, const Unnoticed& least, double step,
                                        Arrival arrival) {
  const double given = stop_of(*at.system, stop).restitution,
               restitution = arrival == Arrival::in_chain && given < 1 ? 0 : given,
               followed = std::max(least_rebound * fastest(*at.system, at.state), least.speed[stop]);
  const bool rebounds = restitution > 0 && -opening_rate(*at.system, at.state, stop) > followed;
  std::vector<bool> among = passing_contacts(at);
  among[stop] = !rebounds;
  std::optional<MeshedState> after = stopped(at, among, least, step);
  if (!after || !rebounds) return after;
  const Eigen::VectorXd before = after->state.v;
  among[stop] = true;
  after = stopped(*after, std::move(among), least, step);
  if (!after) return {};
  after->state.v += restitution * (after->state.v - before);
  return with_contacts_that_stay(*after, least);
}

}  // namespace

double touching(const BeamModel& model, int rider) {
  return 1e-13 * model.beam_of(model.riders[rider]).curve.length();
}

bool touches(const BeamSystem& system, const State& state, int stop) {
  return is_in_place(system.mesh(), stop_of(system, stop)) &&
         distance(system, state, stop) <= touching(system.model(), stop_of(system, stop).rider);
}

double unnoticed_speed(const MeshedState& at, int stop, double step) {
  const double round_off = contact_noise * fastest(*at.system, at.state);
  const double kept = touching(at.system->model(), stop_of(*at.system, stop).rider);
  return step > 0 ? std::max(round_off, kept / step) : round_off;
}

std::vector<bool> closed_contacts(const BeamSystem& system) {
  std::vector<bool> closed = system.mesh().plan.closed;
  closed.resize(system.model().stops.size(), false);
  return closed;
}

MeshedState with_contacts(const MeshedState& at, std::vector<bool> closed) {
  MeshPlan plan = present_plan(*at.system, at.state);
  plan.closed = std::move(closed);
  MeshedState next{at.system->replanned(std::move(plan)), at.state};
  next.state.lambda = Eigen::VectorXd::Zero(next.system->constraint_count());
  return next;
}

MeshedState with_contact(const MeshedState& at, int stop, bool kept) {
  std::vector<bool> closed = closed_contacts(*at.system);
  closed[stop] = kept;
  return with_contacts(at, std::move(closed));
}

std::optional<MeshedState> hit_stop(const MeshedState& at, int stop, double step, Arrival arrival) {
  const Unnoticed least = unnoticed(at, step);
  const bool is_there =
      arrival != Arrival::in_step && opening_rate(*at.system, at.state, stop) >= -least.speed[stop];
  const std::optional<MeshedState> after = after_impact(at, stop, least, step, arrival);
  if (!after) return {};
  MeshedState open = with_contact(*after, stop, false), moving = with_contact(*after, stop, false);
  if (!settle_friction_after_contact(at, moving, step)) return {};
  if (make_accelerations_smooth(*moving.system, step, moving.state) != ConsistencyStatus::done) return {};
  const double away = opening_rate(*open.system, open.state, stop),
               pushed = -distance_of(*open.system, stop)
                             .acceleration(moving.state.q, moving.state.v, moving.state.a),
               unfelt = contact_noise * moving.state.a.lpNorm<Eigen::Infinity>();
  std::vector<bool> among = passing_contacts(*after);
  const bool is_still = std::abs(away) <= least.speed[stop],
             rests = is_there || (among[stop] && is_still && pushed >= -unfelt) ||
                     (pushed > 0 && away < pushed / 2 * shortest_rebound * step);
  if (!rests || others_keep(at.system->model(), closed_contacts(*open.system), stop)) return open;
  among[stop] = false;
  std::optional<MeshedState> kept = stopped(with_contact(*after, stop, true), std::move(among), least, step);
  if (!kept) return open;  // rods keep it there
  // A short step would close an open rest of the contact at a speed of its own.
  close_constraints_to_round_off(*kept->system, kept->state);
  return kept;
}

}  // namespace nurbeam
