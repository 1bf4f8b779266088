#pragma once
#include <string>
#include <vector>

#include "fem/model/beam_model.h"
#include "fem/motion/run/simulation.h"

namespace nurbeam {

/// Three drawings of the arc of [S], the subdivision paper: radius 0.5 m, 60 degrees, from A = (0, 0) with
/// the tangent +x to B = (0.433, 0.25). They differ in the parameter only.
enum class PendulumArc {
  uniform,  ///< symmetric weights
  paper,    ///< nodal slopes and weights as [S] prints them, to their digits (arc length 2e-7 m short)
  extreme   ///< |r'(1)| = 16 |r'(0)|: the conic with weights 1, cos(30 deg)/4, 1/16, raised to degree 3
};
RationalCubic pendulum_axis(PendulumArc arc);

/// Section radius 0.02 m, density 6000 kg/m^3, E = 2e6 Pa, pointwise axial strain. `thinner`: so many times
/// less high, with the same bending stiffness and mass; EA grows by its square.
BeamProperties pendulum_section(double thinner = 1);

/// How the pendulum is divided and measured; planar, pinned at A, stress-free as drawn.
struct PendulumMesh {
  PendulumArc arc = PendulumArc::uniform;
  int elements = 8;    ///< in reference arc length
  double grading = 0;  ///< k of Eq. (17) of [S] [m]
  bool ancf = false;   ///< all weights 1
  bool metric = true;  ///< false: integrals over the label alone, as [S]
  CurvatureMeasure curvature = CurvatureMeasure::spatial;
  double thinner = 1;  ///< pendulum_section()
};
BeamModel pendulum_model(const PendulumMesh& mesh);

/// A motion from rest at evenly spaced times; shorter than asked for when the run ended early.
struct PendulumMotion {
  std::vector<double> t;       ///< [s]
  std::vector<double> AB;      ///< distance of the ends [m]
  std::vector<double> fall;    ///< y_B(t) - y_B(0) [m]
  std::vector<double> length;  ///< of the beam [m]
  std::vector<BeamRecord> beam;
  SimulationReport report;
  double drift() const { return report.energy_drift / report.peak_kinetic_energy; }
};
/// Runs the pendulum for 1 s with fixed steps [s] and keeps intervals + 1 times.
PendulumMotion pendulum_motion(const PendulumMesh& mesh, const IntegratorSettings& integrator, double step,
                               int intervals = 100);
/// Generalized-alpha (rho_infinity 0.9) extrapolated from `step` and half of it to step 0: at 2e-4 s what is
/// left of the step's error is below 1e-6 m, so that of the mesh remains.
PendulumMotion extrapolated_pendulum_motion(const PendulumMesh& mesh, double step, int intervals = 100);

/// Largest differences over the times that both motions have [m].
struct PendulumError {
  double AB, fall;
};
PendulumError largest_difference(const PendulumMotion& a, const PendulumMotion& b);

}  // namespace nurbeam
