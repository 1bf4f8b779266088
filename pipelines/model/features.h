#pragma once
#include <set>
#include <string>

#include "fem/model/beam_model.h"
#include "fem/motion/rest/modes.h"
#include "fem/motion/run/simulation_options.h"

namespace nurbeam {

/// Short names of what a computation uses, such as "torsion" or "friction: capstan".
using Features = std::set<std::string>;

/// The features of a model: elements, sections and laws of its beams, supports, joints, bodies, connectors
/// and loads.
Features features_of(const BeamModel& model);

/// The kind of analysis; of a motion also its integrator.
Features features_of(const SimulationOptions& options);
Features features_of(const ModesOptions& options);

/// All names that features_of() may give.
const Features& all_features();

}  // namespace nurbeam
