#pragma once
#include <vector>

#include "fem/motion/record/snapshot.h"
#include "fem/motion/rest/modes.h"

namespace nurbeam {

/// The amplitude [s.u.] that makes a shape well visible: no node moves by more than a twentieth of the
/// model's size, no slope by more than 0.5 and no section turns by more than 0.5.
double visible_amplitude(const MeshedState& at, const Mode& mode);

/// How short the waves of a mode of bending are.
struct BendingWave {
  int beam = -1;         ///< the beam that bends in the shortest waves of those that bend much; -1: none does
  double half_wave = 0;  ///< pi (int w^2 ds/int w_ss^2 ds)^(1/4), w across the axis [m]
  double diameters = 0;  ///< the half wave in diameters of a disk with the beam's radius of gyration
};
/// The waves of a vibration in which bending has at least half of the energy; else of no beam.
BendingWave bending_wave(const MeshedState& at, const Mode& mode);

/// How well the elements of a beam follow the waves of a mode.
struct WaveResolution {
  int beam = -1;     ///< the beam that follows them worst of those that move much; -1: none moves in waves
  int elements = 0;  ///< of the beam
  double half_wave = 0;      ///< pi (int |d_s|^2 ds/int |d_ss|^2 ds)^(1/2), d the displacement [m]
  double per_half_wave = 0;  ///< elements a half wave
};
WaveResolution wave_resolution(const MeshedState& at, const Mode& mode);

/// The state at rest moved by `amount` times the shape: places of the points, and velocities of `rate` times
/// the shape. Section forces, energies and reactions stay those at rest, as they would mean nothing for large
/// linear displacements.
Snapshot record_mode(const MeshedState& at, const Mode& mode, double amount, double rate,
                     const std::vector<ProbePlace>& probes);

}  // namespace nurbeam
