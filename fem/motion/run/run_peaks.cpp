#include "fem/motion/run/run_peaks.h"

#include <utility>

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

void show_notable(Run& run) {
  for (const PeakMoment& moment : run.peaks.take_notable()) run.observer.peak(snapshot_of(run, moment));
}

}  // namespace

void watch_for_peaks(Run& run, const State& before, bool first, double length_before) {
  if (!run.observer.peak || !run.peaks.passes_peak(run.at.system, run.at.state, first)) return;
  run.peaks.keep({before, length_before, run.account});
  if (run.peaks.is_full()) show_notable(run);
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
