#include "fem/motion/run/run_peaks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "fem/motion/record/adrift.h"
#include "fem/system/observables.h"
#include "nurbs/golden_section.h"

namespace nurbeam {

namespace {

Snapshot snapshot_of(const Run& run, const PeakMoment& moment) {
  const BeamSystem& system = *run.peaks.system();
  SnapshotContents contents = run.observer.contents;
  contents.probes = false;
  Snapshot snapshot =
      record_snapshot(system, run.at_the_moment(system, moment.state, moment.step), {}, contents,
                      [](int, std::vector<ElementRecord>& elements) { elements.clear(); });
  moment.account.enter(snapshot);
  return snapshot;
}

// A snapshot of a moment of which nothing is known: its values are no numbers.
Snapshot blank_snapshot(const Run& run, double time) {
  constexpr double unknown = SectionRecord::no_number;
  const Eigen::Vector3d nowhere = Eigen::Vector3d::Constant(unknown);
  const BeamModel& model = *run.model;
  const SnapshotContents& contents = run.observer.contents;
  Snapshot snapshot;
  snapshot.time = time;
  if (contents.beams) snapshot.beams.resize(model.beams.size());
  snapshot.bodies.assign(model.bodies.size(), {{nowhere, nowhere}, std::nullopt, nowhere});
  if (contents.reactions) snapshot.reactions.assign(model.constraints.size(), {nowhere, nowhere, nowhere});
  snapshot.connectors.assign(model.connectors.size(), {unknown, unknown});
  if (contents.measures) snapshot.measures.resize(model.measures.size());
  for (double* each : {&snapshot.energy.kinetic, &snapshot.energy.axial, &snapshot.energy.bending})
    *each = unknown;
  return snapshot;
}

// The way of a rider's body along a guide in a step: the cubic of time through the places and the speeds at
// both ends. Parts of the step are from 0 to 1.
class WayOnGuide {
 public:
  WayOnGuide(const BeamSystem& system, const State& from, const State& to, int rider)
      : curve_(system.model().beam_of(system.model().riders[rider]).curve),
        gravity_(system.model().gravity),
        h_(to.t - from.t),
        places_{*nurbeam::place(system, from, rider), *nurbeam::place(system, to, rider)},
        rates_{place_rate(system, from, rider), place_rate(system, to, rider)} {}

  double place(double x) const {
    const double y = 1 - x;
    return y * y * (1 + 2 * x) * places_[0] + x * x * (1 + 2 * y) * places_[1] +
           h_ * x * y * (y * rates_[0] - x * rates_[1]);
  }
  double rate(double x) const {
    const double y = 1 - x;
    return 6 * x * y * (places_[1] - places_[0]) / h_ + y * (1 - 3 * x) * rates_[0] +
           x * (1 - 3 * y) * rates_[1];
  }
  CurvePoint point(double x) const { return curve_.point_in(curve_.segment_at(place(x)), place(x)); }
  // The force across the guide that a body asks for, over its mass [m/s^2].
  Eigen::Vector3d pull(double x) const {
    const CurvePoint p = point(x);
    return rate(x) * rate(x) * p.curvature - (gravity_ - gravity_.dot(p.tangent) * p.tangent);
  }

 private:
  const ReferenceCurve& curve_;
  Eigen::Vector3d gravity_;
  double h_;
  std::array<double, 2> places_, rates_;
};

// The part of a step at which a size is largest, where it is larger than `shown`, which it then becomes;
// nothing where it is not.
template <class Size>
std::optional<double> place_of_peak(const Size& size, double& shown) {
  constexpr int parts = 8, refinements = 12;
  constexpr double least_excess = 1e-3;
  double most = (1 + least_excess) * shown, where = -1;
  for (int i = 0; i <= parts; ++i) {
    const double x = i / static_cast<double>(parts), here = size(x);
    if (here > most) {
      most = here;
      where = x;
    }
  }
  if (where < 0) return std::nullopt;
  const double x = minimum_place([&](double part) { return -size(part); }, std::max(0.0, where - 1. / parts),
                                 std::min(1.0, where + 1. / parts), refinements);
  shown = std::max(most, size(x));
  return size(x) > most ? x : where;
}

void show_notable(Run& run) {
  for (const PeakMoment& moment : run.peaks.take_notable()) run.observer.peak(snapshot_of(run, moment));
}

}  // namespace

void watch_for_peaks(Run& run, const State& before, bool first, double length_before) {
  if (!run.observer.peak || !run.peaks.passes_peak(run.at.system, run.at.state, first)) return;
  run.peaks.keep({before, length_before, run.account});
  if (run.peaks.is_full()) show_notable(run);
}

void look_within(Run& run, const State& before, double length_before) {
  if (!run.observer.peak || run.options.step || run.at.state.t <= before.t) return;
  const BeamSystem& system = *run.at.system;
  const State& after = run.at.state;
  const BeamModel& model = system.model();
  run.shown_on_guides.resize(model.riders.size());
  for (int rider = 0; rider < static_cast<int>(model.riders.size()); ++rider) {
    if (!model.beam_of(model.riders[rider]).rigid || !place(system, after, rider)) continue;
    const WayOnGuide way(system, before, after, rider);
    GuidePeaks& shown = run.shown_on_guides[rider];
    for (const auto& peak : {place_of_peak([&](double x) { return way.pull(x).norm(); }, shown.pull),
                             place_of_peak([&](double x) { return std::abs(way.rate(x)); }, shown.speed)}) {
      if (!peak) continue;
      const double x = *peak, y = 1 - x;
      // Whatever else acts on the body changes evenly in the step.
      const auto force = [&](const State& state, double length) {
        return joint_force(system, run.at_the_moment(system, state, length), rider);
      };
      const CurvePoint p = way.point(x);
      Snapshot snapshot = blank_snapshot(run, y * before.t + x * after.t);
      BodyRecord& body = snapshot.bodies[model.riders[rider].body];
      body.point = {p.position, way.rate(x) * p.tangent};
      body.s = model.beam_of(model.riders[rider]).curve.wrapped(way.place(x));
      body.joint_force =
          y * force(before, length_before) + x * force(after, run.last_step) +
          model.body_of(model.riders[rider]).mass * (way.pull(x) - y * way.pull(0) - x * way.pull(1));
      run.observer.peak(std::move(snapshot));
    }
  }
}

void show_arrival(const Run& run, int rider) {
  if (!run.observer.peak) return;
  const BeamSystem& system = *run.at.system;
  const State& state = run.at.state;
  const Rider& arriving = system.model().riders[rider];
  const int r = system.mesh().bodies[arriving.body];
  Snapshot snapshot = blank_snapshot(run, state.t);
  BodyRecord& body = snapshot.bodies[arriving.body];
  body.point = {vector_at(system, state.q, r), vector_at(system, state.v, r)};
  body.s = system.model().beam_of(arriving).curve.wrapped(*place(system, state, rider));
  snapshot.energy = record_energy(energy(system, state));
  snapshot.energy.adrift = kinetic_energy_adrift(system, state, bodies_adrift(system, state));
  run.observer.peak(std::move(snapshot));
}

std::vector<Snapshot> snapshots_of_peaks(const Run& run) {
  std::vector<Snapshot> snapshots;
  for (const PeakMoment& moment : run.peaks.kept()) snapshots.push_back(snapshot_of(run, moment));
  return snapshots;
}

void leave_former_peaks(Run& run) {
  if (run.peaks.system() && run.peaks.system() != run.at.system) show_notable(run);
}

}  // namespace nurbeam
