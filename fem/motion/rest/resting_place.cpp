#include "fem/motion/rest/resting_place.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "fem/motion/events/crossing.h"
#include "fem/motion/events/friction_modes.h"
#include "fem/motion/record/loaded_between.h"
#include "fem/motion/remesh/carried_sections.h"
#include "fem/motion/remesh/recentring.h"
#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/motion/rest/descent.h"
#include "fem/motion/rest/find_loose_part.h"
#include "fem/motion/rest/snap.h"
#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "solver/rest/static_equilibrium.h"

namespace nurbeam {

namespace {

// Distance that a rider can move in a direction while its elements keep half of their length [m]. Beyond it
// Newton's method would start too far off.
double room_to_move(const MeshedState& at, int rider, int direction) {
  const Mesh& mesh = at.system->mesh();
  const int node = mesh.riders[rider].node;
  if (node < 0) return std::numeric_limits<double>::infinity();
  const int beam = at.system->model().riders[rider].beam;
  const MeshSpan& span = mesh.spans[spans_at(mesh, beam, node)[direction > 0 ? 1 : 0]];
  return (span.end(at.state.q) - span.start(at.state.q)) / 2;
}

// The plan of the mesh with riders held at other places.
MeshPlan held_at(const MeshedState& at, const std::vector<double>& places) {
  MeshPlan plan = at.system->mesh().plan;
  plan.places = places;
  carry_sections(*at.system, at.state, plan);
  return plan;
}

// Present places of the riders; a rider whose body has left keeps its place of the plan.
std::vector<double> present_places(const MeshedState& at) {
  std::vector<double> places = at.system->mesh().plan.places;
  for (std::size_t j = 0; j < places.size(); ++j)
    if (const auto s = place(*at.system, at.state, static_cast<int>(j))) places[j] = *s;
  return places;
}

// The search that brings `at` to rest.
class RestSearch {
 public:
  // `equilibrium`: the time at which `at` is in equilibrium, if it is.
  RestSearch(MeshedState& at, const LengthControl& control, const std::function<bool()>& interrupted,
             std::optional<double> equilibrium = {})
      : at_(at), control_(control), interrupted_(interrupted), equilibrium_(equilibrium) {}

  RestSearch& watching_snaps() {
    watches_ = true;
    return *this;
  }

  RestReport held_equilibrium() {
    return told([&] { hold_in_equilibrium(at_.system->mesh().plan); });
  }

  // A held equilibrium on a mesh that needs no change when the motion begins with the riders' initial speeds.
  RestReport held_start() {
    return told([&] {
      MeshPlan plan = at_.system->mesh().plan;
      constexpr int most_rounds = 10;
      for (int round = 0; round < most_rounds && hold_in_equilibrium(std::move(plan)); ++round) {
        // Kept alive, so that no other system gets its address.
        const std::shared_ptr<const BeamSystem> before = at_.system;
        for (int j = 0; j < riders(); ++j) {
          const Rider& rider = model().riders[j];
          const int dof = at_.system->mesh().riders[j].place;  // length control looks at its speed
          if (dof >= 0) at_.state.v[dof] = rider.motion ? rider.motion->at(at_.state.t).speed : rider.speed;
        }
        const bool goes_on = settle_mesh();
        at_.state.v.setZero();
        if (!goes_on || at_.system == before) return;
        plan = held_at(at_, present_places(at_));
      }
    });
  }

  // `slides`: the riders whose bodies look for their resting place.
  RestReport rest(const std::vector<bool>& slides) {
    return told([&] { look_for_rest(slides); });
  }

 private:
  const BeamModel& model() const { return at_.system->model(); }
  int riders() const { return static_cast<int>(model().riders.size()); }
  double spacing(int rider) const { return home_spacing(model(), rider); }

  RestReport told(const std::function<void()>& search) {
    try {
      search();
    } catch (const Interruption&) {
      report_.interrupted = true;
    }
    return std::move(report_);
  }

