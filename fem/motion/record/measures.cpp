#include "fem/motion/record/measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "fem/system/material_points.h"
#include "fem/system/observables.h"
#include "fem/system/stress_resultants.h"
#include "nurbs/golden_section.h"

namespace nurbeam {

namespace {

using Eigen::Vector3d;
constexpr double nothing = std::numeric_limits<double>::infinity();

// A beam in a state, by reference arc length.
class ShapeOfBeam {
 public:
  ShapeOfBeam(const BeamSystem& system, const State& state, int beam)
      : system_(system), state_(state), beam_(beam), first_(system.mesh().first_span[beam]) {}

  double start() const { return system_.mesh().spans[first_].start(state_.q); }
  double end() const { return system_.mesh().spans[system_.mesh().first_span[beam_ + 1] - 1].end(state_.q); }
  double place(const PartEnd& end) const {
    if (end.rider < 0) return end.s;
    const int place = system_.mesh().riders[end.rider].place;  // none after it has left
    return place < 0 ? std::nan("") : state_.q[place];
  }
  Vector3d point(double s) const {
    const int span = find_span(system_.model(), system_.mesh(), state_.q, beam_, s);
    return material_point_in(system_, state_, span, s).r;
  }

  // Where a height is least between two places: samples in each element, then a search beside the lowest.
  // Infinite heights count for nothing.
  template <class Height>
  Extreme lowest(double from, double to, const Height& height) const {
    constexpr int samples = 4, steps = 40;
    const auto at = [&](double s) { return height(point(s)); };
    double best = nothing, s_best = 0, beside = 0;
    const auto look_at = [&](double s, double reach) {
      if (const double here = at(s); here < best) best = here, s_best = s, beside = reach;
    };
    for (int i = first_; i < system_.mesh().first_span[beam_ + 1]; ++i) {
      const MeshSpan& span = system_.mesh().spans[i];
      const double a = std::max(from, span.start(state_.q)), b = std::min(to, span.end(state_.q));
      for (int k = 0; k <= samples && a < b; ++k) look_at(a + (b - a) * k / samples, (b - a) / samples);
    }
    if (best == nothing) return {};
    const double s = minimum_place(at, std::max(from, s_best - beside), std::min(to, s_best + beside), steps);
    look_at(s, 0);
    return {best, s_best};
  }

 private:
  const BeamSystem& system_;
  const State& state_;
  int beam_, first_;
};

// Height over a profile: over its nearest point in plan.
class HeightOver {
 public:
  HeightOver(const std::vector<Vector3d>& profile, const Vector3d& up) : profile_(profile), up_(up) {}

  double operator()(const Vector3d& point) const {
    double nearest = nothing, height = nothing;
    bool is_beyond = true;
    for (std::size_t i = 0; i + 1 < profile_.size(); ++i) {
      const Vector3d along = profile_[i + 1] - profile_[i], from = point - profile_[i];
      const Vector3d in_plan = plan(along);
      if (in_plan.squaredNorm() == 0) continue;
      const double free = in_plan.dot(from) / in_plan.squaredNorm(), x = std::clamp(free, 0.0, 1.0);
      const double away = plan(from - x * along).norm();
      if (!(away < nearest)) continue;
      nearest = away;
      height = (from - x * along).dot(up_);
      is_beyond = (i == 0 && free < -round_off) || (i + 2 == profile_.size() && free > 1 + round_off);
    }
    return is_beyond ? nothing : height;
  }

 private:
  static constexpr double round_off = 1e-9;
  Vector3d plan(const Vector3d& v) const { return v - v.dot(up_) * up_; }

