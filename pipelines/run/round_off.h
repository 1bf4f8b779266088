#pragma once
#include <map>
#include <string>

#include "fem/model/beam_model.h"
#include "fem/motion/record/simulation_report.h"

namespace nurbeam {

/// What the round-off of a run may make of a value that is 0, by its unit: "m", "m/s", "N", "N m", "Pa", "J".
/// Lengths go by the size of the model and its distance from the origin, forces and stresses by the strains
/// that such positions have.
std::map<std::string, double> round_off(const BeamModel& model, const SimulationReport& run);

}  // namespace nurbeam
