#include "pipelines/run/round_off.h"

#include <algorithm>
#include <cmath>

namespace nurbeam {

std::map<std::string, double> round_off(const BeamModel& model, const SimulationReport& run) {
  constexpr double of_places = 1e-12, of_strains = 1e-13;
  double size = 0, stiffness = 0, modulus = 0, couple = 0, strain_energy = 0;
  for (const Beam& beam : model.beams) {
    for (const double s : beam.curve.breaks())
      size = std::max(size, beam.curve.position(s).lpNorm<Eigen::Infinity>());
    if (beam.rigid) continue;
    const double EA = beam.properties.free_axial_stiffness(), L = beam.curve.length();
    stiffness = std::max(stiffness, EA);
    couple = std::max(couple, EA * L);
    modulus = std::max(modulus, beam.material.youngs_modulus);
    strain_energy += EA * L;
  }
  for (const Body& body : model.bodies) stiffness = std::max(stiffness, body.mass * model.gravity.norm());
  const bool is_motion = std::isfinite(run.strain_energy.least);
  return {{"m", of_places * size},
          {"m/s", of_places * size},
          {"N", of_strains * stiffness},
          {"N m", of_strains * couple},
          {"Pa", of_strains * modulus},
          {"J", is_motion ? run.energy_round_off() : of_strains * of_strains * strain_energy}};
}

}  // namespace nurbeam
