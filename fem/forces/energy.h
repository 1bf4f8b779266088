#pragma once

namespace nurbeam {

/// Energies of the whole model [J].
struct SystemEnergy {
  double kinetic = 0, gravity = 0, axial = 0, bending = 0, torsion = 0;
  double dissipation = 0;  ///< rate of energy lost to material damping [W]
  double mechanical() const { return kinetic + gravity + axial + bending + torsion; }
};

}  // namespace nurbeam