  const std::vector<Vector3d>& profile_;
  Vector3d up_;
};

Extreme sag_of(const ShapeOfBeam& part, const PartSag& of, const Vector3d& up) {
  constexpr double upright = 0.1;  // as of Chord
  const double from = part.place(of.from), to = part.place(of.to);
  if (!(from < to)) return {};
  const Vector3d start = part.point(from), chord = part.point(to) - start;
  const Vector3d across = chord - chord.dot(up) * up;
  if (across.norm() <= upright * chord.norm()) return {};
  Extreme lowest = part.lowest(from, to, [&](const Vector3d& point) {
    const Vector3d d = point - start;
    return d.dot(up) - d.dot(across) / across.squaredNorm() * chord.dot(up);
  });
  lowest.value = std::max(-lowest.value, 0.0);
  return lowest;
}

// The tension of a beam beside a rider that is a node; else at its place.
double tension_beside(const BeamSystem& system, const State& state, int rider, int side) {
  const Mesh& mesh = system.mesh();
  const int beam = system.model().riders[rider].beam, node = mesh.riders[rider].node;
  const double s = state.q[mesh.riders[rider].place];
  const int span =
      node < 0 ? find_span(system.model(), mesh, state.q, beam, s) : spans_at(mesh, beam, node)[side];
  return section_at(system, state, span, CarriedBySpans(system, state)[span], s).axial_force;
}

double wrap_at(const BeamSystem& system, const State& state, int rider) {
  const Mesh& mesh = system.mesh();
  const int node = mesh.riders[rider].node;
  if (node < 0) return 0;
  const MeshNode& at = mesh.nodes[system.model().riders[rider].beam][node];
  const Vector3d before = vector_at(system, state.q, at.slope_left).normalized(),
                 behind = vector_at(system, state.q, at.slope_right).normalized();
  return 2 * std::atan2((behind - before).norm(), (behind + before).norm());
}

// The tension where the rope leaves a reel: on its one side.
double tension_at_mouth(const BeamSystem& system, const State& state, int rider) {
  return tension_beside(system, state, rider, system.model().riders[rider].reel->at_start ? 1 : 0);
}

// The reference length of a beam that is on none of its reels [m].
double length_out(const BeamSystem& system, const State& state, int beam) {
  const BeamModel& model = system.model();
  double length = model.beams[beam].curve.length();
  for (std::size_t j = 0; j < model.riders.size(); ++j) {
    const int place = system.mesh().riders[j].place;
    if (model.riders[j].beam == beam && model.riders[j].reel && place >= 0)
      length -= model.stored_length(model.riders[j], state.q[place]);
  }
  return length;
}

Extreme at_ring(const BeamSystem& system, const State& state, const AtRing& of) {
  using enum AtRing::Quantity;
  const int place = system.mesh().riders[of.rider].place;
  if (place < 0) return {};  // it has let go
  const Rider& rider = system.model().riders[of.rider];
  const ReferenceCurve& curve = system.model().beam_of(rider).curve;
  const double s = state.q[place], v = state.v[place];
  const auto value = [&] {
    switch (of.quantity) {
      case tension_before:
        return tension_beside(system, state, of.rider, 0);
      case tension_behind:
        return tension_beside(system, state, of.rider, 1);
      case wrap:
        return wrap_at(system, state, of.rider);
      case axial_force:
        return tension_at_mouth(system, state, of.rider);
      case stored:
        return system.model().stored_length(rider, s);
      case out:
        return length_out(system, state, rider.beam);
      case rate:
        return -rider.reel->sense() * v;
      case power: {
        const Vector3d slope = material_point(system, state, rider.beam, s).rs;
        return tension_at_mouth(system, state, of.rider) * slope.norm() * rider.reel->sense() * v;
      }
    }
    return std::nan("");
  };
  return {value(), curve.wrapped(s)};
}

double of_turn(const BeamSystem& system, const State& state, const OfTurn& of) {
  using enum OfTurn::Quantity;
  if (of.quantity == moment) return angle_and_moment(system, state, of.part).second;
  const AxisTurn* turn = of.of_support ? turn_of(system.model().constraints[of.part]) : nullptr;
  if (!turn) return angle_and_moment(system, state, of.part).first;
  if (of.quantity == OfTurn::Quantity::drive_moment) return nurbeam::drive_moment(system, state, of.part);
  const AngleMotion::Moment now = turn->angle.at(state.t);
  return state.load * (of.quantity == angle ? now.angle : now.rate);
}

}  // namespace

Extreme record_measure(const BeamSystem& system, const State& state, const Measure& measure) {
  if (const auto* turn = std::get_if<OfTurn>(&measure)) return {of_turn(system, state, *turn)};
  if (const auto* ring = std::get_if<AtRing>(&measure)) return at_ring(system, state, *ring);
  const Vector3d gravity = system.model().gravity;
  if (gravity.norm() == 0) return {};
  const Vector3d up = -gravity.normalized();
  if (const auto* sag = std::get_if<PartSag>(&measure))
    return sag_of(ShapeOfBeam(system, state, sag->beam), *sag, up);
  const auto& clearance = std::get<Clearance>(measure);
  const ShapeOfBeam whole(system, state, clearance.beam);
  return whole.lowest(whole.start(), whole.end(), HeightOver(clearance.profile, up));
}

}  // namespace nurbeam