  void look_for_rest(const std::vector<bool>& slides) {
    at_.state.memory.resize(0);  // bodies are held as they are searched for
    if (!goes_on(meeting_bodies(at_)) ||
        !hold_in_equilibrium(equilibrium_ ? held_at(at_, present_places(at_)) : at_.system->mesh().plan))
      return;
    if (!move_driven_bodies()) return;
    std::vector<Descent> bodies;
    for (int j = 0; j < riders(); ++j) bodies.push_back({slides[j] ? first_move(model(), j) : 0});
    for (std::vector<int>& group : coupled_joints(model(), slides))
      coupled_.emplace_back(model(), std::move(group));
    constexpr int most_moves = 2000;
    for (int moves = 0; !report_.failure && let_down(bodies); ++moves)
      if (moves > most_moves) report_.failure = Failure{.kind = Failure::Kind::resting_place};
    if (report_.failure || !goes_on(leaving_body(bodies))) return;
    std::vector<bool> stays;
    for (int j = 0; j < riders(); ++j)
      stays.push_back(bodies[j].at_end || !(slides[j] || model().riders[j].motion));
    hold_by_friction(at_, stays);
    free_bodies(stays);
  }

  bool goes_on(std::optional<Failure> failure) {
    report_.failure = std::move(failure);
    return !report_.failure;
  }

  // The failure of a body that has arrived at a free end which it would leave: it is not at rest there.
  std::optional<Failure> leaving_body(const std::vector<Descent>& bodies) const {
    for (int j = 0; j < riders(); ++j) {
      if (!bodies[j].leaves || !model().riders[j].leave_at_end) continue;
      const double s = *place(*at_.system, at_.state, j),
                   length = model().beam_of(model().riders[j]).curve.length();
      if (!is_held(model(), {j, s, s > length / 2}))
        return Failure{
            .kind = Failure::Kind::leaves_beam, .time = at_.state.t, .places = places_of(at_), .rider = j};
    }
    return {};
  }

  // Moves bodies with a prescribed motion to their places at the present time.
  bool move_driven_bodies() {
    std::vector<double> ds(model().riders.size(), 0);
    for (int j = 0; j < riders(); ++j)
      if (const auto& motion = model().riders[j].motion)
        if (const auto s = place(*at_.system, at_.state, j)) ds[j] = motion->at(at_.state.t).s - *s;
    return move_places(std::move(ds));
  }

  // Makes one move of every body and finds the equilibrium after it. False where all have arrived, or there
  // is no equilibrium.
  bool let_down(std::vector<Descent>& bodies) {
    std::vector<double> ds(bodies.size(), 0);
    for (int j = 0; j < riders(); ++j)
      if (!is_coupled(j)) ds[j] = next_move(at_, j, bodies[j]);
    for (CoupledDescent& group : coupled_) group.next_moves(at_, bodies, ds);
    const bool arrived =
        std::all_of(bodies.begin(), bodies.end(), [](const Descent& body) { return body.arrived; });
    return !arrived && move_places(std::move(ds));
  }

  // Finds the equilibrium from the present state, which is kept on failure. `held`: the held riders.
  StaticReport find_equilibrium(MeshedState& at, const std::vector<bool>& held) {
    // A part that hangs on a rod has its stiffness from the rod's multiplier.
    if (at.state.lambda.size() != at.system->constraint_count())
      at.state.lambda = Eigen::VectorXd::Zero(at.system->constraint_count());
    at.state.v = at.state.a = Eigen::VectorXd::Zero(at.system->coordinate_count());
    const Loading to{1, at.state.t};
    const bool later = equilibrium_ && *equilibrium_ != to.t;
    const Loading from = later ? Loading{1, *equilibrium_} : Loading{0, to.t};
    const State before = at.state;
    const MeshedState start = at;
    const bool is_first = !equilibrium_ || later;  // else the state is near
    const int parts = is_first ? parts_of_turn(from, to) : 1;
    StaticReport found;
    for (int i = 1; i <= parts; ++i) {
      const Loading here = i == 1 ? from : Loading{at.state.load, at.state.t};
      if (i > 1 && recentring_due(*at.system, at.state)) at = recentred(*at.system, at.state, held);
      const double part = i / static_cast<double>(parts);
      found = load_recentred(
          at, here,
          i == parts ? to
                     : Loading{from.load + part * (to.load - from.load), from.t + part * (to.t - from.t)},
          held, parts == 1 && is_first ? &before : nullptr);
      if (found.status != StaticStatus::converged) break;
    }
    if (found.status == StaticStatus::converged)
      equilibrium_ = to.t;
    else if (at.system != start.system)
      at = start;
    return found;
  }

