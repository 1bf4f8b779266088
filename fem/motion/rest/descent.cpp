#include "fem/motion/rest/descent.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "fem/mesh/stop_distance.h"
#include "fem/motion/events/friction_modes.h"
#include "fem/motion/remesh/sliding_bodies.h"
#include "fem/system/observables.h"

namespace nurbeam {

namespace {

// A move off a place where nothing pulls the body, which may be a summit [m]. If it comes back and rests
// there as well, it is put back. The push on a guide is small: from far off, other connections may pull the
// body back over the summit.
double push_off(const BeamModel& model, int rider, double s, Descent& body) {
  ++body.balanced;
  if (body.balanced == 1) {
    const bool came_back = std::abs(s - body.pushed_from) < 1e-6 * home_spacing(model, rider);
    body.pushed_from = s;
    if (came_back) return 0;
  }
  const bool on_guide = model.beam_of(model.riders[rider]).rigid;
  const double push = on_guide ? std::min(body.most, first_move(model, rider)) : body.most;
  return body.balanced == 1 ? push : body.balanced == 2 ? -body.moved : 0;
}

// Round-off of the force that holds a body where nothing pulls it [N]: strains are differences of coordinates
// over the length of an element.
double force_of_round_off(const MeshedState& at, int rider) {
  const BeamModel& model = at.system->model();
  const double elements = at.state.q.lpNorm<Eigen::Infinity>() / home_spacing(model, rider);
  return 8 * std::numeric_limits<double>::epsilon() *
         model.beam_of(model.riders[rider]).properties.force_of_strain(1 + elements);
}

// A move towards the place where no force is needed to hold a body [m], by the secant of the last two places.
// The holding force points uphill.
double step_down(const Descent& body, double s, double force) {
  const double downhill = force < 0 ? body.most : -body.most;
  if (body.moved == 0) return downhill;
  const double slope = (force - body.force) / (s - body.s);
  return slope > 0 ? std::clamp(-force / slope, -body.most, body.most) : downhill;
}

// The force that holds a body less the part that friction holds. A body that sticks is held by friction
// alone; a body that slides goes on until its sliding friction holds it.
double force_beyond_friction(const MeshedState& at, int rider, double force, Descent& body) {
  if (!at.system->model().riders[rider].friction) return force;
  if (body.way == 0) {
    if (std::abs(force) <= holding_capacity(*at.system, at.state, rider, true)) return 0;
    body.way = force < 0 ? 1 : -1;
  }
  return force + body.way * holding_capacity(*at.system, at.state, rider, false);
}

// The move `ds`, ended at a hard stop where it would go beyond [m].
double before_stops(const MeshedState& at, int rider, double s, double ds) {
  for (const Stop& stop : at.system->model().stops) {
    if (stop.rider != rider || stop.other >= 0 || stop.buffer) continue;
    ds = stop.from_below ? std::min(ds, std::max(0.0, stop.place - s))
                         : std::max(ds, std::min(0.0, stop.place - s));
  }
  return ds;
}

// Whether a hard stop holds a rider's body at an end of its beam.
bool stands_at(const BeamModel& model, int rider, double end, bool from_below) {
  const double same = 1e-9 * model.beam_of(model.riders[rider]).curve.length();
  return std::any_of(model.stops.begin(), model.stops.end(), [&](const Stop& stop) {
    return stop.rider == rider && stop.other < 0 && !stop.buffer && stop.from_below == from_below &&
           std::abs(stop.place - end) <= same;
  });
}

bool hard_stop_between(const BeamModel& model, int rider, int other) {
  return std::any_of(
      model.stops.begin(), model.stops.end(),
      [&](const Stop& stop) {
        return stop.other >= 0 && !stop.buffer &&
               std::minmax(stop.rider, stop.other) == std::minmax(rider, other);
      });
}

}  // namespace

double first_move(const BeamModel& model, int rider) {
  return home_spacing(model, rider) / (model.beam_of(model.riders[rider]).rigid ? 64 : 4);
}

double next_move(const MeshedState& at, int rider, Descent& body) {
  body.arrived = body.most == 0;
  if (body.arrived) return 0;
  const double force = force_beyond_friction(at, rider, holding_force(*at.system, at.state, rider), body);
  const double s = *place(*at.system, at.state, rider);
  const double spacing = home_spacing(at.system->model(), rider);
  // A move back is at most half as long: a secant over a buffer's end leads back to where it came from.
  if (body.moved != 0) body.most = body.force * force < 0 ? std::abs(body.moved) / 2 : 2 * body.most;
  body.most = std::min(body.most, 4 * spacing);
  const bool begins = body.moved == 0 || body.balanced > 0;
  const bool has_friction = at.system->model().riders[rider].friction.has_value();
  if (has_friction && body.way == 0 && force == 0 &&
      holding_capacity(*at.system, at.state, rider, true) > 0) {
    body.arrived = true;
    return 0;
  }
  const bool nothing_pulls = std::abs(force) <= (begins ? force_of_round_off(at, rider) : 0);
  double ds = nothing_pulls ? push_off(at.system->model(), rider, s, body) : step_down(body, s, force);
  if (!nothing_pulls) body.balanced = 0;
  const ReferenceCurve& curve = at.system->model().beam_of(at.system->model().riders[rider]).curve;
  const double room = 0.4 * distance_to_others(at, rider);
  const double free = std::clamp(ds, -room, room);
  const double stopped = before_stops(at, rider, s, free);
  ds = curve.closed() ? stopped : std::clamp(stopped, curve.start() - s, curve.end() - s);
  const auto goes = [&](double way) { return std::abs(way) >= 1e-6 * spacing; };
  body.arrived = !goes(ds);
  body.at_end = body.arrived && !nothing_pulls && goes(free);
  body.leaves = body.at_end && goes(stopped);
  if (body.arrived) return 0;
  body.s = s;
  body.force = force;
  body.moved = ds;
  return ds;
}

CoupledDescent::CoupledDescent(const BeamModel& model, std::vector<int> riders)
    : joints_(std::move(riders)),
      spacing_(std::numeric_limits<double>::infinity()),
      moved_(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(joints_.size()))) {
  for (const int j : joints_) spacing_ = std::min(spacing_, home_spacing(model, j));
  most_ = spacing_ / 4;
}

