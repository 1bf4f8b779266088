#pragma once
#include "fem/material/section.h"

namespace nurbeam {

/// Whether an element of length l [m] of a beam follows the rules of ropes at free slopes and against folds.
/// In stiffer elements bending holds a free end straight, and keeps them from folding. On coarse meshes they
/// are better without: a free slope turns aside where the axial force falls by w l, w l^3 > 12 EI, and a beam
/// that is bent much has a strain that folds would have.
inline bool is_slender(const BeamProperties& beam, double l) {
  constexpr double slender = 1e5;  // EA l^2/EI
  return beam.axial_stiffness * l * l >= slender * beam.bending_stiffness;
}

}  // namespace nurbeam