  // Number of parts in which supports turn on the way between two loadings. An equilibrium is one of the
  // angle alone, and not of how often it was turned by: it is followed.
  int parts_of_turn(Loading from, Loading to) const {
    constexpr double largest_turn = 0.5;  // [rad]
    double way = 0;
    for (const Constraint& constraint : model().constraints)
      if (const AxisTurn* turn = turn_of(constraint))
        way = std::max(way, std::abs(to.load - from.load) * std::abs(turn->angle.at(to.t).angle) +
                                turn->angle.way(from.t, to.t));
    return std::max(1, static_cast<int>(std::ceil(way / largest_turn)));
  }

  // As load(), in charts of their own where sections have turned far. `before`: the state from which a snap
  // is looked for, or null.
  StaticReport load_recentred(MeshedState& at, Loading from, Loading to, const std::vector<bool>& held,
                              const State* before) {
    StaticReport found = load(at, from, to);
    if (before && watches_ && found.status == StaticStatus::converged && !report_.snap)
      report_.snap =
          find_snap(*at.system, {*before, from}, {at.state, to}, found.newton_iterations, interrupted_);
    // The search stops half way when sections have turned far from their charts; it goes on in charts of
    // their own.
    constexpr int most_recentrings = 20;
    for (int turns = 0; found.status != StaticStatus::converged && recentring_due(*at.system, at.state) &&
                        turns < most_recentrings;
         ++turns) {
      at = recentred(*at.system, at.state, held);
      found = load(at, {at.state.load, at.state.t}, to);
    }
    return found;
  }

  // Goes from an equilibrium under one loading to one under another, or as far as equilibria are found.
  StaticReport load(MeshedState& at, Loading from, Loading to) {
    const LoadedBetween system(*at.system, from, to, interrupted_);
    at.state.load = 1;
    StaticEquilibrium settings{
        .ends_at = [&](const State& state) { return recentring_due(*at.system, state); }};
    if (nearby_only_) {
      settings.max_load_steps = 1;
      settings.max_iterations = 20;
    }
    StaticReport found = find_static_equilibrium(settings, system, at.state);
    const Loading reached = system.at(found.load_factor);
    at.state.load = found.load_factor = reached.load;
    at.state.t = reached.t;
    report_.newton_iterations += found.newton_iterations;
    report_.load_steps += found.load_steps;
    report_.diverges = report_.diverges || (found.diverges && found.status == StaticStatus::converged);
    if (found.status == StaticStatus::converged) stabilise(at, to);
    return found;
  }

  // Raises the stabilisation of an equilibrium from 0 to 1, which moves it only where an element resists
  // folding. Without an equilibrium on the way the state stays.
  void stabilise(MeshedState& at, const Loading& loading) {
    const LoadedBetween system(*at.system, loading, loading, interrupted_,
                               LoadedBetween::Stabilisation::rising);
    State state = at.state;
    const auto residual = [&](double stabilisation) {
      state.load = stabilisation;
      Eigen::VectorXd dynamics(system.coordinate_count()), constraints(system.constraint_count());
      system.residual(state, dynamics, constraints);
      return dynamics;
    };
    if (residual(0) == residual(1)) return;
    const StaticReport found = find_static_equilibrium({}, system, state);
    report_.newton_iterations += found.newton_iterations;
    report_.load_steps += found.load_steps;
    if (found.status != StaticStatus::converged) return;
    at.state = std::move(state);
    at.state.load = loading.load;
    at.state.t = loading.t;
  }

  // Finds the equilibrium with all sliding bodies held where the plan has them.
  bool hold_in_equilibrium(MeshPlan plan) {
    const StaticReport found = equilibrium_of(std::move(plan));
    if (found.status == StaticStatus::converged) return true;
    Failure failure{.kind = Failure::Kind::equilibrium, .equilibrium = found};
    if (found.status == StaticStatus::singular_matrix) failure.loose = find_free_part(at_);
    return goes_on(failure);
  }
  StaticReport equilibrium_of(MeshPlan plan) {
    const std::vector<bool> held(model().riders.size(), true);
    at_.system = at_.system->replanned(std::move(plan), held);
    return find_equilibrium(at_, held);
  }

  // Applies the changes of the mesh that are due.
  bool settle_mesh() {
    for (std::size_t count = 1;; ++count) {
      const auto start = std::chrono::steady_clock::now();
      const NextPlan next = next_plan(*at_.system, at_.state, control_);
      if (next.change == MeshChange::none) return true;
      if (!goes_on(change_mesh(at_, next, true))) return false;
      report_.length_control_seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (!goes_on(excess_of_changes(at_, count))) return false;
    }
  }

