#pragma once

namespace nurbeam {

/// Energies of the whole model [J].
struct SystemEnergy {
  double kinetic = 0, gravity = 0, axial = 0, bending = 0, torsion = 0;
  double spring = 0;       ///< energy of all elastic parts other than beams
  double dissipation = 0;  ///< rate of energy lost to damping [W]
  double mechanical() const { return kinetic + gravity + axial + bending + torsion + spring; }
  double strain() const { return axial + bending + torsion + spring; }
};

}  // namespace nurbeam
