#pragma once
#include "fem/motion/run/run.h"

/// What is largest between two snapshots of a run (PeakWatch), for its observer.
namespace nurbeam {

/// Looks at the end of a step, and keeps its start, `before`, where something is larger there than ever
/// before. `first`: see PeakWatch::passes_peak; `length_before`: length of the step before it [s].
void watch_for_peaks(Run& run, const State& before, bool first, double length_before);

/// Looks into a step of error control: where a body on a guide is faster than ever before, or the guide's
/// bend and the way it runs ask for more force, shows speed and force. `before`, `length_before`: as above.
void look_within(Run& run, const State& before, double length_before);

/// Shows how fast a rider's body is as it comes to an end of its beam, and the energies then.
void show_arrival(const Run& run, int rider);

/// Snapshots of the moments that are kept, without elements and probes.
std::vector<Snapshot> snapshots_of_peaks(const Run& run);

/// Shows the notable moments where the mesh or the model is another than theirs.
void leave_former_peaks(Run& run);

}  // namespace nurbeam