  bool is_coupled(int rider) const {
    return std::any_of(
        coupled_.begin(), coupled_.end(),
        [&](const CoupledDescent& group) {
          return std::count(group.riders().begin(), group.riders().end(), rider) > 0;
        });
  }

  // The part of each move that is made at once, so that no rider passes a node. Coupled riders go an equal
  // fraction of their ways.
  std::vector<double> parts_at_once(const std::vector<double>& ds) const {
    std::vector<double> parts;
    for (int j = 0; j < riders(); ++j)
      parts.push_back(std::clamp(ds[j], -room_to_move(at_, j, -1), room_to_move(at_, j, 1)));
    for (const CoupledDescent& group : coupled_) {
      double least = 1;
      for (const int j : group.riders())
        if (ds[j] != 0) least = std::min(least, parts[j] / ds[j]);
      for (const int j : group.riders()) parts[j] = least * ds[j];
    }
    return parts;
  }

  // Moves held riders to an equilibrium, by all of `parts`, or by half of them again and again where none is
  // near. Newton's first step predicts it to first order. `parts` become the moves made.
  bool move_by(std::vector<double>& parts) {
    const auto moved_places = [&] {
      std::vector<double> places = present_places(at_);
      for (std::size_t j = 0; j < places.size(); ++j) places[j] += parts[j];
      return places;
    };
    constexpr int most_halvings = 5;
    std::vector<double> all = parts;
    for (int halvings = 0; halvings <= most_halvings; ++halvings) {
      nearby_only_ = true;
      const StaticReport found = equilibrium_of(held_at(at_, moved_places()));
      nearby_only_ = false;
      if (found.status == StaticStatus::converged) return true;
      for (double& part : parts) part /= 2;
    }
    parts = std::move(all);
    return hold_in_equilibrium(held_at(at_, moved_places()));
  }

  // Moves held riders by ds from equilibrium to equilibrium, never past a node at once, and applies length
  // control on the way.
  bool move_places(std::vector<double> ds) {
    while (std::any_of(ds.begin(), ds.end(), [](double rest) { return rest != 0; })) {
      std::vector<double> parts = parts_at_once(ds);
      if (!move_by(parts)) return false;
      for (int j = 0; j < riders(); ++j) {
        ds[j] -= parts[j];
        const int dof = at_.system->mesh().riders[j].place;
        if (dof >= 0) at_.state.v[dof] = parts[j];  // length control looks at it
      }
      // Kept alive, so that no other system gets its address.
      const std::shared_ptr<const BeamSystem> before = at_.system;
      if (!settle_mesh() || !goes_on(meeting_bodies(at_))) return false;
      at_.state.v.setZero();
      if (at_.system != before && !hold_in_equilibrium(held_at(at_, present_places(at_)))) return false;
    }
    return true;
  }

  // Frees the riders that are not `held`, if there is an equilibrium nearby; else nothing changes.
  void free_bodies(const std::vector<bool>& held) {
    MeshedState freed{at_.system->replanned(at_.system->mesh().plan, held), at_.state};
    bool near = find_equilibrium(freed, held).status == StaticStatus::converged;
    for (int j = 0; near && j < riders(); ++j) {
      const auto s = place(*freed.system, freed.state, j);
      near = !s || std::abs(*s - *place(*at_.system, at_.state, j)) < 1e-3 * spacing(j);
    }
    if (near) at_ = std::move(freed);
    report_.freed = near || std::count(held.begin(), held.end(), false) == 0;
  }

