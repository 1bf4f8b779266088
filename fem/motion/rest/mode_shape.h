#pragma once
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "fem/motion/rest/modes.h"

namespace nurbeam {

/// The amplitude [s.u.] that makes a shape well visible: no node moves by more than a twentieth of the
/// model's size, no slope by more than 0.5 and no section turns by more than 0.5.
double visible_amplitude(const MeshedState& at, const Mode& mode);

/// The state at rest moved by `amount` times the shape: places of the points, and velocities of `rate` times
/// the shape. Section forces, energies and reactions stay those at rest, as they would mean nothing for large
/// linear displacements.
Snapshot record_mode(const MeshedState& at, const Mode& mode, double amount, double rate,
                     const std::vector<ProbePlace>& probes);

}  // namespace nurbeam