void CoupledDescent::next_moves(const MeshedState& at, std::vector<Descent>& bodies,
                                std::vector<double>& moves) {
  std::vector<int> movable;
  std::vector<double> forces;
  double before = 0, round_off = 0;  // before: work of the present forces on the last move
  for (std::size_t k = 0; k < joints_.size(); ++k) {
    const int j = joints_[k];
    Descent& body = bodies[j];
    body.arrived = true;
    body.at_end = body.leaves = false;
    moves[j] = 0;
    if (body.most == 0) continue;
    const double force = force_beyond_friction(at, j, holding_force(*at.system, at.state, j), body);
    before += force * moved_[static_cast<Eigen::Index>(k)];
    if (body.way == 0 && at.system->model().riders[j].friction && force == 0) continue;
    movable.push_back(j);
    forces.push_back(force);
    round_off = std::max(round_off, force_of_round_off(at, j));
  }
  most_ = std::min(before > 0 ? moved_.lpNorm<Eigen::Infinity>() / 2 : 2 * most_, 4 * spacing_);
  moved_.setZero();
  const auto H = holding_stiffness(*at.system, at.state, movable);
  if (movable.empty() || !H) return;
  std::vector<MoveLimit> within = limits(at, movable);
  // A body that slides against its friction goes on or stays.
  const auto count = static_cast<Eigen::Index>(movable.size());
  for (Eigen::Index i = 0; i < count; ++i)
    if (const int way = bodies[movable[i]].way; way != 0)
      within.push_back({way * Eigen::VectorXd::Unit(count, i), 0, MoveLimit::Of::move});
  const Eigen::Map<const Eigen::VectorXd> f(forces.data(), count);
  const LimitedMove move = least_within(f, *H, round_off, most_, within);
  const bool arrived = move.x.lpNorm<Eigen::Infinity>() < 1e-6 * spacing_;
  for (std::size_t i = 0; i < movable.size(); ++i) {
    const auto at_row = static_cast<Eigen::Index>(i);
    Descent& body = bodies[movable[i]];
    body.arrived = arrived;
    for (std::size_t k = 0; k < within.size(); ++k) {
      if (!move.pushed[k] || within[k].row[at_row] == 0) continue;
      if (within[k].of != MoveLimit::Of::move) body.at_end = arrived;
      if (within[k].of == MoveLimit::Of::end) body.leaves = arrived;
    }
    if (arrived) continue;
    // Friction is asked again whether it holds the body.
    if (std::abs(move.x[at_row]) < 1e-6 * spacing_) body.way = 0;
    moves[movable[i]] = move.x[at_row];
    moved_[std::find(joints_.begin(), joints_.end(), movable[i]) - joints_.begin()] = move.x[at_row];
  }
}

std::vector<MoveLimit> CoupledDescent::limits(const MeshedState& at, const std::vector<int>& movable) const {
  const BeamModel& model = at.system->model();
  const auto count = static_cast<Eigen::Index>(movable.size());
  std::vector<MoveLimit> all;
  using Of = MoveLimit::Of;
  const auto add = [&](const Eigen::VectorXd& row, double least, Of of) {
    if (!row.isZero()) all.push_back({row, std::min(least, 0.0), of});
  };
  const auto row_of = [&](int rider) {
    Eigen::VectorXd row = Eigen::VectorXd::Zero(count);
    const auto found = std::find(movable.begin(), movable.end(), rider);
    if (found != movable.end()) row[found - movable.begin()] = 1;
    return row;
  };
  for (const int j : movable) {
    const double s = *place(*at.system, at.state, j);
    const ReferenceCurve& curve = model.beam_of(model.riders[j]).curve;
    for (const double way : {1.0, -1.0}) add(way * row_of(j), -most_, Of::move);
    if (!curve.closed()) {
      if (!stands_at(model, j, curve.start(), false)) add(row_of(j), curve.start() - s, Of::end);
      if (!stands_at(model, j, curve.end(), true)) add(-row_of(j), s - curve.end(), Of::end);
    }
    // Without a hard stop between them, two bodies approach by at most a part of their distance in one move:
    // a buffer that a body has jumped over pushes the wrong way.
    for (int other = 0; other < static_cast<int>(model.riders.size()); ++other) {
      const double distance = distance_between(at, j, other);
      if (!std::isfinite(distance) || hard_stop_between(model, j, other)) continue;
      const double there = curve.unrolled(*place(*at.system, at.state, other), s);
      const Eigen::VectorXd apart = row_of(other) - row_of(j);
      add(there > s ? apart : Eigen::VectorXd(-apart), -0.4 * distance, Of::move);
    }
  }
  for (const Stop& stop : model.stops) {
    if (stop.buffer || !is_in_place(at.system->mesh(), stop)) continue;
    Eigen::VectorXd row = stop.weight_of_rider() * row_of(stop.rider);
    if (stop.other >= 0) row += stop.weight_of_other() * row_of(stop.other);
    add(row, -StopDistance(model, at.system->mesh(), stop).value(at.state.q), Of::stop);
  }
  return all;
}

}  // namespace nurbeam