  MeshedState& at_;
  const LengthControl& control_;
  const std::function<bool()>& interrupted_;
  std::optional<double> equilibrium_;  // time of the last equilibrium found
  std::vector<CoupledDescent> coupled_;
  bool watches_ = false;
  bool nearby_only_ = false;  // accept only an equilibrium that Newton's method finds at once
  RestReport report_;
};

// The riders whose bodies look for their resting place. `otherwise`: the rule for StaticPlace::automatic.
std::vector<bool> sliding_at_rest(const BeamModel& model, StaticPlace otherwise) {
  std::vector<bool> slides;
  for (const Rider& rider : model.riders) {
    const StaticPlace rest = rider.rest == StaticPlace::automatic ? otherwise : rider.rest;
    slides.push_back(!rider.motion && rest != StaticPlace::held);
  }
  return slides;
}

// Those of the sliding bodies that must not be held.
std::vector<bool> firmly_sliding(const BeamModel& model, std::vector<bool> slides) {
  for (std::size_t j = 0; j < slides.size(); ++j)
    slides[j] = slides[j] && model.riders[j].rest != StaticPlace::free_or_held;
  return slides;
}

RestReport start_with(MeshedState& at, const std::vector<bool>& slides, const LengthControl& control,
                      const std::function<bool()>& interrupted) {
  RestSearch search(at, control, interrupted);
  search.watching_snaps();
  const bool any = std::find(slides.begin(), slides.end(), true) != slides.end();
  return any ? search.rest(slides) : search.held_start();
}

// Whether a rider that may be held has run to a rest far from its drawn place.
bool is_far(const MeshedState& at, const std::vector<bool>& slides) {
  constexpr double far = 0.1;  // of the beam
  for (int j = 0; j < static_cast<int>(slides.size()); ++j) {
    const Rider& rider = at.system->model().riders[j];
    if (!slides[j] || rider.rest != StaticPlace::free_or_held) continue;
    const ReferenceCurve& curve = at.system->model().beam_of(rider).curve;
    const auto s = place(*at.system, at.state, j);
    if (!s || std::abs(curve.unrolled(*s, rider.s) - rider.s) > far * curve.length()) return true;
  }
  return false;
}

// The riders that may be held and are, with a force that does not come of round-off; friction is judged where
// the motion starts.
void add_held(const MeshedState& at, const std::vector<bool>& slides, RestReport& report) {
  constexpr double much = 1e-3;  // of the force between body and beam
  for (int j = 0; j < static_cast<int>(slides.size()); ++j) {
    const Rider& rider = at.system->model().riders[j];
    if (!slides[j] || rider.rest != StaticPlace::free_or_held || rider.friction) continue;
    const double force = holding_force(*at.system, at.state, j);
    if (std::abs(force) > much * joint_force(*at.system, at.state, j).norm())
      report.held_instead.push_back({j, force, 0});
  }
}

}  // namespace

RestReport find_held_equilibrium(MeshedState& at, const std::function<bool()>& interrupted) {
  return RestSearch(at, LengthControl{}, interrupted).held_equilibrium();
}

namespace {

RestReport find_still_start(MeshedState& at, const LengthControl& control,
                            const std::function<bool()>& interrupted) {
  const std::vector<bool> slides = sliding_at_rest(at.system->model(), StaticPlace::held);
  const std::vector<bool> firmly = firmly_sliding(at.system->model(), slides);
  const MeshedState drawn = at;
  RestReport report = start_with(at, slides, control, interrupted);
  if (firmly != slides && !report.interrupted && (report.failure || is_far(at, slides))) {
    const MeshedState found = std::exchange(at, drawn);
    RestReport held = start_with(at, firmly, control, interrupted);
    held.load_steps += report.load_steps;
    held.newton_iterations += report.newton_iterations;
    if (held.failure)
      at = found;
    else
      report = std::move(held);
  } else if (report.freed) {
    return report;
  }
  if (!report.failure && !report.interrupted) add_held(at, slides, report);
  return report;
}

}  // namespace

RestReport find_start(MeshedState& at, const LengthControl& control,
                      const std::function<bool()>& interrupted) {
  const std::shared_ptr<const BeamModel> model = at.system->shared_model();
  if (std::ranges::none_of(model->beams, [](const Beam& beam) { return beam.flow != 0; }))
    return find_still_start(at, control, interrupted);
  auto running = std::make_shared<BeamModel>(*model);
  running->runs_at_rest = true;
  const auto in_model = [&](std::shared_ptr<const BeamModel> of) {
    at.system = std::make_shared<BeamSystem>(std::move(of), at.system->mesh().plan, at.system->held());
  };
  in_model(std::move(running));
  RestReport report = find_still_start(at, control, interrupted);
  in_model(model);
  return report;
}

RestReport find_rest(MeshedState& at, const LengthControl& control,
                     const std::function<bool()>& interrupted) {
  return RestSearch(at, control, interrupted)
      .watching_snaps()
      .rest(sliding_at_rest(at.system->model(), StaticPlace::free));
}

RestReport find_next_rest(MeshedState& at, double t, const LengthControl& control,
                          const std::function<bool()>& interrupted) {
  RestSearch search(at, control, interrupted, at.state.t);
  at.state.t = t;
  return search.watching_snaps().rest(sliding_at_rest(at.system->model(), StaticPlace::free));
}

}  // namespace nurbeam
